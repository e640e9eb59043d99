#!/usr/bin/env python3
"""Compares the error of `--method auto` with that of `--method mc` for equal work, on scenes that auto was not tuned for.

hard_cases.py KAUSTIK OUT_DIR [--only REGEX] [--rounds 3] [--cpu 20] [--threads 2] [--size 256]
hard_cases.py KAUSTIK OUT_DIR --make-references [--cpu 300] [--check 60]

Writes the scenes as OUT_DIR/NAME.pbrt. The first form renders each by both methods in turn, ROUNDS times with a seed of
its own, and prints the median relMSE (`kaustik compare --mask-bright 4`) and the range; --options is added to the calls of
auto. A render gets as many passes as fit into the CPU seconds of --cpu: 20 are 10 s on two idle cores, and the same work
on a busy machine. OUT_DIR keeps the pictures of the last round.
The second form makes the references OUT_DIR/NAME-reference.exr: by `mc`, or, where paths hardly meet the light, by photons
in many passes with a shrinking radius. At an eighth of the size, where noise is small, it renders both ways in the time of
--check and prints their difference. Needs only Python 3."""
import argparse
import array
import json
import math
import pathlib
import random
import re
import resource
import statistics
import subprocess
import sys

REFERENCE_SEED = "777"  # not a seed of the rounds: errors must not correlate


def shape(*corners):
    """A flat polygon of four corners."""
    points = "  ".join(" ".join(f"{x:.6g}" for x in corner) for corner in corners)
    return f'Shape "trianglemesh" "point3 P" [ {points} ] "integer indices" [ 0 1 2  0 2 3 ]\n'


def diffuse(r, g, b):
    return f'Material "diffuse" "rgb reflectance" [ {r} {g} {b} ]\n'


WHITE, RED, GREEN = diffuse(0.7, 0.7, 0.7), diffuse(0.6, 0.1, 0.1), diffuse(0.15, 0.45, 0.15)
GLASS, MIRROR = 'Material "dielectric" "float eta" 1.5\n', 'Material "mirror" "rgb reflectance" [ 0.9 0.9 0.9 ]\n'


def sphere(x, y, z, radius, material):
    return f'AttributeBegin\n{material}Translate {x} {y} {z}\nShape "sphere" "float radius" {radius}\nAttributeEnd\n'


def block(low, high, material):
    """A box between two corners, its outside towards the viewer."""
    (a, b, c), (d, e, f) = low, high
    return (material + shape((a, b, c), (d, b, c), (d, b, f), (a, b, f)) + shape((a, e, c), (a, e, f), (d, e, f), (d, e, c)) +
            shape((a, b, c), (a, e, c), (d, e, c), (d, b, c)) + shape((a, b, f), (d, b, f), (d, e, f), (a, e, f)) +
            shape((a, b, c), (a, b, f), (a, e, f), (a, e, c)) + shape((d, b, c), (d, e, c), (d, e, f), (d, b, f)))


def light(radiance, *corners):
    L = " ".join(f"{c:.5g}" for c in radiance)
    return f'AttributeBegin\nAreaLightSource "diffuse" "rgb L" [ {L} ]\n{diffuse(0, 0, 0)}{shape(*corners)}AttributeEnd\n'


def light_below(radiance, x, y, z, half):
    return light(radiance, (x - half, y, z - half), (x + half, y, z - half), (x + half, y, z + half), (x - half, y, z + half))


def head(eye, target, fov):
    look = "  ".join(" ".join(str(x) for x in part) for part in (eye, target, (0, 1, 0)))
    return (f'LookAt {look}\nCamera "perspective" "float fov" {fov}\nFilm "rgb" "integer xresolution" 256 "integer yresolution" 256\n'
            'Sampler "sobol" "integer pixelsamples" 16\nWorldBegin\n')


def room(floor=WHITE, left=RED, right=GREEN, others=WHITE):
    """[-2, 2] x [0, 3] x [-3, 3]; the viewer stands inside."""
    return (floor + shape((-2, 0, -3), (-2, 0, 3), (2, 0, 3), (2, 0, -3)) +
            others + shape((-2, 3, -3), (2, 3, -3), (2, 3, 3), (-2, 3, 3)) +
            shape((-2, 0, -3), (2, 0, -3), (2, 3, -3), (-2, 3, -3)) + shape((-2, 0, 3), (-2, 3, 3), (2, 3, 3), (2, 0, 3)) +
            left + shape((-2, 0, -3), (-2, 3, -3), (-2, 3, 3), (-2, 0, 3)) +
            right + shape((2, 0, -3), (2, 0, 3), (2, 3, 3), (2, 3, -3)))


INSIDE = head((0, 1.5, 2.9), (0, 1.25, -3), 60)


def many_lights(_):
    """A thousand lights of different colours and powers below a ceiling, screens between them, a glass and a mirror sphere."""
    numbers = random.Random(1)
    text = INSIDE + room()
    for i in range(1000):
        x, z, y = numbers.uniform(-1.95, 1.95), numbers.uniform(-2.95, 2.95), numbers.uniform(2.7, 2.98)
        hue, power = numbers.uniform(0, 2 * math.pi), numbers.uniform(0.1, 1) ** 3
        colour = [300 * power * (0.55 + 0.45 * math.cos(hue - 2 * math.pi * c / 3)) for c in range(3)]
        text += light_below(colour, x, y, z, 0.006)
    for x in (-1.2, -0.4, 0.4, 1.2):  # screens that hide most lights from most of the room
        text += WHITE + shape((x, 1.8, -2.8), (x, 1.8, 1), (x, 2.69, 1), (x, 2.69, -2.8))
    return text + sphere(0.8, 0.5, -0.6, 0.5, GLASS) + sphere(-0.8, 0.6, -1.4, 0.6, MIRROR) + block(
        (-0.3, 0, 0.2), (0.2, 0.4, 0.7), WHITE)


def light_in_glass(_):
    """A bulb: the only light is inside a shell of smooth glass, so all light comes through glass."""
    return (INSIDE + room() +
            'AttributeBegin\nTranslate 0.3 2.2 -0.8\nAttributeBegin\nAreaLightSource "diffuse" "rgb L" [ 60 52 40 ]\n' +
            diffuse(0, 0, 0) + 'Shape "sphere" "float radius" 0.08\nAttributeEnd\n' + GLASS +
            'Shape "sphere" "float radius" 0.3\nReverseOrientation\nShape "sphere" "float radius" 0.27\nAttributeEnd\n' +
            block((-1.2, 0, -1.8), (-0.4, 1.2, -1), WHITE) + sphere(0.9, 0.45, -0.2, 0.45, WHITE))


def mirror_box(_):
    """Six mirror walls, a light below the ceiling, a diffuse block and sphere. Paths have 64 bounces: after 16 a fifth of the
    light is left, which the methods cut off differently."""
    return (INSIDE.replace("WorldBegin", 'Integrator "photonmap" "integer maxbounces" 64\nWorldBegin') + room(MIRROR, MIRROR, MIRROR, MIRROR) + light_below((6, 5.5, 4.5), 0, 2.98, -0.5, 0.4) +
            block((-1.1, 0.01, -1.6), (-0.3, 1.2, -0.8), RED) + sphere(0.7, 0.6, -0.4, 0.5, WHITE))


def diffuse_only(_):
    """No specular surface: two blocks, a sphere, and a light that illuminates the ceiling and so the room."""
    up = light((40, 34, 25), (0.9, 1.6, -1.8), (0.9, 1.6, -1.4), (1.3, 1.6, -1.4), (1.3, 1.6, -1.8))
    return (INSIDE + room() + up + block((-1.3, 0, -2), (-0.5, 1.4, -1.2), WHITE) + block((0.1, 0, -0.6), (0.7, 0.6, 0), WHITE) +
            sphere(-0.6, 0.4, 0.1, 0.4, diffuse(0.3, 0.4, 0.7)))


def room_with_window(glazing):
    """A room whose right wall has a hole of 1.4 m x 1.2 m, on a wide plain."""
    y0, y1, z0, z1 = 1.0, 2.2, -1.9, -0.5
    wall = [((0, -3), (3, z0)), ((0, z1), (3, 3)), ((0, z0), (y0, z1)), ((y1, z0), (3, z1))]
    text = INSIDE + WHITE + shape((-2, 0, -3), (-2, 0, 3), (2, 0, 3), (2, 0, -3)) + shape((-2, 3, -3), (2, 3, -3), (2, 3, 3), (-2, 3, 3))
    text += shape((-2, 0, -3), (2, 0, -3), (2, 3, -3), (-2, 3, -3)) + shape((-2, 0, 3), (-2, 3, 3), (2, 3, 3), (2, 0, 3))
    text += RED + shape((-2, 0, -3), (-2, 3, -3), (-2, 3, 3), (-2, 0, 3)) + WHITE
    for (ya, za), (yb, zb) in wall:
        text += shape((2, ya, za), (2, ya, zb), (2, yb, zb), (2, yb, za))
    text += diffuse(0.3, 0.3, 0.2) + shape((-12, -0.1, -12), (-12, -0.1, 12), (12, -0.1, 12), (12, -0.1, -12))
    text += glazing((2.0, y0, z0), (2.02, y1, z1))
    return text + block((-1.2, 0, -1.8), (-0.4, 1.2, -1), WHITE) + sphere(0.6, 0.4, -0.6, 0.4, diffuse(0.3, 0.4, 0.7))


def pane(low, high):
    return 'Material "thindielectric" "float eta" 1.5\n' + shape(low, (low[0], high[1], low[2]), (low[0], high[1], high[2]),
                                                              (low[0], low[1], high[2]))


def slab(low, high):
    return block(low, high, GLASS)


def write_sky(path):
    """Writes a sky by latitude and longitude about +z of the image's own frame, 2:1: a gradient and a hazy sun 16 degrees wide."""
    width, height = 256, 128
    rows = []
    for y in range(height):
        theta = math.pi * (y + 0.5) / height
        for x in range(width):
            phi = 2 * math.pi * (x + 0.5) / width
            sun = math.sin(theta) * math.cos(phi - 0.35) * math.sin(1.0) + math.cos(theta) * math.cos(1.0)
            blue = 0.6 + 0.4 * math.cos(theta)
            bright = 60.0 if sun > math.cos(math.radians(8)) else 0.0
            rows.append([0.6 * blue + bright, 0.8 * blue + 0.9 * bright, 1.2 * blue + 0.7 * bright])
    bottom_first = [v for y in reversed(range(height)) for x in range(width) for v in rows[y * width + x]]
    data = array.array("f", bottom_first)
    if sys.byteorder == "big":
        data.byteswap()
    path.write_bytes(f"PF\n{width} {height}\n-1.0\n".encode() + data.tobytes())


def sky_window(out):
    """A sky with a sun, from an image, shines through a window of glass 2 cm thick."""
    write_sky(out / "sky.pfm")
    sky = 'AttributeBegin\nRotate -90 1 0 0\nLightSource "infinite" "string filename" "sky.pfm" "float scale" 2\nAttributeEnd\n'
    return room_with_window(slab).replace("WorldBegin\n", "WorldBegin\n" + sky)


def sky_pane(_):
    """The room of sky-window under a uniform sky; the window is a pane without thickness."""
    return room_with_window(pane).replace("WorldBegin\n", 'WorldBegin\nLightSource "infinite" "rgb L" [ 3 3.4 4 ]\n')


def small_glass(_):
    """A glass ball over a floor, which fills 1 % of the light's view."""
    return (head((0, 1.6, 3), (0, 0, 0), 40) + diffuse(0.6, 0.6, 0.6) + shape((-4, 0, -4), (-4, 0, 4), (4, 0, 4), (4, 0, -4)) +
            light_below((60, 60, 60), 0, 2, 0, 0.1) + sphere(0.3, 0.25, 0, 0.175, GLASS))


SCENES = {"many-lights": many_lights, "light-in-glass": light_in_glass, "mirror-box": mirror_box, "diffuse-only": diffuse_only,
          "sky-window": sky_window, "sky-pane": sky_pane, "small-glass": small_glass}
BY_PHOTONS = {"light-in-glass", "mirror-box", "sky-window", "sky-pane", "small-glass"}  # paths meet these lights too seldom
# A pass has an eighth of the photons and samples.
PASSES = ["--passes", "8", "--alpha", "0.667"]
TONE = ["--exposure", "0", "--tonemap", "srgb"]  # the same for all pictures, so that they can be compared by eye
PATHS, PHOTONS = ["--method", "mc", "--spp", "128"], ["--method", "auto", "--photons", "8M", "--spp", "128"]


def render(args, scene, image, options, seed):
    """Renders and returns the CPU seconds."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([args.kaustik, "render", scene, "-o", image, "-o", image.with_suffix(".png"), "--stats",
                    image.with_suffix(".json"), "--quiet", "--threads", args.threads, "--width", args.size, "--height", args.size,
                    "--seed", seed, *PASSES, *TONE, *options], check=True, stderr=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def render_for(args, seconds, scene, image, options, seed):
    """Renders as many passes as fit into the CPU seconds and returns the seconds that they took."""
    one, three = (render(args, scene, image, [*options, "--pass-range", f"0:{n}"], seed) for n in (1, 3))
    passes = max(1, round(1 + (seconds - one) / max(1e-3, (three - one) / 2)))
    return render(args, scene, image, [*options, "--pass-range", f"0:{passes}"], seed)


def compare(args, reference, image):
    command = [args.kaustik, "compare", reference, image, "--mask-bright", "4", "--json"]
    return json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)


def make_references(args, names):
    for name in names:
        scene, size = args.out / (name + ".pbrt"), int(args.size)
        ways = [PATHS, PHOTONS] if name not in BY_PHOTONS else [PHOTONS, PATHS]
        render_for(args, args.cpu or 300, scene, args.out / f"{name}-reference.exr", ways[0], REFERENCE_SEED)
        small = [args.out / f"{name}-small-{k}.exr" for k in (0, 1)]
        for image, options in zip(small, ways):
            render_for(args, args.check, scene, image, [*options, "--width", str(size // 8), "--height", str(size // 8)],
                       REFERENCE_SEED)
        result = compare(args, *small)
        print(f"{name}, an eighth of the size, {'mc' if ways[1] is PATHS else 'by photons'} against the reference's way: "
              f"relMSE {result['relmse']:.6f}, means {result['reference_mean']:.6g} {result['mean']:.6g}", flush=True)


def measure(args, names):
    print("| scene | auto, relMSE (range) | mc, relMSE (range) | auto / mc | means: reference, auto, mc | CPU s |\n"
          "| --- | --- | --- | --- | --- | --- |")
    for name in names:
        errors, means, cpu = {"auto": [], "mc": []}, {"auto": [], "mc": []}, {"auto": [], "mc": []}
        reference = args.out / f"{name}-reference.exr"
        for seed in range(args.rounds):
            for method in errors:
                image = args.out / f"{name}-{method}.exr"
                more = args.options.split() if method == "auto" else []
                cpu[method].append(render_for(args, args.cpu or 20, args.out / (name + ".pbrt"), image,
                                              ["--method", method, *more], str(seed)))
                result = compare(args, reference, image)
                errors[method].append(result["relmse"])
                means[method].append(result["mean"])
        auto, mc = (statistics.median(errors[m]) for m in ("auto", "mc"))
        ranges = {m: f"{statistics.median(e):.5f} ({min(e):.5f}..{max(e):.5f})" for m, e in errors.items()}
        mean = ", ".join(f"{v:.5f}" for v in (result["reference_mean"], *(statistics.mean(means[m]) for m in means)))
        print(f"| {name} | {ranges['auto']} | {ranges['mc']} | {auto / mc:.2f} | {mean} | "
              f"{statistics.median(cpu['auto']):.1f}, {statistics.median(cpu['mc']):.1f} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("kaustik")
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--only", default="")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--cpu", type=float, help="CPU seconds of each render (default 20) or reference (default 300)")
    parser.add_argument("--threads", default="2")
    parser.add_argument("--size", default="256")
    parser.add_argument("--options", default="", help="further options of auto")
    parser.add_argument("--make-references", action="store_true")
    parser.add_argument("--check", type=float, default=60, help="CPU seconds of each small picture")
    args = parser.parse_args()
    args.out.mkdir(parents=True, exist_ok=True)
    names = [name for name in SCENES if re.search(args.only, name)]
    for name in names:
        (args.out / (name + ".pbrt")).write_text(f"# Made by hard_cases.py: {' '.join(SCENES[name].__doc__.split())}\n{SCENES[name](args.out)}")
    if args.make_references:
        make_references(args, names)
    else:
        measure(args, names)


if __name__ == "__main__":
    main()
