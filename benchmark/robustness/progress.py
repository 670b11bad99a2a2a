# SPDX-License-Identifier: BSD-3-Clause
"""A progress bar on a terminal, nothing elsewhere."""

import sys


class Progress:
    WIDTH = 30

    def __init__(self, title, total):
        self.title, self.total, self.done = title, total, 0
        self._draw()

    def advance(self):
        self.done += 1
        self._draw()

    def _draw(self):
        if not sys.stderr.isatty():
            return
        filled = self.WIDTH * self.done // max(1, self.total)
        bar = "#" * filled + "." * (self.WIDTH - filled)
        end = "\n" if self.done >= self.total else ""
        sys.stderr.write(f"\r{self.title} [{bar}] {self.done}/{self.total}{end}")
        sys.stderr.flush()
