# Settings that all of our targets share.
#   quatro_target(<name>)
function(quatro_target name)
  target_compile_features(${name} PUBLIC cxx_std_20)
  # Contraction would make results depend on the SIMD path.
  target_compile_options(${name} PRIVATE
      -Wall -Wextra -Wshadow -Wconversion -ffp-contract=off
      # Calls within a library stay within it; symbol interposition is not
      # supported.
      -fno-semantic-interposition
      # GCC 12 reports a false overlap in "literal" + std::string (its bug
      # 105651). It skips garbage collection below 512 MB, which saves an eighth
      # of its time.
      $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict;--param=ggc-min-heapsize=524288>)
  if(QUATRO_SANITIZE)
    target_compile_options(${name} PRIVATE
        -fsanitize=${QUATRO_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
    target_link_options(${name} PUBLIC -fsanitize=${QUATRO_SANITIZE})
  endif()
  if(QUATRO_FUZZ)
    # Coverage for the fuzz targets; other programs ignore it.
    target_compile_options(${name} PRIVATE -fsanitize=fuzzer-no-link)
    target_link_options(${name} PUBLIC -fsanitize=fuzzer-no-link)
  endif()
endfunction()

# One library per folder, with sources <name>.cc, linked as quatro::<folder>.
#   quatro_library(<folder> SOURCES a.cc b.cc LINKS PUBLIC x PRIVATE y)
function(quatro_library folder)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINKS;PRECOMPILE" ${ARGN})
  add_library(quatro_${folder} ${ARG_SOURCES})
  add_library(quatro::${folder} ALIAS quatro_${folder})
  target_include_directories(quatro_${folder}
      PUBLIC "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>"
      INTERFACE "$<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/include>")
  set_target_properties(quatro_${folder} PROPERTIES
      EXPORT_NAME ${folder} POSITION_INDEPENDENT_CODE ON INSTALL_RPATH "$ORIGIN"
      VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  target_link_libraries(quatro_${folder} ${ARG_LINKS})
  quatro_target(quatro_${folder})
  # Half of a source's compile time is parsing these. A compiler cache is faster
  # without.
  if(ARG_PRECOMPILE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
    target_precompile_headers(quatro_${folder} PRIVATE ${ARG_PRECOMPILE})
  endif()
  # The sources of a room are compiled as one, so that headers and templates are
  # compiled once. Off where single files are edited again and again.
  if(QUATRO_UNITY)
    set_target_properties(quatro_${folder} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
    foreach(source IN LISTS ARG_SOURCES)
      get_filename_component(room "${source}" DIRECTORY)
      set_source_files_properties("${source}" PROPERTIES UNITY_GROUP "room_${room}")
    endforeach()
    # The sources are then included: GCC takes them for headers, and GCC 14 reports
    # Eigen's SVD as uninitialized; for Clang, a local constant shadows that of
    # another source.
    target_compile_options(quatro_${folder} PRIVATE
        $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage;-Wno-maybe-uninitialized>
        $<$<CXX_COMPILER_ID:Clang>:-Wno-shadow>)
  endif()
endfunction()
