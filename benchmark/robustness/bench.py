# SPDX-License-Identifier: BSD-3-Clause
"""Common to all parts: rendering sequences, running methods, printing tables."""

import os
import sys

from judging import wrong_motions
from measuring import sequences
from measuring.jobs import Folder, Job
from measuring.methods import raw_words
from measuring.programs import MeasuringError, Programs
from measuring.statistics import read_value_file, rpe
from measuring.tables import table
from measuring.tracks import read_frames

METHODS = {
    "mivo": ["run_sequence"],
    "hybrid": ["run_sequence"] + raw_words("hybrid"),
    "mi": ["run_sequence"] + raw_words("mi"),
    "ssd": ["run_sequence"] + raw_words("ssd"),
    "rgbd": ["run_peer", "--method", "rgbd"],
    "rgbd_icp": ["run_peer", "--method", "rgbd_icp"],
}
SCENES = [("room", 1), ("office", 2), ("corridor", 3)]
PATHS = ["rotation", "translation", "figure_of_eight"]
FILMED_LIGHT = ["constant", "ramp_step", "oscillating", "moving_lamp", "left_right", "auto_exposure"]
RECORDINGS = ["tum_fr1_rpy_first240", "sun3d_xtion_fragA"]
SMALL = ["--width", 320, "--height", 240]
NOTHING_TRACKED = 1  # exit code of run_sequence: a result, too, where a view shows nothing


class Bench:
    def __init__(self, options):
        self.options = options
        self.results = Folder(os.path.abspath(options.output))
        self.programs = Programs(options.build)
        self.lines = []
        self.methods = options.methods or list(METHODS)
        self.frames = 60 if options.quick else 100
        self.size = SMALL if options.quick else []
        self.scenes = SCENES[:1] if options.quick else SCENES
        self.paths = PATHS[-1:] if options.quick else PATHS
        os.makedirs(self.results.file("sequences"), exist_ok=True)

    def say(self, line):
        print(line, flush=True)
        self.lines.append(line)

    def say_table(self, title, head, rows, text=""):
        self.say(f"\n## {title}\n")
        if text:
            self.say(text.strip() + "\n")
        self.say(table(head, rows).rstrip("\n"))

    def trackers(self):
        """Of the compared methods those that report a state for each frame."""
        return [method for method in self.methods if METHODS[method][0] == "run_sequence"]

    def folder(self, name):
        return self.results.file("sequences", name)

    def generate(self, name, *options):
        return sequences.generate(self.programs, self.folder(name), *options)

    def filmed(self, scene, seed, path, light):
        """A filmed sequence. `auto_exposure`: the oscillating lamps under an automatic exposure."""
        options = self.size + (["--auto-exposure"] if light == "auto_exposure" else [])
        lamps = "oscillating" if light == "auto_exposure" else light
        return self.generate(f"{scene}{seed}_{path}_{light}_{self.frames}", "--frames", self.frames,
                             "--scene", scene, "--trajectory", path, "--lighting", lamps,
                             "--seed", seed, *options)

    def recordings(self):
        found = sequences.find_recordings("groundtruth.txt")
        if not found:
            print("recordings are skipped: MIVO_DATA is not set", file=sys.stderr)
        return [found[name] for name in RECORDINGS if name in found]

    def relit(self, source, light):
        if light == "constant":
            return source
        name = f"{os.path.basename(source)}_{light}"
        return sequences.relight(self.programs, source, self.folder(name), light)

    def run(self, method, folder, *options):
        """Figures of a run; its trajectory and statistics stay in `runs`."""
        base, command = self.command(method, folder, options)
        judge = [self.programs.path("evaluate_trajectory"),
                 os.path.join(folder, "groundtruth.txt"), base + ".txt"]
        self.results.run_once(Job("run/" + os.path.basename(base),
                                  [command + [">", base + ".summary"],
                                   judge + [">", base + ".errors"]], sequences=[folder]))
        figures = read_value_file(base + ".summary")
        figures.update(read_value_file(base + ".errors"))
        figures["base"] = base
        return figures

    def track(self, method, folder, *options):
        """Frames of a run (measuring.tracks) in which perhaps nothing was tracked."""
        base, command = self.command(method, folder, options)
        self.results.run_once(Job("track/" + os.path.basename(base),
                                  [command + [">", base + ".summary"]], sequences=[folder],
                                  accepted=(0, NOTHING_TRACKED)))
        if not os.path.exists(base + ".csv"):
            raise MeasuringError(f"{os.path.basename(base)}: run_sequence left no statistics")
        return read_frames(base, folder)

    def command(self, method, folder, options):
        """The files of a run without their endings, and the words that make them."""
        words = [str(option) for option in options]
        name = "-".join([os.path.basename(folder), method] + [word.strip("-") for word in words])
        base = self.results.file("runs", name)
        os.makedirs(os.path.dirname(base), exist_ok=True)
        command = [self.programs.path(METHODS[method][0]), folder] + METHODS[method][1:] + words + [
            "--output", base + ".txt", "--force"]
        if METHODS[method][0] == "run_sequence":
            command += ["--write-lost", "--statistics", base + ".csv"]
        return base, command

    def wrong(self, figures, folder):
        """How many frames of a run are wrong and called tracking, as text."""
        return str(len(wrong_motions(read_frames(figures["base"], folder), self.is_recorded(folder))))

    def is_recorded(self, folder):
        """Its truth errs, too, whatever light was put on it."""
        return os.path.basename(folder).startswith(tuple(RECORDINGS))


def cell(figures):
    meters, degrees = rpe(figures)
    lost = int(figures.get("lost", 0))
    return f"{meters:.4f} {degrees:.3f}" + (f" ({lost} lost)" if lost else "")
