#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""mivo is configured with packages newer than this machine has: their package files, as Ubuntu 24.04,
conda and later have them, stand in front of the machine's own.

    newer_packages_test.py
"""

import os
import subprocess
import sys
import tempfile
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.realpath(__file__))))

VERSION_FILE = """
set(PACKAGE_VERSION %(version)s)
if(PACKAGE_FIND_VERSION_MAJOR STREQUAL "" OR PACKAGE_FIND_VERSION_MAJOR STREQUAL "%(major)s")
  set(PACKAGE_VERSION_COMPATIBLE TRUE)
else()
  set(PACKAGE_VERSION_COMPATIBLE FALSE)
endif()
"""

PACKAGES = {
    # No variables, and no other major version than its own.
    ("Eigen3", "5.0.0"): """
add_library(Eigen3::Eigen INTERFACE IMPORTED)
set_target_properties(Eigen3::Eigen PROPERTIES INTERFACE_INCLUDE_DIRECTORIES /usr/include/eigen3)
""",
    # The plain name is gone.
    ("yaml-cpp", "0.8.0"): """
add_library(yaml-cpp::yaml-cpp SHARED IMPORTED)
set_target_properties(yaml-cpp::yaml-cpp PROPERTIES IMPORTED_LOCATION /nowhere/libyaml-cpp.so)
""",
    # No component system.
    ("Boost", "1.89.0"): """
foreach(component ${Boost_FIND_COMPONENTS})
  if(component STREQUAL "program_options")
    add_library(Boost::program_options SHARED IMPORTED)
    set_target_properties(Boost::program_options PROPERTIES IMPORTED_LOCATION /nowhere/libboost.so)
    set(Boost_program_options_FOUND TRUE)
  elseif(Boost_FIND_REQUIRED_${component})
    set(Boost_FOUND FALSE)
    set(Boost_NOT_FOUND_MESSAGE "no component ${component}")
    return()
  endif()
endforeach()
if(NOT TARGET Boost::headers)
  add_library(Boost::headers INTERFACE IMPORTED)
  add_library(Boost::boost INTERFACE IMPORTED)
endif()
""",
    ("embree", "4.3.0"): """
add_library(embree SHARED IMPORTED)
set_target_properties(embree PROPERTIES IMPORTED_LOCATION /nowhere/libembree4.so)
set(EMBREE_LIBRARY embree)
set(EMBREE_INCLUDE_DIRS ${CMAKE_CURRENT_LIST_DIR})
""",
    ("fmt", "12.0.0"): """
add_library(fmt::fmt SHARED IMPORTED)
set_target_properties(fmt::fmt PROPERTIES IMPORTED_LOCATION /nowhere/libfmt.so)
""",
}


def configure(folder, *options):
    return subprocess.run(["cmake", "-S", ROOT, "-B", os.path.join(folder, "build"),
                           "-DMIVO_WITH_ROS=OFF", "-DMIVO_WITH_OPENNI2=OFF", *options], text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False, timeout=120)


class NewerPackagesTest(unittest.TestCase):
    def test_all_are_taken(self):
        with tempfile.TemporaryDirectory() as folder:
            for (name, version), text in PACKAGES.items():
                base = os.path.join(folder, "lib/cmake", name)
                os.makedirs(base)
                with open(os.path.join(base, name + "Config.cmake"), "w", encoding="utf-8") as file:
                    file.write(text)
                with open(os.path.join(base, name + "ConfigVersion.cmake"), "w",
                          encoding="utf-8") as file:
                    file.write(VERSION_FILE % {"version": version, "major": version.split(".")[0]})
            result = configure(folder, "-DCMAKE_PREFIX_PATH=" + folder, "-DBoost_NO_BOOST_CMAKE=OFF")
            self.assertEqual(0, result.returncode, result.stdout)
            self.assertNotIn("Warning", result.stdout)
            with open(os.path.join(folder, "build/CMakeCache.txt"), encoding="utf-8") as file:
                cache = file.read()
            for name, _ in PACKAGES:
                self.assertIn("%s_DIR:PATH=%s/" % (name, folder), cache)

    def test_what_is_left_out_is_told(self):
        with tempfile.TemporaryDirectory() as folder:
            result = configure(folder, "-DCMAKE_DISABLE_FIND_PACKAGE_embree=ON",
                               "-DCMAKE_DISABLE_FIND_PACKAGE_hwy=ON")
            self.assertEqual(0, result.returncode, result.stdout)
            said = " ".join(result.stdout.split())
            self.assertIn("Embree 3 or 4 not found (libembree-dev)", said)
            self.assertIn("Highway 1.0 not found (libhwy-dev)", said)

    def test_vector_kernels_can_be_left_out_in_silence(self):
        with tempfile.TemporaryDirectory() as folder:
            result = configure(folder, "-DMIVO_WITH_SIMD=OFF")
            self.assertEqual(0, result.returncode, result.stdout)
            self.assertNotIn("Warning", result.stdout)

    def test_the_ray_caster_speaks_embree_4(self):
        """Against a header that has Embree 3's types, and the calls as Embree 4 declares them."""
        with tempfile.TemporaryDirectory() as folder:
            os.makedirs(os.path.join(folder, "embree4"))
            with open(os.path.join(folder, "embree4/rtcore.h"), "w", encoding="utf-8") as file:
                file.write(EMBREE_4)
            result = subprocess.run(
                ["c++", "-std=c++17", "-fsyntax-only", "-Wall", "-Wextra", "-Werror", "-I" + folder,
                 "-I" + os.path.join(ROOT, "include"), "-I" + os.path.join(ROOT, "src"), "-isystem",
                 "/usr/include/eigen3", "-isystem", "/usr/include/opencv4", os.path.join(ROOT, "src/synthetic/ray_caster.cpp")],
                text=True, stderr=subprocess.PIPE, check=False)
            self.assertEqual(0, result.returncode, result.stderr)


EMBREE_4 = """
#pragma once
#define rtcIntersect8 rtcIntersect8Of3
#define rtcOccluded8 rtcOccluded8Of3
#define RTCIntersectContext RTCIntersectContextOf3
#define rtcInitIntersectContext rtcInitIntersectContextOf3
#include <embree3/rtcore.h>
#undef rtcIntersect8
#undef rtcOccluded8
#undef RTCIntersectContext
#undef rtcInitIntersectContext
#undef RTC_VERSION_MAJOR
#define RTC_VERSION_MAJOR 4
enum RTCRayQueryFlags { RTC_RAY_QUERY_FLAG_COHERENT = (1 << 16) };
struct RTCIntersectArguments { enum RTCRayQueryFlags flags; };
struct RTCOccludedArguments { enum RTCRayQueryFlags flags; };
void rtcInitIntersectArguments(struct RTCIntersectArguments* arguments);
void rtcInitOccludedArguments(struct RTCOccludedArguments* arguments);
void rtcIntersect8(const int* valid, RTCScene scene, struct RTCRayHit8* rays,
                   struct RTCIntersectArguments* arguments = nullptr);
void rtcOccluded8(const int* valid, RTCScene scene, struct RTCRay8* rays,
                  struct RTCOccludedArguments* arguments = nullptr);
"""


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
