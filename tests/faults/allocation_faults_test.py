#!/usr/bin/env python3
"""Fails one allocation of `kaustik` after the other: what happens then is an error or a whole picture.

    allocation_faults_test.py PROGRAM FAILING_ALLOCATIONS_LIBRARY FOLDER

The program runs with the library preloaded (failing_allocations.cpp). The exit code then is 0 or 1; each output is the file from
before or the new one, which it is if the exit code is 0; and no other file is left.

Of renders to EXR, every allocation of at least two kilobytes fails once. Smaller ones can end the process: the parsers of JSON and
of command lines allocate a few bytes where they may not throw. Of renders to other formats it is those of at least 64 kilobytes:
OpenImageIO loads a hundred libraries, among them GLib, that end the process if they do not get what they allocate when they
are loaded, the first of those 64 kilobytes included.
"""
import json
import os
import pathlib
import subprocess
import sys

OLD = b"the file from before"
EXACT = "exact.exr"  # which always has the same bits
SCENE = """LookAt 0 0 -3 0 0 0 0 1 0
Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" 16 "integer yresolution" 16
WorldBegin
LightSource "point" "point3 from" [0 2 -2] "rgb I" [9 9 9]
Material "dielectric"
Shape "sphere" "float radius" 0.5
Material "diffuse"
Shape "trianglemesh" "point3 P" [-2 -1 -2 2 -1 -2 2 -1 2 -2 -1 2] "integer indices" [0 1 2 0 2 3]
"""


class Command:
    def __init__(self, program, library, folder, outputs, arguments):
        self.folder = folder / "out"
        self.folder.mkdir(exist_ok=True)
        self.names = set(outputs)
        scene = folder / "scene.pbrt"
        scene.write_text(SCENE)
        self.line = [program, "render", scene, "--spp", "2", "--photons", "2000", "--threads", "2", "-q", *arguments]
        for name in outputs:
            self.line += ["--stats" if name.endswith(".json") else "-o", self.folder / name]
        self.environment = dict(os.environ, LD_PRELOAD=str(library), KAUSTIK_ALLOCATIONS_TO=str(folder / "made"))
        self.made = folder / "made"

    def run(self, least, failing):
        for path in self.folder.iterdir():
            path.unlink()
        for name in self.names:
            (self.folder / name).write_bytes(OLD)
        environment = dict(self.environment, KAUSTIK_ALLOCATION_BYTES=str(least), KAUSTIK_FAIL_ALLOCATION=str(failing))
        return subprocess.run(self.line, env=environment, capture_output=True, text=True, timeout=120)

    def found(self):
        return {path.name: path.read_bytes() for path in self.folder.iterdir()}

    # The number of allocations of at least this size in a run in which none fails, and its files.
    def whole(self, least):
        ran = self.run(least, 0)
        assert ran.returncode == 0, ran.stderr
        return int(self.made.read_text()), self.found()

    # What is wrong after the run; empty if nothing is.
    def trouble(self, ran, expected):
        if ran.returncode not in (0, 1):
            return f"exit code {ran.returncode}"
        found = self.found()
        if set(found) - self.names:
            return f"{set(found) - self.names} are left"
        for name in self.names:
            old = found.get(name) == OLD
            if name not in found or (old and ran.returncode == 0):
                return f"{name} is not there"
            if not old and not is_whole(self.line[0], self.folder / name, expected[name]):
                return f"{name} is neither old nor whole"
        return ""


# Statistics hold times, and a picture that could not be denoised differs: it is whole if it can be read.
def is_whole(program, path, expected):
    if path.read_bytes() == expected:
        return True
    if path.name == EXACT:
        return False
    if path.suffix == ".json":
        try:
            return "seconds" in json.loads(path.read_text())
        except ValueError:
            return False
    if path.suffix == ".kpart":
        line = [program, "merge", path, "-o", path.with_suffix(".exr")]
    else:
        line = [program, "compare", path, path]
    return subprocess.run(line, capture_output=True).returncode == 0


# first: the number of the first allocation that fails.
def check(command, least, first, most_runs):
    failures, refused = 0, 0
    count, expected = command.whole(least)
    step = max(1, count // most_runs)
    for n in range(first, count + 1, step):
        ran = command.run(least, n)
        refused += ran.returncode == 1
        trouble = command.trouble(ran, expected)
        if trouble:
            failures += 1
            print(f"allocation {n} of at least {least} bytes: {trouble}\n{ran.stderr}")
    print(f"{count} allocations of at least {least} bytes, of which one in {step} failed: {refused} times with an error")
    if refused == 0:
        failures += 1
        print("none of them was noticed: is the library preloaded?")
    return failures


def main():
    program, library, folder = (pathlib.Path(p).resolve() for p in sys.argv[1:4])
    folder.mkdir(parents=True, exist_ok=True)
    linear = Command(program, library, folder, [EXACT, "a.json"], ["--passes", "2", "--denoise", "off"])
    pictures = Command(program, library, folder, ["a.png", "a.jpg", "a.kpart"], ["--passes", "2", "--denoise", "on"])
    failures = check(linear, 2048, 1, 1000) + check(pictures, 65536, 2, 60)
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
