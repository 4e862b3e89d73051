# Run by cmake --install: installs the public headers, which quatro.h includes,
# as include/quatro/..., and the headers that they include in turn as
# include/quatro/internal/.... The others are not installed.
#   QUATRO_SOURCE, QUATRO_HEADERS (the umbrella quatro.h), QUATRO_INCLUDE_DIR
cmake_minimum_required(VERSION 3.22)

# Sets `result` to our headers that a file includes, relative to the root.
function(quatro_includes_of file prefix result)
  file(STRINGS "${file}" lines REGEX "^#include \"${prefix}(features|solvers|robust)/")
  list(TRANSFORM lines REPLACE "^#include \"${prefix}([^\"]+)\".*" "\\1")
  set(${result} "${lines}" PARENT_SCOPE)
endfunction()

quatro_includes_of("${QUATRO_HEADERS}" "quatro/" public)
set(found ${public})
set(queue ${public})
while(queue)
  list(POP_FRONT queue header)
  quatro_includes_of("${QUATRO_SOURCE}/${header}" "" included)
  foreach(next IN LISTS included)
    if(NOT next IN_LIST found)
      list(APPEND found ${next})
      list(APPEND queue ${next})
    endif()
  endforeach()
endwhile()
foreach(header IN LISTS found)
  cmake_path(GET header PARENT_PATH folder)
  if(NOT header IN_LIST public)
    set(folder "internal/${folder}")
  endif()
  file(INSTALL "${QUATRO_SOURCE}/${header}" DESTINATION "${QUATRO_INCLUDE_DIR}/${folder}")
endforeach()
