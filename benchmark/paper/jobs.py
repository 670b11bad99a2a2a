# SPDX-License-Identifier: BSD-3-Clause
"""Jobs that depend on each other, run side by side, and are not run again when they are done."""

import concurrent.futures
import hashlib
import json
import os
import subprocess
import sys
import tempfile
import time


class JobError(Exception):
    """A program failed; the text says which and why."""


class Job:
    """Commands, run one after the other in the output folder.

    A command is a list of words; the word before a final (">", file) is sent there. `after` are jobs
    whose results it reads. `alone`: nothing else runs beside it, for it measures time.
    """

    def __init__(self, name, commands, after=(), alone=False):
        self.name = name
        self.commands = commands
        self.after = list(after)
        self.alone = alone
        self.key = None


class Folder:
    """Where results are kept, with a note for each job that is done."""

    def __init__(self, path):
        self.path = path
        os.makedirs(os.path.join(path, "done"), exist_ok=True)
        self.programs = {}

    def file(self, *parts):
        return os.path.join(self.path, *parts)

    def program_key(self, path):
        """Hash of an executable and of mivo's libraries behind it: results of another build are not
        taken for this one's."""
        if path not in self.programs:
            digest = hashlib.sha256()
            for name in [path] + own_libraries(path):
                with open(name, "rb") as code:
                    digest.update(code.read())
            self.programs[path] = digest.hexdigest()
        return self.programs[path]

    def key(self, job):
        """Changes with the commands, the programs, and what the job depends on."""
        if job.key is None:
            parts = [json.dumps(job.commands)]
            parts += [self.program_key(command[0]) for command in job.commands]
            parts += [self.key(other) for other in job.after]
            job.key = hashlib.sha256("\n".join(parts).encode()).hexdigest()
        return job.key

    def note(self, job):
        return self.file("done", job.name.replace("/", "_") + ".json")

    def is_done(self, job):
        try:
            with open(self.note(job), encoding="utf-8") as text:
                note = json.load(text)
            return note["key"] == self.key(job) and note["processor_seconds"] >= 0.0
        except (OSError, ValueError, KeyError):
            return False  # never run, interrupted, or by an older version of this program

    def processor_minutes(self, jobs):
        """What all of them took, by their notes."""
        total = 0.0
        for job in jobs:
            with open(self.note(job), encoding="utf-8") as note:
                total += json.load(note)["processor_seconds"]
        return total / 60

    def run(self, job):
        """Runs the commands and leaves the note. Throws JobError."""
        processor = sum(run_command(command, self.path, job.name) for command in job.commands)
        text = json.dumps({"key": self.key(job), "processor_seconds": round(processor, 2)})
        temporary = self.note(job) + ".part"
        with open(temporary, "w", encoding="utf-8") as note:
            note.write(text + "\n")
        os.replace(temporary, self.note(job))


def own_libraries(program):
    """Shared libraries of mivo that a program loads; none when it is linked statically."""
    listed = subprocess.run(["ldd", program], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                            universal_newlines=True, check=False).stdout
    paths = [line.split(" => ")[1].split(" (")[0] for line in listed.splitlines() if " => " in line]
    return sorted(path for path in paths if os.path.basename(path).startswith("libmivo"))


def run_command(command, folder, name):
    """One command; its standard output goes to the file after ">" or nowhere. Returns the processor
    time it took, seconds."""
    words, target = command, os.devnull
    if len(command) > 2 and command[-2] == ">":
        words, target = command[:-2], os.path.join(folder, command[-1])
        os.makedirs(os.path.dirname(target), exist_ok=True)
    with open(target, "w", encoding="utf-8") as output, tempfile.TemporaryFile("w+") as errors:
        process = subprocess.Popen(words, cwd=folder, stdout=output, stderr=errors)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = status  # it has been waited for here
        if status != 0:
            errors.seek(0)
            raise JobError("%s: %s failed (%s): %s" % (
                name, os.path.basename(words[0]), describe(status), errors.read().strip()))
    return usage.ru_utime + usage.ru_stime


def describe(status):
    """How a process ended."""
    if os.WIFSIGNALED(status):
        return "signal %d" % os.WTERMSIG(status)
    return "code %d" % os.WEXITSTATUS(status)


class Progress:
    """A bar on stderr when that is a terminal, otherwise a line every tenth of the way."""

    WIDTH = 30

    def __init__(self, total, done):
        self.total, self.done, self.start = total, done, time.time()
        self.terminal = sys.stderr.isatty()
        self.told = self.tenth()

    def tenth(self):
        return 10 * self.done // max(1, self.total)

    def step(self, name):
        self.done += 1
        elapsed = int(time.time() - self.start)
        clock = "%d:%02d" % (elapsed // 60, elapsed % 60)
        if self.terminal:
            filled = self.WIDTH * self.done // max(1, self.total)
            sys.stderr.write("\r\033[K[%s%s] %d/%d %s %s" % (
                "#" * filled, " " * (self.WIDTH - filled), self.done, self.total, clock, name))
        elif self.tenth() > self.told:
            self.told = self.tenth()
            sys.stderr.write("%d of %d jobs after %s\n" % (self.done, self.total, clock))
        sys.stderr.flush()

    def close(self):
        if self.terminal:
            sys.stderr.write("\r\033[K")
            sys.stderr.flush()


def run_jobs(jobs, folder, workers):
    """Runs what is not done yet; the jobs that measure time come last, one by one."""
    waiting = [job for job in jobs if not folder.is_done(job)]
    progress = Progress(len(jobs), len(jobs) - len(waiting))
    try:
        run_side_by_side([job for job in waiting if not job.alone], folder, workers, progress)
        for job in [job for job in waiting if job.alone]:
            folder.run(job)
            progress.step(job.name)
    finally:
        progress.close()


def run_side_by_side(waiting, folder, workers, progress):
    """Starts each job when those before it are done."""
    unfinished = set(waiting)
    running = {}
    with concurrent.futures.ThreadPoolExecutor(workers) as pool:
        while waiting or running:
            ready = [job for job in waiting if not any(other in unfinished for other in job.after)]
            for job in ready[:workers - len(running)]:
                waiting.remove(job)
                running[pool.submit(folder.run, job)] = job
            if not running:
                raise ValueError("'%s' depends on a job that does not run" % waiting[0].name)
            done, _ = concurrent.futures.wait(running,
                                              return_when=concurrent.futures.FIRST_COMPLETED)
            for future in done:
                job = running.pop(future)
                try:
                    future.result()
                except Exception:
                    waiting.clear()
                    raise
                unfinished.discard(job)
                progress.step(job.name)
