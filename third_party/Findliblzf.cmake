# liblzf::liblzf. Debian and conda-forge install a package configuration; others
# install the header and the library alone.
find_package(liblzf CONFIG QUIET)
if(TARGET liblzf::liblzf)
  return()
endif()
find_path(LIBLZF_INCLUDE_DIR lzf.h PATH_SUFFIXES liblzf)
find_library(LIBLZF_LIBRARY lzf)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(liblzf REQUIRED_VARS LIBLZF_LIBRARY LIBLZF_INCLUDE_DIR)
if(liblzf_FOUND)
  add_library(liblzf::liblzf UNKNOWN IMPORTED)
  set_target_properties(liblzf::liblzf PROPERTIES
      IMPORTED_LOCATION "${LIBLZF_LIBRARY}"
      INTERFACE_INCLUDE_DIRECTORIES "${LIBLZF_INCLUDE_DIR}")
endif()
