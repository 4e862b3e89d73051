# Debian packages, built by `cpack` in the build folder: quatro (programs) and
# libquatro-dev. tests/install/debian_root.sh installs them on a minimal system.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_VENDOR "The quatro authors")
set(CPACK_PACKAGE_CONTACT "The quatro authors")
set(CPACK_COMPONENTS_ALL quatro_programs quatro_development)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# The package includes the libraries of a shared build.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS
    "${PROJECT_BINARY_DIR}/features" "${PROJECT_BINARY_DIR}/solvers" "${PROJECT_BINARY_DIR}/robust")

set(CPACK_DEBIAN_QUATRO_PROGRAMS_PACKAGE_NAME quatro)
set(CPACK_DEBIAN_QUATRO_PROGRAMS_PACKAGE_SECTION science)
# Needed by --picture.
set(CPACK_DEBIAN_QUATRO_PROGRAMS_PACKAGE_RECOMMENDS "python3-matplotlib, python3-numpy")
set(CPACK_COMPONENT_QUATRO_PROGRAMS_DESCRIPTION
    "Robust global registration of point clouds, programs")

set(CPACK_DEBIAN_QUATRO_DEVELOPMENT_PACKAGE_NAME libquatro-dev)
set(CPACK_DEBIAN_QUATRO_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_QUATRO_DEVELOPMENT_PACKAGE_DEPENDS
    "libeigen3-dev (>= ${QUATRO_EIGEN_VERSION}), libceres-dev (>= 2.1), libgoogle-glog-dev, liblzf-dev")
if(ZLIB_FOUND)
  string(APPEND CPACK_DEBIAN_QUATRO_DEVELOPMENT_PACKAGE_DEPENDS ", zlib1g-dev")
endif()
if(BUILD_SHARED_LIBS)
  string(APPEND CPACK_DEBIAN_QUATRO_DEVELOPMENT_PACKAGE_DEPENDS
         ", quatro (= ${PROJECT_VERSION})")
endif()
set(CPACK_COMPONENT_QUATRO_DEVELOPMENT_DESCRIPTION
    "Robust global registration of point clouds, headers and libraries")

include(CPack)
