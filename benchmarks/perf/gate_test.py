"""Tests the verdicts of the gate on given counts and times. Builds and measures nothing."""
import json
import pathlib
import tempfile
import unittest

import counters
import gate
import history
import instructions
import wall_time
from sides import Side, git, snapshot
from table import FAIL, NOT_COMPARABLE, OK, REPORTED, Row, failed, markdown


class Counters(unittest.TestCase):
    def test_names_every_difference(self):
        stored = {"rays": {"camera": 1, "shadow": 2}, "dropped": 0}
        counted = {"rays": {"camera": 1, "shadow": 3}, "bytes": 8}
        self.assertEqual(counters.differences(stored, counted),
                         [("rays.shadow", 2, 3), ("dropped", 0, None), ("bytes", None, 8)])
        self.assertEqual(counters.differences(stored, stored), [])

    def test_judges_counts_that_differ_from_the_stored_ones(self):
        a, b, c, d = ({"n": n} for n in range(4))
        cases = [
            # base here, base stored, head here, head stored, same machine
            ("base matches the stored counts, head does not", a, a, b, a, True, FAIL),
            ("base matches the stored counts, head does not match its new baseline", a, a, b, c, True, FAIL),
            ("base cannot be counted", None, a, b, a, True, FAIL),
            ("another machine: base and head are equal", b, a, b, a, False, NOT_COMPARABLE),
            ("another machine: head differs from base", b, a, c, a, False, FAIL),
            ("another machine: head has a new baseline", b, a, c, d, False, NOT_COMPARABLE),
            ("a new run, on the machine of the baseline", None, None, a, b, True, FAIL),
            ("a new run, on another machine", None, None, a, b, False, NOT_COMPARABLE)]
        for name, *given, verdict in cases:
            with self.subTest(name):
                self.assertEqual(counters.judge_difference(*given), verdict)


class History(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.file = pathlib.Path(folder.name) / "history.jsonl"

    def test_lines_are_appended_and_drawn(self):
        row = Row("time", "shoot <b>", "10 ms", "11 ms", "+10.00 %", FAIL)
        same = Row("counters", "room", "", "all 40 as stored", "", OK)
        history.append(self.file, history.entry("a" * 40, "b" * 40, [row, same], FAIL))
        first = self.file.read_text()
        history.append(self.file, history.entry("b" * 40, "c" * 40, [Row("time", "shoot <b>", "11 ms", "9.9 ms", "-10.00 %", OK)], "passed"))
        self.assertTrue(self.file.read_text().startswith(first))
        entries = history.read(self.file)
        points = history.series_of(entries)[("time", "shoot <b>")]
        self.assertEqual([(e["head"][0], round(ratio, 6), verdict) for e, ratio, verdict in points], [("b", 1.1, FAIL), ("c", 0.9, OK)])
        page = history.page(entries)
        self.assertIn("0.990 to 1.100 times the first base", page)  # 1.1, then 1.1 * 0.9
        self.assertNotIn("<b>", page)
        self.assertEqual(gate.main(["--history", str(self.file), "--page", str(self.file.with_suffix(".html"))]), 0)
        self.assertEqual(self.file.with_suffix(".html").read_text(), page)

    def test_damaged_lines_are_named(self):
        self.file.write_text('{"date": "x", "base": "", "head": "", "verdict": "", "rows": []}\nno json\n')
        with self.assertRaisesRegex(ValueError, "history.jsonl:2: "):
            history.read(self.file)


class Instructions(unittest.TestCase):
    def test_fails_above_one_percent_only(self):
        self.assertEqual(instructions.judge("k", 1_000_000, 1_010_000).verdict, OK)
        self.assertEqual(instructions.judge("k", 1_000_000, 1_010_001).verdict, FAIL)
        self.assertEqual(instructions.judge("k", 1_000_000, 900_000).verdict, OK)

    def test_reads_the_total_of_a_profile(self):
        self.assertEqual(instructions.total_of("events: Ir\nfn=(1) f\n16 40\n\ntotals: 4200\n"), 4200)


class WallTime(unittest.TestCase):
    @staticmethod
    def entry(base, head, p):
        runs = [{"real_time": a, "real_time_other": b} for a, b in zip(base, head)]
        return {"name": "k", "time_unit": "ms", "measurements": runs, "utest": {"time_pvalue": p} if p else {}}

    def test_fails_above_the_limit_where_the_sides_differ(self):
        base, slow, slower = [10, 10, 99], [10.4, 10.4, 10.4], [11.2, 11.2, 11.2]
        for head, p, verdict in ((base, 0.9, OK), (slow, 1e-6, REPORTED), (slower, 1e-6, FAIL), (slower, 0.02, OK),
                                 (slower, None, OK)):
            with self.subTest(head=head, p=p):
                self.assertEqual(wall_time.judge(self.entry(base, head, p), 1.1).verdict, verdict)

    def test_joins_runs_as_repetitions(self):
        runs = [{"context": {}, "benchmarks": [{"name": "k", "real_time": t}]} for t in (1, 2)]
        self.assertEqual([(e["real_time"], e["repetition_index"], e["repetitions"])
                          for e in wall_time.joined(runs)["benchmarks"]], [(1, 0, 2), (2, 1, 2)])


class Table(unittest.TestCase):
    def test_aligns_columns_and_fails_with_any_row(self):
        rows = [Row("a", "b", "1", "2", "", OK), Row("a", "long|er", "1", "2", "", FAIL)]
        lines = markdown(rows).splitlines()
        self.assertEqual(len(lines), 4)
        self.assertEqual(len({len(line) for line in lines}), 1)
        self.assertTrue(failed(rows))
        self.assertFalse(failed(rows[:1]))


class Repository(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        git(self.root, "init", "--quiet")
        self.write(".gitignore", "/build/\n")
        self.first = self.commit("First")

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    def commit(self, message):
        git(self.root, "add", "--all")
        git(self.root, "-c", "user.name=n", "-c", "user.email=e@localhost", "commit", "--quiet", "-m", message)
        return git(self.root, "rev-parse", "HEAD")

    def write_baseline(self, count):
        self.write(counters.BASELINE, json.dumps({"runs": [{"command": "c", "counters": {"n": count}}]}))

    def test_first_baseline_needs_no_reason(self):
        self.write_baseline(1)
        self.commit("Baseline")
        self.assertEqual(counters.unexplained_commits(self.root, self.first), [])

    def test_each_change_of_the_baseline_needs_a_reason(self):
        self.write_baseline(1)
        base = self.commit("Baseline")
        self.write_baseline(2)
        self.commit("Better sampling\n\nCounters: fewer photons leave the scene")
        self.assertEqual(counters.unexplained_commits(self.root, base), [])
        self.write_baseline(3)
        unexplained = self.commit("More\n\nCounters:\n")
        self.write("other", "")
        self.commit("Other")
        self.assertEqual(counters.unexplained_commits(self.root, base), [unexplained])

    def test_snapshot_includes_local_changes_and_keeps_them(self):
        self.assertEqual(snapshot(self.root), self.first)
        self.write("new", "1")
        self.write("build/ignored", "1")
        before = git(self.root, "status", "--porcelain")
        commit = snapshot(self.root)
        self.assertEqual(git(self.root, "ls-tree", "-r", "--name-only", commit).split(), [".gitignore", "new"])
        self.assertEqual(git(self.root, "status", "--porcelain"), before)
        self.assertEqual(git(self.root, "rev-parse", "HEAD"), self.first)

    def test_base_takes_the_driver_of_head(self):
        self.write("photon/a", "old")
        self.write("benchmarks/old", "old")
        base_commit = self.commit("Base")
        self.write("photon/a", "new")
        self.write("benchmarks/perf/driver", "new")
        (self.root / "benchmarks/old").unlink()
        head_commit = self.commit("Head")
        base = Side(self.root, "base")
        for _ in range(2):  # the second time the folder exists
            base.check_out(base_commit)
            base.take_driver(head_commit)
            self.assertEqual((base.folder / "photon/a").read_text(), "old")
            self.assertEqual((base.folder / "benchmarks/perf/driver").read_text(), "new")
            self.assertFalse((base.folder / "benchmarks/old").exists())


if __name__ == "__main__":
    unittest.main()
