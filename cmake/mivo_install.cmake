# Where things are installed, and the CMake package for find_package(mivo), with ROS and without.

include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# catkin's convention: libraries in lib, programs in lib/<package>. Debian's packages have libraries in
# lib/<architecture>.
set(MIVO_LIB_DESTINATION lib CACHE STRING "Folder of the libraries below the prefix")
set(MIVO_CMAKE_DESTINATION share/mivo/cmake)
if(MIVO_WITH_ROS AND CMAKE_INSTALL_PREFIX STREQUAL "/usr")  # where Debian's catkin has mivoConfig.cmake
  set(MIVO_CMAKE_DESTINATION ${MIVO_LIB_DESTINATION}/cmake/mivo)
endif()

# An installed prefix can be moved, and works without LD_LIBRARY_PATH.
file(RELATIVE_PATH mivo_programs_to_libraries /lib/mivo /${MIVO_LIB_DESTINATION})
set(CMAKE_INSTALL_RPATH "$ORIGIN:$ORIGIN/${mivo_programs_to_libraries}")

# mivo::core and mivo::io with what they are made of. The headers of the others are private.
set(MIVO_PUBLIC_LIBRARIES mivo_core mivo_session mivo_io)

function(mivo_install_library name)
  set(destinations
    ARCHIVE DESTINATION ${MIVO_LIB_DESTINATION}
    LIBRARY DESTINATION ${MIVO_LIB_DESTINATION})
  get_target_property(type ${name} TYPE)
  if(name IN_LIST MIVO_PUBLIC_LIBRARIES)
    string(REGEX REPLACE "^mivo_" "" public_name ${name})
    set_target_properties(${name} PROPERTIES EXPORT_NAME ${public_name})
    add_library(mivo::${public_name} ALIAS ${name})
    install(TARGETS ${name} EXPORT mivoTargets ${destinations})
  elseif(type STREQUAL "SHARED_LIBRARY")  # the programs load it
    install(TARGETS ${name} ${destinations})
  endif()
endfunction()

# setup.bash and its like, which make a prefix a workspace: those of the devel space with other paths. A
# Debian package has none.
function(mivo_install_environment)
  if(CMAKE_INSTALL_PREFIX STREQUAL "/usr" OR NOT CMAKE_SOURCE_DIR STREQUAL PROJECT_SOURCE_DIR)
    return()
  endif()
  set(files _setup_util.py env.sh setup.sh setup.bash setup.zsh local_setup.sh local_setup.bash local_setup.zsh)
  install(CODE "
    set(prefix \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}\")
    foreach(file ${files})
      file(READ \"${CATKIN_DEVEL_PREFIX}/\${file}\" text)
      string(REPLACE \"${CATKIN_DEVEL_PREFIX}\" \"\${CMAKE_INSTALL_PREFIX}\" text \"\${text}\")
      file(WRITE \"\${prefix}/\${file}\" \"\${text}\")
    endforeach()
    execute_process(COMMAND chmod 755 \"\${prefix}/_setup_util.py\" \"\${prefix}/env.sh\")
    if(NOT EXISTS \"\${prefix}/.catkin\")
      file(WRITE \"\${prefix}/.catkin\" \"\")
    endif()")
endfunction()

# At the end, when all targets are there.
function(mivo_install_package)
  install(EXPORT mivoTargets NAMESPACE mivo:: DESTINATION ${MIVO_CMAKE_DESTINATION})
  if(MIVO_WITH_ROS)  # catkin writes mivoConfig.cmake, which includes mivo-extras.cmake
    export(EXPORT mivoTargets NAMESPACE mivo::
      FILE ${CATKIN_DEVEL_PREFIX}/${MIVO_CMAKE_DESTINATION}/mivoTargets.cmake)
    mivo_install_environment()
    return()
  endif()
  install(DIRECTORY include/mivo DESTINATION include)
  configure_file(cmake/mivo-extras.cmake.in mivoConfig.cmake @ONLY)
  write_basic_package_version_file(mivoConfigVersion.cmake COMPATIBILITY SameMinorVersion)
  install(FILES ${PROJECT_BINARY_DIR}/mivoConfig.cmake ${PROJECT_BINARY_DIR}/mivoConfigVersion.cmake
    DESTINATION ${MIVO_CMAKE_DESTINATION})
endfunction()
