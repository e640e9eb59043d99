#!/usr/bin/env python3
"""Tests the gate itself: ten changes without effect must pass, and a slow-down of the gather by 2 % must fail.

    python3 benchmarks/perf/experiment.py [--only counters,instructions,time]

Judges a clone of HEAD in build/perf-gate/experiment by scripts/perf-gate; takes about half an hour on two cores. Prints a
table. Exit code: 0 if all verdicts are right, 1 if not. Needs only Python 3."""
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
CLONE = ROOT / "build" / "perf-gate" / "experiment"

UNUSED = """
// This function is never called.
uint64_t unused_{index}(uint64_t key) {{
  return key * 3 + {index};
}}
"""

TWICE = """
  // Every fiftieth query does its work twice.
  static thread_local uint64_t queries = 0;
  if (++queries % 50 == 0) {
    GatherCounters ignored;
    static_cast<void>(gather_flux(map, query, kernel, ignored));
  }
"""


def edit(name, change):
    path = CLONE / name
    before = path.read_text()
    after = change(before)
    assert after != before, f"{name}: nothing to change"
    path.write_text(after)


def change_nothing(_):
    pass


def add_unused_code(index):
    """Adds code that moves other code, and comments that move lines."""
    edit("photon/map/morton.cpp", lambda text: text.replace("namespace kaustik::photon {",
                                                        "namespace kaustik::photon {\n" + UNUSED.format(index=index), 1))
    edit("photon/map/octree.cpp", lambda text: f"// Comment {index}.\n" + text)


def gather_slower(_):
    edit("photon/gather/gather.cpp", lambda text: re.sub(r"(Rgb gather_flux\([^{]*\{)", r"\1" + TWICE, text, count=1))


CHANGES = [("none", change_nothing, 5, 0), ("unused code", add_unused_code, 5, 0),
           ("gather 2 % slower", gather_slower, 3, 1)]


def judge(change, index, arguments):
    subprocess.run(["git", "-C", CLONE, "checkout", "--quiet", "--force", "."], check=True)
    change(index)
    run = subprocess.run([CLONE / "scripts" / "perf-gate", "HEAD", *arguments], cwd=CLONE, stdout=subprocess.PIPE,
                         stderr=subprocess.DEVNULL, text=True)
    return run.returncode, run.stdout


def alarms(table):
    """Returns what failed, and by how much, in a table that the gate printed."""
    rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in table.splitlines() if line.startswith("| ")]
    return "; ".join(f"{row[0]} {row[1]} {row[4]}" for row in rows[1:] if row[-1] == "FAIL")


def main(arguments):
    if CLONE.exists():
        subprocess.run(["git", "-C", CLONE, "pull", "--quiet"], check=True)
    else:
        subprocess.run(["git", "clone", "--quiet", ROOT, CLONE], check=True)
    wrong = 0
    print("| change | run | exit code | alarms |\n| --- | --- | --- | --- |", flush=True)
    for name, change, runs, expected in CHANGES:
        for index in range(runs):
            code, table = judge(change, index, arguments)
            wrong += code != expected
            print(f"| {name} | {index + 1} | {code} | {alarms(table)} |", flush=True)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
