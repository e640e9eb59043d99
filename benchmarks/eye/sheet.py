"""Puts pictures beside their references, as one JPEG. Needs oiiotool."""
import shutil
import subprocess

from eye.score import quantile
from real.runs import Failed

CELL = "320x240"  # [pixels]
GAP = 4  # [pixels]
SHOWN, BRIGHT_SHARE = 0.6, 0.8  # this share of the reference's pixels is darker than this radiance on the screen, 1 is white
TOOL, PACKAGE = "oiiotool", "openimageio-tools"


def check():
    """Throws `Failed` where no sheet can be made."""
    if not shutil.which(TOOL):
        raise Failed(f"--sheet needs {TOOL}, of the Debian package {PACKAGE}")


def write(pairs, file):
    """pairs: (reference, path of the picture) of each scene. Up to three stand below each other, more than that in two columns. Both
    pictures of a pair have the same exposure."""
    columns = 1 if len(pairs) <= 3 else 2
    rows = -(-len(pairs) // columns)
    words = [TOOL, "--nosoftwareattrib"]
    for reference, picture in pairs:
        scale = exposure(reference.picture)
        words += [*shown(reference.path, scale), *shown(picture, scale)]
    words += [f"--mosaic:pad={GAP}", f"{2 * columns}x{rows}", "--eraseattrib", ".*", "-d", "uint8", "--compression", "jpeg:85", "-o", file]
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True)
    if done.returncode != 0:
        raise Failed(f"{TOOL}: {(done.stderr or done.stdout).strip()}")


def exposure(picture):
    grey = [(r + g + b) / 3 for r, g, b in zip(*picture.colours(""))]
    return SHOWN / max(quantile(grey, BRIGHT_SHARE), 1e-30)


def shown(path, scale):
    return [path, "--ch", "R,G,B", "--mulc", scale, "--clamp:min=0:max=1", "--powc", 1 / 2.2, "--fit:pad=1", CELL]
