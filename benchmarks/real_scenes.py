#!/usr/bin/env python3
"""Compares `--method auto` with `--method mc`, at equal time and at ten times the time, on any scenes.

real_scenes.py --references DIR [--make-references SECONDS] [--program kaustik] [--other PROGRAM] [--seconds 10] [--width W]
               [--trials 3] [--sppm PROGRAM] SCENE...

With --make-references, each scene is first rendered for SECONDS by `mc` and for as long by `auto` in many passes with a
shrinking radius. Both are kept in DIR as half-float EXR files of the picture and its classes (emitted, direct, caustic,
indirect), with a JSON file that says whether they agree: how many pixels lie within the errors that both state, the RMSE in
units of that, and the means of the classes in standard errors. Errors are measured against the one that states the lower
error, or the one of --reference-by. DIR/SCENE-auto.exr and -mc.exr (with --width: DIR/SCENE-W-auto.exr) may come from
elsewhere, too.
Then each trial renders, with a seed of its own and one after the other: auto for T = --seconds, mc for T, mc for 10 T, both for
T by --other, and SPPM (benchmarks/sppm_rival) with the best of a few radii. The tables hold medians over the trials: relMSE with
its range, RMSE, FLIP, relMSE of means over blocks (noise of independent samples falls by about 4 a step, blotches do not), fireflies (pixels above ten times the median of the 5 x 5
about them that the reference does not have), and the mean
of each class in per cent of the reference's. One more render of auto, which states its error, tells how many pixels lie within it.
--trials 0 only makes references; --options "--crop X0 X1 Y0 Y1" limits all renders, and so the references, to a part. Writes DIR/results.json, or the file of --json.
Times are those of the whole process, T those of its option --time: what it took stands in the table. Needs only Python 3."""
import argparse
import json
import math
import os
import pathlib
import statistics
import sys

sys.dont_write_bytecode = True
from real import exr, references  # noqa: E402
from real.runs import CLASSES, Failed, errors, render, run, size_options  # noqa: E402

SIDES = ("2", "4", "8")
LIGHT = ["--aov", ",".join(CLASSES)]  # does not change how the time is used, which `error` and `bias` would


def auto_options(seconds):
    return ["--method", "auto", "--time", f"{seconds}s", *LIGHT]


def mc_options(args, seconds):
    """Passes of an eighth of the samples, as many as there is time for: without --spp those of the scene, perhaps thousands."""
    return ["--method", "mc", "--time", f"{seconds}s", "--spp", args.mc_spp, *LIGHT]


def rows(args, scene):
    """(name, function of image and seed that renders) of all renders of a trial."""
    def kaustik(options, program=None):
        return lambda image, seed: render(args, scene, image, [*options, "--seed", seed], program)
    T = args.seconds
    yield "auto, T", kaustik(auto_options(T))
    yield "mc, T", kaustik(mc_options(args, T))
    yield "mc, 10 T", kaustik(mc_options(args, 10 * T))
    if args.other:
        yield "other auto, T", kaustik(auto_options(T), args.other)
        yield "other mc, T", kaustik(mc_options(args, T), args.other)


def sppm_command(args, scene, image, radius, iterations, seed):
    threads = ["--threads", args.threads] if args.threads else []
    return [args.sppm, scene, "-o", image, *threads, *size_options(args), "--iterations", iterations, "--photons-per-iteration",
            args.sppm_photons, "--radius", radius, "--seed", seed]


def sppm_row(args, scene, reference, image, radius):
    """The row of SPPM with the best of --sppm-radii times `radius`, and as many iterations as fill T."""
    def timed(radius, iterations, seed=0):
        _, seconds, cpu = run(sppm_command(args, scene, image, radius, iterations, seed))
        return {"seconds": seconds, "cpu": cpu, "render_seconds": seconds}
    found = []
    for factor in map(float, args.sppm_radii.split(",")):
        iterations, seconds = 1, timed(factor * radius, 1)["seconds"]
        while seconds < args.seconds / 2:  # until the start of the process weighs little
            iterations = math.ceil(iterations * min(8, 0.8 * args.seconds / seconds))
            seconds = timed(factor * radius, iterations)["seconds"]
        iterations = max(1, round(iterations * args.seconds / seconds))
        found.append((errors(args, reference, image, layers=False)["relmse"], factor * radius, iterations))
    _, best, iterations = min(found)
    return f"SPPM, {iterations} iterations, r = {best:.3g}", lambda image, seed: timed(best, iterations, seed)


def calibration(args, scene, reference, image):
    """The share of the reference's pixels within the error that a render of auto states with a confidence of 90 %; None if the
    render has a single pass, which states none."""
    done = render(args, scene, image, [*auto_options(args.seconds)[:-1], ",".join([*CLASSES, "error", "bias"]), "--seed", args.trials])
    picture, truth = exr.read(image), exr.read(reference)
    if not picture.has("error"):
        return {"within_bound": None, "passes": done["stats"]["pass_ranges"]}
    factor = student(passes_in(done["stats"]["pass_ranges"]))
    within = count = 0
    for squares, values, true in zip(references.squares_of_errors(picture), picture.colours(""), truth.colours("")):
        for square, value, wanted in zip(squares, values, true):
            within += abs(value - wanted) <= factor * math.sqrt(square)
            count += 1
    return {"within_bound": within / max(1, count), "passes": done["stats"]["pass_ranges"]}


def passes_in(ranges):
    """"0:6,8:9" names 7 passes."""
    return sum(int(end) - int(begin) for begin, end in (part.split(":") for part in ranges.split(",")))


STUDENT = (6.314, 2.920, 2.353, 2.132, 2.015, 1.943, 1.895)  # for 1 degree of freedom, 2 ...


def student(passes):
    """The 95 % quantile of Student's t with passes - 1 degrees of freedom; for many, the first terms of its expansion about z."""
    if passes < 2:
        return math.inf
    n, z = passes - 1, 1.644854
    return STUDENT[n - 1] if n <= len(STUDENT) else z + (z ** 3 + z) / (4 * n) + (5 * z ** 5 + 16 * z ** 3 + 3 * z) / (96 * n * n)


def reference_of(args, name):
    """The picture to measure against, and what is known about it."""
    images, about = references.files_of(args.references, name, args.width)
    known = json.loads(about.read_text()) if about.exists() else {}
    there = [method for method in references.METHODS if images[method].exists()]
    if not there:
        raise Failed(f"{images['auto']}: there is no reference; --make-references SECONDS makes one")
    chosen = args.reference_by or known.get("used") or there[0]
    if chosen not in there:
        raise Failed(f"{images[chosen]}: there is no such reference")
    return images[chosen], {**known, "used": chosen}


def tell(text):
    print(text, file=sys.stderr, flush=True)


def measure(args, scene, name):
    reference, known = reference_of(args, name)
    image = args.references / f"{name}-trial.exr"
    chosen, trials = list(rows(args, scene)), {}
    stated = calibration(args, scene, reference, image)
    radii = []
    for seed in range(args.trials):
        for row, render_row in chosen:
            tell(f"{name}: trial {seed + 1} of {args.trials}: {row}")
            done = render_row(image, seed)
            radii.append(max(done.get("stats", {}).get("radii", {"": 0}).values()))
            found = errors(args, reference, image, layers="stats" in done)
            done.pop("stats", None)
            trials.setdefault(row, []).append({**done, **found})
            if seed == 0 and len(trials) == 1 and args.sppm:
                chosen.append(sppm_row(args, scene, reference, image, max(radii) or 0.05))
    os.remove(image)
    return {"scene": str(scene), "name": name, "seconds": args.seconds, "reference": known, "calibration": stated, "trials": trials}


def median_of(trials, get):
    values = [get(t) for t in trials]
    return statistics.median(values) if None not in values else None


def number(value, form=".3g"):
    return "-" if value is None else format(value, form)


def share(value):
    return "an unknown share" if value is None else f"{100 * value:.1f} %"


def class_text(trials, name):
    value = median_of(trials, lambda t: t.get("classes", {}).get(name))
    return "-" if value is None else f"{100 * value:.1f}"


def table(result):
    yield (f"| {result['name']} | s (processor s) | relMSE (range) | RMSE | FLIP | 2 x 2 | 4 x 4 | 8 x 8 | fireflies | " +
           " | ".join(f"{name} %" for name in CLASSES) + " |")
    yield "| --- " * (9 + len(CLASSES)) + "|"
    for row, trials in result["trials"].items():
        relmse = [t["relmse"] for t in trials]
        blocks = " | ".join(number(median_of(trials, lambda t: t["relmse_of_blocks"][side])) for side in SIDES)
        yield (f"| {row} | {median_of(trials, lambda t: t['seconds']):.1f} ({median_of(trials, lambda t: t['cpu']):.1f}) | "
               f"{number(statistics.median(relmse))} ({number(min(relmse))}..{number(max(relmse))}) | "
               f"{number(median_of(trials, lambda t: t['rmse']))} | {median_of(trials, lambda t: t['flip']):.3f} | {blocks} | "
               f"{median_of(trials, lambda t: t['fireflies']):g} | " +
               " | ".join(class_text(trials, name) for name in CLASSES) + " |")


def ratio(result, first, second, get):
    a, b = (median_of(result["trials"][row], get) for row in (first, second))
    return a / b if b else None


def error_of(reference):
    """What is known about the reference's own relMSE: what it states, or its difference from the other one if that is less."""
    stated = reference.get("stated", {}).get(reference["used"], {}).get("relmse")
    return None if stated is None else min(stated, reference.get("relmse", math.inf))


def sentences(result):
    """What the table means, as lines."""
    def relmse(t):
        return t["relmse"]
    masked = median_of(result["trials"]["auto, T"], lambda t: t["masked"])
    error = error_of(result["reference"])
    yield (f"Reference: {result['reference']['used']}, whose own relMSE is {number(error)} or less; "
           f"{100 * masked:.1f} % of the pixels masked.")
    least = min(median_of(trials, relmse) for trials in result["trials"].values())
    if error and 4 * error > least:
        yield f"The reference's own error is more than a quarter of the least that is measured, {number(least)}."
    yield (f"relMSE of auto to mc at equal time: {number(ratio(result, 'auto, T', 'mc, T', relmse))}, in blocks of 8 x 8: "
           f"{number(ratio(result, 'auto, T', 'mc, T', lambda t: t['relmse_of_blocks']['8']))}; "
           f"auto at T to mc at 10 T: {number(ratio(result, 'auto, T', 'mc, 10 T', relmse))}; "
           f"relMSE x processor seconds: {number(ratio(result, 'auto, T', 'mc, T', lambda t: t['relmse'] * t['cpu']))}.")
    took = median_of(result["trials"]["auto, T"], lambda t: t["seconds"])
    if abs(took / result["seconds"] - 1) > 0.2:
        yield f"auto took {took:.1f} s of the {result['seconds']:g} s, so the ratios are not those of equal time."
    if "other auto, T" in result["trials"]:
        yield (f"relMSE to that of the other program: auto {number(ratio(result, 'auto, T', 'other auto, T', relmse))}, "
               f"mc {number(ratio(result, 'mc, T', 'other mc, T', relmse))}.")
    yield f"Within the error that auto states with 90 %: {share(result['calibration']['within_bound'])} of the pixels."


def summary(results):
    yield ("| scene | relMSE of auto, T | mc, T | mc, 10 T | auto / mc | auto, T / mc, 10 T | auto / mc, 8 x 8 | within stated error |\n"
           "| --- | --- | --- | --- | --- | --- | --- | --- |")
    for r in results:
        def relmse(t):
            return t["relmse"]
        errors_of = " | ".join(number(median_of(r["trials"][row], relmse)) for row in ("auto, T", "mc, T", "mc, 10 T"))
        yield (f"| {r['name']} | {errors_of} | {number(ratio(r, 'auto, T', 'mc, T', relmse))} | "
               f"{number(ratio(r, 'auto, T', 'mc, 10 T', relmse))} | "
               f"{number(ratio(r, 'auto, T', 'mc, T', lambda t: t['relmse_of_blocks']['8']))} | "
               f"{share(r['calibration']['within_bound'])} |")


def report_reference(name, check):
    classes = ", ".join(f"{n} {c['mc']:.5g} and {c['auto']:.5g} (+- {c['standard_error']:.2g})" for n, c in check["classes"].items())
    print(f"{name}: mc and auto, {100 * check['within_bound']:.1f} % within the bounds of 90 %, RMSE {check['rmse_over_stated']:.2f} "
          f"times the stated; means: {classes}. Used: {check['used']}.")
    for complaint in check["complaints"]:
        print(f"{name}: WARNING, the references do not agree: {complaint}")
    sys.stdout.flush()


def run_scene(args, scene, name):
    """Returns the result, or None without trials."""
    if args.make_references:
        tell(f"{name}: two references of {args.make_references:g} s each")
        report_reference(name, references.make(args, scene, name))
    return measure(args, scene, name) if args.trials > 0 else None


def names_of(scenes):
    """Names of the scenes: those of the files, or of their folders where the files' are the same."""
    stems = [scene.stem for scene in scenes]
    return [stem if stems.count(stem) == 1 else f"{scene.resolve().parent.name}-{stem}" for scene, stem in zip(scenes, stems)]


def parse():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="+", type=pathlib.Path, metavar="SCENE")
    parser.add_argument("--references", type=pathlib.Path, required=True, metavar="DIR")
    parser.add_argument("--make-references", type=float, metavar="SECONDS")
    parser.add_argument("--reference-by", choices=references.METHODS, help="default: the one that states the lower error")
    parser.add_argument("--program", default="build/release/kaustik")
    parser.add_argument("--other", metavar="PROGRAM", help="another build, to compare with")
    parser.add_argument("--seconds", type=float, default=10, metavar="T")
    parser.add_argument("--trials", type=int, default=3)
    parser.add_argument("--width")
    parser.add_argument("--threads")
    parser.add_argument("--options", default="", help="options of all renders of kaustik, like `--max-bounces 8`")
    parser.add_argument("--mc-spp", default="16", help="samples of the first eight passes of mc")
    parser.add_argument("--mask-bright", type=float, default=4, metavar="L", help="see `kaustik compare`; 0: nothing is masked")
    parser.add_argument("--sppm", metavar="PROGRAM", help="benchmarks/sppm_rival, to compare with")
    parser.add_argument("--sppm-photons", default="100000", help="of each iteration")
    parser.add_argument("--sppm-radii", default="0.125,0.25,0.5,1", help="in units of the largest that auto takes")
    parser.add_argument("--json", type=pathlib.Path, metavar="FILE")
    return parser.parse_args()


def main():
    args = parse()
    args.references.mkdir(parents=True, exist_ok=True)
    results, failures = [], 0
    for scene, name in zip(args.scenes, names_of(args.scenes)):
        try:
            result = run_scene(args, scene, name)
        except Failed as failure:
            failures += 1
            tell(f"{name}: {failure}")
            continue
        if result:
            results.append(result)
            (args.json or args.references / "results.json").write_text(json.dumps(results, indent=1) + "\n")
            print("", *table(result), "", *sentences(result), sep="\n", flush=True)
    if len(results) > 1:
        print("", *summary(results), sep="\n")
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
