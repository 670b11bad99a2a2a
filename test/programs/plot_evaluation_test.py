# SPDX-License-Identifier: BSD-3-Clause
"""What plot_evaluation draws: texts beside each other, coordinates far away, few points.

    plot_evaluation_test.py PLOT_EVALUATION
"""
import functools
import importlib.machinery
import importlib.util
import math
import sys
import unittest

try:
    from matplotlib.backends.backend_agg import FigureCanvasAgg
except ImportError:
    print("skipped: python3-matplotlib is missing")
    sys.exit(77)


def load(path):
    loader = importlib.machinery.SourceFileLoader("plot_evaluation", path)
    spec = importlib.util.spec_from_loader("plot_evaluation", loader)
    module = importlib.util.module_from_spec(spec)
    loader.exec_module(module)
    return module


sys.dont_write_bytecode = True
PLOT = load(sys.argv.pop())


def data_of(count, place=(0.0, 0.0, 0.0), size=1.0, error=0.01):
    """Half a circle of `count` poses at a place (m), and errors that grow to `error`."""
    angles = [math.pi * i / max(count - 1, 1) for i in range(count)]
    path = {"x": [place[0] + size * math.cos(a) for a in angles],
            "y": [place[1] + size * math.sin(a) for a in angles],
            "z": [place[2]] * count}
    times = [0.1 * i for i in range(count)]
    errors = [error * (i + 1) / count for i in range(count)]
    return {"truth": path, "estimate": path,
            "absolute": {"time": times, "error": errors, "rmse": 0.5 * error},
            "drift": {"time": times, "translation": errors, "rotation": errors},
            "delta": 1.0, "duration": times[-1]}


CASES = {
    "usual": data_of(300),
    "UTM": data_of(300, (4.5e5, 5.4e6, 120.0), 30.0),
    "negative UTM": data_of(300, (-4.5e5, -5.4e6, 0.0), 0.5),
    "kilometers": data_of(300, size=2e4, error=300.0),
    "nanometers": data_of(300, size=1e-9, error=1e-9),
    "at rest, without error": data_of(300, size=0.0, error=0.0),
    "two poses": data_of(2),
    "one pair": dict(data_of(2), drift={"time": [0.0], "translation": [0.1], "rotation": [5.0]}),
    "no drift": dict(data_of(20), drift={"time": [], "translation": [], "rotation": []}),
}


@functools.lru_cache(maxsize=None)
def drawn(name):
    figure = PLOT.make_figure(CASES[name])
    FigureCanvasAgg(figure).draw()
    return figure


def boxes(texts):
    return [(text.get_text(), text.get_window_extent()) for text in texts
            if text.get_visible() and text.get_text()]


def tick_labels(axis):
    """Those within the axis: matplotlib keeps others, which it does not draw."""
    low, high = sorted(axis.get_view_interval())
    margin = 1e-6 * (high - low)
    return [tick.label1 for tick in axis.get_major_ticks()
            if low - margin <= tick.get_loc() <= high + margin]


class PlotTest(unittest.TestCase):
    def test_no_text_lies_on_another(self):
        for name in CASES:
            figure = drawn(name)
            texts = []
            for axes in figure.axes:
                texts += boxes([axes.title, axes.xaxis.label, axes.yaxis.label])
                for axis in (axes.xaxis, axes.yaxis):
                    texts += boxes(tick_labels(axis))
                    texts += boxes([axis.get_offset_text()])
            self.assertGreater(len(texts), 30)
            for i, (text, box) in enumerate(texts):
                for other, other_box in texts[:i]:
                    self.assertFalse(box.overlaps(other_box),
                                     "{}: '{}' on '{}'".format(name, text, other))

    def test_texts_lie_within_the_paper(self):
        for name in CASES:
            figure = drawn(name)
            for axes in figure.axes:
                for text, box in boxes([axes.title, axes.xaxis.label, axes.yaxis.label]):
                    self.assertTrue(box.x0 >= 0 and box.y0 >= 0 and box.x1 <= figure.bbox.width and
                                    box.y1 <= figure.bbox.height, "{}: {}".format(name, text))

    def test_far_coordinates_have_their_common_part_in_the_label(self):
        axes = drawn("UTM").axes[0]
        self.assertEqual(axes.get_xlabel(), "x − 450000 (m)")
        self.assertEqual(axes.get_ylabel(), "y − 5400000 (m)")
        self.assertLess(max(abs(value) for value in axes.lines[0].get_xdata()), 100.0)
        negative = drawn("negative UTM").axes[0]
        self.assertEqual(negative.get_xlabel(), "x + 450000 (m)")
        self.assertEqual(drawn("usual").axes[0].get_xlabel(), "x (m)")

    def test_few_points_are_marked(self):
        for name in ("two poses", "one pair"):
            for axes in drawn(name).axes:
                for line in axes.lines:
                    self.assertEqual(line.get_marker(), "o", name)
        for axes in drawn("usual").axes:
            for line in axes.lines:
                self.assertEqual(line.get_marker(), "None")

    def test_points_lie_within_the_axes(self):
        for name in CASES:
            for axes in drawn(name).axes:
                (x0, x1), (y0, y1) = axes.get_xlim(), axes.get_ylim()
                for line in axes.lines:
                    for x, y in zip(line.get_xdata(), line.get_ydata()):
                        self.assertTrue(x0 <= x <= x1 and y0 <= y <= y1, name)

    def test_curves_are_the_data(self):
        axes = drawn("usual").axes
        self.assertEqual(list(axes[0].lines[1].get_ydata()), CASES["usual"]["estimate"]["y"])
        self.assertEqual(list(axes[2].lines[0].get_ydata()), CASES["usual"]["absolute"]["error"])
        self.assertEqual(axes[2].get_title(), "Absolute trajectory error, rmse 0.005 m")


if __name__ == "__main__":
    unittest.main()
