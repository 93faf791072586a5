"""Out of doors: a street by day, and a market at night with a thousand lamps."""
import math
import random

from making.gltf_writer import Gltf, axis_rotation, png
from making.shapes import box, ground, place, sphere, upright


def leaves(g):
    """Masked foliage: one card of many discs."""
    dice = random.Random(11)
    discs = [(dice.uniform(5, 59), dice.uniform(5, 59), dice.uniform(3, 5.5)) for _ in range(60)]

    def pixel(x, y):
        covered = any(math.hypot(x - u, y - v) < r for u, v, r in discs)
        return (70 + (7 * x + 3 * y) % 40, 120 + (5 * x + 11 * y) % 50, 45, 255 if covered else 0)
    cut = g.material("leaves", roughness=0.8, alphaMode="MASK", alphaCutoff=0.5, doubleSided=True)
    g.json["materials"][cut]["pbrMetallicRoughness"]["baseColorTexture"] = {"index": g.texture(png(64, 64, pixel, True))}
    positions, normals, uvs, indices = upright(0.9, 0.9)
    return {**g.geometry(positions, normals, indices, [uvs]), "material": cut}


def street():
    """Houses, trees and posts along a street that leads 80 m away, under a low sun; a lamp with a body before the nearest door."""
    g = Gltf()
    place(g, ground(60, 1), g.material("street", (0.42, 0.4, 0.38), 0.0, 0.85), translation=(0, 0, -35), uvs=False)
    dice = random.Random(3)
    walls = [g.material(name, color, 0.0, 0.9) for name, color in
             (("plaster", (0.78, 0.72, 0.6)), ("brick", (0.52, 0.25, 0.18)), ("limewash", (0.75, 0.76, 0.74)))]
    glass = g.material("glass", (0.04, 0.05, 0.06), 0.0, 0.08)
    for i in range(9):
        for side in (-1, 1):
            height, depth = dice.uniform(4.5, 7.5), 5.5
            z = -2.0 - 9.0 * i - (3.0 if side > 0 else 0.0)
            place(g, box(4, height, depth), walls[(i + (side > 0)) % 3], translation=(side * 7.0, height / 2, z), uvs=False)
            for floor in range(2):
                for k in (-1.4, 1.4):
                    place(g, box(0.06, 1.3, 0.9), glass, translation=(side * 4.98, 1.9 + 2.3 * floor, z + k), uvs=False)
    bark = g.material("bark", (0.25, 0.18, 0.12), 0.0, 0.9)
    card = leaves(g)
    for i in range(6):
        x, z = (3.4, -6.5 - 13.0 * i) if i % 2 else (-3.4, -4.0 - 13.0 * i)
        place(g, box(0.22, 2.6, 0.22), bark, translation=(x, 1.3, z), uvs=False)
        mesh = g.mesh(card)
        for k in range(5):
            g.node(mesh=mesh, translation=[x + dice.uniform(-0.4, 0.4), 2.9 + 0.25 * k, z + dice.uniform(-0.4, 0.4)],
                   rotation=axis_rotation((0.3 * dice.uniform(-1, 1), 1, 0.2), 36 * k))
    iron = g.material("iron", (0.5, 0.5, 0.52), 1.0, 0.4)
    for i in range(14):
        place(g, box(0.08, 0.9, 0.08), iron, translation=(-1.9, 0.45, 2.0 - 1.5 * i), uvs=False)
    place(g, box(0.05, 0.05, 21.0), iron, translation=(-1.9, 0.9, -7.7), uvs=False)
    place(g, sphere(32, 0.5), g.material("ball", (0.75, 0.16, 0.1), 0.0, 0.25), translation=(0.7, 0.5, 0.4), uvs=False)
    g.light("directional", 3.2, (1.0, 0.93, 0.8), toward=(-0.62, -0.72, -0.3))
    g.light("point", 9.0, (1.0, 0.8, 0.5), position=(3.9, 2.2, -3.2), shape={"shape": "sphere", "radius": 0.16})
    g.ambient((0.16, 0.19, 0.24))
    g.camera((0.4, 1.7, 6.2), (-0.1, 1.5, -6), 48)
    return g


def hung(g, *light, **more):
    """A light that casts no shadows."""
    g.light(*light, **more)
    g.extension("LOBE_shadow")
    g.json["nodes"][-1]["extensions"]["LOBE_shadow"] = {"cast": False}


def colour(dice):
    hue = dice.random() * 6
    return [max(0.0, min(1.0, abs((hue + shift) % 6 - 3) - 1)) * 0.8 + 0.2 for shift in (0, 4, 2)]


def market():
    """A thousand small lamps on strings, 32 lanterns and spots with shadows, and 8 lights with a body."""
    g = Gltf()
    place(g, ground(16, 1), g.material("ground", (0.5, 0.48, 0.45), 0.0, 0.6), uvs=False)
    dice = random.Random(8)
    wood, cloth = g.material("wood", (0.45, 0.3, 0.18), 0.0, 0.7), g.material("cloth", (0.7, 0.66, 0.6), 0.0, 0.9)
    fruit = [g.material(name, base, metallic, roughness) for name, base, metallic, roughness in
             (("orange", (0.9, 0.4, 0.05), 0.0, 0.4), ("apple", (0.6, 0.06, 0.05), 0.0, 0.2), ("brass", (0.9, 0.75, 0.4), 1.0, 0.25),
              ("jug", (0.2, 0.35, 0.6), 0.0, 0.3))]
    ball = g.geometry(*[sphere(14)[i] for i in (0, 1, 3)])
    stalls = [(x, z) for z in (-9, -5, -1, 3) for x in (-7.5, -2.5, 2.5, 7.5)]
    for n, (x, z) in enumerate(stalls):
        place(g, box(2.2, 0.9, 1.1), wood, translation=(x, 0.45, z), uvs=False)
        for k in (-1.05, 1.05):
            place(g, box(0.08, 2.3, 0.08), wood, translation=(x + k, 1.15, z - 0.5), uvs=False)
        place(g, box(2.4, 0.05, 1.3), cloth, translation=(x, 2.3, z), rotation=axis_rotation((1, 0, 0), 12), uvs=False)
        for k in range(4):
            g.node(mesh=g.mesh({**ball, "material": fruit[(n + k) % 4]}), scale=[0.2] * 3, translation=[x - 0.75 + 0.5 * k, 1.1, z + dice.uniform(-0.2, 0.3)])
        g.light("point", 1.6, (1.0, 0.75, 0.45), (x, 1.9, z + 0.25), range=4.0)
        g.light("spot", 14.0, colour(dice), (x + 1.6, 3.0, z + 2.0), (-0.5, -1, -0.6), cone=(14, 24), range=6.0)
    for i in range(1000):
        string, along = divmod(i, 50)
        x = -14.0 + 28.0 * (along + 0.5) / 50
        sag = 0.5 * math.cos(4 * math.pi * x / 14.0)
        hung(g, "point", 0.05, colour(dice), (x, 2.75 + sag, -12.0 + 20.0 * string / 19), range=1.6)
    for x in (-5, 5):
        g.area_light("rect", 5.0, 0.5, (x, 3.6, -11), (0, -1, 0.35), aspect=3)
        g.area_light("disk", 7.0, 0.6, (x, 3.6, 1), (0, -1, 0))
        g.light("point", 1.6, (1, 0.9, 0.75), (x, 2.6, -7), shape={"shape": "sphere", "radius": 0.18})
        g.light("point", 1.4, (0.7, 0.85, 1), (x, 2.7, -3), shape={"shape": "tube", "radius": 0.03, "length": 1.4})
    g.ambient((0.01, 0.011, 0.015))
    g.camera((0, 4.2, 12.5), (0, 0.9, -2), 46, 0.1)
    return g
