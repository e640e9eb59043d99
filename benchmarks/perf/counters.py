"""Compares exact counts of whole renders with counters.json.

The renders run on valgrind's processor, which has AVX2 and nothing newer: counts depend on how Embree and the SIMD
loops round, so they belong to an instruction set."""
import json
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

from sides import git
from table import FAIL, NOT_COMPARABLE, OK, Row

CHECK = "counters"
BASELINE = "benchmarks/perf/counters.json"
EXPLANATION = re.compile(r"^Counters: \S", re.MULTILINE)
MACHINE = ("isa", "cpu", "compiler", "libraries")  # what counts may depend on


def flat(counters, prefix=""):
    """Flattens {"rays": {"camera": 1}} to {"rays.camera": 1}."""
    out = {}
    for name, value in counters.items():
        if isinstance(value, dict):
            out.update(flat(value, f"{prefix}{name}."))
        else:
            out[prefix + name] = value
    return out


def differences(stored, counted):
    """Returns rows of (name, stored, counted), with None where one of them has no such count."""
    a, b = flat(stored), flat(counted)
    return [(name, a.get(name), b.get(name)) for name in dict.fromkeys([*a, *b]) if a.get(name) != b.get(name)]


def run(side, command):
    """Returns the result of `command`, `kaustik bench ...`, on one side; None when it fails."""
    program = side.build("kaustik")
    if not program:
        return None
    with tempfile.TemporaryDirectory() as folder:
        output = pathlib.Path(folder) / "result.json"
        arguments = [*shlex.split(command)[1:], "--json", output, "--quiet"]
        done = subprocess.run(["valgrind", "--tool=none", "--quiet", program, *arguments], cwd=side.folder,
                              stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        if done.returncode == 0:
            return json.loads(output.read_text())
    print(f"perf-gate: {side.name}: {command}: {done.stderr}", file=sys.stderr)
    return None


def counters_of(result):
    return result and result["points"][0]["counters"]


def machine_of(result):
    return {name: result["machine"][name] for name in MACHINE}


def runs_by_name(text):
    return {entry["name"]: entry for entry in json.loads(text)["runs"]}


def file_at(root, commit):
    """Returns the text of the baseline, None if the commit has none."""
    if not git(root, "ls-tree", "--name-only", commit, BASELINE):
        return None
    return git(root, "show", f"{commit}:{BASELINE}")


def unexplained_commits(root, base):
    """Returns the commits since base that change the baseline without a reason. The first baseline needs no reason."""
    if file_at(root, base) is None:
        return []
    commits = git(root, "log", "--format=%H", f"{base}..HEAD", "--", BASELINE).split()
    return [commit for commit in commits if not EXPLANATION.search(git(root, "log", "-1", "--format=%B", commit))]


def judge_difference(base_here, base_stored, head_here, head_stored, same_machine):
    """Judges counts of one run that differ from the stored ones. *_here: counted on this machine, None when that failed;
    base_stored: None when the run is new; same_machine: the baseline was made on the same kind of machine."""
    if base_stored is None:
        return FAIL if same_machine else NOT_COMPARABLE
    machine_differs = base_here is not None and base_here != base_stored
    if machine_differs and (head_here == base_here or head_stored != base_stored):
        return NOT_COMPARABLE
    return FAIL


def explanation_rows(root, base, head):
    rows = []
    for commit in unexplained_commits(root, base.commit):
        title = git(root, "log", "-1", "--format=%h %s", commit)
        rows.append(Row(CHECK, "baseline changed", "", title, "no line `Counters: reason` in the message", FAIL))
    if file_at(root, "HEAD") not in (None, file_at(root, head.commit)):
        rows.append(Row(CHECK, "baseline changed", "", "not committed", "needs a line `Counters: reason`", OK))
    return rows


def rows_of(stored, machine, base_stored, base, head):
    """stored, base_stored: entry of the head's and of the base's baseline; the latter is None when the run is new."""
    result = run(head, stored["command"])
    if result is None:
        return [Row(CHECK, stored["name"], "", "no result", "", FAIL)]
    counted = counters_of(result)
    different = differences(stored["counters"], counted)
    if not different:
        return [Row(CHECK, stored["name"], "", f"all {len(flat(counted))} as stored", "", OK)]
    base_here = base_stored and counters_of(run(base, base_stored["command"]))
    verdict = judge_difference(base_here, base_stored and base_stored["counters"], counted, stored["counters"],
                               machine_of(result) == machine)
    note = "the baseline is of another kind of machine" if verdict == NOT_COMPARABLE else ""
    return [Row(CHECK, f"{stored['name']}: {count}", f"stored {before}", str(after), note, verdict)
            for count, before, after in different]


def check(root, base, head):
    base_text, head_text = file_at(root, base.commit), file_at(root, head.commit)
    base_runs = runs_by_name(base_text) if base_text else {}
    machine = json.loads(head_text)["machine"]
    rows = explanation_rows(root, base, head)
    for name, stored in runs_by_name(head_text).items():
        rows += rows_of(stored, machine, base_runs.get(name), base, head)
    return rows


def update(root, head):
    """Writes the counts of head into the baseline of the working tree."""
    path = root / BASELINE
    runs = []
    for entry in json.loads(path.read_text())["runs"]:
        result = run(head, entry["command"])
        if result is None:
            return False
        runs.append({**entry, "counters": counters_of(result)})
        machine = machine_of(result)
    path.write_text(json.dumps({"machine": machine, "runs": runs}, indent=2) + "\n")
    return True
