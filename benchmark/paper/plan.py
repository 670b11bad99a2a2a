# SPDX-License-Identifier: BSD-3-Clause
"""What is filmed, what is tracked by which method, and how much of it."""

import os
import sys

HERE = os.path.dirname(os.path.realpath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
# The words that a parameter may take stand in the core's table. At the end: names of modules here
# come first.
sys.path += [os.path.join(ROOT, "config"), os.path.join(ROOT, "benchmark")]

import parameter_table  # noqa: E402
from measuring import methods  # noqa: E402

RAW = methods.RAW


class Method:
    """A name for tables and what it sets; without settings it is mivo as it comes."""

    def __init__(self, key, title, **settings):
        self.key = key
        self.title = title
        self.settings = settings

    def words(self):
        return methods.words(self.settings)


def raw(key, title, **settings):
    """A method on the intensities themselves, as the paper has it."""
    return Method(key, title, **dict(RAW, **settings))


MI = raw("mi", "MI", method="mi")
SSD = raw("ssd", "SSD", method="ssd")
HYBRID = raw("hybrid", "hybrid", method="hybrid")
DEFAULT = Method("default", "mivo")
PAPER_METHODS = [MI, SSD, HYBRID, DEFAULT]

MI_BINS = [8, 16, 32, 64]
CONVERGENCE_METHODS = (
    [SSD] + [raw("mi_%d" % bins, "MI, %d bins" % bins, method="mi", mi_bins=bins)
             for bins in MI_BINS]
    + [raw("mi_all", "MI, 8 bins, all pixels", method="mi", mi_bins=8, point_fraction=1), HYBRID,
       DEFAULT])
RELIT_METHODS = [SSD, MI, HYBRID, DEFAULT]
OPTIMIZERS = [("newton", "Newton, full Hessian"), ("lbfgs", "L-BFGS, the same gradient"),
              ("lbfgs_differences", "L-BFGS, gradient by differences")]
PEERS = [(key, "OpenCV " + title) for key, title in methods.PEERS.items()]


def variants():
    """Beyond the paper: every method on every photometric model, every variant of MI (parameters
    named mi_...), and the depth term. What the core learns later is in the tables as soon as it is
    in parameters.def."""
    parameters = parameter_table.read_parameters()
    models = [parameter.words for parameter in parameters if parameter.name == "photometric_model"]
    result = [SSD, MI, HYBRID]
    for model in models[0]:
        if model != RAW["photometric_model"]:
            for method in ("ssd", "mi", "hybrid"):
                result.append(raw("%s_%s" % (method, model), "%s, %s" % (method, model),
                                  method=method, photometric_model=model))
    for parameter in parameters:
        if parameter.name.startswith("mi_"):
            for word in parameter.words:
                if word != parameter.value:
                    result.append(raw("hybrid_%s_%s" % (parameter.name, word),
                                      "hybrid, %s %s" % (parameter.name, word), method="hybrid",
                                      **{parameter.name: word}))
    result.append(raw("hybrid_depth", "hybrid, depth term", method="hybrid", geometric_term="true"))
    result.append(DEFAULT)
    return result


class Sequence:
    """Options of generate_sequence."""

    def __init__(self, key, scene, trajectory, lighting, frames, options=(), seed=1):
        self.key = key
        self.title = "%s, %s" % (scene, lighting.replace("_", " "))
        self.words = ["--scene", scene, "--trajectory", trajectory, "--lighting", lighting,
                      "--frames", str(frames), "--seed", str(seed)] + list(options)


class Plan:
    """Full or quick: the same experiments on fewer and smaller frames."""

    def __init__(self, quick):
        self.quick = quick
        self.frames = 33 if quick else 120  # drift is measured over 1 s
        self.scenes = ["room"] if quick else ["room", "office"]
        self.size = ["--samples", "2"]
        if quick:
            self.size = ["--width", "320", "--height", "240", "--samples", "1"]
        self.trials = 60 if quick else 1000
        self.magnitudes = [0.05, 0.1, 0.2] if quick else [0.05, 0.1, 0.15, 0.2, 0.3, 0.4]
        self.optimizer_trials = 10 if quick else 200
        self.optimizer_magnitudes = [0.02, 0.1] if quick else [0.02, 0.05, 0.1, 0.15]
        self.pairs = 3 if quick else 10
        self.repetitions = 1 if quick else 3  # of what measures time
        self.seed = 7
        self.lamp_frame = 10 if quick else 40
        self.blurred_frame = 12 if quick else 40
        self.sequences = {}
        self.film_all()

    def film(self, key, scene, trajectory, lighting, options=(), seed=1):
        self.sequences[key] = Sequence(key, scene, trajectory, lighting, self.frames,
                                       list(options) + self.size, seed)
        return key

    def film_all(self):
        self.ideal = self.film("ideal", "room", "figure_of_eight", "constant", ["--ideal"])
        # The same seed films the same path: these two are twins in different light.
        self.basin = self.film("basin_constant", "room", "figure_of_eight", "constant")
        self.basin_relit = self.film("basin_moving_lamp", "room", "figure_of_eight", "moving_lamp")
        self.table_2 = {}
        for trajectory in ("translation", "rotation"):
            for lighting in ("constant", "oscillating"):
                self.table_2[trajectory, lighting] = [
                    self.film("%s_%s_%s" % (scene, trajectory, lighting), scene, trajectory,
                              lighting, seed=2) for scene in self.scenes]
        self.static = {"s1": [], "s2": []}
        for scene in self.scenes:
            self.static["s1"].append(self.film("s1_" + scene, scene, "static", "ramp_step"))
            self.static["s2"].append(self.film("s2_" + scene, scene, "static", "moving_lamp"))
        self.blurred = self.film("blurred", "room", "figure_of_eight", "constant",
                                 ["--exposure-time", "0.03"], seed=3)
        self.beyond = [self.basin, self.basin_relit]
        lights = ["oscillating"] if self.quick else ["oscillating", "left_right", "darkness"]
        for lighting in lights:
            self.beyond.append(self.film("beyond_" + lighting, "room", "figure_of_eight", lighting))
        self.beyond.append(self.film("beyond_auto_exposure", "room", "figure_of_eight", "step",
                                     ["--auto-exposure"]))
        self.sequences["beyond_auto_exposure"].title = "room, step, automatic exposure"
        if not self.quick:
            self.beyond.append(self.film("beyond_rolling_shutter", "room", "rotation", "constant",
                                         ["--readout", "0.02"]))
            self.sequences["beyond_rolling_shutter"].title = "room, constant, rows over 20 ms"
