# Builds and runs a program that uses the library as others would.
#   cmake -DKIND=find_package|add_subdirectory|fetch_content -DSOURCE=repository
#         -DBUILD=its-build-folder -DFOLDER=scratch [-DSHARED=ON]
#         [-DUNITY=ON] -DVERSION=its-version -DGENERATOR=... -DCXX=compiler [-DLAUNCHER=ccache]
#         -P consumer_test.cmake
function(run what)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE code OUTPUT_VARIABLE output
                  ERROR_VARIABLE error)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "${what} ended with ${code}:\n${output}${error}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE "${FOLDER}")
set(programs features_consumer)
set(options "-DQUATRO_SOURCE=${SOURCE}")
if(KIND STREQUAL find_package)
  list(APPEND programs consumer)
  run(install ${CMAKE_COMMAND} --install "${BUILD}" --component quatro_development
      --prefix "${FOLDER}/installed")
  run(install ${CMAKE_COMMAND} --install "${BUILD}" --component quatro_programs
      --prefix "${FOLDER}/installed")
  # Whatever was installed works elsewhere, too.
  file(RENAME "${FOLDER}/installed" "${FOLDER}/moved")
  set(options "-DCMAKE_PREFIX_PATH=${FOLDER}/moved" -DCMAKE_FIND_USE_PACKAGE_REGISTRY=OFF)
  file(GLOB_RECURSE texts "${FOLDER}/moved/*.cmake" "${FOLDER}/moved/*.h")
  foreach(text IN LISTS texts)
    file(READ "${text}" content)
    foreach(path IN ITEMS "${SOURCE}" "${BUILD}" "${FOLDER}")
      string(FIND "${content}" "${path}" found)
      if(NOT found EQUAL -1)
        message(FATAL_ERROR "${text} names ${path}")
      endif()
    endforeach()
  endforeach()
  # About twenty headers are public; others are internal or not installed.
  file(GLOB_RECURSE headers RELATIVE "${FOLDER}/moved/include/quatro"
       "${FOLDER}/moved/include/quatro/*.h")
  list(FILTER headers EXCLUDE REGEX "^internal/")
  list(LENGTH headers num_headers)
  if(num_headers LESS 15 OR num_headers GREATER 25)
    message(FATAL_ERROR "${num_headers} public headers: ${headers}")
  endif()
  foreach(header IN ITEMS features/voxel_grid.h internal/features/voxel_grid.h
                          features/kd_tree.h)
    if(EXISTS "${FOLDER}/moved/include/quatro/${header}")
      message(FATAL_ERROR "${header} is installed")
    endif()
  endforeach()
  file(GLOB installed "${FOLDER}/moved/bin/quatro_*")
  foreach(program IN LISTS installed)
    get_filename_component(name "${program}" NAME)
    run(${name} "${program}" --version)
    if(NOT output STREQUAL "${name} ${VERSION}\n")
      message(FATAL_ERROR "${name} --version: ${output}")
    endif()
  endforeach()
  if(NOT installed)
    message(FATAL_ERROR "no programs were installed")
  endif()
endif()

set(configure ${CMAKE_COMMAND} -G "${GENERATOR}" -S "${CMAKE_CURRENT_LIST_DIR}/${KIND}"
    -B "${FOLDER}/build" ${options} -DCMAKE_BUILD_TYPE=Debug "-DBUILD_SHARED_LIBS=${SHARED}"
    "-DQUATRO_UNITY=${UNITY}"
    "-DCMAKE_CXX_COMPILER=${CXX}" "-DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}"
    "-DCMAKE_CXX_FLAGS_DEBUG=-O0")
run(configure ${configure})
run(build ${CMAKE_COMMAND} --build "${FOLDER}/build" -j 2 --target ${programs})
foreach(program IN LISTS programs)
  run(${program} "${FOLDER}/build/${program}")
  message("${output}")
  if(NOT output MATCHES "^quatro ${VERSION}: ")
    message(FATAL_ERROR "${program}: another version than ${VERSION}: ${output}")
  endif()
endforeach()

# A program with another alignment must not link: features/base/abi_guard.h.
if(KIND STREQUAL find_package)
  set(flags -DEIGEN_MAX_ALIGN_BYTES=0)
  execute_process(COMMAND "${CXX}" -mavx -E -x c++ /dev/null RESULT_VARIABLE code
                  OUTPUT_QUIET ERROR_QUIET)
  if(code EQUAL 0)
    list(APPEND flags -mavx)
  endif()
  foreach(flag IN LISTS flags)
    run("configure with ${flag}" ${configure} "-DCMAKE_CXX_FLAGS=${flag}")
    execute_process(COMMAND ${CMAKE_COMMAND} --build "${FOLDER}/build" --target features_consumer
                    RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE output)
    if(code EQUAL 0 OR NOT output MATCHES
       "undefined [^\n]*library_compiled_with_other_EIGEN_MAX_ALIGN_BYTES_than")
      message(FATAL_ERROR "compiled with ${flag}, the build ended with ${code}:\n${output}")
    endif()
  endforeach()
endif()
file(REMOVE_RECURSE "${FOLDER}")
