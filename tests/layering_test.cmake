# Fails if a folder includes one on its right in
#   features <- solvers <- robust <- experiments
#   cmake -DROOT=. -P tests/layering_test.cmake
set(features_sees "features/")
set(solvers_sees "features/|solvers/")
set(robust_sees "features/|solvers/|robust/")
set(experiments_sees "features/|solvers/|robust/|experiments/")

set(num_checked 0)
foreach(folder features solvers robust experiments)
  file(GLOB_RECURSE sources "${ROOT}/${folder}/*.h" "${ROOT}/${folder}/*.cc")
  foreach(source ${sources})
    file(STRINGS "${source}" includes REGEX "^#include \"")
    foreach(include ${includes})
      math(EXPR num_checked "${num_checked} + 1")
      if(NOT include MATCHES "^#include \"(${${folder}_sees})")
        message(SEND_ERROR "${source}: ${include}")
      endif()
    endforeach()
  endforeach()
endforeach()
if(num_checked EQUAL 0)
  message(SEND_ERROR "no includes found under '${ROOT}'")
endif()
