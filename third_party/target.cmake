# What every target of ours has in common.
#   quatro_target(<name>)
function(quatro_target name)
  target_compile_features(${name} PUBLIC cxx_std_20)
  # Contraction would make a result depend on which SIMD path was taken.
  target_compile_options(${name} PRIVATE
      -Wall -Wextra -Wshadow -Wconversion -ffp-contract=off
      # Calls within a library stay calls within it: nobody puts theirs between.
      -fno-semantic-interposition
      # GCC 12 sees an overlap in "literal" + std::string (its bug 105651). Below
      # 512 MB it collects no garbage: an eighth of its time.
      $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict;--param=ggc-min-heapsize=524288>)
  if(QUATRO_SANITIZE)
    target_compile_options(${name} PRIVATE
        -fsanitize=${QUATRO_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
    target_link_options(${name} PUBLIC -fsanitize=${QUATRO_SANITIZE})
  endif()
  if(QUATRO_FUZZ)
    # Coverage for who fuzzes; a program that does not ignores it.
    target_compile_options(${name} PRIVATE -fsanitize=fuzzer-no-link)
    target_link_options(${name} PUBLIC -fsanitize=fuzzer-no-link)
  endif()
endfunction()

# One folder, one library; sources as <name>.cc, linked as quatro::<folder>.
#   quatro_library(<folder> SOURCES a.cc b.cc LINKS PUBLIC x PRIVATE y)
function(quatro_library folder)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINKS" ${ARGN})
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
endfunction()
