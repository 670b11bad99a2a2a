# SPDX-License-Identifier: BSD-3-Clause
"""How far it is."""

import sys
import time


class Progress:
    """A bar on stderr when that is a terminal, otherwise a line every tenth of the way."""

    WIDTH = 30

    def __init__(self, total, what, done=0):
        self.total, self.what, self.done, self.start = total, what, done, time.time()
        self.terminal = sys.stderr.isatty()
        self.told = self.tenth()

    def tenth(self):
        return 10 * self.done // max(1, self.total)

    def step(self, name):
        self.done += 1
        elapsed = int(time.time() - self.start)
        clock = "%d:%02d" % (elapsed // 60, elapsed % 60)
        if self.terminal:
            filled = self.WIDTH * self.done // max(1, self.total)
            sys.stderr.write("\r\033[K[%s%s] %d/%d %s %s" % (
                "#" * filled, " " * (self.WIDTH - filled), self.done, self.total, clock, name))
        elif self.tenth() > self.told:
            self.told = self.tenth()
            sys.stderr.write("%d of %d %s after %s\n" % (self.done, self.total, self.what, clock))
        sys.stderr.flush()

    def close(self):
        if self.terminal:
            sys.stderr.write("\r\033[K")
            sys.stderr.flush()
