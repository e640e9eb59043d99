#!/usr/bin/env python3
"""Tests benchmarks/real_scenes.py: real_scenes_test.py PROGRAM FOLDER, with a folder to write to."""
import json
import math
import pathlib
import shutil
import subprocess
import sys

kRoot = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(kRoot / "benchmarks"))
import real_scenes  # noqa: E402
from real import exr, references  # noqa: E402

kScript, kScene = kRoot / "benchmarks" / "real_scenes.py", kRoot / "scenes" / "gallery" / "rough-glass.pbrt"


def test_half_floats(program, folder):
    """Halves have 11 bits: a number is off by at most 2^-11 of itself, those below 2^-14 by 2^-25. 40 rows are three blocks."""
    picture = exr.Picture(7, 40, {name: [math.sin(i * (k + 1)) * 10.0 ** (i % 7 - 4) for i in range(280)]
                                  for k, name in enumerate(("R", "G", "B", "direct.R", "direct.G", "direct.B"))})
    picture.channels["R"][3] = 1e9
    exr.write_half(folder / "half.exr", picture, "a test")
    back = exr.read(folder / "half.exr")
    assert (back.width, back.height, sorted(back.channels)) == (7, 40, sorted(picture.channels))
    assert back.channels["R"][3] == 65504
    back.channels["R"][3] = picture.channels["R"][3]
    for name, values in picture.channels.items():
        assert all(abs(a - b) <= max(2 ** -11 * abs(a), 2 ** -25) for a, b in zip(values, back.channels[name])), name
    # OpenEXR's library agrees with the reader: the mean of a layer.
    found = json.loads(subprocess.run([program, "compare", folder / "half.exr", folder / "half.exr", "--layer", "direct", "--json"],
                                      check=True, capture_output=True, text=True).stdout)
    assert abs(found["mean"] - back.mean("direct")) <= 1e-9 * sum(map(abs, back.channels["direct.R"])), found


def test_agreement():
    """Two pictures that differ by twice the error that both state together do not agree; equal ones do."""
    def picture(value):
        layers = {f"{layer}.{c}": [0.0] * 64 for layer in references.CLASSES for c in "RGB"}
        layers.update({f"direct.{c}": [value] * 64 for c in "RGB"})
        layers.update({c: [value] * 64 for c in "RGB"})
        layers.update({f"{layer}.{c}": [error] * 64 for layer, error in (("error", 0.1), ("bias", 0.0)) for c in "RGB"})
        return exr.Picture(8, 8, layers)
    same = references.agreement(picture(1.0), picture(1.0))
    assert same["within_bound"] == 1 and same["rmse_over_stated"] == 0 and not same["complaints"], same
    apart = references.agreement(picture(1.0), picture(1.0 + 0.2 * math.sqrt(2)))
    assert apart["within_bound"] == 0 and abs(apart["rmse_over_stated"] - 2) < 1e-9, apart
    assert len(apart["complaints"]) == 3 and apart["complaints"][2].startswith("direct: mc 1, auto 1.28"), apart


def test_student():
    """Against tables of the distribution, which have four digits; the next term of the expansion is below 0.2 % of it."""
    for passes, value in ((2, 6.314), (4, 2.353), (8, 1.895), (9, 1.860), (31, 1.697)):
        assert abs(real_scenes.student(passes) - value) <= 0.003 * value, (passes, real_scenes.student(passes))
    assert real_scenes.student(1) == math.inf
    assert real_scenes.passes_in("0:6,8:9") == 7


def test_script(program, folder):
    command = [sys.executable, "-B", kScript, "--references", folder, "--program", program, "--width", "48", "--trials", "1",
               "--seconds", "0.3"]
    missing = subprocess.run([*command, kScene], capture_output=True, text=True)
    assert missing.returncode == 1 and "there is no reference" in missing.stderr, missing.stderr
    for seconds in ("5", "60"):  # on slow machines 5 s are a single pass, which does not state its error
        done = subprocess.run([*command, "--make-references", seconds, "--other", program, kScene], capture_output=True, text=True)
        if "are one pass of" not in done.stderr:
            break
    assert done.returncode == 0, done.stdout + done.stderr
    assert "relMSE of auto to mc at equal time" in done.stdout and "relMSE to that of the other program" in done.stdout, done.stdout
    check = json.loads((folder / "rough-glass-48.json").read_text())
    assert set(check["stated"]) == {"mc", "auto"} and check["used"] in check["stated"], check
    names = set(exr.read(folder / "rough-glass-48-mc.exr").channels)
    assert names == {*"RGB", *(f"{layer}.{c}" for layer in references.CLASSES for c in "RGB")}, names
    result, = json.loads((folder / "results.json").read_text())
    assert list(result["trials"]) == ["auto, T", "mc, T", "mc, 10 T", "other auto, T", "other mc, T"], result
    trial, = result["trials"]["auto, T"]
    assert trial["relmse"] > 0 and set(trial["relmse_of_blocks"]) == {"1", "2", "4", "8"}, trial
    assert trial["fireflies"] >= 0, trial
    assert 0 <= trial["flip"] <= 1, trial
    assert set(trial["classes"]) == set(references.CLASSES), trial
    within, passes = result["calibration"]["within_bound"], real_scenes.passes_in(result["calibration"]["passes"])
    assert (within is None) == (passes < 2) and (within is None or 0 <= within <= 1), result["calibration"]
    assert not [path for path in folder.iterdir() if path.name.endswith(("-full.exr", "-trial.exr"))]


def main():
    program, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    test_half_floats(program, folder)
    test_agreement()
    test_student()
    test_script(program, folder)


if __name__ == "__main__":
    main()
