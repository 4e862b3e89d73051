# The targets that others build against. Headers are included as
# "robust/estimators/quatro.h", as they include each other, or as
# <quatro/robust/estimators/quatro.h>, which cannot collide with other projects'
# files. Therefore both include/ and include/quatro/ are on the path, and the
# build folder has an equivalent of the former. Headers that the public ones
# include are in include/quatro/internal/, which is on the path for them.
set(QUATRO_EXPORTED features solvers robust)

configure_file(third_party/version.h.in include/quatro/version.h @ONLY)
configure_file(third_party/quatro.h.in include/quatro/quatro.h @ONLY)
foreach(folder IN LISTS QUATRO_EXPORTED)
  file(CREATE_LINK "${PROJECT_SOURCE_DIR}/${folder}"
       "${PROJECT_BINARY_DIR}/include/quatro/${folder}" SYMBOLIC)
endforeach()

if(NOT QUATRO_INSTALL)
  return()
endif()
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

# Two components: quatro_programs with the files needed to run, and
# quatro_development.
set(QUATRO_CMAKE_DIR "${CMAKE_INSTALL_LIBDIR}/cmake/quatro")
list(TRANSFORM QUATRO_EXPORTED PREPEND quatro_ OUTPUT_VARIABLE targets)
install(TARGETS quatro ${targets} EXPORT quatro
        LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}"
                COMPONENT quatro_programs NAMELINK_COMPONENT quatro_development
        ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT quatro_development
        INCLUDES DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}"
                             "${CMAKE_INSTALL_INCLUDEDIR}/quatro"
                             "${CMAKE_INSTALL_INCLUDEDIR}/quatro/internal")
install(EXPORT quatro FILE quatro-targets.cmake NAMESPACE quatro::
        DESTINATION "${QUATRO_CMAKE_DIR}" COMPONENT quatro_development)
install(CODE "set(QUATRO_SOURCE \"${PROJECT_SOURCE_DIR}\")
set(QUATRO_HEADERS \"${PROJECT_BINARY_DIR}/include/quatro/quatro.h\")
set(QUATRO_INCLUDE_DIR \"\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_INCLUDEDIR}/quatro\")"
        COMPONENT quatro_development)
install(SCRIPT third_party/install_headers.cmake COMPONENT quatro_development)
install(FILES "${PROJECT_BINARY_DIR}/include/quatro/quatro.h"
              "${PROJECT_BINARY_DIR}/include/quatro/version.h"
        DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/quatro" COMPONENT quatro_development)

string(REGEX MATCH "^[0-9]+\\.[0-9]+" QUATRO_EIGEN_VERSION "${Eigen3_VERSION}")
configure_package_config_file(
    third_party/quatro-config.cmake.in "${PROJECT_BINARY_DIR}/quatro-config.cmake"
    INSTALL_DESTINATION "${QUATRO_CMAKE_DIR}" NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file("${PROJECT_BINARY_DIR}/quatro-config-version.cmake"
                                 COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/quatro-config.cmake"
              "${PROJECT_BINARY_DIR}/quatro-config-version.cmake"
              third_party/Findliblzf.cmake
        DESTINATION "${QUATRO_CMAKE_DIR}" COMPONENT quatro_development)

foreach(package IN ITEMS programs development)
  set(name_programs quatro)
  set(name_development libquatro-dev)
  install(FILES LICENSE RENAME copyright COMPONENT quatro_${package}
          DESTINATION "${CMAKE_INSTALL_DATAROOTDIR}/doc/${name_${package}}")
endforeach()
