# Every library that quatro is built with. third_party/install.sh installs them;
# third_party/README.md lists versions and licences.
find_package(Threads REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(Ceres 2.1 REQUIRED)
find_package(glog REQUIRED)
find_package(nanoflann REQUIRED)
find_package(liblzf REQUIRED)

if(QUATRO_BUILD_EXPERIMENTS OR QUATRO_BUILD_TESTS)
  find_package(gflags REQUIRED)
  find_package(nlohmann_json 3 REQUIRED)
  find_package(embree 3 REQUIRED)
endif()
if(QUATRO_BUILD_TESTS)
  find_package(GTest REQUIRED)
endif()

# To compare with; never needed.
if(QUATRO_WITH_OPEN3D)
  find_package(Open3D REQUIRED)  # 0.16; it accepts no version but its own.
endif()
if(QUATRO_WITH_PCL)
  find_package(PCL 1.13 REQUIRED COMPONENTS features registration)
endif()
