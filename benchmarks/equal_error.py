#!/usr/bin/env python3
"""Measures the time to equal error: renderers take turns on one scene; wall seconds from the start of the process to the
written file, and relMSE.

equal_error.py KAUSTIK SPPM_RIVAL SCENE OUT_DIR --reference FILE [--rounds 5] [--threads 2]
               [--auto "--time 1s;--time 3s"] [--mc 16,64] [--sppm 4,16,40] [--povray FILE.pov] [--only REGEX]
equal_error.py KAUSTIK SPPM_RIVAL SCENE OUT_DIR --reference FILE --make-reference SPP

Each round renders every row once, with a seed of its own. Rounds are kept in OUT_DIR/rounds.json, and a further call adds
to them, so that a long list can be measured in pieces (--only). Prints the table of medians,
writes it to OUT_DIR/table.md and table.json. relMSE is that of `kaustik compare --mask-bright 4`.
Needs only Python 3, and povray for --povray.

--make-reference renders the reference by photons, 125,000 per sample, in 64 passes with a shrinking radius, and compares
it with `mc` and with the rival at an eighth of the size, where noise is small. Caustics of point lights are missing from
`mc`: there only the rival can check the reference."""
import argparse
import json
import os
import pathlib
import re
import statistics
import subprocess
import time

REFERENCE_SEED = "777"  # not a seed of the rounds: errors must not correlate


def size_options(args):
    return [text for key in ("width", "height") if getattr(args, key) for text in (f"--{key}", str(getattr(args, key)))]


def kaustik_row(args, name, options):
    def command(image, seed):
        return [args.kaustik, "render", args.scene, "-o", image, "--quiet", "--threads", args.threads, *size_options(args),
                "--denoise", "off", *options, "--seed", str(seed)]
    return name, command


def sppm_row(args, iterations):
    def command(image, seed):
        return [args.sppm_rival, args.scene, "-o", image, "--threads", args.threads, *size_options(args), "--iterations",
                iterations, "--photons-per-iteration", args.sppm_photons, "--radius", args.sppm_radius, "--seed", str(seed)]
    return f"SPPM {iterations} x {args.sppm_photons}, r = {args.sppm_radius}", command


def povray_row(args, name, options):
    size = [f"+W{args.width or 512}", f"+H{args.height or 512}"]

    def command(image, _):  # POV-Ray has no seed
        return ["povray", args.povray, *size, "+FE", f"+O{image}", "-D", "-GA", f"+WT{args.threads}", *options]
    return f"POV-Ray, {name}", command


POVRAY_SETTINGS = {
    "100 k photons, 100 rays": ["Declare=Photons=100000", "Declare=Count=100"],
    "100 k photons, 200 rays": ["Declare=Photons=100000", "Declare=Count=200"],
    "400 k photons, 400 rays, antialiased": ["Declare=Photons=400000", "Declare=Count=400", "Declare=ErrorBound=0.3", "+A0.02",
                                             "+AM2", "+R3"],
}


def rows(args):
    if args.auto:
        for options in args.auto.split(";"):
            yield kaustik_row(args, f"kaustik {options}".strip(), options.split())
    if args.mc:
        for spp in args.mc.split(","):
            yield kaustik_row(args, f"kaustik --method mc --spp {spp}", ["--method", "mc", "--spp", spp])
    if args.sppm:
        for iterations in args.sppm.split(","):
            yield sppm_row(args, iterations)
    if args.povray:
        for name, options in POVRAY_SETTINGS.items():
            yield povray_row(args, name, options)


def timed(command):
    start = time.perf_counter()
    child = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    _, errors = child.communicate()
    seconds = time.perf_counter() - start
    if child.returncode != 0:
        raise SystemExit(f"{' '.join(command)}: {errors.decode()[-2000:]}")
    return seconds


def compare(args, reference, image):
    command = [args.kaustik, "compare", reference, image, "--mask-bright", "4", "--json"]
    return json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)


def measure(args, kept):
    chosen = [row for row in rows(args) if re.search(args.only, row[0])]
    for _ in range(args.rounds):
        for name, command in chosen:
            image = str(args.out / "image.exr")
            done = kept.setdefault(name, [])
            seconds = timed(command(image, len(done)))
            done.append({"seconds": seconds, "relmse": compare(args, args.reference, image)["relmse"]})
            os.remove(image)
            (args.out / "rounds.json").write_text(json.dumps(kept, indent=1) + "\n")


def table(kept):
    for name, rounds in kept.items():
        seconds = [r["seconds"] for r in rounds]
        yield {"renderer": name, "rounds": len(rounds), "seconds": statistics.median(seconds), "least": min(seconds),
               "most": max(seconds), "relmse": statistics.median(r["relmse"] for r in rounds)}


def markdown(results):
    lines = ["| renderer | seconds (range) | relMSE | rounds |", "| --- | --- | --- | --- |"]
    for r in results:
        lines.append(f"| {r['renderer']} | {r['seconds']:.2f} ({r['least']:.2f}..{r['most']:.2f}) | {r['relmse']:.4f} | {r['rounds']} |")
    return "\n".join(lines) + "\n"


def make_reference(args, spp):
    """spp: samples per pixel of the reference."""
    options = ["--direct", "shadow-rays", "--caustics", "photons", "--indirect", "photons", "--passes", "64", "--alpha", "0.667",
               "--radius", "auto", "--seed", REFERENCE_SEED]

    def render(image, more):
        timed([args.kaustik, "render", args.scene, "-o", image, "--quiet", "--threads", args.threads, "--denoise", "off", *more])

    render(args.reference, [*size_options(args), *options, "--spp", str(spp), "--photons", str(125000 * spp)])
    small = ["--width", str((args.width or 512) // 8)]  # an eighth of the size: 64 times the samples per pixel
    by_photons, other = str(args.out / "small-photons.exr"), str(args.out / "small-other.exr")
    render(by_photons, [*small, *options, "--spp", str(16 * spp), "--photons", str(125000 * spp)])
    render(other, [*small, "--method", "mc", "--spp", str(16 * spp)])
    against = {"mc": compare(args, by_photons, other)}
    timed([args.sppm_rival, args.scene, "-o", other, "--threads", args.threads, *small, "--iterations", str(max(16, spp // 2)),
           "--photons-per-iteration", args.sppm_photons, "--radius", args.sppm_radius])
    against["the rival"] = compare(args, by_photons, other)
    for name, result in against.items():
        print(f"an eighth of the size, {name} against the reference: relMSE {result['relmse']:.6f}, "
              f"mean {result['mean']:.6g}, of the reference {result['reference_mean']:.6g}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("kaustik")
    parser.add_argument("sppm_rival")
    parser.add_argument("scene")
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--reference", required=True)
    parser.add_argument("--make-reference", type=int, metavar="SPP")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--threads", default="2")
    parser.add_argument("--width", type=int)
    parser.add_argument("--height", type=int)
    parser.add_argument("--auto", default="--time 1s;--time 3s;--time 10s", help="options of each row, by semicolons")
    parser.add_argument("--mc", default="")
    parser.add_argument("--sppm", default="4,16,40", help="iterations of each row")
    parser.add_argument("--sppm-photons", default="262144")
    parser.add_argument("--sppm-radius", default="0.025")
    parser.add_argument("--povray", default="", help="a scene of benchmarks/povray/ that shows the same")
    parser.add_argument("--only", default="", help="rows whose name this regular expression finds")
    args = parser.parse_args()
    args.out.mkdir(parents=True, exist_ok=True)
    if args.make_reference:
        return make_reference(args, args.make_reference)
    file = args.out / "rounds.json"
    kept = json.loads(file.read_text()) if file.exists() else {}
    measure(args, kept)
    results = list(table(kept))
    (args.out / "table.json").write_text(json.dumps(results, indent=2) + "\n")
    (args.out / "table.md").write_text(markdown(results))
    print(markdown(results), end="")


if __name__ == "__main__":
    main()
