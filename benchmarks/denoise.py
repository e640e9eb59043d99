#!/usr/bin/env python3
"""Compares denoised pictures with noisy ones at equal time, the filter included, and with other filters of the same samples.

denoise.py --references DIR [--program kaustik] [--rivals denoise_rivals] [--seconds 5] [--width W] [--trials 3] [--json FILE]
           [--options "..."] SCENE...

DIR/NAME.exr (with --width: DIR/NAME-W.exr) is the reference of NAME.pbrt, such as real_scenes.py makes it. Each trial renders with a
seed of its own and one after the other: `--time T --denoise off`, `--time T --denoise on`. The samples of the first are filtered by
`kaustik denoise` and by the rivals (benchmarks/denoise_rivals.cpp), too. The table has the medians over the trials of how many times
lower than that of the noisy picture relMSE is, of pixels and of means over blocks of 2 x 2 to 8 x 8; FLIP of the noisy and the denoised
picture; and `edges`: the sum of (gradient of the picture) . (gradient of the reference) over that of the reference's squared, which is
1 where edges are kept, less where they are blurred, and which noise does not change on average. Needs only Python 3."""
import argparse
import json
import os
import pathlib
import statistics
import sys

sys.dont_write_bytecode = True
from real import exr  # noqa: E402
from real.runs import Failed, compare, render, run  # noqa: E402

SIDES = ("1", "2", "4", "8")


def edges(reference, image):
    """How much of the reference's edges an image has: 1 for all."""
    product = square = 0.0
    for want, have in zip(reference.colours(""), image.colours("")):
        for step, columns in ((1, reference.width - 1), (reference.width, reference.width)):
            for y in range(reference.height - (step > 1)):
                row = y * reference.width
                for i in range(row, row + columns):
                    of_reference = want[i + step] - want[i]
                    product += of_reference * (have[i + step] - have[i])
                    square += of_reference * of_reference
    return product / square


def measured(args, reference, picture, image):
    found = compare(args, reference, image, "--flip")
    return {"relmse": found["relmse_of_blocks"], "flip": found["flip"]["mean"], "edges": edges(picture, exr.read(image))}


def trial(args, scene, reference, picture, seed):
    """The errors of each kind of picture."""
    folder = args.references
    noisy, other = folder / "denoise-noisy.exr", folder / "denoise-other.exr"
    timed = ["--time", f"{args.seconds}s", "--seed", seed]
    found = {}
    done = render(args, scene, noisy, [*timed, "--denoise", "off", "--aov", "denoising"])
    found["noisy"] = {**measured(args, reference, picture, noisy), "seconds": done["seconds"]}
    done = render(args, scene, other, [*timed, "--denoise", "on"])
    found["denoised"] = {**measured(args, reference, picture, other), "seconds": done["seconds"],
                         "filter": done["stats"]["seconds"]["denoise"]}
    run([args.program, "denoise", noisy, "-o", other, "-q"])
    found["same samples"] = measured(args, reference, picture, other)
    for rival in ("bilateral", "nl-means") if args.rivals else ():
        run([args.rivals, rival, noisy, other])
        found[rival] = measured(args, reference, picture, other)
    for file in (noisy, other):
        os.remove(file)
    return found


def median(trials, kind, value):
    return statistics.median(value(found[kind]) for found in trials)


def row(name, trials):
    """One line of the table: how many times lower the error is, for each kind and scale."""
    def gain(kind, side):
        return statistics.median(found["noisy"]["relmse"][side] / found[kind]["relmse"][side] for found in trials)
    kinds = [kind for kind in trials[0] if kind != "noisy"]
    cells = [name, f"{median(trials, 'noisy', lambda m: m['relmse']['1']):.3g}"]
    cells += [" / ".join(f"{gain('denoised', side):.2f}" for side in SIDES)]
    cells += [f"{gain(kind, '1'):.2f}" for kind in kinds if kind != "denoised"]
    cells += [f"{median(trials, kind, lambda m: m['flip']):.3f}" for kind in ("noisy", "denoised")]
    cells += [f"{median(trials, kind, lambda m: m['edges']):.3f}" for kind in trials[0]]
    return "| " + " | ".join(cells) + " |"


def header(kinds):
    others = [kind for kind in kinds if kind not in ("noisy", "denoised")]
    cells = ["scene", "relMSE, noisy", "times lower: pixels / 2 / 4 / 8", *others, "FLIP, noisy", "FLIP, denoised",
             *(f"edges, {kind}" for kind in kinds)]
    return "| " + " | ".join(cells) + " |\n|" + " --- |" * len(cells)


def parsed():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("scenes", nargs="+", type=pathlib.Path)
    parser.add_argument("--references", type=pathlib.Path, required=True)
    parser.add_argument("--program", default="build/release/kaustik")
    parser.add_argument("--rivals", default="")
    parser.add_argument("--seconds", type=float, default=5)
    parser.add_argument("--width", type=int, default=0)
    parser.add_argument("--trials", type=int, default=3)
    parser.add_argument("--threads", type=int, default=0)
    parser.add_argument("--options", default="")
    parser.add_argument("--json", type=pathlib.Path)
    return parser.parse_args()


def main():
    args, results = parsed(), {}
    for scene in args.scenes:
        name = scene.stem
        reference = args.references / (f"{name}-{args.width}.exr" if args.width else f"{name}.exr")
        try:
            picture = exr.read(reference)
            trials = [trial(args, scene, reference, picture, seed) for seed in range(1, args.trials + 1)]
        except (Failed, OSError, ValueError) as error:
            print(f"{scene}: {error}", file=sys.stderr)
            continue
        if not results:
            print(header(list(trials[0])))
        results[name] = trials
        print(row(name, trials), flush=True)
    gains = [statistics.median(t["noisy"]["relmse"]["1"] / t["denoised"]["relmse"]["1"] for t in trials) for trials in results.values()]
    if gains:
        print(f"\nmedian over {len(gains)} scenes: {statistics.median(gains):.2f} times lower; least {min(gains):.2f}")
    if args.json:
        args.json.write_text(json.dumps(results, indent=1) + "\n")
    return 0 if len(results) == len(args.scenes) else 1


if __name__ == "__main__":
    sys.exit(main())
