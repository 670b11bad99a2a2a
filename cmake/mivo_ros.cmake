# ROS: catkin, messages, services, dynamic_reconfigure, and what is installed for roslaunch.
# Included at the top of the tree, before any target, as catkin wants it.

# ROS on Debian lives in the system's Python; another one first on the PATH would not find it.
foreach(variable PYTHON_EXECUTABLE Python3_EXECUTABLE)
  if(NOT DEFINED ${variable} AND EXISTS /usr/bin/python3)
    set(${variable} /usr/bin/python3 CACHE FILEPATH "Python with the ROS packages")
  endif()
endforeach()

find_package(catkin REQUIRED COMPONENTS
  camera_info_manager
  cv_bridge
  diagnostic_updater
  dynamic_reconfigure
  geometry_msgs
  image_transport
  message_generation
  nav_msgs
  nodelet
  pluginlib
  rosbag
  roscpp
  sensor_msgs
  std_msgs
  std_srvs
  tf2_msgs
  tf2_ros
  visualization_msgs)

add_message_files(FILES
  LevelStatus.msg
  TrackingStatus.msg)
add_service_files(FILES
  SaveTrajectory.srv
  SetPose.srv)
generate_messages(DEPENDENCIES geometry_msgs std_msgs)

generate_dynamic_reconfigure_options(config/Odometry.cfg config/OpenNI2.cfg)
# The .cfg is made from the table of parameters.
add_custom_command(OUTPUT ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_INCLUDE_DESTINATION}/OdometryConfig.h
  DEPENDS ${PROJECT_SOURCE_DIR}/include/mivo/core/parameters.def
    ${PROJECT_SOURCE_DIR}/config/parameter_table.py APPEND)

catkin_package(
  INCLUDE_DIRS include
  LIBRARIES mivo_core mivo_io mivo_evaluation mivo_ros
  CATKIN_DEPENDS
    camera_info_manager
    cv_bridge
    diagnostic_updater
    dynamic_reconfigure
    geometry_msgs
    image_transport
    message_runtime
    nav_msgs
    nodelet
    pluginlib
    rosbag
    roscpp
    sensor_msgs
    std_msgs
    std_srvs
    tf2_msgs
    tf2_ros
    visualization_msgs
  DEPENDS EIGEN3 OpenCV)

# An installed prefix works without LD_LIBRARY_PATH: programs are in lib/mivo, libraries in lib.
set(CMAKE_INSTALL_RPATH "$ORIGIN:$ORIGIN/..")

# rosrun and roslaunch look into the devel space, programs are built into bin.
file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/bin ${CATKIN_DEVEL_PREFIX}/lib)
if(NOT EXISTS ${CATKIN_DEVEL_PREFIX}/lib/mivo)
  file(CREATE_LINK ${PROJECT_BINARY_DIR}/bin ${CATKIN_DEVEL_PREFIX}/lib/mivo SYMBOLIC)
endif()

# mivo_ros_library(NAME sources...): a library of mivo that uses ROS and mivo's messages.
function(mivo_ros_library name)
  mivo_library(${name} ${ARGN})
  target_include_directories(${name} SYSTEM PUBLIC ${catkin_INCLUDE_DIRS})
  target_link_libraries(${name} PUBLIC ${catkin_LIBRARIES})
  add_dependencies(${name} ${${PROJECT_NAME}_EXPORTED_TARGETS})
endfunction()

install(FILES nodelet_plugins.xml DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})
install(DIRECTORY launch rviz DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})
install(DIRECTORY config DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION} FILES_MATCHING PATTERN "*.yaml")
install(DIRECTORY include/mivo DESTINATION ${CATKIN_GLOBAL_INCLUDE_DESTINATION})
install(DIRECTORY scripts DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION} USE_SOURCE_PERMISSIONS)
