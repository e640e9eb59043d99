#!/usr/bin/env python3
"""Makes the images of the gallery's texture scenes, with nothing but Python's own library.

    scenes/gallery/images/make-images.py    writes the PNG files beside itself
"""
import math
import pathlib
import struct
import zlib


def write_png(name, width, height, channels, pixel):
    rows = bytearray()
    for y in range(height):
        rows.append(0)
        for x in range(width):
            value = pixel((x + 0.5) / width, (y + 0.5) / height)
            rows += bytes(min(255, max(0, round(255 * v))) for v in value)

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", width, height, 8, 2 if channels == 3 else 0, 0, 0, 0)
    png = b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(bytes(rows), 9))
    pathlib.Path(__file__).with_name(name).write_bytes(png + chunk(b"IEND", b""))


def tiles(u, v):
    """Four glazed tiles with a star each, light joints; sRGB."""
    s, t = (2 * u) % 1 - 0.5, (2 * v) % 1 - 0.5
    if max(abs(s), abs(t)) > 0.47:
        return 0.85, 0.83, 0.78
    r, phi = math.hypot(s, t), math.atan2(t, s)
    star = r < 0.22 + 0.13 * math.cos(8 * phi)
    odd = (int(2 * u) + int(2 * v)) % 2
    if star:
        return (0.93, 0.75, 0.25) if odd else (0.90, 0.93, 0.95)
    return (0.10, 0.28, 0.55) if odd else (0.62, 0.20, 0.15)


def weave(u, v):
    """Heights of a basket weave, linear."""
    s, t = 4 * u, 4 * v
    over = (int(s) + int(t)) % 2 == 0
    along, across = ((s % 1), (t % 1)) if over else ((t % 1), (s % 1))
    return (0.2 + 0.8 * math.sin(math.pi * along) ** 0.5 * (0.4 + 0.6 * math.sin(math.pi * across)),)


def domes(u, v):
    """Normals of round domes on a plane, as a normal map stores them."""
    s, t = (4 * u) % 1 - 0.5, 0.5 - (4 * v) % 1
    r = math.hypot(s, t)
    nx, ny = (1.6 * s, 1.6 * t) if r < 0.42 else (0.0, 0.0)
    nz = math.sqrt(max(0.0, 1 - nx * nx - ny * ny))
    return 0.5 + 0.5 * nx, 0.5 + 0.5 * ny, 0.5 + 0.5 * nz


def leaf(u, v):
    """A leaf's outline: one inside, zero outside."""
    x, y = 2 * u - 1, 1 - v
    blade = 0.75 * math.sin(math.pi * min(1.0, max(0.0, (y - 0.12) / 0.85))) ** 0.8
    teeth = 1 - 0.12 * abs((12 * y) % 1)
    stalk = abs(x) < 0.035 and y < 0.2
    return (1.0 if abs(x) < blade * teeth or stalk else 0.0,)


def leaf_colour(u, v):
    """Its colour, with veins; sRGB."""
    x, y = abs(2 * u - 1), 1 - v
    vein = x < 0.03 or abs((8 * (y - 0.6 * x)) % 1 - 0.5) < 0.06
    return (0.55, 0.62, 0.25) if vein else (0.20, 0.42 + 0.1 * y, 0.12)


if __name__ == "__main__":
    write_png("tiles.png", 128, 128, 3, tiles)
    write_png("weave.png", 128, 128, 1, weave)
    write_png("domes.png", 128, 128, 3, domes)
    write_png("leaf.png", 128, 128, 1, leaf)
    write_png("leaf-colour.png", 64, 64, 3, leaf_colour)
