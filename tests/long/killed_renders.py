"""Renders that are killed at random moments and resumed, for kill_test.py and scripts/soak."""
import pathlib
import re
import subprocess
import time

kRoot = pathlib.Path(__file__).resolve().parents[2]
kScene = kRoot / "scenes/cornell-spheres/square-lamp-2.pbrt"
# Many short passes, with a checkpoint after each, so that kills hit every phase and the writing of files, too.
kOptions = ["--width", "120", "--spp", "16", "--photons", "320k", "--passes", "16", "--alpha", "0.8", "--aov", "all", "-q"]
kEach = ["--checkpoint-every", "0.01s"]
# A file that is not complete yet (core/files/pending_file.h) or the lock of a checkpoint or of a sweep (core/files/file_lock.h).
# Those of killed processes do not stay: files have no name before they are complete, and who writes a checkpoint next removes
# what there is of it.
kTemporary = re.compile(r"\..*\.partial|\.(.*\.)?lock")


class Failure(Exception):
    pass


def render_whole(program, picture, options=kOptions):
    """Renders without a checkpoint; returns the seconds it took."""
    begun = time.monotonic()
    subprocess.run([program, "render", kScene, *options, "-o", picture], check=True, timeout=600)
    return time.monotonic() - begun


def render_with_kills(program, folder, random, longest, options=kOptions):
    """Renders folder/killed.exr with a checkpoint, kills the process after up to `longest` seconds (later more, so
    that it ends on a busy machine), resumes, and so on until one lives long enough. Returns the number of kills."""
    checkpoint, picture, kills = folder / "killed.kpart", folder / "killed.exr", 0
    for file in (checkpoint, picture):
        file.unlink(missing_ok=True)
    while True:
        command = [program, "resume", checkpoint, *kEach, "-q"] if checkpoint.exists() else [
            program, "render", kScene, *options, *kEach, "--checkpoint", checkpoint, "-o", picture]
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        try:
            _, messages = process.communicate(timeout=random.uniform(0, longest * (1 + kills / 10)))
        except subprocess.TimeoutExpired:
            process.kill()
            process.communicate()
            kills += 1
            continue
        if process.returncode != 0:
            raise Failure(f"{' '.join(map(str, command[:3]))} ended with {process.returncode} after {kills} kills:\n{messages}")
        return kills


def left_temporaries(folder):
    """Temporary files and locks below the folder, in which no process works."""
    return [file for file in folder.rglob(".*") if kTemporary.fullmatch(file.name)]
