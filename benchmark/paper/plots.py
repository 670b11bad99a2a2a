# SPDX-License-Identifier: BSD-3-Clause
"""The figures. Lines differ by dashes and markers, to be distinguishable in gray."""

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  the backend must be chosen before
import numpy as np  # noqa: E402
from PIL import Image  # noqa: E402

import plan as plans  # noqa: E402  finds the modules of measuring
from measuring.tables import LEVELS  # noqa: E402

STYLES = {
    "ssd": dict(color="0.45", linestyle="--", marker="s"),
    "mi": dict(color="0.0", linestyle="-", marker="o"),
    "mi_8": dict(color="0.0", linestyle="-", marker="o"),
    "mi_16": dict(color="0.2", linestyle="-.", marker="^"),
    "mi_32": dict(color="0.4", linestyle="-.", marker="v"),
    "mi_64": dict(color="0.55", linestyle=":", marker="D"),
    "mi_all": dict(color="0.0", linestyle=":", marker="x"),
    "hybrid": dict(color="0.6", linestyle="-", marker="P"),
    "default": dict(color="tab:blue", linestyle="-", marker="*", linewidth=2.2, markersize=9),
}
plt.rcParams.update({"font.size": 9, "axes.grid": True, "axes.axisbelow": True, "grid.color": "0.88", "figure.dpi": 110,
                     "lines.markersize": 5, "lines.linewidth": 1.4, "legend.framealpha": 0.9})


SMALLEST = 1e-5  # m: a pose that did not move at all has no place on a logarithmic axis


def save(figure, path):
    figure.tight_layout()
    figure.savefig(path)
    plt.close(figure)
    # 64 colors are enough for grays and one blue, and a third of the size.
    with Image.open(path) as picture:
        small = picture.convert("RGB").quantize(64, dither=Image.NONE)
    small.save(path, optimize=True)


def show(axes, path, title, **options):
    """A gray picture of a PNG file."""
    axes.imshow(plt.imread(path), cmap="gray", interpolation="antialiased", **options)
    axes.set_title(title, fontsize=9)
    axes.set_axis_off()


def convergence(results, path):
    """Fig. 3, and the same in other light."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(9.5, 3.9), sharey=True)
    for axes, methods, relit in ((left, plans.CONVERGENCE_METHODS, False),
                                 (right, plans.RELIT_METHODS, True)):
        for method in methods:
            basin = results.basin(method, relit)
            low, high = basin.interval()
            style = STYLES[method.key]
            axes.plot(basin.magnitude, 100 * basin.rate, label=method.title, **style)
            axes.fill_between(basin.magnitude, 100 * low, 100 * high, color=style["color"],
                              alpha=0.13, linewidth=0)
        axes.set_xlabel("norm of the starting twist (m, rad)")
        axes.legend(fontsize=8)
    left.set_ylabel("converged (%), 95 % interval")
    left.set_title("same light")
    right.set_title("keyframe in even light, live frame under a moving lamp")
    save(figure, path)


def ideal(results, path):
    """Fig. 2: pictures and the distribution of the errors."""
    experiments = results.experiments
    figure, axes = plt.subplots(2, 3, figsize=(10, 5.2))
    for column, (image, title) in enumerate((("keyframe.png", "reference image"),
                                             ("depth.png", "depth, near is bright"),
                                             ("points.png", "selected pixels, level 0"))):
        show(axes[0, column], results.picture("reference", image), title)
    axes[1, 2].set_axis_off()
    for column, (name, unit) in enumerate((("translation", "mm"), ("rotation", "mrad"))):
        for method in plans.PAPER_METHODS:
            errors = results.errors("moving", [experiments.plan.ideal], method)
            values = np.sort(1e3 * getattr(errors, name))
            share = 100 * (np.arange(len(values)) + 1) / len(values)
            style = dict(STYLES[method.key], marker=None)
            axes[1, column].plot(values, share, label=method.title, **style)
        axes[1, column].set_xscale("log")
        axes[1, column].set_xlabel("%s error from frame to frame (%s)" % (name, unit))
        axes[1, column].set_ylabel("frames below (%)")
    handles, labels = axes[1, 0].get_legend_handles_labels()
    axes[1, 2].legend(handles, labels, loc="center left")
    save(figure, path)


def static_errors(results, path):
    """Fig. 5: errors against the first image over time, and the light."""
    plan = results.experiments.plan
    figure, axes = plt.subplots(3, 2, figsize=(9.5, 6.8), sharex="col",
                                gridspec_kw={"height_ratios": [3, 3, 1]})
    for column, (case, title) in enumerate((("s1", "S1: light ramps down, then jumps back"),
                                            ("s2", "S2: a lamp moves through the view"))):
        key = plan.static[case][0]
        for row, (kind, start) in enumerate((("first", "from the last pose"),
                                             ("disturbed", "from 5 mm and 5 mrad away"))):
            for method in plans.PAPER_METHODS:
                errors = results.errors(kind, [key], method)
                style = dict(STYLES[method.key], markevery=max(1, len(errors.stamp) // 12))
                seconds = errors.stamp - errors.stamp[0]
                axes[row, column].plot(seconds, 1e3 * np.maximum(errors.translation, SMALLEST),
                                       label=method.title, **style)
            axes[row, column].set_yscale("log")
            axes[row, column].set_ylabel("translation error (mm)")
            axes[row, column].set_title("%s;\nstarted %s" % (title, start), fontsize=9)
        seconds, lux = results.illuminance(key)
        axes[2, column].plot(seconds - seconds[0], lux, color="0.3")
        axes[2, column].set_ylim(bottom=0)
        axes[2, column].set_xlabel("time (s)")
        axes[2, column].set_ylabel("lux" if case == "s1" else "lux without\nthat lamp")
    axes[0, 0].legend(fontsize=8)
    save(figure, path)


def static_pictures(results, path, name, live_title):
    """Figs. 1 and 6: reference, live image and residuals."""
    figure, axes = plt.subplots(1, 4, figsize=(11, 2.5))
    mi, ssd = name + "_mi", name + "_ssd"
    show(axes[0], results.picture(mi, "keyframe.png"), "reference", vmin=0, vmax=1)
    show(axes[1], results.picture(mi, "live.png"), live_title, vmin=0, vmax=1)
    show(axes[2], results.picture(mi, "residual.png"), "residual, MI", vmin=0, vmax=1)
    show(axes[3], results.picture(ssd, "residual.png"), "residual, SSD", vmin=0, vmax=1)
    save(figure, path)


def blurred(results, path):
    """Fig. 4: two blurred images and the residual."""
    figure, axes = plt.subplots(1, 4, figsize=(11, 2.5))
    for one, image, title in zip(axes, ("keyframe.png", "depth.png", "live.png", "residual.png"),
                                 ("reference", "depth", "live", "residual after tracking")):
        show(one, results.picture("blurred", image), title, vmin=0, vmax=1)
    save(figure, path)


def optimizers(results, path):
    """IV-B3: success and time over the magnitude of the start."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.2))
    styles = [dict(color="0.0", linestyle="-", marker="o"),
              dict(color="0.4", linestyle="--", marker="s"),
              dict(color="0.6", linestyle=":", marker="D")]
    for (name, title), style in zip(plans.OPTIMIZERS, styles):
        trials = results.optimizer(name)
        magnitudes = sorted(trials)
        success = [100 * np.mean([t["success"] for t in trials[m]]) for m in magnitudes]
        time = [np.median([t["milliseconds"] for t in trials[m]]) for m in magnitudes]
        left.plot(magnitudes, success, label=title, **style)
        right.plot(magnitudes, time, label=title, **style)
    left.set_ylabel("converged (%)")
    right.set_ylabel("processor time per alignment,\nmedian (ms)")
    right.set_yscale("log")
    for axes in (left, right):
        axes.set_xlabel("norm of the starting twist (m, rad)")
    left.legend(fontsize=8)
    save(figure, path)


def levels(rows, path):
    """Table I as bars; `rows` is {method: statistics of its frames}."""
    figure, axes = plt.subplots(figsize=(7, 3))
    names = list(reversed(LEVELS))
    places = np.arange(len(names))
    width = 0.8 / len(rows)
    for i, (method, hatch) in enumerate(zip(plans.PAPER_METHODS, ("", "////", "....", "xx"))):
        times = [np.mean([row["ms_%d" % name] for row in rows[method.key]]) for name in names]
        axes.bar(places + i * width, times, width, label=method.title, color=str(0.3 + 0.2 * i),
                 hatch=hatch, edgecolor="black")
    axes.set_xticks(places + 0.4 - width / 2)
    axes.set_xticklabels(["level %d" % name for name in names])
    axes.set_ylabel("processor time per frame (ms)")
    axes.legend(fontsize=8)
    save(figure, path)
