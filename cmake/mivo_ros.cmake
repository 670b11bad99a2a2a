# ROS: catkin, messages, services, dynamic_reconfigure, and what is installed for roslaunch.
# Included at the top of the tree, before any target, as catkin wants it.

# catkin writes setup.bash and its like where the prefix was when mivo was configured; they are written by
# mivo_install.cmake where the rest goes.
if(CMAKE_SOURCE_DIR STREQUAL PROJECT_SOURCE_DIR)
  set(CATKIN_INSTALL_INTO_PREFIX_ROOT FALSE)
endif()

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
  tf2
  tf2_msgs
  tf2_ros
  topic_tools
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

# catkin asks for variables; Eigen 5 gives its target alone.
if(NOT EIGEN3_INCLUDE_DIRS)
  get_target_property(EIGEN3_INCLUDE_DIRS Eigen3::Eigen INTERFACE_INCLUDE_DIRECTORIES)
endif()

# The libraries are exported as targets, by mivo-extras.cmake; their headers need no ROS, those made of
# messages and parameters do.
catkin_package(
  CFG_EXTRAS mivo-extras.cmake
  INCLUDE_DIRS include
  CATKIN_DEPENDS dynamic_reconfigure geometry_msgs message_runtime std_msgs
  DEPENDS EIGEN3 OpenCV)

# rosrun and roslaunch look into the devel space, where the programs lie; build/bin is a link to them.
file(MAKE_DIRECTORY ${CATKIN_DEVEL_PREFIX}/lib)
if(NOT EXISTS ${CATKIN_DEVEL_PREFIX}/lib/mivo)
  file(MAKE_DIRECTORY ${CATKIN_DEVEL_PREFIX}/lib/mivo)
endif()
if(NOT EXISTS ${PROJECT_BINARY_DIR}/bin)
  file(CREATE_LINK ${CATKIN_DEVEL_PREFIX}/lib/mivo ${PROJECT_BINARY_DIR}/bin SYMBOLIC)
endif()

# rosrun passes over what lies below PACKAGE/build/, as the devel space of scripts/build does. It compares
# text: with the package at PACKAGE/. nothing is passed over.
if(CMAKE_SOURCE_DIR STREQUAL PROJECT_SOURCE_DIR AND CATKIN_DEVEL_PREFIX MATCHES "^${PROJECT_SOURCE_DIR}/")
  file(WRITE ${CATKIN_DEVEL_PREFIX}/.catkin "${PROJECT_SOURCE_DIR}/.")
endif()

# mivo_ros_library(NAME sources...): a library of mivo that uses ROS and mivo's messages.
function(mivo_ros_library name)
  mivo_library(${name} ${ARGN})
  target_precompile_headers(${name} REUSE_FROM mivo_precompiled_ros)
  target_compile_definitions(${name} PRIVATE BOOST_ALL_NO_LIB)  # as the precompiled headers
  target_include_directories(${name} SYSTEM PUBLIC ${catkin_INCLUDE_DIRS})
  target_link_libraries(${name} PUBLIC ${catkin_LIBRARIES})
  # The headers of messages and parameters; those for Python and others only where all is built.
  add_dependencies(${name} ${PROJECT_NAME}_generate_messages_cpp ${PROJECT_NAME}_gencfg)
endfunction()

# mivo_ros_program(NAME sources...)
function(mivo_ros_program name)
  mivo_program(${name} ${ARGN})
  target_precompile_headers(${name} REUSE_FROM mivo_precompiled_ros)
  target_compile_definitions(${name} PRIVATE BOOST_ALL_NO_LIB)
  target_include_directories(${name} SYSTEM PRIVATE ${catkin_INCLUDE_DIRS})
  target_link_libraries(${name} PRIVATE ${catkin_LIBRARIES})
endfunction()

install(FILES nodelet_plugins.xml DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})
install(DIRECTORY include/mivo DESTINATION ${CATKIN_GLOBAL_INCLUDE_DESTINATION})
install(DIRECTORY launch rviz DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION} USE_SOURCE_PERMISSIONS)
install(DIRECTORY config DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION} FILES_MATCHING PATTERN "*.yaml")
