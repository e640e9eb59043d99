#!/usr/bin/env python3
"""Prints many-lights.pbrt: a long hall with small coloured lights in a grid on its ceiling. Argument: how many."""
import math
import sys

count = int(sys.argv[1]) if len(sys.argv) > 1 else 1000
columns = max(1, round(math.sqrt(count / 10)))
rows = math.ceil(count / columns)
side = 0.15 * min(4 / columns, 40 / rows)  # of a light
print(f"""# A hall of 4 m x 40 m with {count} lights on its ceiling, each a square of {side:.3g} m. Made by make_many_lights.py.
LookAt 0 1.6 0.5  0 1.2 12  0 1 0
Camera "perspective" "float fov" 55
Film "rgb" "integer xresolution" 320 "integer yresolution" 240 "string filename" "many-lights.exr"
Sampler "sobol" "integer pixelsamples" 32
Integrator "photonmap" "integer photons" 1000000
WorldBegin
Material "diffuse" "rgb reflectance" [ 0.6 0.6 0.6 ]
Shape "trianglemesh" "point3 P" [ -2 0 0  -2 0 40  2 0 40  2 0 0 ] "integer indices" [ 0 1 2  0 2 3 ]
Shape "trianglemesh" "point3 P" [ -2 3 0  2 3 0  2 3 40  -2 3 40 ] "integer indices" [ 0 1 2  0 2 3 ]
Shape "trianglemesh" "point3 P" [ -2 0 0  -2 3 0  -2 3 40  -2 0 40 ] "integer indices" [ 0 1 2  0 2 3 ]
Shape "trianglemesh" "point3 P" [ 2 0 0  2 0 40  2 3 40  2 3 0 ] "integer indices" [ 0 1 2  0 2 3 ]
Shape "trianglemesh" "point3 P" [ -2 0 40  -2 3 40  2 3 40  2 0 40 ] "integer indices" [ 0 1 2  0 2 3 ]""")
for k in range(8):
    z = 3 + 4.5 * k
    print(f"""AttributeBegin
  Translate {-1.1 if k % 2 else 1.1} 0.5 {z:g}
  Shape "sphere" "float radius" 0.5
AttributeEnd""")
for i in range(count):
    x = -2 + 4 * (i % columns + 0.5) / columns
    z = 40 * (i // columns + 0.5) / rows
    hue = 2 * math.pi * (3 * i // columns) / rows
    rgb = [0.55 + 0.45 * math.cos(hue - 2 * math.pi * c / 3) for c in range(3)]
    radiance = 60 / (count * side * side)
    L = " ".join(f"{radiance * c:.4g}" for c in rgb)
    h = side / 2
    print(f'AreaLightSource "diffuse" "rgb L" [ {L} ]')
    print(f'Shape "trianglemesh" "point3 P" [ {x - h:.5g} 2.99 {z - h:.5g}  {x + h:.5g} 2.99 {z - h:.5g}  '
          f'{x + h:.5g} 2.99 {z + h:.5g}  {x - h:.5g} 2.99 {z + h:.5g} ] "integer indices" [ 0 1 2  0 2 3 ]')
