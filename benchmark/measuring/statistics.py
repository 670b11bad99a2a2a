# SPDX-License-Identifier: BSD-3-Clause
"""Reads what programs print and their tables of one row per frame, and sums up."""

import csv
import math


def read_values(text):
    """Lines `name: value`, the values as text."""
    return dict(line.split(": ", 1) for line in text.splitlines() if ": " in line)


def read_value_file(path):
    with open(path, encoding="utf-8") as file:
        return read_values(file.read())


def rpe(figures, which="rmse"):
    """Meters and degrees of what evaluate_trajectory printed."""
    return (float(figures[f"rpe_translation_{which}_m"]),
            float(figures[f"rpe_rotation_{which}_deg"]))


def read_rows(path):
    """Rows of a CSV file with a header: numbers where they are numbers."""
    with open(path, encoding="utf-8") as table:
        return [{name: number_or_text(text) for name, text in row.items()}
                for row in csv.DictReader(table)]


def number_or_text(text):
    try:
        return float(text)
    except ValueError:
        return text


def column(rows, name):
    return [row[name] for row in rows]


def mean(values):
    return sum(values) / len(values)


def geometric_mean(values):
    return math.exp(mean([math.log(value) for value in values]))


def deviation(values):
    middle = mean(values)
    return (sum((value - middle) ** 2 for value in values) / max(1, len(values) - 1)) ** 0.5


def quantile(values, share):
    """Interpolated between neighbors."""
    ordered = sorted(values)
    place = share * (len(ordered) - 1)
    low = int(place)
    high = min(low + 1, len(ordered) - 1)
    return ordered[low] + (place - low) * (ordered[high] - ordered[low])


def by_frame(runs):
    """Runs of the same frames: for each number the median over the runs."""
    merged = []
    for rows in zip(*runs):
        row = dict(rows[0])
        for name, value in rows[0].items():
            if isinstance(value, float):
                row[name] = quantile([other[name] for other in rows], 0.5)
        merged.append(row)
    return merged
