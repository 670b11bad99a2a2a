# SPDX-License-Identifier: BSD-3-Clause
"""The virtual Xtion from the side of a test: its control file, its record of what it took, and waiting
for conditions."""

import bisect
import collections
import os
import threading
import time

import rospy
from diagnostic_msgs.msg import DiagnosticArray
from rosgraph_msgs.msg import Log

NANO = 1e-9


class Control:
    """Writes the control file that the driver polls."""

    def __init__(self):
        self.path = os.environ["MIVO_VIRTUAL_XTION"]
        self.values = {"folder": os.environ["MIVO_TEST_SEQUENCE"]}

    def set(self, **values):
        self.values.update(values)
        with open(self.path + ".new", "w", encoding="ascii") as file:
            for name, value in self.values.items():
                file.write(f"{name} {value}\n")
        os.rename(self.path + ".new", self.path)

    def play(self, until):
        """The sequence plays up to this image, each taken once."""
        self.set(until=until)


class Truth:
    """What the virtual camera took: host time and number of each color image."""

    def __init__(self, path):
        self.path = path
        self.times = []
        self.frames = []

    def read(self):
        self.times, self.frames = [], []
        if os.path.exists(self.path):
            with open(self.path, encoding="ascii") as file:
                for line in file:
                    fields = line.split()
                    if len(fields) == 3 and line.endswith("\n"):
                        self.times.append(int(fields[1]) * NANO)
                        self.frames.append(int(fields[2]))
        return self

    def nearest(self, stamp):
        """Index of the image taken closest to the time."""
        i = bisect.bisect(self.times, stamp)
        return min((k for k in (i - 1, i) if 0 <= k < len(self.times)),
                   key=lambda k: abs(self.times[k] - stamp))


def read_trajectory(path):
    """[(stamp, tx, ty, tz, qx, qy, qz, qw)] of a trajectory file."""
    with open(path, encoding="ascii") as file:
        return [tuple(map(float, line.split())) for line in file
                if line.strip() and not line.startswith("#")]


class Listener:
    """Collects what nodes log and say on /diagnostics."""

    def __init__(self):
        self.condition = threading.Condition(threading.RLock())
        self.lines = []
        self.diagnostics = {}
        rospy.Subscriber("/rosout", Log, self._log, queue_size=1000)
        rospy.Subscriber("/diagnostics", DiagnosticArray, self._diagnose, queue_size=100)

    def _log(self, message):
        with self.condition:
            self.lines.append(message.msg)
            self.condition.notify_all()

    def _diagnose(self, message):
        with self.condition:
            for status in message.status:
                values = {pair.key: pair.value for pair in status.values}
                values["level"] = status.level
                values["summary"] = status.message
                self.diagnostics[status.name] = values
            self.condition.notify_all()

    def mark(self):
        with self.condition:
            return len(self.lines)

    def lines_since(self, mark, text):
        with self.condition:
            return [line for line in self.lines[mark:] if text in line]

    def wait_line(self, mark, text, timeout):
        """True once a line logged after the mark has the text."""
        return self._wait(lambda: any(text in line for line in self.lines[mark:]), timeout)

    def wait_diagnostics(self, name, condition, timeout):
        """True once the latest status of the node fulfils the condition."""
        return self._wait(lambda: condition(self.status(name)), timeout)

    def status(self, name):
        """Values of the node's latest status; all are empty texts before the first."""
        with self.condition:
            return next((values for key, values in self.diagnostics.items()
                         if key.split(":")[0].strip("/") == name), collections.defaultdict(str))

    def _wait(self, condition, timeout):
        end = time.monotonic() + timeout
        with self.condition:
            while not condition():
                left = end - time.monotonic()
                if left <= 0 or rospy.is_shutdown():
                    return False
                self.condition.wait(left)
            return True


class Counter:
    """Counts messages, and waits for more of them."""

    def __init__(self, topic, kind):
        self.condition = threading.Condition()
        self.messages = []
        self.subscriber = rospy.Subscriber(topic, kind, self._add, queue_size=1000)

    def stop(self):
        self.subscriber.unregister()

    def _add(self, message):
        with self.condition:
            self.messages.append(message)
            self.condition.notify_all()

    def stamps(self):
        """Of the messages so far."""
        with self.condition:
            return {message.header.stamp for message in self.messages}

    def wait_more(self, count, timeout):
        """True once so many more have come."""
        with self.condition:
            wanted = len(self.messages) + count
            return self.condition.wait_for(lambda: len(self.messages) >= wanted, timeout)
