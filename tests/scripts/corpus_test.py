#!/usr/bin/env python3
"""Tests scripts/corpus: corpus_test.py PROGRAM FOLDER, with a folder to write to."""
import json
import pathlib
import shutil
import subprocess
import sys

kRoot = pathlib.Path(__file__).resolve().parent.parent.parent
kPlane = """LookAt 0 2 5  0 0 0  0 1 0
Camera "perspective"
WorldBegin
LightSource "point" "rgb I" [ 9 9 9 ]
Include "part.pbrt"
"""


def main():
    program, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    shutil.rmtree(folder, ignore_errors=True)
    (folder / "scenes" / "below").mkdir(parents=True)
    (folder / "scenes" / "good.pbrt").write_text(kPlane)
    (folder / "scenes" / "part.pbrt").write_text('Shape "disk"\n')
    (folder / "scenes" / "below" / "bad.pbrt").write_text('WorldBegin\nShape "dsik"\n')
    (folder / "scenes" / "below" / "a & b.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    done = subprocess.run([kRoot / "scripts" / "corpus", folder / "scenes", "--into", folder / "page", "--program", program,
                           "--", "--width", "16", "--spp", "1", "--photons", "100"], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    results = {r["scene"]: r for r in json.loads((folder / "page" / "results.json").read_text())}
    assert sorted(results) == ["below/a & b.obj", "below/bad.pbrt", "good.pbrt"], results
    for name, code in [("good.pbrt", 0), ("below/a & b.obj", 0), ("below/bad.pbrt", 3)]:
        assert results[name]["exit_code"] == code, results[name]
        assert (results[name]["picture"] is not None) == (code == 0), results[name]
        assert results[name]["peak_bytes"] > 1e6, results[name]
    assert "did you mean" in results["below/bad.pbrt"]["messages"], results
    page = (folder / "page" / "index.html").read_text()
    assert "a &amp; b.obj" in page and "refused: exit code 3" in page, page


main()
