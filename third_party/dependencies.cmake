# All libraries with which quatro is built. third_party/install.sh installs
# them; third_party/README.md lists versions and licenses.
find_package(Threads REQUIRED)
# Without a version: a request for 3.4 would refuse Eigen 5, and a range both.
find_package(Eigen3 REQUIRED NO_MODULE)
if(Eigen3_VERSION VERSION_LESS 3.4)
  message(FATAL_ERROR "Eigen ${Eigen3_VERSION} in ${Eigen3_DIR} is too old: "
          "install 3.4 or newer, or set Eigen3_DIR")
endif()
find_package(Ceres 2.1 REQUIRED)
find_package(glog REQUIRED)
find_package(nanoflann REQUIRED)
list(APPEND CMAKE_MODULE_PATH "${CMAKE_CURRENT_LIST_DIR}")
find_package(liblzf REQUIRED)
find_package(ZLIB QUIET)
if(NOT ZLIB_FOUND)
  message(STATUS "zlib not found: no point clouds compressed by gzip")
endif()

if(QUATRO_BUILD_EXPERIMENTS OR QUATRO_BUILD_TESTS)
  find_package(gflags REQUIRED)
  find_package(nlohmann_json 3 REQUIRED)
  find_package(embree REQUIRED)
  if(NOT embree_VERSION MATCHES "^[34]\\.")
    message(FATAL_ERROR "Embree ${embree_VERSION} in ${embree_DIR}: "
            "install 3 or 4, or set embree_DIR")
  endif()
  if(QUATRO_BUILD_BENCHMARK STREQUAL AUTO)
    find_package(benchmark QUIET)
    if(NOT benchmark_FOUND)
      message(STATUS "Google Benchmark not found: no quatro_benchmark")
    endif()
  elseif(QUATRO_BUILD_BENCHMARK)
    find_package(benchmark REQUIRED)
  endif()
endif()
if(QUATRO_BUILD_TESTS)
  find_package(GTest REQUIRED)
  find_package(rapidcheck QUIET)
  if(NOT rapidcheck_FOUND)
    message(STATUS "RapidCheck not found: no tests/properties")
  endif()
endif()

# Only for comparison; never required.
if(QUATRO_WITH_OPEN3D)
  find_package(Open3D REQUIRED)  # 0.16; it accepts only its exact version.
endif()
if(QUATRO_WITH_PCL)
  # Found manually, because PCL's own configuration requires VTK, whose targets
  # need MPI.
  find_path(PCL_INCLUDE_DIR pcl/features/fpfh.h PATH_SUFFIXES pcl-1.13 pcl-1.14 pcl-1.12 REQUIRED)
  set(PCL_FOUND_LIBRARIES "")
  foreach(name IN ITEMS features registration sample_consensus search kdtree common)
    find_library(PCL_${name}_LIBRARY pcl_${name} REQUIRED)
    list(APPEND PCL_FOUND_LIBRARIES ${PCL_${name}_LIBRARY})
  endforeach()
endif()
