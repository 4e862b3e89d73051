# Fails if README.md, examples/README.md, CONTRIBUTING.md or a page of docs/ names
# a test or a file that does not exist, if a row of docs/fidelity.md names no
# test, or if docs/method.md names a function that its header does not have.
#   cmake -DROOT=. -P tests/readme_names_test.cmake
get_filename_component(ROOT "${ROOT}" ABSOLUTE)
file(GLOB_RECURSE sources "${ROOT}/tests/*_test.cc")
set(all_tests "")
foreach(source ${sources})
  file(STRINGS "${source}" lines REGEX "^(TEST|TEST_F|TEST_P|TYPED_TEST)\\(")
  string(APPEND all_tests "${lines}\n")
endforeach()

set(num_tests 0)
set(num_files 0)
file(GLOB pages RELATIVE "${ROOT}" "${ROOT}/*.md" "${ROOT}/examples/*.md" "${ROOT}/docs/*.md")
list(REMOVE_ITEM pages CHANGELOG.md)  # Old entries name files of their time.
foreach(page ${pages})
  file(READ "${ROOT}/${page}" text)
  string(REGEX MATCHALL "`[A-Z][A-Za-z0-9]+\\.[A-Z][A-Za-z0-9]+`" names "${text}")
  foreach(name ${names})
    string(REGEX MATCH "([A-Za-z0-9]+)\\.([A-Za-z0-9]+)" name "${name}")
    if(NOT all_tests MATCHES "\\(${CMAKE_MATCH_1}, ${CMAKE_MATCH_2}\\)")
      message(SEND_ERROR "${page} names the test ${name}, which does not exist")
    endif()
    math(EXPR num_tests "${num_tests} + 1")
  endforeach()

  # `robust/estimators/ransac.h` or `tests/install/`, with or without arguments.
  string(REGEX MATCHALL "`(features|solvers|robust|experiments|python|tests|third_party|docs|examples)/[a-z0-9_./]*"
         names "${text}")
  foreach(name ${names})
    string(SUBSTRING "${name}" 1 -1 name)
    if(NOT EXISTS "${ROOT}/${name}")
      message(SEND_ERROR "${page} names the file ${name}, which does not exist")
    endif()
    math(EXPR num_files "${num_files} + 1")
  endforeach()
endforeach()
if(num_tests LESS 60 OR num_files LESS 15)
  message(SEND_ERROR "README.md and docs/ name only ${num_tests} tests and ${num_files} files")
endif()

# In docs/fidelity.md, each row names a test or, as `QuatroOptionTest`, a suite.
file(STRINGS "${ROOT}/docs/fidelity.md" rows ENCODING UTF-8 REGEX "^\\| [^|]")
set(num_rows 0)
foreach(row ${rows})
  if(row MATCHES "\\| test \\|$")  # The header.
    continue()
  endif()
  math(EXPR num_rows "${num_rows} + 1")
  if(NOT row MATCHES "`[A-Z][A-Za-z0-9]+(\\.[A-Z][A-Za-z0-9]+)?` \\|$")
    message(SEND_ERROR "docs/fidelity.md: this row names no test: ${row}")
  endif()
endforeach()
if(num_rows LESS 35)
  message(SEND_ERROR "docs/fidelity.md has only ${num_rows} rows with tests")
endif()

# docs/method.md writes "[robust/gnc/gnc.h](../robust/gnc/gnc.h), `SolveGnc`", or
# the function first, then "," or "in".
file(READ "${ROOT}/docs/method.md" method)
set(name "`[A-Z][A-Za-z]+(\\([a-z, ]+\\))?`")
set(header "\\[[a-z_0-9/]+\\.h\\]\\(\\.\\./[a-z_0-9/]+\\.h\\)")
string(REGEX MATCHALL "${name}(,| in)[ \n]${header}" pairs "${method}")
string(REGEX MATCHALL "(^|\n)${header}, ${name}" more "${method}")
list(LENGTH pairs num_pairs)
foreach(pair ${pairs} ${more})
  string(REGEX MATCH "\\.\\./([a-z_0-9/]+\\.h)" path "${pair}")
  set(path "${CMAKE_MATCH_1}")
  string(REGEX MATCH "`([A-Za-z]+)" function "${pair}")
  set(function "${CMAKE_MATCH_1}")
  file(STRINGS "${ROOT}/${path}" lines REGEX "(^|[^A-Za-z])${function}[^A-Za-z]")
  if(NOT lines)
    message(SEND_ERROR "docs/method.md: ${path} has no ${function}")
  endif()
endforeach()
if(num_pairs LESS 8)
  message(SEND_ERROR "docs/method.md names only ${num_pairs} functions")
endif()
