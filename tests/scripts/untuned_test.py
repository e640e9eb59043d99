#!/usr/bin/env python3
"""Tests benchmarks/untuned.py: untuned_test.py PROGRAM FOLDER, with a folder to write to."""
import json
import math
import pathlib
import shutil
import subprocess
import sys

sys.dont_write_bytecode = True
kRoot = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(kRoot / "benchmarks"))
from eye import limits, references, sheet  # noqa: E402
from eye.score import quantile, score  # noqa: E402
from real import exr  # noqa: E402
from real.runs import Failed  # noqa: E402

kSide = 32  # pixels: four blocks of 16 x 16
kPixels = kSide * kSide


def picture(changed=(), base=1.0):
    """A grey picture, of which some pixels are changed: (x, y, value)."""
    values = [base] * kPixels
    for x, y, value in changed:
        values[kSide * y + x] = value
    return exr.Picture(kSide, kSide, {letter: values for letter in "RGB"})


def close(value, expected):
    assert math.isclose(value, expected, rel_tol=1e-9, abs_tol=1e-12), (value, expected)


def test_equal_pictures():
    assert score(picture(), picture()) == {"mean": 1, "mse1": 0, "mse4": 0, "mse16": 0, "blocks": 0, "spots": 0, "not_finite": 0}


def test_noise_and_blotches():
    """Of a reference of 1 everywhere, R^2 + 0.01 m^2 is 1.01. What alternates is gone in blocks; a square of 4 x 4 pixels is a block
    of 64, and a 16th of one of four."""
    noise = score(picture(), picture([(x, y, 1 + 0.5 * (-1) ** (x + y)) for x in range(kSide) for y in range(kSide)]))
    close(noise["mse1"], 0.25 / 1.01)
    close(noise["mse4"], 0)
    blotch = score(picture(), picture([(x, y, 1.5) for x in range(4, 8) for y in range(8, 12)]))
    close(blotch["mse1"], 0.25 / 64 / 1.01)
    close(blotch["mse4"], 0.25 / 64 / 1.01)
    close(blotch["mse16"], (0.5 / 16) ** 2 / 4 / 1.01)
    close(blotch["mean"], 1 + 0.5 / 64)
    close(blotch["blocks"], 0.85 * 0.5 / 16)  # of 0, 0, 0, 1/32: 0.85 of the way from the third to the last


def test_exposure_does_not_matter():
    blotch = [(x, y, 1.5) for x in range(5) for y in range(5)]
    scaled = [(x, y, 8 * v) for x, y, v in blotch]
    assert score(picture(), picture(blotch)) == score(picture(base=8.0), picture(scaled, 8.0))


def test_what_is_near_a_light_is_left_out():
    """A pixel of 1000 is above 30 times the mean, which is 2: its 25 pixels do not count, the next one does."""
    light = (10, 10, 1000.0)
    inside = score(picture([light]), picture([light, (12, 8, 50.0)]))
    assert inside["mse1"] == 0 and inside["spots"] == 0 and inside["mean"] == 1, inside
    outside = score(picture([light]), picture([light, (13, 10, 50.0)]))
    assert outside["mse1"] > 0 and outside["spots"] > 0, outside


def test_spots():
    close(score(picture(), picture([(3, 3, 3.1), (20, 9, 2.9)]))["spots"], 1e4 / kPixels)
    assert score(picture([(5, 4, 2.0)]), picture([(3, 3, 3.1)]))["spots"] == 0  # the reference is as bright nearby


def test_what_cannot_be_scored():
    assert score(picture(), picture([(1, 1, math.nan), (2, 2, math.inf)]))["not_finite"] == 6
    small = exr.Picture(8, 8, {letter: [1.0] * 64 for letter in "RGB"})
    assert math.isnan(score(small, small)["mse16"])
    for reference, image in ((picture(), small), (picture(base=0.0), picture())):
        try:
            score(reference, image)
        except Failed:
            continue
        raise AssertionError("scored what has no score")
    assert math.isnan(quantile([], 0.5)) and quantile([3, 1], 0.5) == 2


def test_halves():
    """Halves of 1 + e and 1 - e have a mean of 1, and each has an error of e: their mean has e^2 / 2 where they are independent."""
    first, second = picture(base=1.1), picture(base=0.9)
    assert all(abs(v - 1) < 1e-6 for v in references.mean_of(first, second).colours("")[1])
    close(references.floor_of(first, second)["mse1"], 0.2 ** 2 / (1.01 * 1.1 ** 2) / 4)


def test_limits():
    close(limits.limit_of([1.0, 2.0, 3.0]), 2 + 4)
    close(limits.limit_of([-1.0, -2.0, -3.0]), 2 + 4)


def run(program, folder, *options):
    command = [sys.executable, "-B", kRoot / "benchmarks" / "untuned.py", program, "--width", "32", "--references", folder, "--out",
               folder / "out", *options]
    return subprocess.run(command, capture_output=True, text=True)


def rows(done):
    """The tables' lines of scenes and means, by their first columns."""
    lines = [[cell.strip() for cell in line.strip("|").split("|")] for line in done.stdout.splitlines() if line.startswith("| ")]
    return {cells[0]: cells[1:] for cells in lines if cells[0] not in ("scene", "---")}


def test_script(program, folder):
    scenes = ["--only", "ring,sunroom,fog2"]
    arguments = ["--", "--photons", "20k", "--spp", "1"]
    done = run(program, folder, *scenes, "--reference-effort", "0.001", "--sheet", folder / "sheet.jpg", *arguments)
    if not shutil.which(sheet.TOOL):
        assert done.returncode == 1 and sheet.PACKAGE in done.stderr, done.stderr
        done = run(program, folder, *scenes, "--reference-effort", "0.001", *arguments)
    else:
        assert (folder / "sheet.jpg").read_bytes()[:2] == b"\xff\xd8", done.stderr
    assert done.returncode == 0, done.stdout + done.stderr
    found = rows(done)
    assert set(found) == {"ring", "sunroom", "fog2", "geometric mean, without fogs"} and len(found["ring"]) == 8, done.stdout
    assert json.loads((folder / "ring-32.json").read_text())["effort"] == 0.001
    assert "--method" in json.loads((folder / "fog2-32.json").read_text())["options"]
    kept = (folder / "ring-32.exr").stat().st_mtime_ns
    assert run(program, folder, "--only", "ring", "--reference-effort", "0.0005", *arguments).returncode == 0
    assert (folder / "ring-32.exr").stat().st_mtime_ns == kept, "a reference of more effort was made again"
    assert run(program, folder, "--only", "ring", "--reference-effort", "0.002", "--make-references").returncode == 0
    assert json.loads((folder / "ring-32.json").read_text())["effort"] == 0.002


def test_arms(program, folder):
    done = run(program, folder, "--only", "sunroom", "--reference-effort", "0.001", "--arms", "--", "--spp", "1")
    assert done.returncode == 0 and done.stdout.count("\n| sunroom |") == 5, done.stdout + done.stderr
    for arm in ("default", "photons", "paths", "time"):
        assert (folder / "out" / arm / "sunroom.exr").exists()


def test_messages(program, folder):
    for options, text in ((["--only", "gone"], "has no scene gone"), (["--seeds", "1"], "2 or more"),
                          (["--only", "ring", "--reference-effort", "0.001", "--", "--gone"], "exit code 2, see")):
        done = run(program, folder, *options)
        assert done.returncode != 0 and text in done.stderr, (options, done.stderr)
    done = run(folder / "gone", folder)
    assert done.returncode == 1 and "no such program" in done.stderr, done.stderr


def main():
    program, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    for test in (test_equal_pictures, test_noise_and_blotches, test_exposure_does_not_matter, test_what_is_near_a_light_is_left_out,
                 test_spots, test_what_cannot_be_scored, test_halves, test_limits):
        test()
    for test in (test_script, test_arms, test_messages):
        test(program, folder)


if __name__ == "__main__":
    main()
