"""Small pictures of a few scenes of scenes/untuned: their references and limits, which tests/untuned/pictures_test.py reads."""
import json
import pathlib
import statistics

from eye import references, renders
from eye.score import score
from real import exr

FOLDER = pathlib.Path(__file__).resolve().parents[2] / "tests" / "untuned"
FILE = FOLDER / "limits.json"
NAMES = ("lampshade", "ring", "skylight", "sunroom")
WIDTH = 96  # [pixels]
SEED = 0  # of the test's pictures, the default; the limits come from others
DEVIATIONS = 4  # standard deviations from the mean over the seeds to the limit
NOISY = ("mse4", "mse16")  # measures to which the noise of the reference adds
MEASURES = ("mean", *NOISY)


def reference_of(name):
    return FOLDER / f"{name}.exr"


def measure(program, name, image, seed):
    """Renders a small picture with the default settings. Returns its errors: `mean` is that of the picture divided by that of the
    reference, less 1; the others are scores."""
    options = [*references.size_options(WIDTH), "--seed", seed, "-o", image.with_suffix(".png")]
    renders.render(program, references.scene_of(name), image, options)
    found = score(exr.read(reference_of(name)), exr.read(image))
    return {"mean": found["mean"] - 1, "mse4": found["mse4"], "mse16": found["mse16"]}


def limit_of(errors):
    """What the error of another seed hardly exceeds: the mean of these and DEVIATIONS of their standard deviations. A mean below 0,
    of pictures that are too dark, counts as far from 0 as it is."""
    return abs(statistics.mean(errors)) + DEVIATIONS * statistics.stdev(errors)


def known():
    return json.loads(FILE.read_text()) if FILE.exists() else {}


def make_reference(made, name, out):
    """Keeps a reference as half floats in FOLDER, and returns what its noise adds to the errors. made: the `References` that have
    it, or make it."""
    reference = made.get(name, out)
    exr.write_half(reference_of(name), reference.picture, "made by untuned.py --set-limits")
    return {key: rounded(reference.floor[key]) for key in NOISY}


def set_limits(program, made, out, seeds, again):
    """Measures each scene with `seeds` seeds and writes FILE; references are made where they are missing, or `again`. Yields the lines
    of a table."""
    limits = known()
    yield "| scene | " + " | ".join(f"{key}: mean, limit" for key in MEASURES) + f" | floor: {', '.join(NOISY)} |"
    yield "| --- " * (len(MEASURES) + 2) + "|"
    for name in NAMES:
        if again:
            made.make(name)
        if again or name not in limits or not reference_of(name).exists():
            limits[name] = {"floor": make_reference(made, name, out)}
        errors = [measure(program, name, out / f"{name}-{seed}.exr", seed) for seed in range(SEED + 1, SEED + 1 + seeds)]
        columns = {key: [e[key] for e in errors] for key in MEASURES}
        limits[name].update(seeds=seeds, means={key: rounded(statistics.mean(values)) for key, values in columns.items()},
                            limits={key: rounded(limit_of(values)) for key, values in columns.items()})
        FILE.write_text(json.dumps(limits, indent=1, sort_keys=True) + "\n")
        yield line_of(name, limits[name])


def line_of(name, found):
    pairs = [f"{found['means'][key]:.3g}, {found['limits'][key]:.3g}" for key in MEASURES]
    floor = ", ".join(f"{found['floor'][key]:.2g}" for key in NOISY)
    return f"| {name} | {' | '.join(pairs)} | {floor} |"


def rounded(value):
    return float(f"{value:.4g}")
