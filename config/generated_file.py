# SPDX-License-Identifier: BSD-3-Clause
"""Command line of the scripts that generate a file from the parameter table."""

import os
import sys

ROOT = os.path.join(os.path.dirname(os.path.realpath(__file__)), "..")


def write_or_check(path, text, script, usage):
    """Writes the text into ROOT/path; with --check only compares. Returns the exit code."""
    if sys.argv[1:] not in ([], ["--check"]):
        print(usage, file=sys.stderr)
        return 2
    if not sys.argv[1:]:
        with open(os.path.join(ROOT, path), "w", encoding="utf-8") as file:
            file.write(text)
        return 0
    with open(os.path.join(ROOT, path), encoding="utf-8") as file:
        if file.read() == text:
            return 0
    print("%s is not up to date with include/mivo/core/parameters.def; run %s" % (path, script),
          file=sys.stderr)
    return 1
