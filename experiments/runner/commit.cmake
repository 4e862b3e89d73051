# Writes the commit of SOURCE into the header OUTPUT, which is modified only if
# the text changes. "-dirty" follows the commit if tracked files differ from it;
# the commit is "unknown" without git.
#   cmake -DSOURCE=. -DOUTPUT=commit_text.h -P commit.cmake
set(commit "unknown")
find_program(GIT git)
if(GIT)
  execute_process(COMMAND "${GIT}" -C "${SOURCE}" rev-parse --show-toplevel
                  OUTPUT_VARIABLE top OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  file(REAL_PATH "${SOURCE}" source)
  # Ignore a repository into which this source was unpacked.
  if(top)
    file(REAL_PATH "${top}" top)
  endif()
  if(top STREQUAL source)
    execute_process(COMMAND "${GIT}" -C "${SOURCE}" describe --always --dirty --abbrev=12 --exclude=*
                    OUTPUT_VARIABLE text OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    if(text MATCHES "^[0-9a-f]+(-dirty)?$")
      set(commit "${text}")
    endif()
  endif()
endif()
file(CONFIGURE OUTPUT "${OUTPUT}" CONTENT "#define QUATRO_COMMIT \"${commit}\"\n")
