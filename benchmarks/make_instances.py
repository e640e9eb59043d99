#!/usr/bin/env python3
"""Writes a scene of many instances of one large mesh, to measure memory and time.

  make_instances.py [--instances 1000] [--triangles 1000000] FOLDER

FOLDER/instances.pbrt uses FOLDER/mesh.ply: a binary mesh of a sphere with waves and shared vertices. The instances lie on a
square grid, each with a rotation of its own. Render it with `/usr/bin/time -v` or `--stats`.
"""
import argparse
import array
import math
import pathlib

kScene = """LookAt 0 {height} {back}  0 0 0  0 1 0
Camera "perspective" "float fov" 45
Film "rgb" "integer xresolution" 320 "integer yresolution" 240
Sampler "sobol" "integer pixelsamples" 4
Integrator "photonmap" "integer photons" 1000000
WorldBegin
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [ 40 38 34 ]
  Translate 0 {light} 0
  Rotate 90 1 0 0
  Shape "disk" "float radius" {radius}
AttributeEnd
Material "diffuse" "rgb reflectance" [ 0.6 0.58 0.55 ]
Shape "trianglemesh" "point3 P" [ -{floor} 0 {floor}  {floor} 0 {floor}  {floor} 0 -{floor}  -{floor} 0 -{floor} ]
  "integer indices" [ 0 1 2  0 2 3 ]
ObjectBegin "stone"
  Material "diffuse" "rgb reflectance" [ 0.6 0.3 0.2 ]
  Shape "plymesh" "string filename" "mesh.ply"
ObjectEnd
"""


def write_mesh(path, triangles):
    """Writes a mesh with rows of latitude and columns of longitude: 2 rows columns triangles."""
    rows = max(2, round(math.sqrt(triangles / 4)))
    columns = max(3, round(triangles / (2 * rows)))
    vertices, faces = array.array("f"), bytearray()
    for r in range(rows + 1):
        theta = math.pi * (r + 0.5) / (rows + 1)
        for c in range(columns):
            phi = 2 * math.pi * c / columns
            radius = 0.4 * (1 + 0.06 * math.sin(9 * theta) * math.sin(8 * phi))
            vertices.extend((radius * math.sin(theta) * math.cos(phi), radius * math.cos(theta),
                             radius * math.sin(theta) * math.sin(phi)))
    for r in range(rows):
        for c in range(columns):
            a, b = r * columns + c, r * columns + (c + 1) % columns
            for corners in ((a, b, a + columns), (b, b + columns, a + columns)):
                faces += b"\x03" + array.array("i", corners).tobytes()
    head = (f"ply\nformat binary_little_endian 1.0\nelement vertex {(rows + 1) * columns}\n"
            "property float x\nproperty float y\nproperty float z\n"
            f"element face {2 * rows * columns}\nproperty list uchar int vertex_indices\nend_header\n")
    path.write_bytes(head.encode() + vertices.tobytes() + faces)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--instances", type=int, default=1000)
    parser.add_argument("--triangles", type=int, default=1_000_000)
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    write_mesh(arguments.folder / "mesh.ply", arguments.triangles)
    side = math.ceil(math.sqrt(arguments.instances))
    text = kScene.format(height=0.7 * side, back=0.9 * side, light=side, radius=0.2 * side, floor=2 * side)
    for i in range(arguments.instances):
        x, z = i % side - side / 2, i // side - side / 2
        text += (f"AttributeBegin Translate {x} 0.45 {z} Rotate {i * 137.5 % 360:.1f} 0 1 0 "
                 'ObjectInstance "stone" AttributeEnd\n')
    (arguments.folder / "instances.pbrt").write_text(text)


if __name__ == "__main__":
    main()
