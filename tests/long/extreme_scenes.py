#!/usr/bin/env python3
"""Renders scenes of the repository in which some numbers are replaced by extreme ones, such as 1e38, 1e-45 or 1.9e18. Each render
must end with a picture, or with errors of the scene (exit code 3).

  extreme_scenes.py KAUSTIK FOLDER [--renders N] [--seed N]   default: 2000 renders, two at a time, seed 1

A scene follows from the seed and its number. FOLDER keeps the scenes that failed, beside a copy of the files that they name. Exit
code: 0 if all is well, 1 if not.
"""
import argparse
import concurrent.futures
import pathlib
import random
import re
import shutil
import subprocess
import sys

kRoot = pathlib.Path(__file__).resolve().parents[2]
kLongest = 120  # seconds after which a render of 64 pixels hangs
kMostBytes = 10_000  # of scenes that are changed
kNumber = re.compile(r"(?<![\w.\"])-?\d+\.?\d*(?:e-?\d+)?(?![\w.\"])")
kResolution = re.compile(r'"integer [xy]resolution" *\[? *\d+ *\]?')
kExtremes = ["0", "-0", "1", "-1", "2", "0.5", "1e6", "1e-6", "1e10", "1e-10", "1e19", "1.9e18", "1e20", "1e-20", "1e30", "1e38", "-1e38",
             "3.4e38", "1e-38", "1e-45", "16777217", "2147483647", "0.9999999", "1.0000001", "180", "360"]
kOptions = ["--width", "8", "--height", "8", "--spp", "1", "--photons", "500", "--memory", "2G", "--threads", "1", "-q"]


def copies_of_scenes(folder):
    """Copies the repository's scenes with all files that they name, and gives those that are small enough."""
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(kRoot / "scenes", folder)
    return [file for file in sorted(folder.rglob("*.pbrt")) if file.stat().st_size < kMostBytes]


def changed(file, numbers):
    """The text of the scene with one to six of its numbers replaced."""
    text = kResolution.sub("", file.read_text())
    places = [match.span() for match in kNumber.finditer(text)]
    chosen = numbers.sample(places, min(len(places), numbers.choice([1, 1, 2, 3, 6])))
    for begin, end in sorted(chosen, reverse=True):
        text = text[:begin] + numbers.choice(kExtremes) + text[end:]
    return text


def render(program, seed, number, files):
    """Renders one changed scene; gives its exit code, and keeps the scene if that is wrong."""
    numbers = random.Random(seed << 32 | number)
    original = numbers.choice(files)
    method = numbers.choice(["auto", "auto", "photon", "mc"])
    scene, picture = original.with_name(f"extreme-{seed}-{number}.pbrt"), original.with_name(f"extreme-{number}.exr")
    scene.write_text(changed(original, numbers))
    try:
        done = subprocess.run([program, "render", scene, "-o", picture, "--method", method, *kOptions], capture_output=True,
                              text=True, errors="replace", timeout=kLongest)
        code, messages = done.returncode, done.stderr
    except subprocess.TimeoutExpired:
        code, messages = "timeout", ""
    picture.unlink(missing_ok=True)
    if code in (0, 3):
        scene.unlink()
    else:
        print(f"extreme_scenes: {scene}, changed {original.name}, by {method}: {code}\n{messages[-500:]}", flush=True)
    return code


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--renders", type=int, default=2000)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    files = copies_of_scenes(options.folder / "scenes")
    program = options.program.resolve()
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        codes = list(pool.map(lambda number: render(program, options.seed, number, files), range(options.renders)))
    pictures, refused = codes.count(0), codes.count(3)
    failed = len(codes) - pictures - refused
    print(f"extreme_scenes: {len(codes)} scenes: {pictures} pictures, {refused} refused, {failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
