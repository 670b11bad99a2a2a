#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Fails when a file uses what a standard header declares, and neither the file nor a header of mivo that
it includes includes that header. It then compiles only where Eigen, OpenCV, ROS or the standard library
happen to include it, which changes from version to version.

    test/includes_test.py
"""

import functools
import os
import re
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.realpath(__file__)))
FOLDERS = ("include", "src", "test", "benchmark", "examples")
INCLUDE_FOLDERS = ("include", "src", "test", "benchmark")

DECLARED = {header: re.compile(pattern) for header, pattern in {
    "algorithm": r"std::(min|max|clamp|sort|fill|copy|find_if|any_of|all_of|none_of|lower_bound|nth_element)\b",
    "array": r"std::array\b",
    "atomic": r"std::atomic\b",
    "cassert": r"\bassert\(",
    "chrono": r"std::chrono\b",
    "cmath": r"std::(abs|floor|isfinite|lround|pow|round|sqrt)\(",
    "fmt/ranges.h": r"\bfmt::join\b",  # in fmt/format.h before fmt 11
    "cstdint": r"\bu?int(8|16|32|64)_t\b",
    "cstdio": r"std::(printf|snprintf|fopen)\b",
    "cstdlib": r"std::(getenv|exit|strtod|system)\b",
    "cstring": r"std::(memcmp|memcpy|memset|strcmp|strerror|strlen)\b",
    "iostream": r"std::(cin|cout|cerr)\b",
    "limits": r"std::numeric_limits\b",
    "memory": r"std::(make_shared|make_unique|shared_ptr|unique_ptr)\b",
    "mutex": r"std::(mutex|lock_guard|unique_lock)\b",
    "numeric": r"std::(accumulate|iota|inner_product)\b",
    "optional": r"std::(optional|nullopt)\b",
    "sstream": r"std::[io]?stringstream\b",
    "stdexcept": r"std::(runtime_error|logic_error|invalid_argument|out_of_range)\b",
    "string": r"std::(string|to_string)\b",
    "thread": r"std::(thread|this_thread)\b",
    "utility": r"std::(move|pair|exchange)\b",
    "vector": r"std::vector\b",
}.items()}


def text_of(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


@functools.lru_cache(maxsize=None)
def standard_headers(root, path):
    """Those that a file includes, itself or through headers of mivo."""
    headers = set()
    for mark, name in re.findall(r'^\s*#\s*include\s*([<"])([^>"]+)', text_of(path), re.MULTILINE):
        if mark == "<":
            headers.add(name)
            continue
        for folder in (os.path.dirname(path), *(os.path.join(root, top) for top in INCLUDE_FOLDERS)):
            included = os.path.join(folder, name)
            if os.path.exists(included):
                headers |= standard_headers(root, included)
                break
    return frozenset(headers)


def missing_includes(root):
    for top in FOLDERS:
        for directory, _, names in sorted(os.walk(os.path.join(root, top))):
            for name in sorted(names):
                # Parts of one source file have what that file includes.
                if not name.endswith((".h", ".cpp")) or name.endswith("-inl.h"):
                    continue
                path = os.path.join(directory, name)
                code = re.sub(r"//.*|\"(\\.|[^\"\\\n])*\"", "", text_of(path))
                for header, pattern in DECLARED.items():
                    if header not in standard_headers(root, path) and pattern.search(code):
                        yield f"{os.path.relpath(path, root)}: uses <{header}> without including it"


def check_self():
    with tempfile.TemporaryDirectory() as root:
        os.makedirs(os.path.join(root, "src/core"))
        for name, text in (("core/a.h", "#include <cstdint>\n"),
                           ("core/b.cpp", '#include "core/a.h"\n#include <Eigen/Core>\nstd::uint8_t x; // assert(\n'),
                           ("core/c.cpp", '#include <Eigen/Core>\nstd::uint8_t x = f(" // ", "std::string");\n')):
            with open(os.path.join(root, "src", name), "w", encoding="utf-8") as file:
                file.write(text)
        found = list(missing_includes(root))
        if found != ["src/core/c.cpp: uses <cstdint> without including it"]:
            sys.exit(f"self-check: found {found}")


def main():
    check_self()
    faults = list(missing_includes(ROOT))
    print("\n".join(faults) or "each file includes what it uses")
    sys.exit(bool(faults))


if __name__ == "__main__":
    main()
