"""Measures the time of the kernels: both programs take turns, and Google Benchmark's compare.py tests by the U test (Mann
and Whitney 1947) whether they differ."""
import json
import statistics
import subprocess

from table import FAIL, NOT_COMPARABLE, OK, REPORTED, Row, percent

CHECK = "wall time"
# Needs the packages libbenchmark-tools and python3-scipy; the latter is for the distribution's own Python.
COMPARE = ["/usr/bin/python3", "/usr/share/benchmark/compare.py"]
SIGNIFICANT = 0.01  # p of the U test below which the sides differ


def run_benchmarks(program):
    run = subprocess.run([program, "--benchmark_format=json", "--benchmark_min_time=0.1"], check=True,
                         stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    return json.loads(run.stdout)


def joined(runs):
    """Joins runs of one repetition each to one result with many repetitions."""
    benchmarks = [{**entry, "repetitions": len(runs), "repetition_index": index}
                  for index, run in enumerate(runs) for entry in run["benchmarks"]]
    return {"context": runs[0]["context"], "benchmarks": benchmarks}


def take_turns(programs, rounds):
    """programs: by side. Each starts every second round, in case the first of a round has an advantage."""
    runs = {side: [] for side in programs}
    for index in range(rounds):
        for side in sorted(programs, reverse=index % 2 == 1):
            runs[side].append(run_benchmarks(programs[side]))
    return {side: joined(of_side) for side, of_side in runs.items()}


def compare(base_file, head_file, results):
    report = results / "wall-time.json"
    text = subprocess.run([*COMPARE, "--no-color", "-a", "-d", report, "benchmarks", base_file, head_file], check=True,
                          stdout=subprocess.PIPE, text=True).stdout
    (results / "wall-time.txt").write_text(text)
    return json.loads(report.read_text())


def judge(entry, limit):
    """entry: a benchmark of compare.py's report. limit: highest ratio of head to base."""
    base, head = (statistics.median(run[field] for run in entry["measurements"])
                  for field in ("real_time", "real_time_other"))
    p = entry["utest"].get("time_pvalue")
    differs = p is not None and p < SIGNIFICANT
    verdict = FAIL if differs and head > base * limit else REPORTED if differs else OK
    unit = entry["time_unit"]
    change = f"{percent(head / base)}, p = {p:.2g}" if p is not None else f"{percent(head / base)}, too few runs for p"
    return Row(CHECK, entry["name"], f"{base:.3f} {unit}", f"{head:.3f} {unit}",
               f"{change} (limit {percent(limit)})", verdict)


def check(base, head, results, rounds, limit):
    programs = {side.name: side.build("perf_kernels") for side in (base, head)}
    if not programs[base.name]:
        return [Row(CHECK, "all kernels", f"no build: {base.log('perf_kernels')}", "", "", NOT_COMPARABLE)]
    files = {}
    for side, result in take_turns(programs, rounds).items():
        files[side] = results / f"wall-time-{side}.json"
        files[side].write_text(json.dumps(result))
    report = compare(files[base.name], files[head.name], results)
    return [judge(entry, limit) for entry in report if entry["run_type"] == "iteration"]
