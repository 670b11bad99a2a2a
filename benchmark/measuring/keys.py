# SPDX-License-Identifier: BSD-3-Clause
"""What a result depends on, as a hash of contents: as long as its key stays, it is kept. When a file
was written and where it lies do not matter."""

import hashlib
import json
import os
import subprocess

RECIPE = "made_of.txt"  # in the folder of a sequence that a benchmark made
LISTS = ("rgb.txt", "depth.txt", "associations.txt", "camera.txt", "groundtruth.txt")
FILMING = ("generate_sequence", "relight_sequence")


def key_of(*parts):
    """Of words, numbers, other keys, and lists of them."""
    return hashlib.sha256(json.dumps(parts).encode()).hexdigest()


def file_key(*paths):
    digest = hashlib.sha256()
    for path in paths:
        with open(path, "rb") as file:
            digest.update(hashlib.sha256(file.read()).digest())
    return digest.hexdigest()


def program_key(path):
    """Of an executable and mivo's libraries behind it: results of another build are not taken for
    this one's."""
    return file_key(path, *own_libraries(path))


def own_libraries(program):
    """Shared libraries of mivo that a program loads; none when it is linked statically. What films
    looks the same whatever the tracker does."""
    start = "libmivo_synthetic" if os.path.basename(program) in FILMING else "libmivo"
    listed = subprocess.run(["ldd", program], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                            universal_newlines=True, check=False).stdout
    paths = [line.split(" => ")[1].split(" (")[0] for line in listed.splitlines() if " => " in line]
    return sorted(path for path in paths if os.path.basename(path).startswith(start))


def sequence_key(folder):
    """Of what a sequence was made of, or of a recording's name, lists, camera and truth."""
    recipe = os.path.join(folder, RECIPE)
    if os.path.exists(recipe):
        return file_key(recipe)
    paths = [os.path.join(folder, name) for name in LISTS]
    paths = [path for path in paths if os.path.exists(path)]
    names = [os.path.basename(path) for path in [os.path.abspath(folder)] + paths]
    return key_of(names, file_key(*paths))
