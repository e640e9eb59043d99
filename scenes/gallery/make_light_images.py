#!/usr/bin/env python3
"""Makes the images that lamps of the gallery emit; needs OpenImageIO's oiiotool.

sky.exr    an evening sky with a low sun over dark ground, equal-area (Clarberg 2008), +z up
lamp.exr   intensities of a lamp with six beams, latitude and longitude
slide.exr  a coloured window for a projector
"""
import math
import struct
import subprocess
import sys
import tempfile
from pathlib import Path


def direction(u, v):
    """Of a point of the equal-area square."""
    a, b = 2 * u - 1, 2 * v - 1
    inner = 1 - abs(a) - abs(b)
    r = 1 - abs(inner)
    phi = (1 if r == 0 else (abs(b) - abs(a)) / r + 1) * math.pi / 4
    s = r * math.sqrt(max(0, 2 - r * r))
    return math.copysign(math.cos(phi) * s, a), math.copysign(math.sin(phi) * s, b), math.copysign(1 - r * r, inner)


def mix(a, b, t):
    t = min(1, max(0, t))
    return [x + t * (y - x) for x, y in zip(a, b)]


def sky(u, v):
    x, y, z = direction(u, v)
    ground = mix([0.10, 0.085, 0.07], [0.03, 0.025, 0.02], -4 * z)
    if z < -0.06:
        return ground
    sun = [math.cos(0.6) * math.cos(0.42), math.sin(0.6) * math.cos(0.42), math.sin(0.42)]
    cosine = x * sun[0] + y * sun[1] + z * sun[2]
    colour = mix([0.95, 0.62, 0.38], [0.16, 0.28, 0.62], 2.2 * z)
    streaks = math.sin(9 * z + 3 * math.sin(2 * math.atan2(y, x)) + 2 * x) ** 8 * max(0, 0.6 - z)
    glow = max(0, cosine) ** 60
    colour = [c + 0.7 * streaks + g * glow for c, g in zip(colour, [2.2, 1.2, 0.5])]
    if cosine > math.cos(math.radians(3)):
        return [220, 150, 80]
    return mix(ground, colour, 0.5 + z / 0.12)  # a hazy horizon, wider than pixels


def lamp(u, v):
    beams = max(0, math.cos(6 * math.pi * u)) ** 6 * math.exp(-((v - 0.62) / 0.1) ** 2)
    down = math.exp(-((1 - v) / 0.12) ** 2)
    return [0.02 + beams + 0.6 * down] * 3


def slide(u, v):
    x, y = 2 * u - 1, 2 * v - 1
    r, turn = math.hypot(x, y), math.atan2(y, x) / (2 * math.pi) % 1
    if r > 0.96 or 0.40 < r < 0.44 or (r > 0.44 and abs(turn * 12 % 1 - 0.5) > 0.46):
        return [0.004] * 3
    if r <= 0.40:
        return [1.0, 0.75, 0.15] if int(turn * 6) % 2 else [0.95, 0.25, 0.1]
    petals = [[0.9, 0.08, 0.1], [0.1, 0.25, 0.9], [0.08, 0.7, 0.2], [0.8, 0.5, 0.05]]
    return petals[int(turn * 12) % 4]


def write(folder, name, width, height, colour):
    rows = [[colour((x + 0.5) / width, (y + 0.5) / height) for x in range(width)] for y in range(height)]
    with tempfile.NamedTemporaryFile(suffix=".pfm") as f:  # rows from below, little endian
        f.write(b"PF\n%d %d\n-1.0\n" % (width, height))
        for row in reversed(rows):
            f.write(b"".join(struct.pack("<3f", *c) for c in row))
        f.flush()
        subprocess.run(["oiiotool", f.name, "-d", "half", "--attrib", "compression", "zip", "--eraseattrib", "DateTime",
                        "-o", str(folder / name)], check=True)


if __name__ == "__main__":
    here = Path(sys.argv[1] if len(sys.argv) > 1 else __file__).resolve()
    folder = here if here.is_dir() else here.parent
    write(folder, "sky.exr", 512, 512, sky)
    write(folder, "lamp.exr", 256, 128, lamp)
    write(folder, "slide.exr", 256, 256, slide)
