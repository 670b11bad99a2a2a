# What mivo is built from, in the versions of Debian 12, Ubuntu 20.04 to 24.04, and conda.

# A range would do from CMake 3.19 on; a plain 3.3 refuses Eigen 5.
find_package(Eigen3 REQUIRED NO_MODULE)
if(Eigen3_VERSION VERSION_LESS 3.3)
  message(FATAL_ERROR "mivo: Eigen 3.3 or newer is needed, found ${Eigen3_VERSION} in ${Eigen3_DIR}")
endif()

find_package(OpenCV REQUIRED COMPONENTS core imgproc imgcodecs)

# The vector kernels need Highway 1.0; without it, or with MIVO_WITH_SIMD=OFF, the plain ones serve
# alone.
option(MIVO_WITH_SIMD "Build the vector kernels (needs Highway)" ON)
if(MIVO_WITH_SIMD)
  find_package(hwy 1.0 QUIET CONFIG)
  if(NOT TARGET hwy::hwy)
    message(WARNING "mivo: Highway 1.0 not found (libhwy-dev): plain kernels only, which are 4 to 8 "
      "times slower")
  endif()
endif()

find_package(fmt REQUIRED)
find_package(Boost REQUIRED COMPONENTS program_options)
find_package(Threads REQUIRED)

find_package(yaml-cpp REQUIRED)
set(MIVO_YAML_CPP yaml-cpp)  # its name before 0.8
if(TARGET yaml-cpp::yaml-cpp)
  set(MIVO_YAML_CPP yaml-cpp::yaml-cpp)
endif()

# Python for the tests and for what is made from tables. ROS on Debian lives in the system's Python;
# another one first on the PATH does not find it. A conda's Python that has ROS stays.
if(MIVO_WITH_ROS)
  set(mivo_python_modules "import catkin_pkg, em")
else()
  set(mivo_python_modules "import numpy")
endif()
if(NOT DEFINED PYTHON_EXECUTABLE AND NOT DEFINED Python3_EXECUTABLE)
  find_program(MIVO_PYTHON3_ON_PATH python3)
  mark_as_advanced(MIVO_PYTHON3_ON_PATH)
  foreach(python ${MIVO_PYTHON3_ON_PATH} /usr/bin/python3)
    execute_process(COMMAND ${python} -c ${mivo_python_modules}
      RESULT_VARIABLE result OUTPUT_QUIET ERROR_QUIET)
    if(result EQUAL 0)
      set(PYTHON_EXECUTABLE ${python} CACHE FILEPATH "Python that has what mivo needs")
      set(Python3_EXECUTABLE ${python} CACHE FILEPATH "Python that has what mivo needs")
      break()
    endif()
  endforeach()
endif()
