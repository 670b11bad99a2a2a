# SPDX-License-Identifier: BSD-3-Clause
"""Tables in Markdown."""

from measuring.statistics import column, deviation, mean

LEVELS = range(5)


def table(header, rows):
    lines = ["| " + " | ".join(header) + " |", "|" + "---|" * len(header)]
    lines += ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]
    return "\n".join(lines) + "\n"


def level_table(rows):
    """Table I of the paper: time per level. `rows` are the statistics of each method's frames."""
    lines = []
    for level in reversed(LEVELS):
        total, search = "ms_%d" % level, "ms_line_search_%d" % level
        lines.append([str(level), spread(column(rows["ssd"], total)),
                      spread(column(rows["mi"], search)), spread(column(rows["mi"], total)),
                      spread(column(rows["hybrid"], search)), spread(column(rows["hybrid"], total)),
                      spread(column(rows["default"], search)),
                      spread(column(rows["default"], total))])
    all_levels = {name: level_sums(rows[name]) for name in rows}
    lines.append(["all", spread(all_levels["ssd"]), "", spread(all_levels["mi"]), "",
                  spread(all_levels["hybrid"]), "", spread(all_levels["default"])])
    return table(["level", "SSD", "MI line search", "MI total", "hybrid line search", "hybrid total",
                  "default line search", "default total"], lines)


def level_sums(rows):
    """Time of each frame on all levels, ms."""
    return [sum(row["ms_%d" % level] for level in LEVELS) for row in rows]


def spread(values):
    return "%.3f ± %.3f" % (mean(values), deviation(values))
