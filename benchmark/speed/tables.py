# SPDX-License-Identifier: BSD-3-Clause
"""Markdown tables of the measurements."""

from measuring.methods import PEERS
from measuring.statistics import column, quantile
from measuring.tables import table

# Asked of one run on one thread; the paper's own figures are 8.2 and 2.55.
GOALS = (
    ("OpenCV's RgbdOdometry / default", "rgbd", "default", 18.0, True),
    ("OpenCV's RgbdICPOdometry / default", "rgbd_icp", "default", 45.0, True),
    ("OpenCV's RgbdOdometry / the paper's hybrid", "rgbd", "hybrid", 25.0, True),
    ("MI / hybrid", "mi", "hybrid", 3.0, False),
    ("hybrid / SSD", "hybrid", "ssd", 1.5, False))
KERNEL_GOALS = {"warp_and_interpolation": 5.0, "warp_and_normalized_interpolation": 5.0,
                "accumulation": 5.0, "mi_gradient_and_hessian": 5.0, "histogram": 3.0}


def stage_table(measured):
    stages = (("pyramid", "ms_pyramid"), ("tracking", "ms_tracking"), ("whole frame", "cpu_ms"))
    lines = []
    for name, key in stages:
        values = column(measured["rows"]["default"], key)
        lines.append([name] + ["%.2f" % quantile(values, share) for share in (0.5, 0.95, 1.0)])
    keyframes = [row["ms_keyframe"] for row in measured["rows"]["default"] if row["ms_keyframe"] > 0]
    if keyframes:
        lines.append(["half of a keyframe, in frames that create or complete one (%d of %d)"
                      % (len(keyframes), len(measured["rows"]["default"]))]
                     + ["%.2f" % quantile(keyframes, share) for share in (0.5, 0.95, 1.0)])
    return table(["stage", "median ms", "p95 ms", "max ms"], lines)


def medians(measured):
    """Median time of a frame by method or peer, milliseconds."""
    result = {name: quantile(column(rows, "cpu_ms"), 0.5)
              for name, rows in measured["rows"].items()}
    result.update(measured["peers"])
    return result


def median_table(sequences):
    names = ["ssd", "mi", "hybrid", "default"] + list(PEERS)
    titles = ["SSD", "MI", "hybrid", "default"] + list(PEERS.values())
    lines = [[sequence] + ["%.2f" % medians(measured)[name] for name in names]
             for sequence, measured in sequences.items()]
    return table(["sequence"] + titles, lines)


def goal_table(sequences):
    lines = []
    for title, above, below, goal, at_least in GOALS:
        values = [medians(measured)[above] / medians(measured)[below]
                  for measured in sequences.values()]
        lines.append([title, "%s %g" % ("at least" if at_least else "at most", goal)]
                     + ["%.2f" % value for value in values])
    ratios = []
    for measured in sequences.values():
        times = column(measured["rows"]["default"], "cpu_ms")
        ratios.append("%.2f" % (quantile(times, 0.95) / quantile(times, 0.5)))
    lines.append(["default, p95 / median", "at most 2.5"] + ratios)
    return table(["ratio", "goal"] + list(sequences), lines)


def kernel_table(times):
    backends = list(next(iter(times.values())))
    lines = []
    for kernel, values in times.items():
        ratio = values[backends[0]] / values[backends[-1]]
        goal = "at least %g" % KERNEL_GOALS[kernel] if kernel in KERNEL_GOALS else ""
        lines.append([kernel.replace("_", " ")]
                     + ["%.1f" % (1e-3 * values[name]) for name in backends]
                     + ["%.1f" % ratio, goal])
    return table(["kernel, µs"] + backends + ["ratio", "goal"], lines)


def size_table(sizes):
    names = ["ssd", "mi", "hybrid", "default"]
    widths = sorted({width for width, _, _ in sizes})
    value = {(width, name): ms for width, name, ms in sizes}
    return table(["width", "SSD", "MI", "hybrid", "default"],
                 [[str(width)] + ["%.2f" % value[width, name] for name in names]
                  for width in widths])


def parameter_table(title, rows):
    return table([title, "median ms"], [["%g" % value, "%.2f" % ms] for value, ms in rows])
