# SPDX-License-Identifier: BSD-3-Clause
"""Jobs that depend on each other, run side by side, and are not run again when they are done."""

import concurrent.futures
import json
import os

from measuring import keys
from measuring.programs import run_words
from measuring.progress import Progress


class Job:
    """Commands, run one after the other in the output folder.

    A command is a list of words; its output is sent to the file of a final (">", file). `after` are
    jobs whose results it reads, `sequences` folders that no job makes. `alone`: nothing else runs
    beside it, for it measures time. `accepted` are exit codes that are results, too.
    """

    def __init__(self, name, commands, after=(), sequences=(), alone=False, accepted=(0,)):
        self.name = name
        self.commands = commands
        self.after = list(after)
        self.sequences = list(sequences)
        self.alone = alone
        self.accepted = accepted
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
        if path not in self.programs:
            self.programs[path] = keys.program_key(path)
        return self.programs[path]

    def key(self, job):
        """Changes with the commands, the programs, and what the job depends on."""
        if job.key is None:
            words = [[os.path.basename(word) if os.path.isabs(word) else word for word in command]
                     for command in job.commands]
            job.key = keys.key_of(words,
                                  [self.program_key(command[0]) for command in job.commands],
                                  [self.key(other) for other in job.after],
                                  [keys.sequence_key(folder) for folder in job.sequences])
        return job.key

    def note(self, job):
        return self.file("done", job.name.replace("/", "_") + ".json")

    def is_done(self, job):
        try:
            with open(self.note(job), encoding="utf-8") as text:
                note = json.load(text)
            return note["key"] == self.key(job) and note["processor_seconds"] >= 0.0
        except (OSError, ValueError, KeyError):
            return False  # never run, interrupted, or by an older version of the benchmark

    def processor_minutes(self, jobs):
        """What all of them took, by their notes."""
        total = 0.0
        for job in jobs:
            with open(self.note(job), encoding="utf-8") as note:
                total += json.load(note)["processor_seconds"]
        return total / 60

    def run_once(self, job):
        """Runs the commands unless that has been done."""
        if not self.is_done(job):
            self.run(job)

    def run(self, job):
        """Runs the commands and leaves the note. Throws MeasuringError."""
        if os.path.exists(self.note(job)):
            os.remove(self.note(job))  # it would be wrong if this is interrupted
        processor = sum(run_command(command, self.path, job.name, job.accepted)
                        for command in job.commands)
        text = json.dumps({"key": self.key(job), "processor_seconds": round(processor, 2)})
        temporary = self.note(job) + ".part"
        with open(temporary, "w", encoding="utf-8") as note:
            note.write(text + "\n")
        os.replace(temporary, self.note(job))


def run_command(command, folder, name, accepted=(0,)):
    """One command; its standard output goes to the file after ">" or nowhere. Returns the processor
    time it took, seconds."""
    words, target = command, os.devnull
    if len(command) > 2 and command[-2] == ">":
        words, target = command[:-2], os.path.join(folder, command[-1])
        os.makedirs(os.path.dirname(target), exist_ok=True)
    with open(target, "w", encoding="utf-8") as output:
        return run_words(words, output, "%s: %s" % (name, os.path.basename(words[0])), folder,
                         accepted)


def run_jobs(jobs, folder, workers):
    """Runs what is not done yet; the jobs that measure time come last, one by one."""
    waiting = [job for job in jobs if not folder.is_done(job)]
    progress = Progress(len(jobs), "jobs", len(jobs) - len(waiting))
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
