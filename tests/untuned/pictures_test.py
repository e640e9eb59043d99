#!/usr/bin/env python3
"""Holds small pictures of scenes/untuned, rendered with the default settings, to the limits of limits.json:
pictures_test.py PROGRAM FOLDER, with a folder to write to.

References and limits stand beside this file. A limit is the mean of the error over several seeds and four of its standard deviations
(benchmarks/eye/limits.py): of a Gaussian error, seven seeds in ten thousand are beyond it (Student's t with 15 degrees of freedom).
The seed of this test is fixed, so it does not fail now and then. After a change of the defaults that is meant,
`benchmarks/untuned.py PROGRAM --set-limits` measures anew."""
import pathlib
import shutil
import sys
import unittest

sys.dont_write_bytecode = True
kRoot = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(kRoot / "benchmarks"))
from eye import limits  # noqa: E402

program, folder = None, None


class Pictures(unittest.TestCase):
    def test_every_scene_has_limits_above_what_its_reference_lacks(self):
        known = limits.known()
        self.assertEqual(set(known), set(limits.NAMES))
        for name, found in known.items():
            self.assertEqual(set(found["limits"]), set(limits.MEASURES), name)
            for measure, floor in found["floor"].items():
                self.assertLess(4 * floor, found["limits"][measure], f"{name}: the reference is too noisy for {measure}")

    def test_errors_are_within_their_limits(self):
        for name in limits.NAMES:
            image = folder / f"{name}.exr"
            found, most = limits.measure(program, name, image, limits.SEED), limits.known()[name]["limits"]
            for measure in limits.MEASURES:
                with self.subTest(scene=name, measure=measure):
                    self.assertLessEqual(abs(found[measure]), most[measure],
                                         f"{name}: {measure} is beyond its limit. The picture is {image}, and .png; its reference is "
                                         f"{limits.reference_of(name)}")


if __name__ == "__main__":
    program, folder = sys.argv[1], pathlib.Path(sys.argv[2]).resolve()
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    unittest.main(argv=sys.argv[:1], verbosity=1)
