"""Runs renderers and `kaustik compare`, and measures them."""
import functools
import json
import os
import pathlib
import resource
import subprocess
import time

CLASSES = ("emitted", "direct", "caustic", "indirect")


class Failed(Exception):
    """A program ended with an error; the text is its command and its last messages."""


def run(command):
    """Runs a command; returns its output, its wall seconds and its processor seconds."""
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, errors="replace")
    seconds, after = time.perf_counter() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode != 0:
        raise Failed(f"{' '.join(map(str, command))}: {done.stderr[-1000:].strip()}")
    return done.stdout, seconds, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def size_options(args):
    return ["--width", args.width] if args.width else []


@functools.cache
def undenoised(program):
    """The options by which a program does not denoise: none for builds from before it could."""
    return ["--denoise", "off"] if "--denoise" in run([program, "render", "--help"])[0] else []


def render(args, scene, image, options, program=None):
    """Renders with kaustik into an EXR file; returns seconds, processor seconds and the program's own statistics. Estimators are
    compared, so nothing is denoised unless the options say so."""
    stats = pathlib.Path(image).with_suffix(".json")
    threads = ["--threads", args.threads] if args.threads else []
    _, seconds, cpu = run([program or args.program, "render", scene, "-o", image, "--stats", stats, "--quiet", *threads,
                           *size_options(args), *undenoised(program or args.program), *args.options.split(), *options])
    found = json.loads(stats.read_text())
    os.remove(stats)
    rendered = sum(found["seconds"][phase] for phase in ("photon_trace", "photon_build", "render"))
    return {"seconds": seconds, "cpu": cpu, "render_seconds": rendered, "stats": found}


def compare(args, reference, image, *options):
    return json.loads(run([args.program, "compare", reference, image, "--json", *options])[0])


def errors(args, reference, image, layers=True):
    """The errors of an image, and the mean of each class in units of the reference's; None where that has none."""
    mask = ["--mask-bright", args.mask_bright] if args.mask_bright > 0 else []
    found = compare(args, reference, image, "--flip", *mask)
    out = {key: found[key] for key in ("relmse", "rmse", "relmse_of_blocks", "mean_ratio")}
    out["flip"] = found["flip"]["mean"]
    out["fireflies"] = found["fireflies"]["count"]
    out["masked"] = found["pixels"]["masked"] / max(1, found["pixels"]["masked"] + found["pixels"]["compared"])
    if layers:
        out["classes"] = {name: compare(args, reference, image, "--layer", name)["mean_ratio"] for name in CLASSES}
    return out
