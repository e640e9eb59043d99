"""Runs kaustik for benchmarks that score pictures."""
import json
import subprocess
import time

from real.runs import Failed, run


def render(program, scene, image, options):
    """Renders an EXR file and returns the wall seconds. Messages go to the file of the image's name with .log. Throws `Failed`."""
    log = image.with_suffix(".log")
    command = [str(word) for word in (program, "render", scene, "-o", image, *options)]
    start = time.perf_counter()
    with open(log, "w") as messages:
        done = subprocess.run(command, stdout=messages, stderr=subprocess.STDOUT)
    seconds = time.perf_counter() - start
    if done.returncode != 0:
        raise Failed(f"{' '.join(command)}: exit code {done.returncode}, see {log}")
    return seconds


def flip(program, reference, image):
    return json.loads(run([program, "compare", "--flip", "--json", reference, image])[0])["flip"]["mean"]
