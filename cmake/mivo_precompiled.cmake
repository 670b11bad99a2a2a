# Precompiled headers: parsing Eigen, OpenCV, ROS and GoogleTest takes most of a compiler's time. Each
# group of targets that are compiled with the same options shares one. What a file needs it includes all
# the same: scripts/check_style compiles without them, as -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON does.

set(MIVO_STANDARD_HEADERS <algorithm> <array> <cmath> <cstdint> <functional> <limits> <memory> <optional>
  <sstream> <string> <utility> <vector>)
set(MIVO_MATRIX_HEADERS <Eigen/Cholesky> <Eigen/Geometry> <opencv2/core.hpp>)

file(WRITE ${PROJECT_BINARY_DIR}/precompiled.cpp "")

# mivo_precompiled(NAME headers...): an object library whose headers others use again.
function(mivo_precompiled name)
  add_library(${name} OBJECT ${PROJECT_BINARY_DIR}/precompiled.cpp)
  target_link_libraries(${name} PRIVATE Eigen3::Eigen opencv_core)
  target_precompile_headers(${name} PRIVATE ${ARGN})
endfunction()

mivo_precompiled(mivo_precompiled_library ${MIVO_STANDARD_HEADERS} ${MIVO_MATRIX_HEADERS})

if(MIVO_WITH_ROS)
  mivo_precompiled(mivo_precompiled_ros ${MIVO_STANDARD_HEADERS} ${MIVO_MATRIX_HEADERS}
    <nav_msgs/Odometry.h> <ros/console.h> <ros/node_handle.h> <sensor_msgs/CameraInfo.h>
    <sensor_msgs/Image.h>)
  target_include_directories(mivo_precompiled_ros SYSTEM PRIVATE ${catkin_INCLUDE_DIRS})
  # Boost's package file has it for the programs; boost's headers ask for it.
  target_compile_definitions(mivo_precompiled_ros PRIVATE BOOST_ALL_NO_LIB)
endif()

if(MIVO_WITH_TESTS)
  mivo_precompiled(mivo_precompiled_test ${MIVO_STANDARD_HEADERS} ${MIVO_MATRIX_HEADERS}
    <gtest/gtest.h>)
  target_link_libraries(mivo_precompiled_test PRIVATE GTest::GTest)
  # As an executable's sources are compiled.
  target_compile_options(mivo_precompiled_test PRIVATE -fPIE ${MIVO_TEST_OPTIONS})
endif()
