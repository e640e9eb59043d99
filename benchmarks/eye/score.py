"""Scores a picture against a reference by what an eye sees, and not by single pixels alone. Needs only Python 3.

relMSE is the mean of (I - R)^2 / (R^2 + 0.01 m^2) over blocks and channels, where I and R are means of n x n pixels and m is the mean
of the reference. Unlike that of `kaustik compare`, it does not depend on the exposure. A blotch survives the averaging, noise does not."""
import itertools
import math

from real.runs import Failed

SIDES = (1, 4, 16)  # of the blocks whose relMSE is given, in pixels
NEAR = 2  # pixels around a bright one that the filter of the camera may have lit
BRIGHTEST = 30  # times the mean; what is brighter is a light or its reflection, and left out with the pixels near it
LIT = 0.1  # times the mean: blocks that are darker are left out of `blocks`
SPOT, FAINTEST_SPOT = 3, 0.25  # times the brightest reference pixel nearby, and times the mean


def score(reference, picture):
    """The scores of a picture of `real.exr`, as numbers by name:

    mean         of the picture, divided by that of the reference
    mse1 ...     relMSE of pixels, and of the means of 4 x 4 and 16 x 16 pixels
    blocks       the 95 % quantile of |I / R - 1| over blocks of 16 x 16 pixels
    spots        pixels far brighter than the reference is nearby (fireflies), for each 10,000
    not_finite   the count of numbers that are not finite; then the others may not be, either

    NaN stands for what cannot be given, as where the picture has no whole block. Throws `Failed` where the sizes differ or the
    reference is black."""
    if (reference.width, reference.height) != (picture.width, picture.height):
        raise Failed(f"the reference has {reference.width} x {reference.height} pixels, the picture {picture.width} x {picture.height}")
    truth, seen, width, mean = reference.colours(""), picture.colours(""), reference.width, reference.mean("")
    if not mean > 0:
        raise Failed("the reference is black")
    kept = [v <= BRIGHTEST * mean for v in brightest_near(list(map(max, *truth)), width)]
    grey = [[(r + g + b) / 3 for r, g, b in zip(*colours)] for colours in (truth, seen)]
    out = {"mean": total(seen, kept) / total(truth, kept)}
    for side in SIDES:
        out[f"mse{side}"] = relmse(truth, seen, kept, width, side, 0.01 * mean * mean)
    out["blocks"] = deviation(*(block_means(values, kept, width, SIDES[-1]) for values in grey), LIT * mean)
    out["spots"] = 1e4 * spots(*grey, kept, width, FAINTEST_SPOT * mean) / len(kept)
    out["not_finite"] = sum(not math.isfinite(v) for values in seen for v in values)
    return out


def total(colours, kept):
    return math.fsum(itertools.chain.from_iterable(itertools.compress(values, kept) for values in colours))


def relmse(truth, seen, kept, width, side, floor):
    errors = [(i - r) ** 2 / (r * r + floor) for channels in zip(truth, seen)
              for r, i in zip(*(block_means(values, kept, width, side) for values in channels)) if r is not None]
    return math.fsum(errors) / len(errors) if errors else math.nan


def deviation(truth, seen, darkest):
    """The 95 % quantile of |I / R - 1| over the means of blocks."""
    return quantile([abs(i / r - 1) for r, i in zip(truth, seen) if r is not None and r > darkest], 0.95)


def spots(truth, seen, kept, width, faintest):
    return sum(k and i > max(SPOT * r, faintest) for k, i, r in zip(kept, seen, brightest_near(truth, width)))


def block_means(values, kept, width, side):
    """The means over the kept pixels of all whole blocks, row by row; None for those of which less than half is kept."""
    sums = block_sums([v if k else 0.0 for v, k in zip(values, kept)], width, side)
    return [s / count if 2 * count >= side * side else None for s, count in zip(sums, block_sums(kept, width, side))]


def block_sums(values, width, side):
    for top in range(0, len(values) // width - side + 1, side):
        rows = [values[y * width:(y + 1) * width] for y in range(top, top + side)]
        columns = list(map(sum, zip(*rows)))
        yield from (sum(columns[x:x + side]) for x in range(0, width - side + 1, side))


def brightest_near(values, width):
    """For each pixel the largest number of those at most NEAR rows and columns away."""
    rows = [largest_near(values[at:at + width]) for at in range(0, len(values), width)]
    columns = [largest_near(column) for column in zip(*rows)]
    return [v for row in zip(*columns) for v in row]


def largest_near(line):
    beyond = [-math.inf] * NEAR
    padded = [*beyond, *line, *beyond]
    return list(map(max, *(padded[at:at + len(line)] for at in range(2 * NEAR + 1))))


def quantile(values, share):
    """Linear between the values; NaN of none."""
    if not values:
        return math.nan
    ordered, at = sorted(values), share * (len(values) - 1)
    below = math.floor(at)
    above = min(below + 1, len(ordered) - 1)
    return ordered[below] + (at - below) * (ordered[above] - ordered[below])
