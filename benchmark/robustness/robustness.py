#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""How mivo, the paper's methods and OpenCV's odometries stand light, darkness, loss and rest.

    scripts/benchmark robustness [--quick] [--document] [--only PART]... [--methods NAME]...

Films and relights what it needs, runs every method over it and prints the tables of
doc/robustness.md. What is filmed already is kept, what was run by the same program too.
"""

import argparse
import datetime
import os
import sys

import numpy as np

HERE = os.path.dirname(os.path.realpath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
sys.path.append(os.path.dirname(HERE))

import events  # noqa: E402
import models  # noqa: E402
import shutter as shutters  # noqa: E402
from measuring import machine, sequences  # noqa: E402  found by the path above
from measuring.jobs import Folder, Job  # noqa: E402
from measuring.methods import raw_words  # noqa: E402
from measuring.programs import MeasuringError, Programs  # noqa: E402
from measuring.progress import Progress  # noqa: E402
from measuring.statistics import quantile, read_rows, read_value_file, rpe  # noqa: E402
from measuring.tables import table  # noqa: E402
from measuring.trajectories import (  # noqa: E402
    covariance_of, difference, normalised_error, poses_at, read_trajectory)

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
RELIT = ["ramp_step", "oscillating", "spot", "gradient", "gamma", "auto_exposure", "inversion"]
NEAR_DARK = ["darkness", "black"]
RECORDINGS = ["tum_fr1_rpy_first240", "sun3d_xtion_fragA"]
CALLED_WRONG_M, CALLED_WRONG_DEG = 0.10, 5.0


class Bench:
    def __init__(self, options):
        self.options = options
        self.results = Folder(os.path.abspath(options.output))
        self.programs = Programs(options.build)
        self.lines = []
        self.methods = options.methods or list(METHODS)
        self.frames = 60 if options.quick else 100
        self.size = ["--width", 320, "--height", 240] if options.quick else []
        self.scenes = SCENES[:1] if options.quick else SCENES
        self.paths = PATHS[-1:] if options.quick else PATHS
        os.makedirs(self.results.file("sequences"), exist_ok=True)

    def say(self, line):
        print(line, flush=True)
        self.lines.append(line)

    def folder(self, name):
        return self.results.file("sequences", name)

    def filmed(self, scene, seed, path, light):
        """A filmed sequence. `auto_exposure`: the oscillating lamps under an automatic exposure."""
        name = f"{scene}{seed}_{path}_{light}_{self.frames}"
        options = self.size + (["--auto-exposure"] if light == "auto_exposure" else [])
        lamps = "oscillating" if light == "auto_exposure" else light
        return sequences.generate(self.programs, self.folder(name), "--frames", self.frames,
                                  "--scene", scene, "--trajectory", path, "--lighting", lamps,
                                  "--seed", seed, *options)

    def recordings(self):
        found = sequences.find_recordings("groundtruth.txt")
        if not found:
            print("recordings are left out: MIVO_DATA names no folder", file=sys.stderr)
        return [found[name] for name in RECORDINGS if name in found]

    def relit(self, source, light):
        if light == "constant":
            return source
        name = f"{os.path.basename(source)}_{light}"
        return sequences.relight(self.programs, source, self.folder(name), light)

    def run(self, method, folder, *options):
        """Figures of a run; its trajectory and statistics stay in `runs`."""
        words = METHODS[method][1:] + [str(option) for option in options]
        name = "-".join([os.path.basename(folder), method]
                        + [str(option).strip("-") for option in options])
        base = self.results.file("runs", name)
        command = [self.programs.path(METHODS[method][0]), folder] + words + [
            "--output", base + ".txt", "--force"]
        if METHODS[method][0] == "run_sequence":
            command += ["--statistics", base + ".csv", "--write-lost"]  # a pose for each row
        judge = [self.programs.path("evaluate_trajectory"),
                 os.path.join(folder, "groundtruth.txt"), base + ".txt"]
        self.results.run_once(Job("run/" + name, [command + [">", base + ".summary"],
                                                  judge + [">", base + ".errors"]],
                                  sequences=[folder]))
        figures = read_value_file(base + ".summary")
        figures.update(read_value_file(base + ".errors"))
        figures["base"] = base
        return figures

    def judged(self, figures, folder):
        """Frames of a run that are called tracking although their pose against the keyframe is
        wrong; all of them by state; the first that is right again after each loss."""
        stamps, poses = read_trajectory(figures["base"] + ".txt")
        truth, has_truth = poses_at(stamps, *read_trajectory(os.path.join(folder,
                                                                          "groundtruth.txt")))
        keyframe_of, wrong = {}, []
        rows = read_rows(figures["base"] + ".csv")
        made = 0
        for i, row in enumerate(rows):
            number = int(row["keyframe"])
            if row["state"] == "tracking" and number in keyframe_of and has_truth[i]:
                k = keyframe_of[number]
                metres, radians = difference(poses[k], poses[i], truth[k], truth[i])
                if metres > CALLED_WRONG_M or np.degrees(radians) > CALLED_WRONG_DEG:
                    wrong.append(i)
            if row["new_keyframe"] == 1.0:
                made += 1
                keyframe_of[made] = i
        return wrong, rows, poses, truth


def cell(figures):
    metres, degrees = rpe(figures)
    lost = int(figures.get("lost", 0))
    return f"{metres:.4f} {degrees:.3f}" + (f" ({lost} lost)" if lost else "")


def print_table(bench, title, head, rows, text=""):
    bench.say(f"\n## {title}\n")
    if text:
        bench.say(text.strip() + "\n")
    bench.say(table(head, rows).rstrip("\n"))


def light(bench):
    """RPE over 1 s under each light, and its ratio to constant light."""
    tasks = []
    for scene, seed in bench.scenes:
        for path in bench.paths:
            tasks += [(f"{scene} {path}", name, "generated",
                       lambda s=scene, e=seed, p=path, n=name: bench.filmed(s, e, p, n))
                      for name in FILMED_LIGHT]
    for recording in bench.recordings():
        tasks += [(os.path.basename(recording), name, "recording",
                   lambda r=recording, n=name: bench.relit(r, n)) for name in ["constant"] + RELIT]
    rows, default, peers, progress = [], {}, {}, Progress(len(tasks), "sequences of light")
    for name, lamps, kind, folder_of in tasks:
        folder = folder_of()
        results = {method: bench.run(method, folder) for method in bench.methods}
        rows.append([name, lamps] + [cell(results[method]) for method in bench.methods])
        if "mivo" in results:
            which = "median" if name.startswith("tum") else "rmse"
            default[name, lamps] = (kind, rpe(results["mivo"], which))
        peers[name, lamps] = min((rpe(results[m])[0] for m in ("rgbd", "rgbd_icp") if m in results),
                                 default=None)
        progress.step(f"{name} {lamps}")
    progress.close()
    print_table(bench, "Light: RPE over 1 s, m deg", ["sequence", "light"] + bench.methods, rows)
    judge_light(bench, default, peers)


def judge_light(bench, default, peers):
    if not default:
        return
    ratios, generated = [], []
    for (name, lamps), (kind, (metres, degrees)) in default.items():
        if lamps != "constant":
            base = default[name, "constant"][1]
            ratios.append((metres / base[0], degrees / base[1], f"{name} {lamps}"))
        if kind == "generated":
            generated.append((metres, degrees, f"{name} {lamps}"))
    worst = max(ratios, key=lambda row: row[0])
    bench.say(f"\nchanging light against constant light: worst RPE ratio {worst[0]:.2f} ({worst[2]}), "
          f"{sum(row[0] > 1.10 for row in ratios)} of {len(ratios)} above 1.10; rotation worst "
          f"{max(row[1] for row in ratios):.2f}")
    bench.say("generated: RPE median {:.4f} m {:.3f} deg, worst {:.4f} m ({}) {:.3f} deg".format(
        quantile([row[0] for row in generated], 0.5),
        quantile([row[1] for row in generated], 0.5), max(generated)[0], max(generated)[2],
        max(row[1] for row in generated)))
    shares = [default[key][1][0] / peer for key, peer in peers.items() if peer and
              default[key][0] == "generated"]
    if shares:
        bench.say(f"generated: at most {max(shares):.3f} of OpenCV's better one, median "
              f"{quantile(shares, 0.5):.3f}")


def darkness(bench):
    """20 nearly dark or black frames, with depth and without."""
    rows = []
    recordings = bench.recordings()
    progress = Progress(
        len(NEAR_DARK) * (len(bench.scenes) * len(bench.paths) + len(recordings)),
        "sequences of darkness")
    for scene, seed in bench.scenes:
        for path in bench.paths:
            for kind in NEAR_DARK:
                folder = bench.filmed(scene, seed, path, kind)
                rows.append([f"{scene} {path}", kind] +
                            [cell(bench.run(method, folder)) for method in bench.methods] +
                            [after_darkness(bench, folder)])
                progress.step(f"{scene} {path} {kind}")
    for recording in recordings:
        for kind in NEAR_DARK:
            folder = bench.relit(recording, kind)
            rows.append([os.path.basename(recording), kind] +
                        [cell(bench.run(method, folder)) for method in bench.methods] + [""])
            progress.step(f"{os.path.basename(recording)} {kind}")
    progress.close()
    print_table(bench, "Darkness: RPE over 1 s, m deg",
                ["sequence", "dark"] + bench.methods + ["without depth: 5 frames later"], rows)


def after_darkness(bench, folder):
    """The same without depth in the dark: pose error 5 frames after the light is back."""
    first = (bench.frames - 20) // 2
    bare = events.without_depth(folder + "_without_depth", folder, first, 20)
    figures = bench.run("mivo", bare)
    wrong, rows, poses, truth = bench.judged(figures, bare)
    states = {row["state"] for row in rows[first + 2:first + 18]}
    metres, radians = difference(poses[0], poses[first + 25], truth[0], truth[first + 25])
    return f"{metres:.4f} {np.degrees(radians):.3f}, {'/'.join(sorted(states))}, {len(wrong)} wrong"


def loss(bench):
    """Frames called tracking that are not, good frames called lost, recovery."""
    rows = []
    places = [bench.filmed(scene, seed, "figure_of_eight", "constant")
              for scene, seed in bench.scenes]
    middle = bench.frames // 2
    missing = 3 * bench.frames // 10  # more than a second is left of a short sequence, too
    for i, place in enumerate(places):
        name = os.path.basename(place)
        other = places[(i + 1) % len(places)] if len(places) > 1 else bench.filmed(
            "office", 2, "rotation", "constant")
        for kind, folder in [
                ("covered 2 s", events.covered(place + "_covered", place, middle, 60)),
                ("teleport", events.teleported(place + "_teleport", place, middle - missing // 2,
                                               missing)),
                ("joined", events.joined(place + "_joined", place, other, middle)),
                ("blurred", events.blurred(place + "_blurred", place, middle, 10))]:
            figures = bench.run("mivo", folder)
            wrong, frames, poses, truth = bench.judged(figures, folder)
            back = ""
            if kind == "covered 2 s":
                back = recovery(frames, poses, truth, middle + 60)
            rows.append([name, kind, figures["tracked"], figures["degraded"], figures["lost"],
                         str(len(wrong)), back])
    print_table(bench, "Loss", ["sequence", "event", "tracking", "degraded", "lost",
                         "wrong but tracking", "frames until recovered"], rows)


def recovery(frames, poses, truth, first):
    """Frames from `first` on until the state is good and the pose within 2 cm, 1 deg again."""
    for i in range(first, len(frames)):
        metres, radians = difference(poses[0], poses[i], truth[0], truth[i])
        if frames[i]["state"] in ("tracking", "degraded") and metres < 0.02 and \
                np.degrees(radians) < 1.0:
            return str(i - first + 1)
    return "never"


def static(bench):
    """Table III: one real or filmed frame relit, every frame from a disturbed start."""
    rows = []
    for scene, seed in bench.scenes:
        for kind, light_name in (("S1", "ramp_step"), ("S2", "moving_lamp")):
            folder = bench.filmed(scene, seed, "static", light_name)
            cells = []
            for method in bench.methods:
                if METHODS[method][0] != "run_sequence":
                    continue
                figures = bench.run(method, folder, "--reference", "first", "--disturb", 0.005,
                                    0.005, "--seed", 1)
                _, poses = read_trajectory(figures["base"] + ".txt")
                sizes = np.array([difference(np.eye(4), np.eye(4), poses[0], pose)
                                  for pose in poses[1:]])
                cells.append("{:.3f} mm {:.3f} mrad".format(*(1e3 * np.median(sizes, axis=0))))
            rows.append([f"{scene}{seed}", kind] + cells)
    print_table(bench, "Static, disturbed starts: median error",
                ["scene", "light"] + [m for m in bench.methods if METHODS[m][0] == "run_sequence"],
                rows)


def rest(bench):
    """A camera that stands still: rms about its mean."""
    rows = []
    for scene, seed in bench.scenes:
        for lamps in ("constant", "oscillating"):
            folder = bench.filmed(scene, seed, "static", lamps)
            figures = bench.run("mivo", folder)
            _, poses = read_trajectory(figures["base"] + ".txt")
            positions = poses[:, :3, 3]
            rms = np.sqrt(np.mean(np.sum((positions - positions.mean(axis=0))**2, axis=1)))
            angles = [difference(np.eye(4), np.eye(4), poses[len(poses) // 2], pose)[1]
                      for pose in poses]
            rows.append([f"{scene}{seed}", lamps, f"{1e3 * rms:.3f}",
                         f"{np.degrees(np.sqrt(np.mean(np.square(angles)))):.4f}"])
    print_table(bench, "Standing still", ["scene", "light", "rms mm", "rms deg"], rows)


def covariance(bench):
    """Error of each pose, the first being true, over the covariance that is claimed for it."""
    rows, every = [], []
    for scene, seed in bench.scenes:
        for path in bench.paths:
            folder = bench.filmed(scene, seed, path, "constant")
            figures = bench.run("mivo", folder)
            _, frames, poses, truth = bench.judged(figures, folder)
            world = truth[0] @ np.linalg.inv(poses[0])
            ratios = [normalised_error(world @ poses[i], truth[i], covariance_of(frames[i])) / 6.0
                      for i in range(1, len(frames))]
            every += ratios
            rows.append([f"{scene}{seed} {path}", f"{np.mean(ratios):.2f}",
                         f"{np.median(ratios):.2f}", f"{np.quantile(ratios, 0.95):.2f}"])
    rows.append(["all", f"{np.mean(every):.2f}", f"{np.median(every):.2f}",
                 f"{np.quantile(every, 0.95):.2f}"])
    print_table(bench, "Covariance: NEES / 6", ["sequence", "mean", "median", "95 %"], rows)


def compared(bench):
    """mivo on lcn, on intensities, and on other maps of the images."""
    for title, head, rows in models.tables(bench):
        print_table(bench, title, head, rows)


def shutter(bench):
    """Ten seeds with and without a rolling shutter."""
    print_table(bench, "Read-out time", shutters.HEAD, shutters.rows(bench), shutters.TEXT)


PARTS = {"light": light, "darkness": darkness, "loss": loss, "static": static, "rest": rest,
         "covariance": covariance, "shutter": shutter, "models": compared}


def document(bench):
    """Writes doc/robustness.md: the remarks, then the tables of this run."""
    with open(os.path.join(HERE, "remarks.md"), encoding="utf-8") as file:
        remarks = file.read()
    with open(os.path.join(ROOT, "doc", "robustness.md"), "w", encoding="utf-8") as file:
        file.write(remarks + f"\n`scripts/benchmark robustness --document`, {datetime.date.today()}, "
                   f"{machine.processor()}.\n" + "\n".join(bench.lines) + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true",
                        help="one scene and path, short sequences of small images")
    parser.add_argument("--build", default="build", metavar="FOLDER")
    parser.add_argument("--output", default="benchmark_output/robustness", metavar="FOLDER")
    parser.add_argument("--document", action="store_true", help="write doc/robustness.md, too")
    parser.add_argument("--only", action="append", choices=list(PARTS), metavar="PART",
                        help=f"one of {', '.join(PARTS)}; may be repeated")
    parser.add_argument("--methods", action="append", choices=list(METHODS), metavar="NAME",
                        help=f"one of {', '.join(METHODS)}; may be repeated")
    bench = Bench(parser.parse_args())
    try:
        for part in bench.options.only or PARTS:
            PARTS[part](bench)
    except MeasuringError as error:
        sys.exit(f"robustness: {error}")
    if bench.options.document:
        document(bench)


if __name__ == "__main__":
    main()
