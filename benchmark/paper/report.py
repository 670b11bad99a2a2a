# SPDX-License-Identifier: BSD-3-Clause
"""Writes results.md: every number in it comes from the run."""

import datetime
import os
import subprocess

import numpy as np

import findings
import paper_numbers
import plan as plans  # finds the modules of measuring
import plots
from measuring import machine
from measuring.programs import MeasuringError
from measuring.tables import level_table, table

PICTURES = "results"


def number(value):
    """Three digits: what is small needs decimals. Throws MeasuringError for what is no number."""
    if not np.isfinite(value):
        raise MeasuringError("a result is not finite; the output folder says which")
    return "%.0f" % value if value >= 100 else "%.1f" % value if value >= 10 else "%.2f" % value


def spread(mean, deviation):
    """In thousandths: mm or mrad."""
    return "%s ± %s" % (number(1e3 * mean), number(1e3 * deviation))


def cell(errors):
    return "%s / %s" % (spread(errors.translation.mean(), errors.translation.std()),
                        spread(errors.rotation.mean(), errors.rotation.std()))


def paper_cell(pair):
    return "%s / %s" % (spread(*pair[0]), spread(*pair[1]))


def version(program):
    """What the measured program says of itself: its name and number."""
    found = subprocess.run([program, "--version"], stdout=subprocess.PIPE, universal_newlines=True,
                           check=True)
    return found.stdout.strip()


class Report:
    """The text, section by section, and the figures beside it."""

    def __init__(self, results, folder):
        self.results = results
        self.folder = folder
        self.plan = results.experiments.plan
        self.text = []
        os.makedirs(os.path.join(folder, PICTURES), exist_ok=True)

    def write(self):
        """Throws nothing away: results.md is written when all of it is there."""
        self.introduction()
        self.finding_section()
        self.ideal_section()
        self.convergence_section()
        self.optimiser_section()
        self.level_section()
        self.table_2_section()
        self.static_section()
        self.blur_section()
        if not self.results.experiments.paper_only:
            self.beyond_section()
            self.recording_section()
        self.sequence_section()
        path = os.path.join(self.folder, "results.md")
        with open(path, "w", encoding="utf-8") as output:
            output.write("\n".join(self.text))
        return path

    def add(self, *paragraphs):
        for paragraph in paragraphs:
            self.text.append(paragraph.rstrip("\n") + "\n")

    def figure(self, name, caption, draw, *arguments):
        draw(*arguments, os.path.join(self.folder, PICTURES, name))
        self.add("![%s](%s/%s)" % (caption, PICTURES, name))

    def introduction(self):
        plan = self.plan
        self.add(
            "# The paper's experiments",
            "Section IV of K. S. Shankar and N. Michael, *Robust Direct Visual Odometry using Mutual "
            "Information*, 2016, on sequences that mivo films itself, by the tracker that the nodelet "
            "runs. This page is written by", "    scripts/reproduce_paper%s%s" % (
                " --quick" if plan.quick else "",
                " --paper-only" if self.results.experiments.paper_only else ""),
            "on %s (%d cores), %s, %s, in %.0f minutes of processor time. Sequences have %d frames at 30 Hz%s; their options and "
            "seeds stand at the end. The paper's sequences are recordings of a real camera and of "
            "another synthetic room: its numbers are printed beside ours to compare the order of "
            "the methods, not the digits." % (
                machine.processor(), machine.cores(), datetime.date.today().isoformat(),
                version(self.results.experiments.program("run_sequence")),
                self.results.folder.processor_minutes(self.results.experiments.jobs), plan.frames,
                ", 320 x 240" if plan.quick else ", 640 x 480"),
            "*MI*, *SSD* and *hybrid* are the paper's methods on raw intensities (`method` with "
            "`photometric_model: none`, `geometric_term: false`, `rolling_shutter_estimation: "
            "false`); *mivo* is the tracker as it comes. All track against keyframes. Errors are the "
            "paper's Eq. 6, mean ± standard deviation, in mm / mrad.")

    def finding_section(self):
        rows = [(found.claim, "**%s**" % found.verdict, found.evidence)
                for found in findings.all_findings(self.results)]
        self.add("## What the paper finds, and whether it holds here",
                 table(("finding", "here", "evidence"), rows))
        if not self.plan.quick:  # they are about the numbers of the full run
            self.add(remarks("findings"))

    def ideal_section(self):
        key = self.plan.ideal
        rows = []
        for method in plans.PAPER_METHODS:
            errors = self.results.errors("moving", [key], method)
            rows.append((method.title, cell(errors), number(1e3 * np.median(errors.translation)),
                         number(1e3 * np.median(errors.rotation)), errors.lost))
        self.add("## Errors on an ideal sequence (IV-B1, Fig. 2)",
                 "Figure of eight without noise, blur and holes in depth; from frame to frame.",
                 table(("method", "mean ± deviation", "median mm", "median mrad", "lost frames"),
                       rows))
        self.figure("ideal.png", "Reference image, depth, selected pixels and distributions of the "
                    "errors", plots.ideal, self.results)

    def convergence_section(self):
        plan = self.plan
        header = ["method"] + ["%g" % m for m in plan.magnitudes] + ["mean", "ms"]
        for relit, methods, title in (
                (False, plans.CONVERGENCE_METHODS, "## Convergence (IV-B2, Fig. 3)"),
                (True, plans.RELIT_METHODS, "### The same with the light changed")):
            rows = []
            for method in methods:
                basin = self.results.basin(method, relit)
                rows.append([method.title] + ["%.1f" % (100 * rate) for rate in basin.rate]
                            + ["%.1f" % (100 * basin.mean()), number(basin.milliseconds.mean())])
            self.add(title)
            if not relit:
                self.add("%d random twists per magnitude, uniform in direction in all six degrees of "
                         "freedom (m and rad alike), from the true pose of %d pairs of frames 0.1 s "
                         "apart; converged means errors below 0.01 m and 0.01 rad. Every method meets "
                         "the same twists. Percentages; processor time per alignment." % (
                             plan.trials, plan.pairs))
            else:
                self.add("Keyframes in even light, live frames from the same path under a moving "
                         "lamp: beyond the paper, and what the methods were made for.")
            self.add(table(header, rows))
        self.figure("convergence.png", "Share of starts that converge over their distance from the "
                    "truth", plots.convergence, self.results)

    def optimiser_section(self):
        self.add("## Newton against L-BFGS (IV-B3)")
        if not self.results.experiments.has_optimisers:
            self.add("Not run: this build is without Ceres (`libceres-dev`).")
            return
        rows = []
        for name, title in plans.OPTIMISERS:
            for magnitude, trials in sorted(self.results.optimiser(name).items()):
                column = lambda field: np.array([trial[field] for trial in trials])
                rows.append((title, "%g" % magnitude, "%.1f" % (100 * column("success").mean()),
                             number(1e3 * np.median(column("translation_m"))),
                             number(1e3 * np.median(column("rotation_rad"))),
                             "%.0f" % np.median(column("iterations")),
                             "%.0f" % np.median(column("evaluations")),
                             number(np.median(column("milliseconds")))))
        self.add("The same MI cost, levels, points and starts (%d per magnitude); L-BFGS of Ceres with "
                 "its defaults and the tolerance of our Newton. The gradient that the tracker uses "
                 "warps the keyframe; by differences it is exact for the cost as it is sampled." %
                 self.plan.optimiser_trials,
                 table(("optimiser", "start", "converged %", "median mm", "median mrad", "iterations",
                        "evaluations", "ms"), rows))
        self.figure("optimisers.png", "Convergence and time of the optimisers", plots.optimisers,
                    self.results)

    def level_section(self):
        rows = self.results.level_times()
        paper = [[level] + list(times) for level, times in paper_numbers.TABLE_1.items()]
        self.add("## Time per level (Table I)",
                 "Milliseconds of processor time of one thread per frame on `%s`, mean ± standard "
                 "deviation, as the speed benchmark takes them: without the images' pyramids and new "
                 "keyframes." % self.plan.basin, level_table(rows),
                 "The paper's, on a desktop i7 at 640 x 480:",
                 table(["level", "SSD", "MI", "hybrid"], paper))
        self.figure("levels.png", "Time per level", plots.levels, rows)

    def table_2_section(self):
        names = {"constant": "nominal", "oscillating": "varying light"}
        cases = list(self.plan.table_2)
        header = ["method"] + ["%ss, %s" % (trajectory, names[light])
                               for trajectory, light in cases] + ["lost frames"]
        rows = []
        for method in plans.PAPER_METHODS:
            errors = self.results.table_2(method)
            rows.append([method.title] + [cell(errors[case]) for case in cases]
                        + ["%d of %d" % (sum(e.lost for e in errors.values()),
                                         sum(e.frames for e in errors.values()))])
        for method in plans.PAPER_METHODS[:3]:
            rows.append(["paper: " + method.title] + [
                paper_cell(paper_numbers.TABLE_2[case][method.key]) for case in cases] + [""])
        self.add("## Moving camera (Table II)",
                 "Scenes %s; varying light oscillates between 7.9 and 32.7 lux at 1 Hz. From frame to "
                 "frame; the paper's numbers have the noise of its motion capture in them." %
                 " and ".join(self.plan.scenes), table(header, rows))

    def static_section(self):
        rows = []
        for kind, start in (("first", "last pose"), ("disturbed", "5 mm, 5 mrad away")):
            for method in plans.PAPER_METHODS:
                row = [method.title, start]
                for case in ("s1", "s2"):
                    errors = self.results.errors(kind, self.plan.static[case], method)
                    row += [cell(errors), "%d of %d" % (errors.lost, errors.frames)]
                rows.append(row)
        for method in plans.PAPER_METHODS[:3]:
            row = ["paper: " + method.title, "last pose"]
            for case in ("s1", "s2"):
                row += [paper_cell(paper_numbers.TABLE_3[case][method.key]), ""]
            rows.append(row)
        self.add("## Static camera against the well-lit first image (Table III, Figs. 1, 5 and 6)",
                 "Scenes %s. S1: 61 lux falling to 9.8, then 61 at once; S2: a lamp moves around and "
                 "through the view. Each frame is aligned with the first one, started from the last "
                 "pose as in the paper, and from 5 mm and 5 mrad beside it, for a tracker that never "
                 "moves is perfect in the first. A lost frame keeps the pose it was started from." %
                 " and ".join(self.plan.scenes),
                 table(("method", "start", "S1 mm / mrad", "lost", "S2 mm / mrad", "lost"), rows))
        self.figure("static.png", "Errors over time in S1 and S2", plots.static_errors, self.results)
        self.figure("dark.png", "S1 at its darkest", lambda results, path: plots.static_pictures(
            results, path, "dark", "live, 9.8 lux"), self.results)
        self.figure("lamp.png", "S2 with the lamp on the scene", lambda results, path:
                    plots.static_pictures(results, path, "lamp", "live, lamp moving"), self.results)
        self.add("Residuals are live minus keyframe intensities warped by the pose found, grey where "
                 "they agree.")

    def blur_section(self):
        self.add("## Motion blur (Fig. 4)",
                 "Figure of eight with exposures of 30 ms, tracked by the hybrid: frame %s and its "
                 "residual." % self.results.picture_summary("blurred")["frame"])
        self.figure("blurred.png", "A frame of the figure of eight with blur, and its residual",
                    plots.blurred, self.results)

    def drift_table(self, keys, titles):
        rows = []
        for method, title in self.results.variants():
            row, times = [title], []
            for key in keys:
                figures = self.results.evaluation(key, method)
                row.append("%s / %.2f%s" % (number(1e3 * figures["rpe_translation_rmse_m"]),
                                            figures["rpe_rotation_rmse_deg"],
                                            " (%d)" % figures["lost"] if figures["lost"] else ""))
                times.append(figures["cpu_ms_median"])
            rows.append(row + [number(float(np.median(times)))])
        return table(["method"] + titles + ["ms"], rows)

    def beyond_section(self):
        self.add("## Beyond the paper",
                 "Drift over one second, RMSE in mm / degrees, lost frames in brackets; figure of eight "
                 "unless the title says rows. Median processor time per frame, measured beside other "
                 "work: to compare within the table only. OpenCV's odometries run frame to frame.",
                 self.drift_table(self.plan.beyond,
                                  [self.plan.sequences[key].title for key in self.plan.beyond]))
        if not self.plan.quick:
            self.add(remarks("beyond"))
        self.add("### Tables II and III for all of them",
                 "Mean error, mm / mrad, lost frames in brackets; the static camera from a start 5 mm and "
                 "5 mrad away.", self.variant_table())

    def variant_table(self):
        """Mean errors of the variants on the sequences of Tables II and III."""
        cases = [("%ss, %s" % case, "moving", keys) for case, keys in self.plan.table_2.items()]
        cases += [(case.upper(), "disturbed", keys) for case, keys in self.plan.static.items()]
        rows = []
        for method in self.results.experiments.variants:
            row = [method.title]
            for _, kind, keys in cases:
                errors = self.results.errors(kind, keys, method)
                row.append("%s / %s%s" % (number(1e3 * errors.translation.mean()),
                                          number(1e3 * errors.rotation.mean()),
                                          " (%d)" % errors.lost if errors.lost else ""))
            rows.append(row)
        return table(["method"] + [name for name, _, _ in cases], rows)

    def recording_section(self):
        recordings = sorted(self.results.experiments.recordings)
        self.add("## Recordings")
        if not recordings:
            self.add("Not run: `MIVO_DATA` names no folder of recordings.")
            return
        self.add("The sequence folders in `$MIVO_DATA`, in the same units.",
                 self.drift_table(recordings, [name.split("_", 1)[1] for name in recordings]))

    def sequence_section(self):
        plan = self.plan
        self.add("## Sequences and seeds",
                 "Twists: seed %d; disturbed starts: seed 1. The options of `generate_sequence`:" %
                 plan.seed,
                 table(("sequence", "options"),
                       [(key, "`%s`" % " ".join(plan.sequences[key].words))
                        for key in self.results.experiments.film_jobs]))


def remarks(section):
    """What a person has to say about the numbers: remarks.md, the part below `## section`."""
    path = os.path.join(plans.HERE, "remarks.md")
    with open(path, encoding="utf-8") as text:
        for part in text.read().split("\n## ")[1:]:
            title, _, body = part.partition("\n")
            if title.strip() == section:
                return body.strip()
    raise SystemExit("%s has no section '%s'" % (path, section))
