#!/usr/bin/env python3
"""Checks whether performance got worse between two revisions, by exact counts, instructions and time: see
docs/guide/benchmarks.md.

scripts/perf-gate BASE_REV [--only counters,instructions,time] [--rounds 15] [--time-limit 10] [--history FILE]
scripts/perf-gate --history FILE --page PAGE.html
scripts/perf-gate --update-baseline

The head is the working tree, including local changes. Prints a table and writes it to build/perf-gate/results/table.md.
Exit code: 0 if nothing got worse, 1 if something did, 2 if a measurement failed. Needs only Python 3."""
import argparse
import pathlib
import subprocess
import sys

import counters
import history
import instructions
import wall_time
from sides import BASE, HEAD, Side, git, snapshot
from table import FAIL, failed, markdown

ROOT = pathlib.Path(__file__).resolve().parents[2]
CHECKS = ("counters", "instructions", "time")


class CannotTell(Exception):
    pass


def parse_arguments(arguments):
    parser = argparse.ArgumentParser(prog="perf-gate", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("base", nargs="?", metavar="BASE_REV", help="revision to compare with")
    parser.add_argument("--only", default=",".join(CHECKS), help="the checks to run, separated by commas")
    parser.add_argument("--rounds", type=int, default=15, help="runs of each side for the time (default: 15)")
    parser.add_argument("--time-limit", type=float, default=10, metavar="PERCENT",
                        help="slow-down that fails if the U test confirms it (default: 10)")
    parser.add_argument("--update-baseline", action="store_true", help=f"count again and write {counters.BASELINE}")
    parser.add_argument("--history", type=pathlib.Path, metavar="FILE", help="append what was found to this file, a line for each run")
    parser.add_argument("--page", type=pathlib.Path, metavar="FILE", help="draw the history as this HTML page")
    options = parser.parse_args(arguments)
    options.only = options.only.split(",")
    if options.page and not options.history:
        parser.error("--page draws the file of --history")
    if bool(options.base) + options.update_baseline + bool(options.page and not options.base) != 1:
        parser.error("give a revision to compare with, --update-baseline, or --history and --page")
    if not set(options.only) <= set(CHECKS):
        parser.error(f"--only takes {', '.join(CHECKS)}")
    return options


def require(side, target):
    if not side.build(target):
        raise CannotTell(f"{target} of {side.name} does not build: {side.log(target)}")


def make_sides(options, head_commit):
    head, base = Side(ROOT, HEAD), Side(ROOT, BASE)
    head.check_out(head_commit)
    if options.base:
        base.check_out(git(ROOT, "rev-parse", "--verify", f"{options.base}^{{commit}}"))
        base.take_driver(head_commit)
    return base, head


def make_checks(options, base, head, results):
    rows = []
    if "counters" in options.only:
        require(head, "kaustik")
        rows += counters.check(ROOT, base, head)
    if "instructions" in options.only:
        require(head, "perf_kernels")
        rows += instructions.check(base, head, results)
    if "time" in options.only:
        require(head, "perf_kernels")
        rows += wall_time.check(base, head, results, options.rounds, 1 + options.time_limit / 100)
    return rows


def compare(options, base, head, results):
    rows = make_checks(options, base, head, results)
    verdict = FAIL if failed(rows) else "passed"
    text = f"perf-gate {base.commit[:10]} .. {head.commit[:10]}: {verdict}\n\n{markdown(rows)}\n"
    (results / "table.md").write_text(text)
    print(text)
    if options.history:
        history.append(options.history, history.entry(base.commit, head.commit, rows, verdict))
    return 1 if failed(rows) else 0


def main(arguments):
    options = parse_arguments(arguments)
    results = ROOT / "build" / "perf-gate" / "results"
    results.mkdir(parents=True, exist_ok=True)
    try:
        code = 0
        if options.base or options.update_baseline:
            base, head = make_sides(options, snapshot(ROOT))
        if options.base:
            code = compare(options, base, head, results)
        if options.page:
            options.page.write_text(history.page(history.read(options.history)), encoding="utf-8")
        if not options.update_baseline:
            return code
        require(head, "kaustik")
        if not counters.update(ROOT, head):
            raise CannotTell("a render of the baseline failed")
        print(f"perf-gate: wrote {counters.BASELINE}; say why in its commit: `Counters: reason`")
        return 0
    except (CannotTell, subprocess.CalledProcessError, OSError, ValueError) as error:
        print(f"perf-gate: {error}", file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
