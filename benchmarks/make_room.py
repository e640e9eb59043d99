#!/usr/bin/env python3
"""Writes a furnished room of fine meshes, to measure how fast camera samples are where geometry is fine.

  make_room.py [--triangles 3000000] [--pieces 300] FOLDER

FOLDER/room.pbrt is a box with a lamp and as many pieces of furniture, each a mesh and a surface group of its own: cushions,
mouldings (rings with grooves), and cabinets with thin bars. Pieces do not touch; the more there are, the smaller they are.
FOLDER/box.pbrt is the same room without them. All pieces are made by this script from the same seed.
"""
import argparse
import array
import math
import pathlib
import random

SCENE = """LookAt 0.3 1.6 3.8  0 1.1 0  0 1 0
Camera "perspective" "float fov" 62
Film "rgb" "integer xresolution" 320 "integer yresolution" 240
Sampler "sobol" "integer pixelsamples" 16
Integrator "photonmap" "integer photons" 1000000
WorldBegin
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [ 12 11 10 ]
  Shape "trianglemesh" "point3 P" [ -0.6 2.95 -0.3  0.6 2.95 -0.3  0.6 2.95 0.3  -0.6 2.95 0.3 ] "integer indices" [ 0 1 2  0 2 3 ]
AttributeEnd
Material "diffuse" "rgb reflectance" [ 0.7 0.68 0.62 ]
Shape "trianglemesh" "point3 P" [ -3 0 4  3 0 4  3 0 -4  -3 0 -4 ] "integer indices" [ 0 1 2  0 2 3 ]
Shape "trianglemesh" "point3 P" [ -3 3 4  -3 3 -4  3 3 -4  3 3 4 ] "integer indices" [ 0 1 2  0 2 3 ]
Shape "trianglemesh" "point3 P" [ -3 0 -4  3 0 -4  3 3 -4  -3 3 -4 ] "integer indices" [ 0 1 2  0 2 3 ]
Shape "trianglemesh" "point3 P" [ 3 0 4  -3 0 4  -3 3 4  3 3 4 ] "integer indices" [ 0 1 2  0 2 3 ]
Shape "trianglemesh" "point3 P" [ -3 0 4  -3 0 -4  -3 3 -4  -3 3 4 ] "integer indices" [ 0 1 2  0 2 3 ]
Shape "trianglemesh" "point3 P" [ 3 0 -4  3 0 4  3 3 4  3 3 -4 ] "integer indices" [ 0 1 2  0 2 3 ]
"""
MATERIALS = (
    'Material "diffuse" "rgb reflectance" [ {r:.2f} {g:.2f} {b:.2f} ]',
    'Material "coateddiffuse" "rgb reflectance" [ {r:.2f} {g:.2f} {b:.2f} ] "float roughness" [ 0.05 ]',
    'Material "diffuse" "rgb reflectance" [ {r:.2f} {g:.2f} {b:.2f} ]',
    'Material "conductor" "spectrum eta" "metal-Cu-eta" "spectrum k" "metal-Cu-k" "float roughness" [ 0.02 ]',
)


def cushion(u, v, size):
    """A rounded box: a superellipsoid of exponents 4, with a quilt of a few millimetres."""
    def power(x):
        return math.copysign(abs(x) ** 0.5, x)
    theta, phi = math.pi * (v - 0.5), 2 * math.pi * u
    bump = 1 + 0.01 * math.sin(8 * math.pi * u) * math.sin(6 * math.pi * v)
    return [bump * s * w for s, w in zip(size, (power(math.cos(theta)) * power(math.cos(phi)), power(math.sin(theta)),
                                                power(math.cos(theta)) * power(math.sin(phi))))]


def moulding(u, v, size):
    """A ring of a grooved profile."""
    phi, psi = 2 * math.pi * u, 2 * math.pi * v
    profile = 0.12 * (1 + 0.25 * math.cos(7 * psi))
    radius = 1 + profile * math.cos(psi)
    return [size[0] * radius * math.cos(phi), size[1] * profile * math.sin(psi), size[2] * radius * math.sin(phi)]


def mesh_of(form, columns, rows, size, place):
    """Vertices and faces of a surface over the unit square; around it closes where u does."""
    vertices, faces = array.array("f"), bytearray()
    for r in range(rows + 1):
        for c in range(columns):
            x, y, z = form(c / columns, r / rows, size)
            vertices.extend((x + place[0], y + place[1], z + place[2]))
    for r in range(rows):
        for c in range(columns):
            a, b = r * columns + c, r * columns + (c + 1) % columns
            faces += b"\x03" + array.array("i", (a, a + columns, b)).tobytes()
            faces += b"\x03" + array.array("i", (b, a + columns, b + columns)).tobytes()
    return vertices, faces


def bars(columns, rows, size, place):
    """A cabinet as a grille: thin boxes side by side, each cut into small quads."""
    vertices, faces = array.array("f"), bytearray()
    count = max(2, columns * rows // 400)
    steps = max(1, columns * rows // (4 * count))
    for i in range(count):
        x0 = place[0] + size[0] * (2 * (i + 0.25) / count - 1)
        x1 = place[0] + size[0] * (2 * (i + 0.75) / count - 1)
        for corner in range(4):
            (xa, za), (xb, zb) = [((x0, x1)[k in (1, 2)], place[2] + size[2] * (-1, 1)[k in (2, 3)])
                                  for k in (corner, (corner + 1) % 4)]
            first = len(vertices) // 3
            for s in range(steps + 1):
                y = place[1] + size[1] * (2 * s / steps - 1)
                vertices.extend((xa, y, za, xb, y, zb))
            for s in range(steps):
                a = first + 2 * s
                faces += b"\x03" + array.array("i", (a, a + 1, a + 2)).tobytes()
                faces += b"\x03" + array.array("i", (a + 1, a + 3, a + 2)).tobytes()
    return vertices, faces


def write_ply(path, vertices, faces):
    head = (f"ply\nformat binary_little_endian 1.0\nelement vertex {len(vertices) // 3}\n"
            "property float x\nproperty float y\nproperty float z\n"
            f"element face {len(faces) // 13}\nproperty list uchar int vertex_indices\nend_header\n")
    path.write_bytes(head.encode() + vertices.tobytes() + faces)


def free_place(rng, largest, taken):
    """Half the size of a box, and its place in the room where it meets none of those taken; not before the camera."""
    while True:
        size = [rng.uniform(0.3, 1) * largest for _ in range(3)]
        # A moulding is 1.15 times as wide as its size.
        reach = [1.2 * s for s in size]
        place = [rng.uniform(-2.9 + reach[0], 2.9 - reach[0]), rng.choice((size[1], rng.uniform(0.3, 2.8 - reach[1]))),
                 rng.uniform(-3.9 + reach[2], 1.5)]
        if all(any(abs(p - q) > r + s for p, q, r, s in zip(place, other, reach, other_reach)) for other, other_reach in taken):
            taken.append((place, reach))
            return size, place


def piece(rng, triangles, largest, taken):
    """A mesh of about so many triangles."""
    columns = max(8, round(math.sqrt(triangles)))
    rows = max(4, triangles // (2 * columns))
    size, place = free_place(rng, largest, taken)
    form = rng.choice((cushion, moulding, None))
    return bars(columns, rows, size, place) if form is None else mesh_of(form, columns, rows, size, place)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--triangles", type=int, default=3_000_000)
    parser.add_argument("--pieces", type=int, default=300)
    parser.add_argument("folder", type=pathlib.Path)
    args = parser.parse_args()
    args.folder.mkdir(parents=True, exist_ok=True)
    rng = random.Random(1)
    lines, taken = [SCENE], []
    largest = 0.25 * min(1, (300 / args.pieces) ** (1 / 3))
    for i in range(args.pieces):
        name = f"piece{i}.ply"
        write_ply(args.folder / name, *piece(rng, args.triangles // args.pieces, largest, taken))
        r, g, b = (rng.uniform(0.2, 0.8) for _ in range(3))
        lines.append(rng.choice(MATERIALS).format(r=r, g=g, b=b))
        lines.append(f'Shape "plymesh" "string filename" "{name}"')
    (args.folder / "box.pbrt").write_text(SCENE)
    (args.folder / "room.pbrt").write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
