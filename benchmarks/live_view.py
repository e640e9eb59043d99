#!/usr/bin/env python3
"""What it costs a render to be followed: processor time, and elapsed time of the image phase, of `kaustik render` with `--view` and a reader that
fetches every change, as the page does, over those without, in alternating pairs. The bits must be the same.

    live_view.py [--program build/release/kaustik] [--trials 7] [--options "..."] SCENE...
"""

import argparse
import json
import pathlib
import re
import resource
import statistics
import subprocess
import tempfile
import threading
import urllib.request

kOptions = "--width 600 --spp 16 --photons 1M --denoise off"


def follow(address, fetched):
    """Reads the events, and the pixels that have changed, until the program ends."""
    version = 0
    try:
        with urllib.request.urlopen(address + "events", timeout=5) as events:
            for line in events:
                found = re.search(rb'"version":(\d+)', line)
                if not found or int(found[1]) == version:
                    continue
                with urllib.request.urlopen(f"{address}pixels?layer=&since={version}", timeout=5) as answer:
                    pixels = answer.read()
                version = int.from_bytes(pixels[:8], "little")
                fetched.append(len(pixels))
    except (OSError, ValueError):
        pass  # the program has ended


def render(program, scene, options, picture, followed):
    """Processor seconds, seconds of the image phase, and the bytes that the reader fetched."""
    before, statistics_file = resource.getrusage(resource.RUSAGE_CHILDREN), picture.with_suffix(".json")
    process = subprocess.Popen([program, "render", scene, *options, "-o", picture, "--stats", statistics_file,
                                *(["--view"] if followed else [])],
                               stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    fetched = []
    if followed:
        reader = threading.Thread(target=follow, args=(process.stdout.readline().strip(), fetched))
        reader.start()
        reader.join()
    if process.wait() != 0:
        raise SystemExit(f"{scene}: the render failed")
    elapsed, after = json.loads(statistics_file.read_text())["seconds"]["render"], resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, elapsed, sum(fetched)


def compare(arguments, scene, folder):
    pairs = []
    for _ in range(arguments.trials):
        alone = render(arguments.program, scene, arguments.options.split(), folder / "alone.exr", False)
        followed = render(arguments.program, scene, arguments.options.split(), folder / "followed.exr", True)
        if (folder / "alone.exr").read_bytes() != (folder / "followed.exr").read_bytes():
            raise SystemExit(f"{scene}: a render that is followed has other bits")
        pairs.append((followed[0] / alone[0], followed[1] / alone[1], alone[1], followed[2]))
    median = [statistics.median(column) for column in zip(*pairs)]
    print(f"| {pathlib.Path(scene).stem} | {median[2]:.2f} | {median[0]:.3f} | {median[1]:.3f} | {median[3] / 2**20:.0f} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default="build/release/kaustik")
    parser.add_argument("--trials", type=int, default=7)
    parser.add_argument("--options", default=kOptions)
    parser.add_argument("scenes", nargs="+", metavar="SCENE")
    arguments = parser.parse_args()
    print("| scene | s alone | processor time, followed / alone | image phase, followed / alone | MiB fetched |\n| --- | --- | --- | --- | --- |")
    with tempfile.TemporaryDirectory() as folder:
        for scene in arguments.scenes:
            compare(arguments, scene, pathlib.Path(folder))


if __name__ == "__main__":
    main()
