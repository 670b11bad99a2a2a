# SPDX-License-Identifier: BSD-3-Clause
"""Trajectory files that strangers have, made from one of TUM's format: its lines as lists of words."""


def lines(rows, separator=" ", end="\n"):
    return end.join(separator.join(row) for row in rows) + end


def scalar_first(rows):
    return [row[:4] + [row[7]] + row[4:7] for row in rows]


def in_units(rows, factor):
    return [[str(round(float(row[0]) * factor))] + row[1:] for row in rows]


def of_today(rows):
    return [["{:.6f}".format(float(row[0]) + 1.6e9)] + row[1:] for row in rows]


def ros2(rows):
    result = []
    for row in rows:
        second = int(float(row[0]))
        result.append([str(second), str(round((float(row[0]) - second) * 1e9)), "map"] + row[1:])
    return result


EUROC = "#timestamp, p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], q_RS_z []\n"

# What the file is, what makes it of the rows, and what becomes of the truth beside it.
ROWS = [
    ("TUM: the twin of all others", lines, None),
    ("TUM, byte order mark and carriage returns",
     lambda rows: "\ufeff# comment\r\n" + lines(rows, end="\r\n"), None),
    ("TUM, the order of the lines reversed", lambda rows: lines(rows[::-1]), None),
    ("commas, semicolons or both", lambda rows: lines(rows, ",").replace(",", ";", 60), None),
    ("stamps in nanoseconds", lambda rows: lines(in_units(rows, 1e9)), None),
    ("EuRoC, with its heading",
     lambda rows: EUROC + lines(in_units(of_today(scalar_first(rows)), 1e9), ","), of_today),
    ("EuRoC, without it",
     lambda rows: lines(in_units(of_today(scalar_first(rows)), 1e9), ","), of_today),
    ("qw before qx in seconds, without a heading", lambda rows: lines(scalar_first(rows)), None),
    ("ROS 2: ros2 topic echo --csv", lambda rows: lines(ros2(rows), ","), None),
    ("nine columns", lambda rows: lines([row + ["0"] for row in rows]), None),
    ("seven columns", lambda rows: lines([row[:7] for row in rows]), None),
    ("quaternions of length 1.5",
     lambda rows: lines([row[:4] + [str(1.5 * float(w)) for w in row[4:]] for row in rows]), None),
    ("not a number in it", lambda rows: lines(rows[:5] + [rows[5][:1] + ["nan"] + rows[5][2:]]),
     None),
    ("no pose in it", lambda rows: "# comment\n", None),
    ("another time", lambda rows: lines([[str(float(row[0]) + 50.0)] + row[1:] for row in rows]),
     None),
    ("truth at 10 Hz, estimate at 30", lines, lambda rows: rows[::3]),
]
