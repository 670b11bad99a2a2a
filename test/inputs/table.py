#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tries what strangers have on mivo's programs, and writes down what becomes of it: the tables of
folders and trajectories in doc/inputs.md.

    test/inputs/table.py BUILD/bin --write doc/inputs.md
    test/inputs/table.py BUILD/bin --check doc/inputs.md     fails when its tables would be others

Inputs are made in a temporary folder. Each row is a claim: a result that is wrong and of which nothing
is said ends the script.
"""
import argparse
import os
import re
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
try:
    import folders
    import sequence
    import trajectories
except ImportError as error:
    print("skipped: {} (python3-numpy, python3-opencv)".format(error))
    sys.exit(77)

# Error from frame to frame as a part of the motion between frames: a wrong scale is far above.
WRONG = 0.05
# Of the twin's relative pose error, for inputs that lose no information.
NEARLY = 1.2

BEGIN, END = "<!-- folders: written by test/inputs/table.py -->", "<!-- folders: end -->"


def run(command):
    result = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                            stdin=subprocess.DEVNULL, timeout=300)
    return result.returncode, result.stdout, result.stderr


def figure(text, name):
    match = re.search("^{}: (.*)$".format(re.escape(name)), text, re.MULTILINE)
    return float(match.group(1)) if match else None


def motion():
    """Between two frames, m."""
    positions = [sequence.pose(i)[1] for i in range(sequence.FRAMES)]
    return sum(sum((b - a) ** 2) ** 0.5 for a, b in zip(positions, positions[1:])) / (
        sequence.FRAMES - 1)


def said(errors, output, program, folder):
    """What the program told, without its name and with DIR for the folder, as one line."""
    lines = [line for line in errors.splitlines() if not line.startswith("skipped: ")]
    lines += [line for line in output.splitlines() if line.startswith(("skipped (", "left_out ("))]
    text = "; ".join(lines).replace(program + ": ", "").replace("note: ", "")
    return text.replace(os.path.realpath(folder), "DIR").replace(folder, "DIR").replace("|", "\\|")


class Table:
    def __init__(self, programs, work):
        self.programs, self.work = programs, work
        self.text = "\n"
        self.twin = None

    def program(self, name):
        return os.path.join(self.programs, name)

    def group(self, title, program):
        self.text += "\n### {}\n\n| input | outcome | what {} says |\n|---|---|---|\n".format(
            title, program)

    def row(self, name, outcome, words):
        silent = outcome.endswith("wrong") and not words
        assert not silent, "a wrong result in silence: " + name
        self.text += "| {} | {} | {} |\n".format(name, outcome, words)

    def folder_row(self, name, make):
        path = os.path.join(self.work, "rgbd_bonn_x" if name.startswith("Bonn") else "input")
        make(sequence.Folder(path))
        trajectory = os.path.join(self.work, "trajectory.txt")
        code, output, errors = run([self.program("run_sequence"), path, "--output", trajectory,
                                    "--force"])
        assert code in (0, 1), "{}: exit code {}\n{}".format(name, code, errors)
        self.row(name, self.outcome(name, code, output, path, trajectory),
                 said(errors, output, "run_sequence", path))

    def outcome(self, name, code, output, path, trajectory):
        if code != 0:
            return "refused" if not output else "not tracked"
        # 0.3 s; frames that are numbered are 1 s apart; what is soon lost has fewer.
        for delta in ("0.3", "1", "0.04"):
            _, figures, errors = run([self.program("evaluate_trajectory"),
                                      os.path.join(path, "groundtruth.txt"), trajectory,
                                      "--delta", delta])
            error = figure(figures, "rpe_frame_translation_rmse_m")
            if error is not None:
                break
        if error is None:  # moved in time, with the truth left where it was
            _, figures, errors = self.evaluate_in_order(path, trajectory)
            error = figure(figures, "rpe_frame_translation_rmse_m")
        assert error is not None, name + ": " + errors
        tracked = int(figure(output, "tracked"))
        part = "" if tracked == sequence.FRAMES else ", {} of {} frames".format(tracked,
                                                                                sequence.FRAMES)
        if error > WRONG * motion():
            return "tracked" + part + ", wrong"
        if self.twin is None:
            self.twin = figure(figures, "rpe_translation_rmse_m")
        elif "repeat" in name:
            assert figure(figures, "rpe_translation_rmse_m") <= NEARLY * self.twin, name
        return "tracked" + part

    def evaluate_in_order(self, path, trajectory):
        """Each pose with the frame whose stamp is that of its line, for stamps that were made up."""
        with open(trajectory) as stream:
            rows = [line.split() for line in stream if not line.startswith("#")]
        numbers = range(sequence.FRAMES - len(rows), sequence.FRAMES)  # the first ones have no stamp
        if len(rows) == sequence.FRAMES and float(rows[0][0]) < sequence.FIRST:  # earlier by turns
            numbers = sorted(numbers, key=lambda i: sequence.stamps()[i] - 3 * (i % 2))
        ordered = sorted(zip(numbers, rows))
        moved = os.path.join(self.work, "moved.txt")
        with open(moved, "w") as stream:
            for number, row in ordered:
                stream.write("{:.6f} {}\n".format(sequence.stamps()[number], " ".join(row[1:])))
        return run([self.program("evaluate_trajectory"), os.path.join(path, "groundtruth.txt"), moved,
                    "--delta", "0.3"])

    def trajectory_row(self, name, write, change_truth):
        rows = sequence.truth()
        files = [os.path.join(self.work, part + ".txt") for part in ("truth", "estimate")]
        true_rows = change_truth(rows) if change_truth else rows
        for path, content in zip(files, (trajectories.lines(true_rows), write(rows))):
            with open(path, "wb") as stream:
                stream.write(content.encode())
        code, output, errors = run([self.program("evaluate_trajectory")] + files + ["--delta", "0.1"])
        if code != 0:
            outcome = "refused"
        else:
            errors_found = [figure(output, figure_name) for figure_name in
                            ("ate_rmse_m", "rpe_rotation_rmse_deg")]
            outcome = "no error" if max(errors_found) < 1e-3 else "read, wrong"
            if figure(output, "matched") < 1.0:
                outcome += ", {:.0f} % of the poses matched".format(100 * figure(output, "matched"))
        self.row(name, outcome, said(errors, "", "evaluate_trajectory", self.work))

    def make(self):
        for title, rows in folders.GROUPS:
            self.group("Sequence folders: " + title.lower(), "run_sequence")
            for name, make in rows:
                self.folder_row(name, make)
        self.group("Trajectories, as the estimate of themselves", "evaluate_trajectory")
        for row in trajectories.ROWS:
            self.trajectory_row(*row)
        return self.text


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("programs", help="folder of the programs, build/bin")
    what = parser.add_mutually_exclusive_group(required=True)
    what.add_argument("--write", metavar="FILE")
    what.add_argument("--check", metavar="FILE")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as work:
        text = Table(os.path.abspath(arguments.programs), os.path.realpath(work)).make()
    path = arguments.write or arguments.check
    with open(path) as stream:
        document = stream.read()
    begin, end = document.index(BEGIN) + len(BEGIN), document.index(END)
    if arguments.write:
        with open(path, "w") as stream:
            stream.write(document[:begin] + text + document[end:])
    elif text != document[begin:end]:
        for line, other in zip(document[begin:end].splitlines(), text.splitlines()):
            if line != other:
                print("in the file: {}\nnow:         {}".format(line, other))
        sys.exit("{} is not what the programs do: write it again".format(path))


if __name__ == "__main__":
    main()
