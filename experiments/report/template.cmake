# Builds report_template.html in bin/../share/quatro/, for the build and for an
# install. Its dependencies are in node_modules, where third_party/install.sh
# puts them: nothing is downloaded while building.
set(QUATRO_REPORT AUTO CACHE STRING
    "Build the template of HTML reports: ON, OFF, or AUTO (if Node.js and its packages are installed)")
set(report "${CMAKE_CURRENT_SOURCE_DIR}/report")
find_program(QUATRO_NODE NAMES node nodejs)
set(has_packages OFF)
if(QUATRO_NODE AND EXISTS "${report}/node_modules/three")
  execute_process(COMMAND ${QUATRO_NODE} "${report}/node_modules/esbuild/bin/esbuild" --version
                  RESULT_VARIABLE result OUTPUT_QUIET ERROR_QUIET)
  if(result EQUAL 0)
    set(has_packages ON)
  endif()
endif()
if(QUATRO_REPORT STREQUAL AUTO AND NOT has_packages)
  message(STATUS "Node.js or its packages not found (see third_party/install.sh): no HTML reports")
elseif(QUATRO_REPORT AND NOT has_packages)
  message(FATAL_ERROR "QUATRO_REPORT=ON needs Node.js and its packages: run third_party/install.sh")
elseif(QUATRO_REPORT)
  set(template "${PROJECT_BINARY_DIR}/share/quatro/report_template.html")
  file(GLOB pages CONFIGURE_DEPENDS "${report}/page/*")
  add_custom_command(
    OUTPUT "${template}"
    COMMAND ${CMAKE_COMMAND} -E make_directory "${PROJECT_BINARY_DIR}/share/quatro"
    COMMAND ${QUATRO_NODE} "${report}/build_template.mjs" "${template}"
    DEPENDS ${pages} "${report}/build_template.mjs" "${report}/package-lock.json"
    COMMENT "Building the template of HTML reports" VERBATIM)
  add_custom_target(quatro_report_template ALL DEPENDS "${template}")
  add_dependencies(quatro_experiment quatro_report_template)
  add_dependencies(quatro_register quatro_report_template)
  if(QUATRO_INSTALL)
    install(FILES "${template}" DESTINATION "${CMAKE_INSTALL_DATAROOTDIR}/quatro"
            COMPONENT quatro_programs)
  endif()
endif()
