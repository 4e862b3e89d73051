# Fails unless the README's example registers two simulated scans.
#   cmake -DSIMULATE=... -DEXAMPLE=... -DFOLDER=... -P tests/readme_test.cmake
file(REMOVE_RECURSE "${FOLDER}")
execute_process(COMMAND "${SIMULATE}" --output=${FOLDER} --num_frames=2 --frame_spacing=8
                RESULT_VARIABLE code ERROR_VARIABLE error)
if(NOT code EQUAL 0)
  message(FATAL_ERROR "quatro_simulate: ${code} ${error}")
endif()
execute_process(COMMAND "${EXAMPLE}" ${FOLDER}/velodyne/000001.bin ${FOLDER}/velodyne/000000.bin
                RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE error)
file(REMOVE_RECURSE "${FOLDER}")
if(NOT code EQUAL 0 OR NOT output MATCHES "^registered: ")
  message(FATAL_ERROR "the example ended with ${code}: ${output}${error}")
endif()
