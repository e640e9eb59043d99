#!/usr/bin/env python3
"""Runs every command of the README, the tutorial and the guides, at small size, so that the pages stay true.

  run_pages.py PROGRAM FOLDER   PROGRAM: the kaustik under test; FOLDER: emptied, and the commands' working directory

Commands are the lines of blocks marked `sh`. Each must end with exit code 0 and write the files that it names; each picture
that the tutorial shows must be one that a command of its writes.
"""
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import unittest

kRoot = pathlib.Path(__file__).resolve().parents[2]
kTutorial = kRoot / "docs" / "tutorial.md"
kPages = [kRoot / "README.md", kTutorial, *sorted((kRoot / "docs" / "guide").glob("*.md"))]
# These replace what a command says.
kSmall = {
    "render": ["--width", "40", "--photons", "4k", "--spp", "2"],
    "split": ["--width", "40", "--photons", "4k", "--spp", "2"],
    "photons": ["--width", "40", "--photons", "500"],
    "bench": ["--width", "24", "--photons", "1k", "--spp", "1", "--threads", "1", "--repeat", "1"],
    "sweep": ["--width", "16", "--photons", "500", "--spp", "1", "--radius", "auto", "--seeds", "2", "--reference-time",
              "200ms"],
}
kOutputs = {"-o", "--image", "--heatmap", "--json", "--checkpoint", "--stats", "--plot"}
program, folder = None, None


def commands_of(page):
    """Lines of the page's sh blocks; a backslash at the end joins two."""
    for block in re.findall(r"^```sh\n(.*?)^```", page.read_text(), re.M | re.S):
        for line in block.replace("\\\n", " ").splitlines():
            line = line.split(" #")[0].strip()
            if line and not line.startswith("#"):
                yield line


def made_small(words):
    command = words[1]
    small = list(kSmall.get(command, []))
    if "--crop" in words:  # whose pixels are those of the picture's own size
        small = small[2:]
    if "--time" in words:  # which chooses photons and samples where they are not given
        small = ["--width", "40", "--time", "300ms"]
    if "--target-error" in words:
        small += ["--target-error", "50%"]
    if command == "bench" and "--from" in words:
        small = []
    for option in small[::2]:
        while option in words:
            at = words.index(option)
            words = words[:at] + words[at + 2:]
    return words + small


def outputs(words):
    for option, value in zip(words, words[1:]):
        if option in kOutputs and not (option == "--json" and value.startswith("-")):
            yield value
    if words[1] == "convert":
        yield words[3]


class Pages(unittest.TestCase):
    def run_command(self, line):
        words = shlex.split(line)
        if words[0] == "mkdir" or words[0].startswith("./scripts/"):
            return
        if words[0].endswith("/submit.sh") or words[0] == "ffmpeg":  # scripts/check-slurm submits to a Slurm
            return
        if words[0].startswith("out/"):  # a script that a command before has written
            return self.run_script(words)
        self.assertEqual(words[0], "kaustik", f"not a command of ours: {line}")
        names = list(outputs(words))
        # A resumed render replaces its files, so what a command before it wrote does not count.
        for name in names:
            if (folder / name).is_file():
                (folder / name).unlink()
        done = subprocess.run([program, *made_small(words)[1:]], cwd=folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, f"{line}\n{done.stdout}{done.stderr}")
        for name in names:
            file = folder / re.sub("%0?([0-9]?)d", lambda digits: "0" * int(digits[1] or 1), name)
            self.assertTrue(file.is_dir() or file.is_file() and file.stat().st_size > 0, f"{line}: no {name}")

    def run_script(self, words):
        done = subprocess.run(words, cwd=folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, f"{words}\n{done.stdout}{done.stderr}")

    def test_every_command_works(self):
        for page in kPages:
            lines = list(commands_of(page))
            self.assertTrue(lines, f"{page} has no commands")
            for line in lines:
                with self.subTest(page=page.name, command=line):
                    self.run_command(line)

    def test_the_tutorial_has_twelve_commands_and_their_pictures(self):
        lines = [line for line in commands_of(kTutorial) if line.startswith("kaustik ")]
        self.assertEqual(len(lines), 12)
        text = kTutorial.read_text()
        self.assertEqual(re.findall(r"^### (\d+)\. ", text, re.M), [str(i) for i in range(1, 13)])
        made = {pathlib.PurePosixPath(name).stem for line in lines for name in outputs(shlex.split(line))}
        shown = re.findall(r"\]\(images/tutorial/([\w-]+)\.jpg\)", text)
        self.assertTrue(shown)
        self.assertEqual([name for name in shown if name not in made], [])


if __name__ == "__main__":
    program, folder = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
    shutil.rmtree(folder, ignore_errors=True)
    (folder / "out").mkdir(parents=True)
    os.symlink(kRoot / "scenes", folder / "scenes")
    unittest.main(argv=sys.argv[:1], verbosity=1)
