# Fails unless runner/commit.cmake writes "unknown" outside of a clone, and does
# not modify a header that already says so.
#   cmake -DROOT=. -DFOLDER=scratch -P tests/experiments/runner/commit_test.cmake
set(header "${FOLDER}/commit_text.h")
file(REMOVE_RECURSE "${FOLDER}")
file(MAKE_DIRECTORY "${FOLDER}/unpacked")

function(expect_commit source pattern)
  execute_process(COMMAND ${CMAKE_COMMAND} -DSOURCE=${source} -DOUTPUT=${header}
                          -P ${ROOT}/experiments/runner/commit.cmake
                  RESULT_VARIABLE code)
  file(READ "${header}" text)
  if(code OR NOT text MATCHES "^#define QUATRO_COMMIT \"(${pattern})\"\n$")
    message(SEND_ERROR "${source}: exit code ${code}, ${text}")
  endif()
endfunction()

expect_commit("${ROOT}" "unknown|[0-9a-f]+(-dirty)?")
# Inside a clone if FOLDER is in one, or else outside of any.
expect_commit("${FOLDER}/unpacked" "unknown")
file(TIMESTAMP "${header}" before "%s")
execute_process(COMMAND ${CMAKE_COMMAND} -E sleep 1.1)
expect_commit("${FOLDER}/unpacked" "unknown")
file(TIMESTAMP "${header}" after "%s")
if(NOT before STREQUAL after)
  message(SEND_ERROR "a header that said so was written again")
endif()
