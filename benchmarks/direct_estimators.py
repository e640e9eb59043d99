#!/usr/bin/env python3
"""Compares the estimators of direct light: error, shadow rays and time, for several N and r0.

direct_estimators.py KAUSTIK SCENE OUT_DIR [--photons 1M,4M] [--radii auto,0.1,0.4] [--spp 16] [--rounds 5] [--reference-spp 512]

Renders direct light only (--method raytrace): a reference by shadow rays, then in each round shadow-rays, predicted,
photons, lecture and signed in turn. Writes OUT_DIR/table.md and the pictures. relMSE is the mean over the rounds, each
with a seed of its own, of `kaustik compare --mask-bright 4`; seconds are the median over the rounds of the CPU time of the
whole program on one thread. Needs only Python 3."""
import argparse
import json
import os
import pathlib
import statistics
import subprocess

REFERENCE_SEED = "77"  # not a seed of the measured runs: errors must not correlate


def render(args, name, options):
    image, stats = args.out / (name + ".exr"), args.out / (name + ".json")
    command = [args.kaustik, "render", args.scene, "-o", str(image), "--stats", str(stats), "--quiet",
               "--method", "raytrace", "--denoise", "off", *options]
    child = subprocess.Popen(command)
    _, status, usage = os.wait4(child.pid, 0)
    if status != 0:
        raise SystemExit(f"{command} failed")
    return image, json.loads(stats.read_text()), usage.ru_utime + usage.ru_stime


def relmse(args, reference, image):
    command = [args.kaustik, "compare", str(reference), str(image), "--mask-bright", "4", "--json"]
    return json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)["relmse"]


def configurations(args):
    yield {"direct": "shadow-rays"}
    yield {"direct": "predicted"}  # chooses its photons by the number of samples
    for direct in ("photons", "lecture", "signed"):
        for photons in args.photons.split(","):
            for radius in args.radii.split(","):
                yield {"direct": direct, "photons": photons, "radius": radius}


def measure(args, reference, rows):
    for seed in range(args.rounds):
        for row in rows:
            options = [text for key in ("direct", "photons", "radius") if key in row for text in (f"--{key}", row[key])]
            name = "-".join(row[key] for key in ("direct", "photons", "radius") if key in row)
            image, stats, seconds = render(args, name, [*options, "--spp", args.spp, "--seed", str(seed), "--threads", "1"])
            row.setdefault("relmse", []).append(relmse(args, reference, image))
            row.setdefault("seconds", []).append(seconds)
            row.setdefault("rays", []).append(stats["rays"]["shadow"])


def markdown(rows):
    lines = ["| direct | N | r0 (m) | relMSE | shadow rays | CPU seconds |", "| --- | --- | --- | --- | --- | --- |"]
    most = statistics.mean(rows[0]["rays"])
    for row in rows:
        lines.append(f"| {row['direct']} | {row.get('photons', '-')} | {row.get('radius', '-')} "
                     f"| {statistics.mean(row['relmse']):.5f} | {100 * statistics.mean(row['rays']) / most:.1f} % "
                     f"| {statistics.median(row['seconds']):.2f} |")
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("kaustik")
    parser.add_argument("scene")
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--photons", default="1M,4M")
    parser.add_argument("--radii", default="auto,0.1,0.4")
    parser.add_argument("--spp", default="16")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--reference-spp", default="512")
    args = parser.parse_args()
    args.out.mkdir(parents=True, exist_ok=True)
    reference = args.out / "reference.exr"
    if not reference.exists():
        render(args, "reference", ["--spp", args.reference_spp, "--seed", REFERENCE_SEED])
    rows = list(configurations(args))
    measure(args, reference, rows)
    (args.out / "table.md").write_text(markdown(rows))
    print(markdown(rows), end="")


if __name__ == "__main__":
    main()
