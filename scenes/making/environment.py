"""The environment: a panorama that names its directions, and balls that show it."""
import math

from making.gltf_writer import Gltf, png
from making.shapes import ground, place, sphere

# Seven rows of five from the top, a bit a square.
GLYPHS = {"+": (0, 4, 4, 31, 4, 4, 0), "-": (0, 0, 0, 31, 0, 0, 0), "X": (17, 17, 10, 4, 10, 17, 17),
          "Y": (17, 17, 10, 4, 4, 4, 4), "Z": (31, 1, 2, 4, 8, 16, 31)}

# Each face of the cube as it is seen from inside: its name, forward, right, up; its colour, 0..255.
FACES = (("+X", (1, 0, 0), (0, 0, 1), (0, 1, 0), (190, 60, 50)), ("-X", (-1, 0, 0), (0, 0, -1), (0, 1, 0), (60, 150, 150)),
         ("+Y", (0, 1, 0), (-1, 0, 0), (0, 0, -1), (90, 170, 60)), ("-Y", (0, -1, 0), (-1, 0, 0), (0, 0, 1), (120, 60, 130)),
         ("+Z", (0, 0, 1), (-1, 0, 0), (0, 1, 0), (60, 80, 190)), ("-Z", (0, 0, -1), (1, 0, 0), (0, 1, 0), (190, 160, 50)))


def dot(a, b):
    return sum(p * q for p, q in zip(a, b))


def directions_color(d):
    """Of a unit direction: its face's colour, a grid, and the face's name in white."""
    name, forward, right, up, color = max(FACES, key=lambda face: dot(face[1], d))
    s, t = dot(right, d) / dot(forward, d), dot(up, d) / dot(forward, d)
    column, row = math.floor((s + 0.55) / 0.1), math.floor((0.35 - t) / 0.1)
    if 0 <= row < 7 and 0 <= column < 11 and column != 5:
        if GLYPHS[name[column // 6]][row] >> (4 - column % 6) & 1:
            return 255, 255, 255
    line = min(abs(s * 4 - round(s * 4)), abs(t * 4 - round(t * 4))) < 0.06
    return tuple(c // 2 if line else c for c in color)


def directions(width=512, height=256):
    def pixel(x, y):
        phi, theta = 2 * math.pi * (x + 0.5) / width, math.pi * (y + 0.5) / height
        return directions_color((math.sin(theta) * math.sin(phi), math.cos(theta), -math.sin(theta) * math.cos(phi)))
    return png(width, height, pixel)


def balls():
    """A mirror, a rough and a fine metal, glaze over white, chalk: before the panorama of directions."""
    g = Gltf()
    surfaces = (g.material("mirror", brdf={"model": "mirror", "fresnel": {"type": "schlick", "f0": [1, 1, 1]}}),
                g.material("fine metal", (0.95, 0.93, 0.88), 1.0, 0.2), g.material("rough metal", (0.95, 0.93, 0.88), 1.0, 0.5),
                g.material("glaze", (0.8, 0.8, 0.8), 0.0, 0.25),
                g.material("chalk", brdf={"model": "lambert", "diffuse": [0.8, 0.8, 0.8]}))
    for i, surface in enumerate(surfaces):
        place(g, sphere(28, 0.48), surface, translation=(i - 2.0, 0, 0), uvs=False)
    g.scene_extension("LOBE_environment", image="directions.png")
    g.camera((0, 0.6, 6.0), (0, 0, 0), 34)
    return g


def sky():
    """A mirror, a metal, glaze and chalk on a pale floor under a clear sky with the sun low at the left."""
    g = Gltf()
    surfaces = (g.material("mirror", brdf={"model": "mirror", "fresnel": {"type": "schlick", "f0": [0.9, 0.9, 0.9]}}),
                g.material("rough metal", (0.95, 0.93, 0.88), 1.0, 0.4), g.material("glaze", (0.5, 0.05, 0.03), 0.0, 0.15),
                g.material("chalk", brdf={"model": "lambert", "diffuse": [0.8, 0.8, 0.8]}))
    place(g, ground(), g.material("floor", brdf={"model": "lambert", "diffuse": [0.45, 0.42, 0.38]}), uvs=False)
    for i, surface in enumerate(surfaces):
        place(g, sphere(28, 0.48), surface, translation=(1.1 * (i - 1.5), 0.48, 0), uvs=False)
    g.scene_extension("LOBE_environment", intensity=0.005, sky={
        "model": "preetham", "turbidity": 3, "sunElevation": math.radians(25), "sunAzimuth": math.radians(-60),
        "ground": [0.3, 0.28, 0.25]})
    g.camera((0.6, 1.5, 6.5), (0, 0.5, 0), 38)
    return g
