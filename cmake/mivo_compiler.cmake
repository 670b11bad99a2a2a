# Compiler settings shared by all targets, and the functions that declare mivo's targets.

if(NOT CMAKE_CXX_STANDARD)
  set(CMAKE_CXX_STANDARD 17)
endif()
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()

# Results are the same to the bit wherever the code is inlined: no fused multiply-add behind our back.
add_compile_options(-Wall -Wextra -Wpedantic -ffp-contract=off)
if(MIVO_WARNINGS_AS_ERRORS)
  add_compile_options(-Werror)
endif()

# For tests (scripts/test --sanitize): a build that ends at the first access out of bounds, undefined
# operation or leak, with the assertions of the C++ library, Eigen and OpenCV in force. Programs of
# test/fuzz need clang's coverage besides.
option(MIVO_SANITIZE "Build with AddressSanitizer and UndefinedBehaviorSanitizer, and with assertions" OFF)
if(MIVO_SANITIZE)
  set(MIVO_SANITIZERS address,undefined)
  if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    string(APPEND MIVO_SANITIZERS ",fuzzer-no-link")
  endif()
  add_compile_options(-fsanitize=${MIVO_SANITIZERS} -fno-sanitize-recover=undefined
    -fno-omit-frame-pointer -O1 -g1 -UNDEBUG)
  add_compile_definitions(_GLIBCXX_ASSERTIONS)
  add_link_options(-fsanitize=${MIVO_SANITIZERS})
endif()

# mivo_library(NAME sources...): one library of one folder.
function(mivo_library name)
  add_library(${name} ${ARGN})
  target_include_directories(${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>
    $<INSTALL_INTERFACE:include>)
  target_precompile_headers(${name} REUSE_FROM mivo_precompiled_library)
  mivo_install_library(${name})
endfunction()

# mivo_program(NAME sources...): build/bin/NAME, installed where rosrun finds it.
function(mivo_program name)
  add_executable(${name} ${ARGN})
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
  # As libraries are compiled, whose precompiled headers then serve.
  target_compile_options(${name} PRIVATE -fPIC)
  target_precompile_headers(${name} REUSE_FROM mivo_precompiled_library)
  install(TARGETS ${name} RUNTIME DESTINATION lib/mivo)
endfunction()

# mivo_link(FILE): beside the programs in the build folder.
function(mivo_link file)
  file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
  if(NOT EXISTS ${PROJECT_BINARY_DIR}/bin/${file})
    file(CREATE_LINK ${CMAKE_CURRENT_SOURCE_DIR}/${file} ${PROJECT_BINARY_DIR}/bin/${file} SYMBOLIC)
  endif()
endfunction()

# mivo_script(FILE): an executable script beside the programs.
function(mivo_script file)
  mivo_link(${file})
  install(PROGRAMS ${file} DESTINATION lib/mivo)
endfunction()

# mivo_plot(FILE): what a program beside it hands to Python (programs/python_plot.h). It is not executable:
# rosrun would offer it, and once more for each build without ROS.
function(mivo_plot file)
  mivo_link(${file})
  install(FILES ${file} DESTINATION lib/mivo)
endfunction()

# Tests are compiled more often than they run; what they test is optimized.
set(MIVO_TEST_OPTIONS -O1)

# mivo_test(NAME LIBRARIES libraries... SOURCES sources...): a GoogleTest program run by ctest, which
# lists it as skipped when a test was and none has failed (test/support/test_main.cpp). Tests that need
# what not every machine has are programs of their own, so that the others are not listed so with them.
function(mivo_test name)
  cmake_parse_arguments(ARG "" "" "LIBRARIES;SOURCES" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/test)
  target_compile_options(${name} PRIVATE ${MIVO_TEST_OPTIONS})
  target_precompile_headers(${name} REUSE_FROM mivo_precompiled_test)
  target_link_libraries(${name} PRIVATE ${ARG_LIBRARIES} mivo_test_main GTest::GTest Threads::Threads)
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/test_bin)
  add_test(NAME ${name} COMMAND ${name})
  set_tests_properties(${name} PROPERTIES SKIP_RETURN_CODE 77)
endfunction()
