#!/usr/bin/env python3
"""Writes scenes in which path tracing is hard to beat: OUT/street.pbrt, a street of painted houses under sky and sun, and
OUT/studio.pbrt, a toy car of paint, glass and chrome on a floor between two soft boxes.

make_open_scenes.py OUT

Neither has caustics of a light that no path can hit, so that `--method mc` is a reference. The same files each time; needs
only Python 3."""
import pathlib
import random
import sys

HEAD = """LookAt {look}
Camera "perspective" "float fov" [{fov}]
Film "rgb" "integer xresolution" [400] "integer yresolution" [225]
Sampler "independent" "integer pixelsamples" [64]
Integrator "path" "integer maxdepth" [8]
WorldBegin
"""
DIFFUSE = 'Material "diffuse" "rgb reflectance" [{:.3f} {:.3f} {:.3f}]\n'


def box(low, high):
    corners = [(x, y, z) for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])]
    sides = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    points = " ".join(f"{c:g}" for corner in corners for c in corner)
    indices = " ".join(f"{a} {b} {c} {a} {c} {d}" for a, b, c, d in sides)
    return f'Shape "trianglemesh" "point3 P" [{points}] "integer indices" [{indices}]\n'


def house(side, z, width, height):
    """A house on one side of the street, with a window for each 2.5 m of each floor."""
    near, far = 6 * side, 18 * side
    lines = [box((min(near, far), 0, z), (max(near, far), height, z + width)), DIFFUSE.format(0.05, 0.05, 0.06)]
    for floor in range(int(height // 3)):
        for window in range(int(width // 2.5)):
            start = z + 0.6 + 2.5 * window
            face = near - 0.05 if side > 0 else near
            lines.append(box((face, 3 * floor + 1, start), (face + 0.05, 3 * floor + 2.4, start + 1.4)))
    return lines


def street():
    draw = random.Random(3)
    lines = [HEAD.format(look="0 1.7 -12  0 4 10  0 1 0", fov=60),
             'LightSource "infinite" "rgb L" [0.5 0.7 1]\n',
             'LightSource "distant" "point3 from" [3 8 -4] "point3 to" [0 0 0] "rgb L" [6 5.5 5]\n',
             DIFFUSE.format(0.25, 0.25, 0.25), box((-200, -1, -200), (200, 0, 200))]
    for side in (-1, 1):
        z = -20
        while z < 120:
            width, height = draw.uniform(8, 16), draw.uniform(8, 25)
            lines.append(DIFFUSE.format(*(draw.uniform(0.2, 0.7) for _ in range(3))))
            lines += house(side, z, width, height)
            z += width + (3 if draw.random() < 0.3 else 0)
    return "".join(lines)


def ellipsoid(material, centre, size):
    at, scale = (" ".join(f"{c:g}" for c in v) for v in (centre, size))
    return f'AttributeBegin\n{material}Translate {at}\nScale {scale}\nShape "sphere"\nAttributeEnd\n'


def soft_box(radiance, corners):
    points = " ".join(f"{c:g}" for corner in corners for c in corner)
    return (f'AttributeBegin\nAreaLightSource "diffuse" "rgb L" [{radiance} {radiance} {radiance}]\n'
            f'Shape "trianglemesh" "point3 P" [{points}] "integer indices" [0 1 2 0 2 3]\nAttributeEnd\n')


def studio():
    paint = 'Material "coateddiffuse" "rgb reflectance" [0.6 0.05 0.04] "float roughness" [0.02]\n'
    glass = 'Material "dielectric" "float eta" [1.5]\n'
    chrome = 'Material "conductor" "spectrum eta" "metal-Al-eta" "spectrum k" "metal-Al-k" "float roughness" [0.05]\n'
    tyre = DIFFUSE.format(0.03, 0.03, 0.03)
    lines = [HEAD.format(look="3 1.6 -6  0 0.6 0  0 1 0", fov=40), 'LightSource "infinite" "rgb L" [0.3 0.3 0.3]\n',
             soft_box(4, [(-3, 5, -2), (3, 5, -2), (3, 5, 2), (-3, 5, 2)]),
             soft_box(3, [(-6, 0, -2), (-6, 4, -2), (-6, 4, 2), (-6, 0, 2)]),
             DIFFUSE.format(0.7, 0.7, 0.7), box((-30, -1, -30), (30, 0, 30)),
             ellipsoid(paint, (0, 0.75, 0), (2, 0.45, 0.9)), ellipsoid(glass, (-0.2, 1.15, 0), (1.1, 0.5, 0.75))]
    for x in (-1.2, 1.2):
        for z in (-0.8, 0.8):
            lines += [ellipsoid(tyre, (x, 0.4, z), (0.4, 0.4, 0.15)),
                      ellipsoid(chrome, (x, 0.4, 1.05 * z), (0.25, 0.25, 0.13))]
    return "".join(lines)


def main():
    if len(sys.argv) != 2 or sys.argv[1].startswith("-"):
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "street.pbrt").write_text(street())
    (folder / "studio.pbrt").write_text(studio())


if __name__ == "__main__":
    main()
