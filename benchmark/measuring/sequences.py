# SPDX-License-Identifier: BSD-3-Clause
"""Sequences of the benchmarks: recordings, and what is filmed and relit once."""

import json
import os
import shutil

from measuring import keys
from measuring.programs import MeasuringError


def find_recordings(needed):
    """Folders below $MIVO_DATA with that file, by name."""
    root = os.environ.get("MIVO_DATA", "")
    if not root:
        return {}
    if not os.path.isdir(root):
        raise MeasuringError("MIVO_DATA: there is no folder '%s'" % root)
    return {name: os.path.join(os.path.abspath(root), name) for name in sorted(os.listdir(root))
            if os.path.exists(os.path.join(root, name, needed))}


def make_once(folder, recipe, make):
    """Makes a sequence, unless it is there and of the same recipe: a list of words and keys."""
    path = os.path.join(folder, keys.RECIPE)
    text = json.dumps(recipe) + "\n"
    if os.path.exists(path):
        with open(path, encoding="utf-8") as file:
            if file.read() == text:
                return folder
    if os.path.isdir(folder):
        shutil.rmtree(folder)
    make()
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)
    return folder


def generate(programs, folder, *options):
    """Films a sequence."""
    words = [str(option) for option in options]
    recipe = ["generate_sequence", keys.program_key(programs.path("generate_sequence"))] + words
    return make_once(folder, recipe, lambda: programs.run("generate_sequence", folder, *words))


def relight(programs, source, folder, lighting, seed=1):
    """A sequence in other light."""
    options = ["--lighting", lighting, "--seed", str(seed)]
    recipe = ["relight_sequence", keys.program_key(programs.path("relight_sequence")),
              keys.sequence_key(source)] + options
    return make_once(folder, recipe,
                     lambda: programs.run("relight_sequence", source, folder, *options))
