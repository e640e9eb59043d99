#!/usr/bin/env python3
"""Kills renders at random moments and resumes them from their checkpoints: the picture must be that of an uninterrupted render,
byte for byte, and no temporary file may be left.

  kill_test.py PROGRAM FOLDER [--kills 100] [--seed 1]
"""
import argparse
import pathlib
import random
import shutil
import sys

sys.dont_write_bytecode = True
from killed_renders import Failure, left_temporaries, render_whole, render_with_kills  # noqa: E402


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--kills", type=int, default=100)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    program, folder = arguments.program.resolve(), arguments.folder
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    whole = folder / "whole.exr"
    # Of moments up to half of a render, some come before the first checkpoint, and a resumed render survives most.
    longest = render_whole(program, whole) / 2
    print(f"kill test: seed {arguments.seed}; a render takes {2 * longest:.1f} s", flush=True)
    moments, kills, renders = random.Random(arguments.seed), 0, 0
    while kills < arguments.kills:
        kills += render_with_kills(program, folder, moments, longest)
        renders += 1
        if (folder / "killed.exr").read_bytes() != whole.read_bytes():
            raise Failure(f"after {kills} kills the picture of render {renders} differs from that of an uninterrupted render")
        if left := left_temporaries(folder):
            raise Failure(f"left behind: {', '.join(map(str, left))}")
    print(f"kill test: {renders} renders survived {kills} kills with the same bits")


if __name__ == "__main__":
    try:
        main()
    except Failure as failure:
        sys.exit(f"kill test: {failure}")
