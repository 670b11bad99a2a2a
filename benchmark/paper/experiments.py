# SPDX-License-Identifier: BSD-3-Clause
"""The jobs of each experiment, and where their results lie in the output folder."""

import os

import plan as plans  # finds the modules of measuring
from measuring.jobs import Job
from measuring.methods import TIMED

FIRST = ["--reference", "first"]
FIRST_SETTINGS = ["--set", "keyframe_policy=first", "--set", "motion_model=constant_pose"]
DISTURB = ["--disturb", "0.005", "0.005", "--seed", "1"]  # m, rad
FOLDERS = ["convergence", "levels", "optimizer", "pictures", "runs", "sequences"]


class Experiments:
    """All jobs of a plan, and the paths of what they leave behind."""

    def __init__(self, plan, programs, recordings, paper_only=False):
        self.plan = plan
        self.programs = programs
        self.paper_only = paper_only
        self.recordings = {} if paper_only else recordings  # name: folder
        self.jobs = []
        self.film_jobs = {}
        self.variants = plans.PAPER_METHODS if paper_only else plans.variants()
        self.has_peers = programs.has("run_peer")
        self.has_optimizers = programs.has("optimizer_experiment")
        for key in plan.sequences:
            if not paper_only or key not in plan.beyond or key in (plan.basin, plan.basin_relit):
                self.film(key)
        self.add_convergence()  # the longest jobs, so that none is left over at the end
        self.add_runs()
        self.add_optimizers()
        self.add_level_times()
        self.add_pictures()

    def program(self, name):
        return self.programs.path(name)

    def add(self, *arguments, **options):
        job = Job(*arguments, **options)
        self.jobs.append(job)
        return job

    # ---- Sequences

    def film(self, key):
        command = [self.program("generate_sequence"), self.sequence(key), "--force", "--threads", "1"]
        self.film_jobs[key] = self.add("film/" + key,
                                       [command + self.plan.sequences[key].words])

    def sequence(self, key):
        """Folder of a sequence or recording."""
        return self.recordings.get(key, os.path.join("sequences", key))

    def source(self, key):
        """What a job that reads a sequence or recording depends on."""
        if key in self.film_jobs:
            return {"after": [self.film_jobs[key]]}
        return {"sequences": [self.recordings[key]]}

    # ---- Tracking runs

    def add_runs(self):
        moving = [key for keys in self.plan.table_2.values() for key in keys]
        static = [key for keys in self.plan.static.values() for key in keys]
        for method in self.variants:
            for key in moving:
                self.track("moving", key, method)
            for key in static:
                self.track("disturbed", key, method, FIRST + DISTURB)
        for method in plans.PAPER_METHODS:
            self.track("moving", self.plan.ideal, method)
            for key in static:
                self.track("first", key, method, FIRST)
        if self.paper_only:
            return
        for key in self.plan.beyond + sorted(self.recordings):
            for method in self.variants:
                self.track("drift", key, method)
            if self.has_peers:
                for peer, _ in plans.PEERS:
                    self.track_peer(key, peer)

    def run_path(self, kind, key, method, ending):
        return os.path.join("runs", "%s-%s-%s.%s" % (kind, key, method, ending))

    def track(self, kind, key, method, options=()):
        path = lambda ending: self.run_path(kind, key, method.key, ending)
        # The errors are those of all frames, lost ones included.
        command = [self.program("run_sequence"), self.sequence(key), "--output", path("txt"),
                   "--force", "--write-lost"] + list(options) + method.words() + [">", path("summary")]
        self.add("track/%s/%s/%s" % (kind, key, method.key),
                 [command] + self.judge(kind, key, path), **self.source(key))

    def track_peer(self, key, peer):
        path = lambda ending: self.run_path("drift", key, "peer_" + peer, ending)
        command = [self.program("run_peer"), self.sequence(key), "--output", path("txt"), "--force",
                   "--method", peer, ">", path("summary")]
        self.add("track/drift/%s/peer_%s" % (key, peer),
                 [command] + self.judge("drift", key, path), **self.source(key))

    def judge(self, kind, key, path):
        truth = os.path.join(self.sequence(key), "groundtruth.txt")
        if kind == "drift":  # drift over a second
            return [[self.program("evaluate_trajectory"), truth, path("txt"), "--json", path("json"),
                     "--force"]]
        options = FIRST if kind in ("first", "disturbed") else []
        return [[self.program("pose_errors"), truth, path("txt")] + options + [">", path("csv")]]

    # ---- Experiments on pairs of images

    def pair_words(self, magnitudes, trials):
        words = ["--trials", str(trials), "--pairs", str(self.plan.pairs),
                 "--seed", str(self.plan.seed), "--force"]
        for magnitude in magnitudes:
            words += ["--magnitude", str(magnitude)]
        return words

    def add_convergence(self):
        words = self.pair_words(self.plan.magnitudes, self.plan.trials)
        program = self.program("convergence_experiment")
        for relit, methods in ((False, plans.CONVERGENCE_METHODS), (True, plans.RELIT_METHODS)):
            for method in reversed(methods):
                path = self.convergence_path(method.key, relit)
                command = [program, self.sequence(self.plan.basin), "--output", path]
                after = [self.film_jobs[self.plan.basin]]
                if relit:
                    command += ["--live", self.sequence(self.plan.basin_relit)]
                    after.append(self.film_jobs[self.plan.basin_relit])
                self.add(path, [command + words + method.words()], after=after)

    def convergence_path(self, method, relit):
        return os.path.join("convergence", method + ("-relit" if relit else "") + ".csv")

    def add_optimizers(self):
        if not self.has_optimizers:
            return
        words = self.pair_words(self.plan.optimizer_magnitudes, self.plan.optimizer_trials)
        for name, _ in plans.OPTIMIZERS:
            command = [self.program("optimizer_experiment"), self.sequence(self.plan.basin),
                       "--output", self.optimizer_path(name), "--optimizer", name]
            self.add(self.optimizer_path(name), [command + words + plans.MI.words()],
                     alone=True, **self.source(self.plan.basin))

    def optimizer_path(self, name):
        return os.path.join("optimizer", name + ".csv")

    def add_level_times(self):
        """Table I by the means of the speed benchmark. The runs take turns, as there."""
        for repetition in range(self.plan.repetitions):
            for method, words in TIMED.items():
                path = self.level_path(method, repetition)
                command = [self.program("run_sequence"), self.sequence(self.plan.basin), "--output",
                           path + ".txt", "--statistics", path + ".csv", "--force", "--threads", "1"]
                self.add(path, [command + words], alone=True, **self.source(self.plan.basin))

    def level_path(self, method, repetition):
        return os.path.join("levels", "%s-%d" % (method, repetition))

    # ---- Pictures

    def add_pictures(self):
        plan = self.plan
        dark = int(0.69 * plan.frames)  # ramp_step is darkest at 70 % of the time
        self.picture("reference", plan.ideal, plans.MI, max(1, plan.frames // 3))
        for method in (plans.MI, plans.SSD):
            self.picture("dark_" + method.key, plan.static["s1"][0], method, dark, FIRST_SETTINGS)
            self.picture("lamp_" + method.key, plan.static["s2"][0], method, plan.lamp_frame,
                         FIRST_SETTINGS)
        self.picture("blurred", plan.blurred, plans.HYBRID, plan.blurred_frame)

    def picture(self, name, key, method, frame, settings=()):
        command = [self.program("tracking_pictures"), self.sequence(key), self.picture_path(name),
                   "--frame", str(frame), "--force"]
        summary = os.path.join("pictures", name + ".summary")
        self.add("pictures/" + name, [command + list(settings) + method.words() + [">", summary]],
                 **self.source(key))

    def picture_path(self, name, *parts):
        return os.path.join("pictures", name, *parts)
