#!/usr/bin/env python3
"""Renders the scenes of scenes/untuned, situations that people bring, and scores them by what an eye sees.

untuned.py PROGRAM [--only NAMES] [--references DIR] [--out DIR] [--width W] [--sheet FILE] [--arms] [-- RENDER ARGUMENTS]
untuned.py PROGRAM --make-references [--only NAMES] [--reference-effort X]
untuned.py PROGRAM --set-limits [--make-references] [--seeds 16] [--reference-effort X]

The first form renders each scene with these arguments (none: the defaults), compares it with its reference and prints a table:
seconds of the process; the mean, divided by the reference's; relMSE of pixels, and of the means of 4 x 4 and 16 x 16 pixels, which a
blotch survives and noise does not; blocks, the 95 % quantile of |I / R - 1| over blocks of 16 x 16 pixels; spots, pixels far brighter
than the reference is nearby, for each 10,000; and FLIP. Geometric means leave out the fogs. --out keeps the pictures, and --sheet
puts them beside their references as one JPEG. --arms does so four times: with the defaults, with six million photons for all
caustics and indirect light, with denoised paths and with --time for the seconds that the defaults took.

References are made where they are missing, in two halves with seeds of their own; what their noise adds to relMSE is their floor.
All of them take about an hour on two cores. --reference-effort 0.01 makes quick ones to try the script; they are made again when more
effort is asked for. --make-references makes them again in any case.
--set-limits measures the small pictures of tests/untuned with several seeds and writes their limits. Their references are made where
they are missing, and again with --make-references. Needs only Python 3, and oiiotool for --sheet."""
import argparse
import math
import pathlib
import shutil
import sys

sys.dont_write_bytecode = True
from eye import limits, renders, sheet  # noqa: E402
from eye.references import FOGS, References, check_names, names, scene_of, size_options  # noqa: E402
from eye.score import SIDES, score  # noqa: E402
from real import exr  # noqa: E402
from real.runs import Failed  # noqa: E402

BUILD = pathlib.Path(__file__).resolve().parent.parent / "build"
MSE = [f"mse{side}" for side in SIDES]
HEADS = ["s", "mean", "relMSE", "4 x 4", "16 x 16", "blocks", "spots", "FLIP"]
AVERAGED = ["seconds", *MSE, "flip"]
# The sets of arguments that --arms compares: name and title, and the arguments for a scene that took the defaults so many seconds.
ARMS = [
    ("default", "The defaults", lambda _: []),
    ("photons", "Six million photons", lambda _: ["--indirect", "photons", "--caustics", "photons", "--photons", "6M"]),
    ("paths", "Denoised paths, for the seconds of the defaults",
     lambda seconds: ["--method", "mc", "--denoise", "on", "--time", f"{seconds:.2f}s"]),
    ("time", "--time, for the seconds of the defaults", lambda seconds: ["--time", f"{seconds:.2f}s"]),
]


def tell(text):
    print(text, file=sys.stderr, flush=True)


def measure(args, name, reference, image, options):
    seconds = renders.render(args.program, scene_of(name), image, [*size_options(args.width), *options, *args.extra])
    found = score(reference.picture, exr.read(image))
    return {**found, "seconds": seconds, "flip": renders.flip(args.program, reference.path, image)}


def line(name, found):
    warning = f" NOT FINITE: {found['not_finite']}" if found["not_finite"] else ""
    return (f"| {name} | {found['seconds']:.1f} | {found['mean']:.3f} | " + " | ".join(f"{found[key]:.5f}" for key in MSE) +
            f" | {100 * found['blocks']:.1f} % | {found['spots']:.1f} | {found['flip']:.4f}{warning} |")


def geometric_mean(values):
    """Of those that have a logarithm: an error of 0, or none, tells nothing about a ratio."""
    logarithms = [math.log(v) for v in values if v > 0]
    return math.exp(sum(logarithms) / len(logarithms)) if logarithms else math.nan


def means_line(found):
    mean = {key: geometric_mean([f[key] for f in found]) for key in AVERAGED}
    return (f"| geometric mean, without fogs | {mean['seconds']:.1f} | | " + " | ".join(f"{mean[key]:.5f}" for key in MSE) +
            f" | | | {mean['flip']:.4f} |")


def run_arm(args, references, folder, options_of):
    """Renders and scores all scenes, and prints a table. Returns the scores by scene, without those that failed."""
    folder.mkdir(parents=True, exist_ok=True)
    print("| scene | " + " | ".join(HEADS) + " |\n" + "| --- " * (len(HEADS) + 1) + "|", flush=True)
    found = {}
    for name, reference in references.items():
        try:
            found[name] = measure(args, name, reference, folder / f"{name}.exr", options_of(name))
            print(line(name, found[name]), flush=True)
        except Failed as failure:
            tell(f"{name}: {failure}")
    clear = [f for name, f in found.items() if name not in FOGS]
    if len(clear) > 1:
        print(means_line(clear), flush=True)
    return found


def run_arms(args, references):
    seconds, complete = {}, True
    for arm, title, options in ARMS:
        print(f"\n{title}:\n")
        done = {n: r for n, r in references.items() if arm == "default" or n in seconds}
        found = run_arm(args, done, args.out / arm, lambda name: options(seconds.get(name)))
        complete = complete and len(found) == len(references)
        if arm == "default":
            seconds = {name: f["seconds"] for name, f in found.items()}
    return complete


def get_references(args):
    """The references by scene; their floors are printed as a table."""
    made, found = References(args.program, args.references, args.width, args.reference_effort), {}
    for name in args.only:
        if args.make_references or made.is_missing(name):
            tell(f"{name}: two halves of a reference")
            made.make(name)
        found[name] = made.get(name, args.out)
    floors = {name: reference.floor for name, reference in found.items() if reference.floor}
    if floors:
        print("What the noise of the references adds to relMSE:\n\n| scene | pixels | 4 x 4 | 16 x 16 |\n| --- | --- | --- | --- |")
        for name, floor in floors.items():
            print(f"| {name} | " + " | ".join(f"{floor[key]:.5f}" for key in MSE) + " |")
        print(flush=True)
    return found


def compare(args):
    if args.sheet:
        sheet.check()
    references = get_references(args)
    if args.make_references:
        return True
    if args.arms:
        return run_arms(args, references)
    found = run_arm(args, references, args.out, lambda _: [])
    if args.sheet and found:
        sheet.write([(references[name], args.out / f"{name}.exr") for name in found], args.sheet)
    return len(found) == len(references)


def set_limits(args):
    made = References(args.program, args.references, limits.WIDTH, args.reference_effort)
    for text in limits.set_limits(args.program, made, args.out, args.seeds, args.make_references):
        print(text, flush=True)
    return True


def parse(words):
    """What follows -- is for `kaustik render`."""
    cut = words.index("--") if "--" in words else len(words)
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", metavar="PROGRAM")
    parser.add_argument("--only", metavar="NAMES", help="scenes, separated by commas; default: all")
    parser.add_argument("--references", type=pathlib.Path, default=BUILD / "untuned-references", metavar="DIR")
    parser.add_argument("--out", type=pathlib.Path, default=BUILD / "untuned", metavar="DIR")
    parser.add_argument("--width", type=int, metavar="W", help="of pictures and references; default: that of the scene")
    parser.add_argument("--sheet", type=pathlib.Path, metavar="FILE", help="a JPEG: left the references, right the pictures")
    parser.add_argument("--arms", action="store_true", help="four sets of arguments, one after the other")
    parser.add_argument("--make-references", action="store_true")
    parser.add_argument("--reference-effort", type=float, default=1.0, metavar="X", help="scales the work for a reference")
    parser.add_argument("--set-limits", action="store_true")
    parser.add_argument("--seeds", type=int, default=16, help="of --set-limits")
    args = parser.parse_args(words[:cut])
    args.extra = words[cut + 1:]
    if not args.reference_effort > 0:
        parser.error("--reference-effort takes a number above 0")
    if args.seeds < 2:
        parser.error("--seeds takes 2 or more: one has no spread")
    if args.sheet and args.arms:
        parser.error("--sheet shows one set of arguments, so it does not go with --arms")
    if args.set_limits and (args.only or args.width or args.extra):
        parser.error("--set-limits has scenes, a width and arguments of its own")
    return args


def main():
    args = parse(sys.argv[1:])
    try:
        if not shutil.which(args.program):
            raise Failed(f"{args.program}: no such program")
        args.only = args.only.split(",") if args.only else names()
        check_names(args.only)
        args.out.mkdir(parents=True, exist_ok=True)
        complete = set_limits(args) if args.set_limits else compare(args)
    except (Failed, OSError, ValueError) as failure:  # the last of EXR files that cannot be read
        sys.exit(f"untuned.py: {failure}")
    sys.exit(0 if complete else 1)


if __name__ == "__main__":
    main()
