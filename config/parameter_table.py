# SPDX-License-Identifier: BSD-3-Clause
"""Parser of the parameter table, include/mivo/core/parameters.def."""

import os
import re

TABLE = os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "include", "mivo", "core",
                     "parameters.def")

# A row is one macro call whose arguments are words, numbers and plain string literals.
ROW = re.compile(r'^MIVO_(\w+)\s*\(((?:[^()"]|"[^"]*")*)\)', re.MULTILINE)
ARGUMENT = re.compile(r'\s*("[^"]*"|[^,\s]+)\s*(?:,|$)')


class Parameter:
    """One row: kind is INT, DOUBLE, BOOL or ENUM; value, minimum and maximum are text."""

    def __init__(self, group, kind, row):
        self.group = group
        self.kind = kind
        self.minimum = self.maximum = self.unit = ""
        self.words = []
        if kind in ("INT", "DOUBLE"):
            self.name, self.value, self.minimum, self.maximum, self.unit, self.update, self.text = row
        elif kind == "BOOL":
            self.name, self.value, self.update, self.text = row
        elif kind == "ENUM":
            _, self.name, value, words, self.update, self.text = row
            self.words = words.split("|")
            self.value = camel_to_snake(value)
            if self.value not in self.words:
                raise SystemExit("%s: default %s of '%s' is not one of %s"
                                 % (TABLE, value, self.name, self.words))
        else:
            raise SystemExit("%s: unknown kind of row: MIVO_%s" % (TABLE, kind))

    def range_text(self):
        """The range or the choices as text."""
        if self.words:
            return " | ".join(self.words)
        if self.kind == "BOOL":
            return "true | false"
        return "%s to %s %s" % (self.minimum, self.maximum, self.unit)


def camel_to_snake(enumerator):
    """kConstantVelocity -> constant_velocity, as in the words of the table."""
    return re.sub(r"(?<!^)(?=[A-Z])", "_", enumerator[1:]).lower()


def read_parameters():
    """All rows, in the order of the table."""
    with open(TABLE, encoding="utf-8") as table:
        text = re.sub(r"^\s*//.*$", "", table.read(), flags=re.MULTILINE)
    group = ""
    parameters = []
    for kind, arguments in ROW.findall(text):
        row = [argument.strip('"') for argument in ARGUMENT.findall(arguments)]
        if kind == "GROUP":
            group = row[2]
        elif kind != "GROUP_END":
            parameters.append(Parameter(group, kind, row))
    if not parameters:
        raise SystemExit("%s: no parameters found" % TABLE)
    return parameters
