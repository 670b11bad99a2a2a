# SPDX-License-Identifier: BSD-3-Clause
"""Runs programs."""

import os
import subprocess
import tempfile


class MeasuringError(Exception):
    """Something cannot be measured; the text says what and why."""


class Programs:
    """The programs of one build."""

    def __init__(self, build):
        self.folder = os.path.join(os.path.abspath(build), "bin")

    def path(self, name):
        """Where a program is. Throws MeasuringError when it has not been built."""
        if not self.has(name):
            raise MeasuringError("there is no %s in %s: build with scripts/build "
                                 "-DMIVO_WITH_BENCHMARKS=ON" % (name, self.folder))
        return os.path.join(self.folder, name)

    def has(self, name):
        return os.path.exists(os.path.join(self.folder, name))

    def run(self, name, *arguments):
        """Output of a program as text."""
        words = [str(word) for word in arguments]
        with tempfile.TemporaryFile("w+", encoding="utf-8") as output:
            run_words([self.path(name)] + words, output, " ".join([name] + words))
            output.seek(0)
            return output.read()


def run_words(words, output, name, folder=None, accepted=(0,)):
    """Runs a command to its end in a folder; its standard output goes to a file. Returns the
    processor time it took, seconds. Throws MeasuringError, in which it is called `name`, for an exit
    code that is not accepted."""
    with tempfile.TemporaryFile("w+", encoding="utf-8", errors="replace") as errors:
        process = subprocess.Popen(words, cwd=folder, stdout=output, stderr=errors)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = status  # it has been waited for here
        if not (os.WIFEXITED(status) and os.WEXITSTATUS(status) in accepted):
            errors.seek(0)
            raise MeasuringError("%s failed (%s): %s" % (name, describe(status),
                                                         errors.read().strip()))
    return usage.ru_utime + usage.ru_stime


def describe(status):
    """How a process ended."""
    if os.WIFSIGNALED(status):
        return "signal %d" % os.WTERMSIG(status)
    return "code %d" % os.WEXITSTATUS(status)
