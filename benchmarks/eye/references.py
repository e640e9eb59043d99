"""References of the scenes in scenes/untuned: how each is rendered, and the two halves that each has."""
import array
import dataclasses
import json
import pathlib

from eye import renders
from eye.score import SIDES, score
from real import exr
from real.runs import Failed

SCENES = pathlib.Path(__file__).resolve().parents[2] / "scenes" / "untuned"
FULL_PHOTONS, FULL_SECONDS = 100_000_000, 200  # of a half at an effort of 1
PHOTONS_OF_A_PASS, SAMPLES_OF_A_PASS = 1_000_000, 4
SEEDS = (1001, 1002)  # of the halves, not those of any picture: errors must not correlate


def by_photons(effort, radius=None):
    """Photons carry all caustics and indirect light. Many passes have a radius that shrinks, so that noise and blur vanish together,
    or a small one [m] that stays, where a caustic is finer than the chosen radius."""
    photons = max(1, round(FULL_PHOTONS * effort))
    passes = max(1, round(photons / PHOTONS_OF_A_PASS))
    options = ["--indirect", "photons", "--caustics", "photons", "--photons", photons, "--passes", passes,
               "--spp", SAMPLES_OF_A_PASS * passes, "--denoise", "off"]
    return [*options, "--radius", radius] if radius else [*options, "--alpha", "0.667"]


def by_paths(effort):
    """What photons bring into fog is under test there, so paths decide."""
    return ["--method", "mc", "--time", f"{FULL_SECONDS * effort}s", "--denoise", "off"]


FIXED_RADII = {"ring": 0.008, "water": 0.001, "wine-glass": 0.003}  # [m]
FOGS = ("fog2", "fog3", "min-medium-light")


def options_of(name, effort):
    return by_paths(effort) if name in FOGS else by_photons(effort, FIXED_RADII.get(name))


def names():
    return sorted(file.stem for file in SCENES.glob("*.pbrt"))


@dataclasses.dataclass
class Reference:
    path: pathlib.Path  # a picture to compare with: the mean of both halves
    picture: exr.Picture
    floor: dict  # what the noise of the reference adds to relMSE, by the names of the scores; None without a second half


class References:
    """The references in a folder. NAME.exr and NAME.b.exr are halves with seeds of their own, and NAME.json says how they were made.
    With a width they are called NAME-WIDTH. A NAME.exr alone may come from elsewhere; it is then compared with as it is.

    What is missing, or was made with less effort than is asked for, is rendered."""

    def __init__(self, program, folder, width=None, effort=1.0):
        self.program, self.folder, self.width, self.effort = program, folder, width, effort

    def file(self, name, ending):
        return self.folder / (f"{name}-{self.width}{ending}" if self.width else name + ending)

    def is_missing(self, name):
        about = self.file(name, ".json")
        effort = json.loads(about.read_text())["effort"] if about.exists() else self.effort
        return not self.file(name, ".exr").exists() or effort < self.effort

    def make(self, name):
        self.folder.mkdir(parents=True, exist_ok=True)
        about, options = self.file(name, ".json"), [*size_options(self.width), *map(str, options_of(name, self.effort))]
        about.unlink(missing_ok=True)
        self.file(name, ".exr").unlink(missing_ok=True)  # rendered last, it says that the reference is complete
        seconds = [renders.render(self.program, scene_of(name), self.file(name, ending), [*options, "--seed", seed])
                   for ending, seed in ((".b.exr", SEEDS[1]), (".exr", SEEDS[0]))]
        about.write_text(json.dumps({"effort": self.effort, "options": options, "seconds": [round(s, 1) for s in seconds]}) + "\n")

    def get(self, name, out):
        """Makes what is missing. Writes the mean of the halves into the folder `out`."""
        if self.is_missing(name):
            self.make(name)
        first, second = (self.file(name, ending) for ending in (".exr", ".b.exr"))
        if not second.exists():
            return Reference(first, exr.read(first), None)
        halves, mean = [exr.read(first), exr.read(second)], out / f"{name}.reference.exr"
        picture = mean_of(*halves)
        exr.write_half(mean, picture, f"mean of {first.name} and {second.name}")
        return Reference(mean, picture, floor_of(*halves))


def size_options(width):
    return ["--width", str(width)] if width else []


def scene_of(name):
    return SCENES / f"{name}.pbrt"


def mean_of(first, second):
    channels = {letter: array.array("f", ((a + b) / 2 for a, b in zip(first.channels[letter], second.channels[letter])))
                for letter in "RGB"}
    return exr.Picture(first.width, first.height, channels)


def floor_of(first, second):
    """The halves differ by the squares of both errors, so a quarter of that is the square of their mean's error."""
    found = score(first, second)
    return {f"mse{side}": found[f"mse{side}"] / 4 for side in SIDES}


def check_names(wanted):
    """Throws `Failed` for names of no scene."""
    unknown = sorted(set(wanted) - set(names()))
    if unknown:
        raise Failed(f"{SCENES} has no scene {', '.join(unknown)}. It has: {', '.join(names())}")
