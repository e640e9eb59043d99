"""Makes two references of a scene, one by paths and one by photons, and checks that they agree."""
import json
import math
import os

from real import exr
from real.runs import CLASSES, Failed, render

REFERENCE_SEED = "777"  # not a seed of the trials: errors must not correlate
METHODS = ("mc", "auto")
LAYERS = [*CLASSES, "error", "bias"]
BLOCKS = 8  # the picture's blocks, along each side, whose differences give the standard error of a mean
# Of Gaussian errors 90 % lie within the bounds, and a root mean square is 1 in units of its own. Both tell a reference that
# is wrong by more than it says; the margins are for estimates from few passes and for tails.
LEAST_WITHIN, MOST_TIMES_STATED = 0.8, 1.5
MOST_STANDARD_ERRORS, LEAST_SHARE = 3, 0.01


def files_of(folder, name, width):
    stem = f"{name}-{width}" if width else name
    return {method: folder / f"{stem}-{method}.exr" for method in METHODS}, folder / f"{stem}.json"


def options_of(method, seconds):
    """Passes of a million photons and 8 samples, or of fewer where there is little time: there should be many."""
    part = min(1, max(1 / 8, seconds / 120))
    options = ["--method", method, "--time", f"{seconds}s", "--seed", REFERENCE_SEED, "--spp", round(64 * part), "--aov", ",".join(LAYERS)]
    return options if method == "mc" else [*options, "--photons", round(8e6 * part), "--alpha", "0.667"]


def make(args, scene, name):
    """Renders both references, keeps them with the check in the folder of references, and returns the check."""
    images, about = files_of(args.references, name, args.width)
    pictures, check = {}, {"scene": str(scene), "seconds_each": args.make_references, "stated": {}}
    for method in METHODS:
        full = args.references / f"{name}-full.exr"
        done = render(args, scene, full, options_of(method, args.make_references))
        pictures[method] = exr.read(full)
        if not pictures[method].has("error"):
            raise Failed(f"{scene}: {args.make_references} s are one pass of {method}, which does not state its error")
        os.remove(full)
        check["stated"][method] = {"seconds": done["seconds"], "passes": done["stats"]["pass_ranges"], **stated(pictures[method])}
        exr.write_half(images[method], kept(pictures[method]), f"{method}, {done['seconds']:.0f} s, by real_scenes.py")
    check.update(agreement(pictures["mc"], pictures["auto"]))
    check["used"] = min(METHODS, key=lambda method: check["stated"][method]["relmse"])
    about.write_text(json.dumps(check, indent=1) + "\n")
    return check


def kept(picture):
    layers = {*CLASSES, ""}
    channels = {n: v for n, v in picture.channels.items() if n.rpartition(".")[0] in layers}
    return exr.Picture(picture.width, picture.height, channels)


def squares_of_errors(picture):
    """Per colour channel: what the picture says its squared error is, of noise and kernels, for each pixel."""
    for error, bias in zip(picture.colours("error"), picture.colours("bias")):
        yield [e * e + b * b for e, b in zip(error, bias)]


def stated(picture):
    """The error that a picture of several passes states: RMSE, and in units of relMSE."""
    squares, relative, count = 0.0, 0.0, 0
    for errors, values in zip(squares_of_errors(picture), picture.colours("")):
        for square, value in zip(errors, values):
            if math.isfinite(square) and math.isfinite(value):
                squares += square
                relative += square / (value * value + 0.01)
                count += 1
    if count == 0:
        return {"rmse": math.inf, "relmse": math.inf}
    return {"rmse": math.sqrt(squares / count), "relmse": relative / count}


def agreement(mc, auto):
    """Compares two pictures by their stated errors and by the means of their classes. `relmse` is that of one to the other: the sum
    of the errors of both, since they are independent, and so no less than that of each."""
    within, squares, relative, expected, count = 0, 0.0, 0.0, 0.0, 0
    for c, (first, second) in enumerate(zip(squares_of_errors(mc), squares_of_errors(auto))):
        a, b = mc.colours("")[c], auto.colours("")[c]
        for i, (e, f) in enumerate(zip(first, second)):
            if not math.isfinite(a[i] - b[i]) or not math.isfinite(e + f):
                continue
            within += abs(a[i] - b[i]) <= 1.645 * math.sqrt(e + f)
            squares += (a[i] - b[i]) ** 2
            relative += (a[i] - b[i]) ** 2 / (a[i] * a[i] + 0.01)
            expected += e + f
            count += 1
    ratio = math.sqrt(squares / expected) if expected > 0 else 1.0
    classes = {name: class_difference(mc, auto, name) for name in CLASSES}
    out = {"within_bound": within / max(1, count), "rmse_over_stated": ratio, "relmse": relative / max(1, count), "classes": classes,
           "bias": mc.mean("bias") + auto.mean("bias")}
    return {**out, "complaints": complaints(out)}


def class_difference(mc, auto, layer):
    """Means of a class and their difference, with its standard error from the spread over blocks of the picture."""
    blocks = [[0.0, 0] for _ in range(BLOCKS * BLOCKS)]
    width, height = mc.width, mc.height
    for a, b in zip(mc.colours(layer), auto.colours(layer)):
        for y in range(height):
            row = BLOCKS * (y * BLOCKS // height)
            for x in range(width):
                block = blocks[row + x * BLOCKS // width]
                block[0] += b[y * width + x] - a[y * width + x]
                block[1] += 1
    means = [total / count for total, count in blocks if count]
    mean = sum(means) / len(means)
    spread = math.sqrt(sum((m - mean) ** 2 for m in means) / max(1, len(means) - 1) / len(means))
    return {"mc": mc.mean(layer), "auto": auto.mean(layer), "difference": mean, "standard_error": spread}


def complaints(found):
    """Sentences about what does not agree. The means of classes may differ by their noise and by the bias of kernels that the
    pictures state themselves, or by a hundredth."""
    out = []
    if found["within_bound"] < LEAST_WITHIN:
        out.append(f"only {100 * found['within_bound']:.0f} % of the pixels lie within the bounds of 90 %")
    if found["rmse_over_stated"] > MOST_TIMES_STATED:
        out.append(f"their RMSE is {found['rmse_over_stated']:.2f} times what they state")
    for name, c in found["classes"].items():
        allowed = MOST_STANDARD_ERRORS * c["standard_error"] + abs(found["bias"])
        if abs(c["difference"]) > max(allowed, LEAST_SHARE * abs(c["mc"])):
            out.append(f"{name}: mc {c['mc']:.5g}, auto {c['auto']:.5g} "
                       f"({c['difference'] / max(c['standard_error'], 1e-30):+.1f} standard errors)")
    return out
