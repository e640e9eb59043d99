#!/usr/bin/env python3
"""Compares direct light by the lecture's photon estimator with shadow rays alone, for several N and r0.

accuracy_table.py KAUSTIK SCENE OUT_DIR [--photons 1M,3M,10M] [--radii 0.1,0.2,0.4,0.8] [--spp 4] [--reference-spp 1024]

Renders direct light only (caustics and indirect off): a reference by pure Monte Carlo, then the lecture's estimator for
each N and r0, then pure Monte Carlo with 1, 4, 16 and 64 samples. Writes OUT_DIR/table.md, OUT_DIR/table.json and the
pictures. Times are wall seconds of photons, build and render together, from the program's own statistics. Every
configuration runs once, one after the other, so compare ratios, not seconds. Needs only Python 3."""
import argparse
import json
import pathlib
import subprocess

DIRECT_ONLY = ["--caustics", "off", "--indirect", "off", "--quiet"]
TONE = ["--exposure", "0", "--tonemap", "srgb"]  # the same for all pictures, so that they can be compared by eye
REFERENCE_SEED = "77"  # not the seed of the measured runs: errors must not correlate


def render(args, name, options):
    image, stats = args.out / (name + ".exr"), args.out / (name + ".json")
    outputs = ["-o", str(image), "-o", str(image.with_suffix(".png")), "--stats", str(stats)]
    command = [args.kaustik, "render", args.scene, *outputs, *DIRECT_ONLY, *TONE, "--denoise", "off", *options]
    subprocess.run(command, check=True)
    return image, json.loads(stats.read_text())


def relmse(args, reference, image):
    command = [args.kaustik, "compare", str(reference), str(image), "--mask-bright", "4", "--json"]
    return json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)["relmse"]


def seconds(stats):
    return sum(stats["seconds"][phase] for phase in ("photon_trace", "photon_build", "render"))


def fallback_share(stats):
    lecture = stats["fallbacks"]
    fallbacks = lecture["fallback_few"] + lecture["fallback_shadow"] + lecture["fallback_face"]
    return fallbacks / max(1, fallbacks + lecture["from_photons"])


def lecture_rows(args, reference):
    for photons in args.photons.split(","):
        for radius in args.radii.split(","):
            options = ["--method", "hybrid", "--photons", photons, "--radius", radius, "--spp", args.spp]
            image, stats = render(args, f"lecture-{photons}-{radius}", options)
            yield {"estimator": "lecture", "photons": photons, "radius": radius, "spp": args.spp,
                   "relmse": relmse(args, reference, image), "seconds": seconds(stats),
                   "fallback": fallback_share(stats)}


def monte_carlo_rows(args, reference):
    for spp in ("1", "4", "16", "64"):
        image, stats = render(args, f"mc-{spp}", ["--method", "mc", "--spp", spp])
        yield {"estimator": "pure Monte Carlo", "photons": "-", "radius": "-", "spp": spp,
               "relmse": relmse(args, reference, image), "seconds": seconds(stats), "fallback": None}


def markdown(rows):
    lines = ["| estimator | N | r0 (m) | samples | relMSE of direct light | seconds | fallback to shadow rays |",
             "| --- | --- | --- | --- | --- | --- | --- |"]
    for row in rows:
        share = "-" if row["fallback"] is None else f"{100 * row['fallback']:.1f} %"
        lines.append(f"| {row['estimator']} | {row['photons']} | {row['radius']} | {row['spp']} "
                     f"| {row['relmse']:.5f} | {row['seconds']:.2f} | {share} |")
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("kaustik")
    parser.add_argument("scene")
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--photons", default="1M,3M,10M")
    parser.add_argument("--radii", default="0.1,0.2,0.4,0.8")
    parser.add_argument("--spp", default="4")
    parser.add_argument("--reference-spp", default="1024")
    args = parser.parse_args()
    args.out.mkdir(parents=True, exist_ok=True)
    reference, _ = render(args, "reference", ["--method", "mc", "--spp", args.reference_spp, "--seed", REFERENCE_SEED])
    rows = [*lecture_rows(args, reference), *monte_carlo_rows(args, reference)]
    (args.out / "table.json").write_text(json.dumps(rows, indent=2) + "\n")
    (args.out / "table.md").write_text(markdown(rows))
    print(markdown(rows), end="")


if __name__ == "__main__":
    main()
