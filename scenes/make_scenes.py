#!/usr/bin/env python3
"""Writes the scenes of this folder (README.md lists them). Standard library only; deterministic.

usage: make_scenes.py [FOLDER]"""
import math
import pathlib
import random
import struct
import sys

from gltf_writer import Gltf, axis_rotation, cross, normalized, png

HERE = pathlib.Path(__file__).resolve().parent


# Shapes: positions, normals, texture coordinates, indices.

def sphere(n=24, radius=1.0):
    positions, normals, uvs, indices = [], [], [], []
    for i in range(n + 1):
        for j in range(2 * n + 1):
            theta, phi = math.pi * i / n, math.pi * j / n
            p = (math.sin(theta) * math.cos(phi), math.cos(theta), -math.sin(theta) * math.sin(phi))
            positions.append(tuple(radius * c for c in p))
            normals.append(p)
            uvs.append((j / (2 * n), i / n))
    for i in range(n):
        for j in range(2 * n):
            a, b = i * (2 * n + 1) + j, (i + 1) * (2 * n + 1) + j
            if i > 0:
                indices += [a, b + 1, a + 1]
            if i < n - 1:
                indices += [a, b, b + 1]
    return positions, normals, uvs, indices


def ground(half=10.0, tile=1.0):
    uv = half / tile
    return ([(-half, 0, half), (half, 0, half), (half, 0, -half), (-half, 0, -half)], [(0, 1, 0)] * 4,
            [(0, uv), (uv, uv), (uv, 0), (0, 0)], [0, 1, 2, 0, 2, 3])


def upright(half_width=1.0, half_height=1.0):
    return ([(-half_width, -half_height, 0), (half_width, -half_height, 0), (half_width, half_height, 0), (-half_width, half_height, 0)],
            [(0, 0, 1)] * 4, [(0, 1), (1, 1), (1, 0), (0, 0)], [0, 1, 2, 0, 2, 3])


def box(x, y, z):
    positions, normals, uvs, indices = [], [], [], []
    for axis in range(3):
        for sign in (-1, 1):
            n = [0, 0, 0]
            n[axis] = sign
            u = [0, 0, 0]
            u[(axis + 1) % 3] = sign
            v = cross(n, u)
            base = len(positions)
            for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                p = [n[k] + a * u[k] + b * v[k] for k in range(3)]
                positions.append((p[0] * x / 2, p[1] * y / 2, p[2] * z / 2))
                normals.append(tuple(n))
                uvs.append(((a + 1) / 2, (1 - b) / 2))
            indices += [base, base + 1, base + 2, base, base + 2, base + 3]
    return positions, normals, uvs, indices


def teapot(steps=9):
    """Newell's teapot (1975), tessellated from its bicubic Bezier patches; exact normals."""
    lines = [line for line in (HERE / "data/teapot_bezier.txt").read_text().splitlines() if line and not line.startswith("#")]
    points, patches = map(int, lines[0].split())
    control = [tuple(map(float, line.split())) for line in lines[1:1 + points]]
    positions, normals, indices = [], [], []

    def basis(t):
        s = 1 - t
        return (s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t), (-3 * s * s, 3 * s * (s - 2 * t), 3 * t * (2 * s - t), 3 * t * t)
    for line in lines[1 + points:1 + points + patches]:
        patch = [control[int(i)] for i in line.split()]
        first = len(positions)
        for i in range(steps + 1):
            for j in range(steps + 1):
                # At the poles of knob and bottom an edge of a patch is a point, or a loop of a fraction of a millimetre that turns
                # the other way: the normal is taken a little beside it.
                for nudge in (0.0, 0.03):
                    u = min(max(i / steps, nudge), 1 - nudge)
                    v = min(max(j / steps, nudge), 1 - nudge)
                    (bu, du), (bv, dv) = basis(u), basis(v)
                    tangent_u = [sum(du[a] * bv[b] * patch[4 * a + b][k] for a in range(4) for b in range(4)) for k in range(3)]
                    tangent_v = [sum(bu[a] * dv[b] * patch[4 * a + b][k] for a in range(4) for b in range(4)) for k in range(3)]
                    n = cross(tangent_u, tangent_v)
                    if min(sum(c * c for c in t) for t in (tangent_u, tangent_v)) > 1e-4:
                        break
                (bu, _), (bv, _) = basis(i / steps), basis(j / steps)
                positions.append(tuple(sum(bu[a] * bv[b] * patch[4 * a + b][k] for a in range(4) for b in range(4)) for k in range(3)))
                normals.append(normalized(n))
        for i in range(steps):
            for j in range(steps):
                a = first + i * (steps + 1) + j
                b = a + steps + 1
                indices += [a, b, b + 1, a, b + 1, a + 1]
    return positions, normals, [], indices


def outward(shape):
    """Turns triangles and normals so that they agree, and point away from the shape's axis at most places."""
    positions, normals, uvs, indices = shape
    a, b, c = (positions[i] for i in indices[:3])
    face = cross([b[k] - a[k] for k in range(3)], [c[k] - a[k] for k in range(3)])
    center_y = sum(p[1] for p in positions) / len(positions)
    score = sum(n[0] * p[0] + n[1] * (p[1] - center_y) + n[2] * p[2] for p, n in zip(positions, normals))
    agree = sum(f * n for f, n in zip(face, normals[indices[0]]))
    if score < 0:
        normals = [tuple(-c for c in n) for n in normals]
    if (agree < 0) != (score < 0):
        indices = [i for t in range(0, len(indices), 3) for i in (indices[t], indices[t + 2], indices[t + 1])]
    return positions, normals, uvs, indices


def place(g, shape, material, uvs=True, **node):
    positions, normals, texture, indices = shape
    primitive = g.geometry(positions, normals, indices, [texture] if uvs and texture else [])
    return g.node(mesh=g.mesh({**primitive, "material": material}), **node)


def checker(dark=(70, 74, 80), light=(150, 152, 150)):
    return png(64, 64, lambda x, y: light if (x // 32 + y // 32) % 2 else dark)


def floor_material(g, **more):
    texture = g.texture(checker(), magFilter=9728)
    index = g.material("floor", roughness=0.6, **more)
    g.json["materials"][index]["pbrMetallicRoughness"]["baseColorTexture"] = {"index": texture}
    return index


def studio(g, ambient=0.12):
    """Three lights: warm key from the left, cool fill from the right, rim from behind."""
    g.light("directional", 2.6, (1.0, 0.96, 0.9), toward=(0.55, -0.75, -0.55))
    g.light("directional", 0.7, (0.7, 0.82, 1.0), toward=(-0.8, -0.35, -0.3))
    g.light("directional", 1.2, (1.0, 0.9, 0.8), toward=(-0.2, -0.5, 0.9))
    g.ambient((ambient, ambient * 1.05, ambient * 1.15))


# The gallery.

def white_plane():
    g = Gltf()
    place(g, upright(10, 10), g.material("white", brdf={"model": "lambert", "diffuse": [1, 1, 1]}), uvs=False)
    g.light("directional", 3.0, toward=(0, 0, -1))
    g.camera((0, 0, 4), (0, 0, 0))
    return g


def spheres():
    g = Gltf()
    positions, normals, _, indices = sphere(28)
    shape = g.geometry(positions, normals, indices)

    def rows(t):
        blue, orange, n = [0.1, 0.25, 0.6], [0.75, 0.3, 0.08], round(4 * 2 ** (t * 8))
        yield g.material("lambert", brdf={"model": "lambert", "diffuse": [0.15 + 0.8 * t, 0.55, 0.95 - 0.8 * t]})
        yield g.material("phong classic", brdf={"model": "phong", "ambient": blue, "diffuse": [c / 3 for c in blue], "specular": [0.25] * 3,
                                              "shininess": n})
        yield g.material("blinn_phong energy", brdf={"model": "blinn_phong", "ambient": orange, "diffuse": orange, "specular": [0.08] * 3,
                                                     "shininess": 4 * n, "normalization": "energy"})
        yield g.material("dielectric", (0.5, 0.06, 0.1), 0.0, 0.08 + 0.9 * t)
        yield g.material("gold", (1.0, 0.78, 0.34), 1.0, 0.08 + 0.9 * t)
    columns = 7
    for column in range(columns):
        for row, material in enumerate(rows(column / (columns - 1))):
            g.node(mesh=g.mesh({**shape, "material": material}), scale=[0.44] * 3, translation=[column - 3.0, 2.0 - row, 0])
    studio(g, 0.18)
    g.camera((0, 0, 9.2), (0, 0, 0), 36)
    return g


def lights():
    g = Gltf()
    wall = g.material("wall", (0.72, 0.7, 0.66), roughness=0.85)
    place(g, ground(6), wall, uvs=False)
    place(g, upright(6, 2.5), wall, uvs=False, translation=[0, 2.5, -4])
    place(g, upright(6, 2.5), wall, uvs=False, translation=[-5, 2.5, 0], rotation=axis_rotation((0, 1, 0), 90))
    place(g, upright(6, 2.5), wall, uvs=False, translation=[5, 2.5, 0], rotation=axis_rotation((0, 1, 0), -90))
    ball = g.geometry(*[sphere(28)[i] for i in (0, 1, 3)])
    for x, z, r, material in ((-2.6, -1.2, 0.8, g.material("clay", (0.8, 0.45, 0.3), roughness=0.7)),
                              (0, -1.8, 1.0, g.material("steel", (0.7, 0.72, 0.75), 1.0, 0.3)),
                              (2.6, -1.2, 0.8, g.material("lacquer", (0.05, 0.3, 0.5), roughness=0.2))):
        g.node(mesh=g.mesh({**ball, "material": material}), scale=[r] * 3, translation=[x, r, z])
    g.light("directional", 0.35, (0.7, 0.8, 1.0), toward=(0.2, -1, -0.4))
    g.light("point", 6.0, (1.0, 0.75, 0.45), (-4.2, 3.6, -3.2))
    g.light("point", 6.0, (0.4, 0.6, 1.0), (4.2, 2.2, -3.0), range=4.0)
    g.light("spot", 60.0, (1.0, 0.95, 0.85), (0, 4.8, 2.0), (0, -1, -0.75), cone=(12, 16))
    g.light("spot", 30.0, (1.0, 0.3, 0.25), (-3.5, 4.6, 1.5), (0.25, -1, -0.6), cone=(2, 22))
    g.light("spot", 30.0, (0.3, 1.0, 0.45), (3.5, 4.6, 1.5), (-0.25, -1, -0.6), cone=(21, 22))
    g.ambient((0.03, 0.032, 0.04))
    g.camera((0, 2.6, 8.6), (0, 1.7, -2), 40)
    return g


def teapots():
    g = Gltf()
    positions, normals, _, indices = outward(teapot())
    shape = g.geometry(positions, normals, indices)
    low = min(p[1] for p in positions)
    for x, z, turn, material in ((-2.0, -0.5, 20, g.material("glazed blue", (0.04, 0.12, 0.42), 0.0, 0.18)),
                                 (0.0, 0.35, -25, g.material("copper", (0.955, 0.638, 0.538), 1.0, 0.32)),
                                 (2.0, -0.5, -60, g.material("porcelain", (0.86, 0.84, 0.78), 0.0, 0.3))):
        g.node(mesh=g.mesh({**shape, "material": material}), translation=[x, -low, z], rotation=axis_rotation((0, 1, 0), turn))
    place(g, ground(12, 1.0), floor_material(g))
    studio(g, 0.2)
    g.light("spot", 40.0, (1.0, 0.9, 0.75), (-2.5, 5, 3), (0.4, -1, -0.55), cone=(8, 28))
    g.camera((0, 1.7, 5.4), (0, 0.42, 0), 33)
    return g


def textured():
    g = Gltf()

    def bricks(x, y):
        row = y // 16
        mortar = y % 16 < 2 or (x + 16 * (row % 2)) % 32 < 2
        shade = 0.85 + 0.3 * ((x // 32 * 7 + row * 13) % 5) / 5
        return (150, 146, 140) if mortar else tuple(c * shade for c in (150, 70, 52))

    def brick_normals(x, y):
        u, v = (x + 16 * (y // 16 % 2)) % 32, y % 16
        nx = 0.8 if u in (0, 31) else -0.8 if u in (2, 3) else 0.0
        ny = -0.8 if v in (0, 15) else 0.8 if v in (2, 3) else 0.0
        n = normalized((nx, ny, 1))
        return tuple(127.5 * (c + 1) for c in n)
    brick = g.texture(png(128, 128, bricks))
    relief = g.texture(png(128, 128, brick_normals))
    rough = g.texture(png(64, 64, lambda x, y: (255, 60 + 150 * ((x // 8 + y // 8) % 2), 0)))
    leaf = g.texture(png(64, 64, lambda x, y: (60, 130 + x, 40, 255 if abs(y - 31.5) < 20 * math.sin(math.pi * x / 63) * (1 - 0.25 * ((x + y // 2) % 12 < 2)) else 0), True))
    stripes = g.texture(png(32, 32, lambda x, y: (230, 200, 60) if x < 16 else (40, 60, 120)), wrapS=33071, wrapT=33648)
    ring = g.texture(png(32, 32, lambda x, y: (255, 255, 255) if 8 < math.hypot(x - 15.5, y - 15.5) < 13 else (40, 40, 40)))

    wall = g.material("bricks", roughness=1.0, normalTexture={"index": relief})
    g.json["materials"][wall]["pbrMetallicRoughness"].update(baseColorTexture={"index": brick}, metallicRoughnessTexture={"index": rough})
    positions, normals, uvs, indices = upright(4.5, 1.6)
    primitive = g.geometry(positions, normals, indices, [[(u * 5, v * 1.8) for u, v in uvs]])
    g.node(mesh=g.mesh({**primitive, "material": wall}), translation=[0, 1.6, -1.5])

    cut = g.material("leaf", roughness=0.7, alphaMode="MASK", alphaCutoff=0.5, doubleSided=True)
    g.json["materials"][cut]["pbrMetallicRoughness"]["baseColorTexture"] = {"index": leaf}
    for i in range(3):
        place(g, upright(0.5, 0.5), cut, translation=[-2.5 + 0.5 * i, 0.75 + 0.3 * (i % 2), 0.2 * i], rotation=axis_rotation((0.1, 1, 0), 30 - 40 * i))

    # Base colour through the second UV set and a texture transform; emission through the first.
    g.extension("KHR_texture_transform")
    two = g.material("two sets", roughness=0.4, emissiveFactor=[0.5, 0.35, 0.1], emissiveTexture={"index": ring})
    g.json["materials"][two]["pbrMetallicRoughness"]["baseColorTexture"] = {
        "index": stripes, "texCoord": 1, "extensions": {"KHR_texture_transform": {"offset": [0.5, 0.0], "rotation": 0.6, "scale": [2, 2]}}}
    positions, normals, uvs, indices = box(1.1, 1.1, 1.1)
    primitive = g.geometry(positions, normals, indices, [uvs, [(u * 2 - 0.5, v * 2 - 0.5) for u, v in uvs]])
    g.node(mesh=g.mesh({**primitive, "material": two}), translation=[-0.35, 0.56, 0.5], rotation=axis_rotation((0, 1, 0), 28))

    positions, normals, uvs, indices = sphere(24, 0.6)
    colors = [(0.5 + 0.5 * n[0], 0.5 + 0.5 * n[1], 0.5 + 0.5 * n[2], 1) for n in normals]
    primitive = g.geometry(positions, normals, indices, [uvs], colors)
    g.node(mesh=g.mesh({**primitive, "material": g.material("vertex colours", roughness=0.3)}), translation=[1.15, 0.6, 0.3])
    positions, normals, uvs, indices = sphere(24, 0.6)
    primitive = g.geometry(positions, normals, indices, [[(u * 6, v * 3) for u, v in uvs]])
    g.node(mesh=g.mesh({**primitive, "material": wall}), translation=[2.5, 0.6, 0.1])
    place(g, ground(8, 1.0), floor_material(g))
    studio(g, 0.15)
    g.light("point", 5.0, (1.0, 0.85, 0.6), (0.5, 2.6, 1.6))
    g.camera((0.2, 1.7, 5.8), (0.0, 0.9, 0), 37)
    return g


def blend():
    g = Gltf()
    place(g, ground(8, 0.5), floor_material(g))
    ball = g.geometry(*[sphere(28)[i] for i in (0, 1, 3)])
    for x, material in ((-1.8, g.material("red", (0.7, 0.08, 0.06), roughness=0.3)), (0, g.material("chrome", (0.8, 0.8, 0.82), 1.0, 0.2)),
                        (1.8, g.material("green", (0.1, 0.5, 0.15), roughness=0.3))):
        g.node(mesh=g.mesh({**ball, "material": material}), scale=[0.7] * 3, translation=[x, 0.7, -1.2])
    panes = ((-1.6, 0.9, (1.0, 0.75, 0.1), 0.45), (0.0, 1.3, (0.1, 0.45, 1.0), 0.45), (1.6, 0.9, (0.95, 0.15, 0.5), 0.45), (0.9, 1.9, (0.9, 0.95, 1.0), 0.2))
    for number, (x, z, color, alpha) in enumerate(panes):
        material = g.material(f"pane {number}", color, 0.0, 0.15, alpha, alphaMode="BLEND", doubleSided=True)
        place(g, upright(0.95, 0.85), material, uvs=False, translation=[x, 0.9, z - 0.6], rotation=axis_rotation((0, 1, 0), 12 - 8 * number))
    studio(g, 0.2)
    g.light("spot", 50.0, (1.0, 0.95, 0.9), (1.5, 5.5, 3.0), (-0.25, -1, -0.65), cone=(10, 26))
    g.camera((0, 1.9, 6.2), (0, 0.8, 0), 38)
    return g


def many_lights():
    g = Gltf()
    floor = g.material("floor", (0.6, 0.6, 0.62), 0.0, 0.45)
    place(g, ground(20), floor, uvs=False)
    ball = g.geometry(*[sphere(16)[i] for i in (0, 1, 3)])
    materials = [g.material("white", (0.85, 0.85, 0.85), 0.0, 0.3), g.material("metal", (0.85, 0.8, 0.75), 1.0, 0.25)]
    for i in range(7):
        for j in range(7):
            g.node(mesh=g.mesh({**ball, "material": materials[(i + j) % 2]}), scale=[0.5] * 3, translation=[2.4 * (i - 3), 0.5, 2.4 * (j - 3)])
    dice = random.Random(4)
    for _ in range(100):
        hue = dice.random() * 6
        color = [max(0.0, min(1.0, abs((hue + shift) % 6 - 3) - 1)) * 0.85 + 0.15 for shift in (0, 4, 2)]
        g.light("point", 2.2, color, (dice.uniform(-9.5, 9.5), dice.uniform(0.35, 1.5), dice.uniform(-9.5, 9.5)), range=3.2)
    g.ambient((0.01, 0.01, 0.015))
    g.camera((0, 7.5, 13), (0, 0, 1), 40, 0.1)
    return g


def animated():
    g = Gltf()
    place(g, ground(6, 0.5), floor_material(g))
    # A bending post: one joint at its foot, one at half its height, weights that blend along it.
    rings, around = 17, 20
    positions, normals, joints, weights, indices = [], [], [], [], []
    for r in range(rings):
        for a in range(around + 1):
            angle = 2 * math.pi * a / around
            y = 2.0 * r / (rings - 1)
            positions.append((0.22 * math.cos(angle), y, -0.22 * math.sin(angle)))
            normals.append((math.cos(angle), 0, -math.sin(angle)))
            upper = min(max((y - 0.6) / 0.8, 0.0), 1.0)
            joints += [0, 1, 0, 0]
            weights += [1 - upper, upper, 0, 0]
    for r in range(rings - 1):
        for a in range(around):
            p = r * (around + 1) + a
            q = p + around + 1
            indices += [p, p + 1, q + 1, p, q + 1, q]
    primitive = g.geometry(positions, normals, indices)
    primitive["attributes"]["JOINTS_0"] = g.accessor(joints, "VEC4", "B")
    primitive["attributes"]["WEIGHTS_0"] = g.accessor(weights, "VEC4")
    primitive["material"] = g.material("post", (0.2, 0.5, 0.3), 0.0, 0.35)
    tip = g.node(root=False, translation=[0, 1, 0])
    foot = g.node(root=False, children=[tip])
    inverse = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1]
    g.json["skins"] = [{"joints": [foot, tip], "skeleton": foot, "inverseBindMatrices": g.accessor(inverse, "MAT4")}]
    g.node(translation=[-1.4, 0, 0], children=[foot, g.node(root=False, mesh=g.mesh(primitive), skin=0)])

    positions, normals, _, indices = sphere(24, 0.7)
    primitive = g.geometry(positions, normals, indices)
    primitive["material"] = g.material("morph", (0.75, 0.3, 0.15), 0.0, 0.3)
    spikes = [[0.45 * n[k] * max(0.0, math.cos(4 * math.atan2(n[2], n[0])) * (1 - n[1] ** 2)) for k in range(3)] for n in normals]
    primitive["targets"] = [{"POSITION": g.accessor([c for s in spikes for c in s], "VEC3", bounds=True)}]
    morph_mesh = g.mesh(primitive)
    g.json["meshes"][morph_mesh]["weights"] = [0]
    morph = g.node(mesh=morph_mesh, translation=[0.4, 0.95, 0])
    spinner = place(g, box(0.7, 0.7, 0.7), g.material("spinner", (0.2, 0.3, 0.7), 0.0, 0.3), uvs=False, translation=[2.0, 0.8, 0])

    times = g.accessor([0, 1, 2], "SCALAR", bounds=True)
    bend = g.accessor([c for d in (0, 70, 0) for c in axis_rotation((0, 0, 1), -d)], "VEC4")
    spin = g.accessor([c for d in (0, 120, 240) for c in axis_rotation((1, 1, 0), d)], "VEC4")
    weight = g.accessor([0, 1, 0], "SCALAR")
    g.json["animations"] = [{"name": "all", "samplers": [{"input": times, "output": o, "interpolation": "LINEAR"} for o in (bend, spin, weight)],
                             "channels": [{"sampler": 0, "target": {"node": tip, "path": "rotation"}},
                                          {"sampler": 1, "target": {"node": spinner, "path": "rotation"}},
                                          {"sampler": 2, "target": {"node": morph, "path": "weights"}}]}]
    studio(g, 0.18)
    g.light("point", 4.0, (1.0, 0.85, 0.65), (0.5, 2.8, 2.0))
    g.camera((0.2, 1.9, 5.6), (0.15, 0.95, 0), 36)
    return g


def lathe(profile, around=36):
    """A profile of (radius, height) from the foot to the rim and down the inside, turned about Y; normals from its tangents."""
    positions, normals, uvs, indices = [], [], [], []
    lengths = [0.0]
    for (r0, y0), (r1, y1) in zip(profile, profile[1:]):
        lengths.append(lengths[-1] + math.hypot(r1 - r0, y1 - y0))
    for i, (r, y) in enumerate(profile):
        (ra, ya), (rb, yb) = profile[max(i - 1, 0)], profile[min(i + 1, len(profile) - 1)]
        nr, ny, _ = normalized((yb - ya, ra - rb, 0))
        for a in range(around + 1):
            angle = 2 * math.pi * a / around
            c, s = math.cos(angle), math.sin(angle)
            positions.append((r * c, y, -r * s))
            normals.append((nr * c, ny, -nr * s))
            uvs.append((a / around, 1 - lengths[i] / lengths[-1]))
    for i in range(len(profile) - 1):
        for a in range(around):
            p = i * (around + 1) + a
            q = p + around + 1
            indices += [p, p + 1, q + 1, p, q + 1, q]
    return positions, normals, uvs, indices


def curve(points, steps):
    """A Catmull-Rom spline through the points."""
    result = []
    for i in range(len(points) - 1):
        a, b, c, d = (points[min(max(k, 0), len(points) - 1)] for k in (i - 1, i, i + 1, i + 2))
        for j in range(steps):
            t = j / steps
            result.append(tuple(0.5 * (2 * b[k] + (c[k] - a[k]) * t + (2 * a[k] - 5 * b[k] + 4 * c[k] - d[k]) * t * t
                                       + (3 * b[k] - a[k] - 3 * c[k] + d[k]) * t ** 3) for k in range(2)))
    return result + [points[-1]]


def cook_torrance(fresnel, m, diffuse=(0, 0, 0), specular=(1, 1, 1)):
    return {"model": "cook_torrance", "diffuse": list(diffuse), "specular": list(specular), "m": m, "fresnel": fresnel}


def metal(name):
    return {"type": "metal", "name": name}


PAPER = "R. L. Cook and K. E. Torrance, ACM TOG 1(1), 1982"
WARD = "G. Ward, SIGGRAPH 1992, table of fitted materials"
INDEX = "index: Palik and others, as in Lobe's table of metals"


def vase_materials():
    """Name, model and where its numbers are from; what is no measurement is called an estimate."""
    yield "carbon", cook_torrance({"type": "conductor", "eta": [2.7] * 3, "k": [1.4] * 3}, 0.4, [0.02] * 3, [0.35] * 3), "all estimates, after graphite"
    yield "rubber", cook_torrance({"type": "dielectric", "eta": 1.52}, 0.3, [0.045, 0.042, 0.04]), "all estimates; index of natural rubber"
    yield "obsidian", cook_torrance({"type": "dielectric", "eta": 1.49}, 0.12, [0.006, 0.006, 0.008]), "all estimates; index of volcanic glass"
    yield "lunar dust", {"model": "oren_nayar", "diffuse": [0.125, 0.12, 0.11], "sigma": 0.6}, "reflectance near the Moon's geometric albedo of 0.12; sigma an estimate"
    yield "olive drab", cook_torrance({"type": "dielectric", "eta": 1.5}, 0.5, [0.1, 0.1, 0.045]), "all estimates"
    yield "rust", cook_torrance({"type": "dielectric", "eta": 2.0}, 0.45, [0.28, 0.085, 0.03], [0.4] * 3), "all estimates"
    yield "bronze", cook_torrance({"type": "schlick", "f0": [0.8, 0.58, 0.35]}, 0.25), "all estimates"
    yield "tungsten", cook_torrance(metal("tungsten"), 0.3), INDEX + "; m an estimate"
    yield "copper", cook_torrance(metal("copper"), 0.28), INDEX + f"; m the weighted mean of the two slopes of the copper vase of {PAPER} (0.4 and 0.2 with weights 0.4 and 0.6, not checked against print)"
    yield "tin", cook_torrance({"type": "conductor", "eta": [1.5, 1.3, 1.2], "k": [5.3, 4.7, 4.2]}, 0.35), "all estimates"
    yield "nickel", cook_torrance(metal("nickel"), 0.2), INDEX + "; m an estimate"
    yield "stainless steel", cook_torrance({"type": "conductor", "eta": [2.76, 2.54, 2.27], "k": [3.79, 3.43, 3.04]}, 0.15), "all estimates"
    yield "gold", cook_torrance(metal("gold"), 0.25), INDEX + "; m an estimate"
    yield "titanium nitride", cook_torrance(metal("titanium nitride"), 0.3), INDEX + "; m an estimate"
    yield "rolled brass", {"model": "ward_anisotropic", "diffuse": [0.10, 0.075, 0.03], "specular": [0.33, 0.25, 0.1], "alphaX": 0.16, "alphaY": 0.05}, WARD + " (0.10, 0.33, 0.050, 0.16); its colour an estimate"
    yield "white ceramic tile", {"model": "ward", "diffuse": [0.70] * 3, "specular": [0.05] * 3, "alpha": 0.071}, WARD


def vases():
    g = Gltf()
    outside = curve([(0.0, 0.0), (0.2, 0.0), (0.24, 0.03), (0.2, 0.1), (0.26, 0.25), (0.385, 0.52), (0.36, 0.76), (0.2, 0.95), (0.15, 1.06), (0.19, 1.16), (0.25, 1.2)], 5)
    inside = curve([(0.25, 1.2), (0.235, 1.205), (0.175, 1.155), (0.135, 1.06), (0.18, 0.93)], 3)
    positions, normals, uvs, indices = lathe(outside[5:] + inside[1:])
    shape = g.geometry(positions, normals, indices, [uvs])
    board = g.geometry(*[box(1, 1, 1)[i] for i in (0, 1, 3)])
    wood = g.material("shelf", brdf={"model": "oren_nayar", "diffuse": [0.17, 0.092, 0.05], "sigma": 0.35})
    back = g.material("back", brdf={"model": "oren_nayar", "diffuse": [0.085, 0.11, 0.125], "sigma": 0.35})
    wall = g.material("wall", brdf={"model": "oren_nayar", "diffuse": [0.115, 0.11, 0.1], "sigma": 0.35})
    width, height, depth, thick = 1.45, 1.42, 0.95, 0.06

    def slab(material, x, y, z, sx, sy, sz):
        g.node(mesh=g.mesh({**board, "material": material}), scale=[sx, sy, sz], translation=[x, y, z])
    for i in range(5):
        slab(wood, 0, i * height - thick / 2, 0, 4 * width + thick, thick, depth)
        slab(wood, (i - 2) * width, 2 * height - thick / 2, -0.02, thick, 4 * height, depth - 0.04)
    slab(back, 0, 2 * height, -depth / 2, 4 * width, 4 * height, 0.02)
    place(g, upright(14, 8), wall, uvs=False, translation=[0, 2 * height, -depth / 2])
    for i, (name, brdf, source) in enumerate(vase_materials()):
        material = g.material(name, brdf=brdf, extras={"source": source})
        g.node(name=name, mesh=g.mesh({**shape, "material": material}), translation=[(i % 4 - 1.5) * width, (3 - i // 4) * height, 0.02])
    middle = 2 * height
    # Lamps that stand well before the shelves: each vase shows one highlight of each.
    g.light("point", 135.0, (1.0, 0.93, 0.84), (-5.5, middle + 4.0, 7.0))
    g.light("point", 62.0, (0.75, 0.86, 1.0), (7.0, middle + 0.5, 5.0))
    g.light("spot", 75.0, (1.0, 0.9, 0.76), (0.0, middle + 5.5, 5.0), (0, -0.9, -0.85), cone=(10, 36))
    g.light("point", 20.0, (1.0, 0.8, 0.6), (-6.0, middle - 2.5, 2.6))
    g.light("point", 20.0, (0.8, 0.9, 1.0), (5.8, middle + 3.0, 2.6))
    g.ambient((0.15, 0.155, 0.17))
    g.camera((0.6, middle + 0.1, 11.0), (0, middle - 0.03, 0), 31)
    return g


def averaged_normals(positions, indices):
    """The facets' normals, weighted by area, averaged over all corners at one place."""
    def key(p):
        return tuple(round(c, 5) for c in p)
    sums = {}
    for t in range(0, len(indices), 3):
        a, b, c = (positions[i] for i in indices[t:t + 3])
        n = cross([b[k] - a[k] for k in range(3)], [c[k] - a[k] for k in range(3)])
        for p in (a, b, c):
            total = sums.setdefault(key(p), [0.0, 0.0, 0.0])
            for k in range(3):
                total[k] += n[k]
    return [normalized(sums[key(p)]) for p in positions]


def teapot_normals():
    g = Gltf()
    positions, normals, _, indices = outward(teapot(5))
    glaze = g.material("glaze", brdf={"model": "cook_torrance", "diffuse": [0.5, 0.16, 0.07], "specular": [1] * 3, "m": 0.22,
                                      "fresnel": {"type": "dielectric", "eta": 1.6}})
    exact = g.geometry(positions, normals, indices)
    averaged = {**exact, "attributes": {**exact["attributes"], "NORMAL": g.accessor([c for n in averaged_normals(positions, indices) for c in n], "VEC3")}}
    flat = {**exact, "attributes": {"POSITION": exact["attributes"]["POSITION"]}}  # glTF: without normals, facets are flat
    low = min(p[1] for p in positions)
    for x, name, shape in ((-1.9, "flat", flat), (0.0, "interpolated", exact), (1.9, "averaged", averaged)):
        g.node(name=name, mesh=g.mesh({**shape, "material": glaze}), translation=[x, -low, 0], rotation=axis_rotation((0, 1, 0), -28))
    place(g, ground(30), g.material("table", brdf={"model": "lambert", "diffuse": [0.035, 0.045, 0.05]}), uvs=False)
    studio(g, 0.16)
    g.light("spot", 90.0, (1.0, 0.92, 0.8), (-3.0, 5.5, 4.5), (0.5, -1, -0.8), cone=(8, 34))
    g.camera((0.05, 2.7, 7.4), (0.05, 0.36, 0), 26)
    return g


def merl_table(path, shape, reflectance):
    """A small table in the layout of the MERL database: sizes, then red, green and blue of f(theta_h, theta_d), none of phi_d."""
    nh, nd = shape
    cells = [reflectance(math.pi / 2 * ((h + 0.5) / nh) ** 2, math.pi / 2 * (d + 0.5) / nd) for h in range(nh) for d in range(nd)]
    scale = (1500.0, 1500.0 / 1.15, 1500.0 / 1.66)
    values = [float(f"{cell[c] * scale[c]:.9g}") for c in range(3) for cell in cells]
    path.write_bytes(struct.pack("<3i", nh, nd, 1) + struct.pack(f"<{len(values)}d", *values))


def metallic_paint(theta_h, theta_d):
    """A made-up paint: flakes of two slopes under a lacquer over a diffuse ground."""
    t2 = math.tan(theta_h) ** 2
    flakes = sum(w * math.exp(-min(t2 / (m * m), 700.0)) / (m * m * math.cos(theta_h) ** 4) for w, m in ((0.35, 0.45), (0.02, 0.08)))
    schlick = 0.04 + 0.96 * (1 - math.cos(theta_d)) ** 5
    return tuple(ground / math.pi + 0.25 / math.pi * flakes * (tint * (1 - schlick) + schlick) for ground, tint in zip((0.02, 0.06, 0.1), (0.25, 0.5, 0.75)))


# What a sphere of each model is made of; models that have no entry take their defaults.
MODELS = {
    "lambert": {"diffuse": [0.6, 0.3, 0.2]},
    "mirror": {"fresnel": metal("silver")},
    "phong": {"ambient": [0.1, 0.2, 0.5], "diffuse": [0.05, 0.1, 0.25], "specular": [0.25] * 3, "shininess": 30},
    "blinn_phong": {"ambient": [0.55, 0.3, 0.06], "diffuse": [0.55, 0.3, 0.06], "specular": [0.15] * 3, "shininess": 120, "normalization": "energy"},
    "cook_torrance": {"m": 0.25, "fresnel": metal("copper")},
    "beckmann_smith": {"m": 0.25, "fresnel": metal("gold")},
    "ggx": {"alphaX": 0.45, "alphaY": 0.12, "fresnel": metal("nickel")},
    "he": {"diffuse": [0.02] * 3, "sigma": 0.28e-6, "tau": 1.77e-6, "fresnel": metal("aluminium")},
    "ward": {"diffuse": [0.25, 0.04, 0.05], "specular": [0.047] * 3, "alpha": 0.088},
    "ward_anisotropic": {"diffuse": [0.10, 0.075, 0.03], "specular": [0.33, 0.25, 0.1], "alphaX": 0.16, "alphaY": 0.05},
    "lafortune": {"preset": "bluepaint"},
    "measured": {"file": "data/metallic_paint.binary"},
    "metallic_roughness": {"baseColor": [0.9, 0.55, 0.2], "metallic": 1.0, "roughness": 0.45},
    "oren_nayar": {"diffuse": [0.7, 0.66, 0.6], "sigma": 0.6},
    "thin_transmission": {"baseColor": [0.35, 0.6, 0.85], "metallic": 0.0, "roughness": 0.3},
    "ashikhmin_shirley": {"diffuse": [0.08, 0.3, 0.12], "specular": [0.12] * 3, "nu": 600, "nv": 30},
}


def models():
    """A sphere for every model of shaders/glsl/brdf, which holds a file for each that is registered."""
    g = Gltf()
    positions, normals, uvs, indices = sphere(28)
    shape = g.geometry(positions, normals, indices, [uvs])
    names = sorted(path.stem for path in (HERE / "../shaders/glsl/brdf").glob("*.glsl"))
    columns = 6
    rows = -(-len(names) // columns)
    for i, name in enumerate(names):
        material = g.material(name, brdf={"model": name, **MODELS.get(name, {})})
        g.node(name=name, mesh=g.mesh({**shape, "material": material}), scale=[0.46] * 3,
               translation=[i % columns - (columns - 1) / 2, (rows - 1) / 2 - i // columns, 0])
    wall = g.material("wall", brdf={"model": "oren_nayar", "diffuse": [0.12, 0.125, 0.13], "sigma": 0.4})
    place(g, upright(8, 6), wall, uvs=False, translation=[0, 0, -0.75])
    studio(g, 0.2)
    g.light("point", 14.0, (1.0, 0.95, 0.9), (0.5, 3.2, 4.0))
    g.camera((0, 0, 7.6), (0, 0, 0), 26)
    return g


# The stiff ones: no NaN, no infinity, no crash.

def ball_scene(material, scale=1.0, offset=(0, 0, 0), with_light=True):
    g = Gltf()
    positions, normals, _, indices = sphere(20)
    primitive = {**g.geometry(positions, normals, indices), "material": material(g)}
    center = list(offset)
    g.node(mesh=g.mesh(primitive), scale=[scale] * 3, translation=center)
    if with_light:
        g.light("directional", 3.0, toward=(0.4, -0.5, -1))
        g.light("point", 4.0 * scale * scale, position=[c + d * scale for c, d in zip(center, (2, 2, 2))])
    g.camera([c + d * scale for c, d in zip(center, (0, 0, 4))], center, 40, 0.01 * scale)
    return g


def soft_light():
    """A ball on the ground under one rectangular light."""
    g = Gltf()
    place(g, ground(4), g.material("ground", (0.6, 0.6, 0.6), 0.0, 0.6), uvs=False)
    place(g, sphere(48, 0.8), g.material("ball", (0.8, 0.35, 0.2), 0.0, 0.35), translation=(0, 0.8, 0), uvs=False)
    g.area_light("rect", 12.0, 1.2, (-1.2, 3.0, 0.8), (0.4, -1, -0.25), aspect=1.5)
    g.camera((0, 1.8, 4.6), (0, 0.6, 0))
    return g


def interior():
    """A room with one light of each type that has a body, and balls of several models."""
    g = Gltf()
    wall = g.material("wall", (0.7, 0.68, 0.64), 0.0, 0.9)
    turned = axis_rotation
    floor = g.material("floor", (0.35, 0.28, 0.22), 0.0, 0.35)
    place(g, upright(3, 3), floor, translation=(0, 0, 0), rotation=turned((1, 0, 0), -90), uvs=False)
    place(g, upright(3, 3), wall, translation=(0, 3, 0), rotation=turned((1, 0, 0), 90), uvs=False)
    place(g, upright(3, 1.5), wall, translation=(0, 1.5, -3), uvs=False)
    place(g, upright(3, 1.5), g.material("red wall", (0.7, 0.25, 0.2), 0.0, 0.9), translation=(-3, 1.5, 0), rotation=turned((0, 1, 0), 90), uvs=False)
    place(g, upright(3, 1.5), g.material("blue wall", (0.2, 0.3, 0.65), 0.0, 0.9), translation=(3, 1.5, 0), rotation=turned((0, 1, 0), -90), uvs=False)
    balls = (("lambert", {"diffuse": [0.7, 0.7, 0.7]}),
             ("ggx", {"alphaX": 0.15, "alphaY": 0.15, "fresnel": {"type": "metal", "name": "gold"}}),
             ("cook_torrance", {"m": 0.25, "fresnel": {"type": "metal", "name": "copper"}}),
             ("ward", {"diffuse": [0.1, 0.3, 0.15], "specular": [0.2, 0.2, 0.2], "alpha": 0.2}),
             ("phong", {"diffuse": [0.2, 0.2, 0.5], "specular": [0.4, 0.4, 0.4], "shininess": 60, "normalization": "energy"}))
    for i, (model, parameters) in enumerate(balls):
        place(g, sphere(32, 0.42), g.material(model, brdf={"model": model, **parameters}), translation=(-2.0 + i, 0.42, 0.35 * (-1) ** i), uvs=False)
    place(g, box(0.9, 1.1, 0.5), g.material("crate", (0.5, 0.4, 0.3), 0.0, 0.7), translation=(1.6, 0.55, -1.9), rotation=turned((0, 1, 0), 25), uvs=False)
    g.area_light("rect", 6.0, 0.8, (0, 2.98, -0.5), (0, -1, 0), aspect=1.6)
    g.area_light("disk", 8.0, 0.5, (-2.8, 1.9, -1.0), (1, -0.45, 0.3), color=(1, 0.8, 0.55))
    g.light("point", 0.9, color=(0.6, 0.8, 1), position=(1.6, 1.35, -1.9), shape={"shape": "sphere", "radius": 0.12})
    g.light("point", 0.8, color=(1, 0.6, 0.7), position=(0, 1.1, -2.85), shape={"shape": "tube", "radius": 0.03, "length": 1.6})
    g.camera((0, 1.5, 4.9), (0, 1.05, -0.5), degrees=42)
    return g


def balls_of_models():
    """A ball for every model on the ground, five a row in the order of their names, the first row at the back."""
    g = Gltf()
    positions, normals, uvs, indices = sphere(28)
    shape = g.geometry(positions, normals, indices, [uvs])
    for i, name in enumerate(sorted(path.stem for path in (HERE / "../shaders/glsl/brdf").glob("*.glsl"))):
        parameters = dict(MODELS.get(name, {}))
        if "file" in parameters:
            parameters["file"] = pathlib.Path(parameters["file"]).name  # beside the scene: paths may not leave its folder
        material = g.material(name, brdf={"model": name, **parameters})
        g.node(name=name, mesh=g.mesh({**shape, "material": material}), scale=[0.42] * 3,
               translation=[1.1 * (i % 5 - 2), 0.42, 1.2 * (i // 5 - 1)])
    place(g, ground(5), g.material("ground", brdf={"model": "lambert", "diffuse": [0.3, 0.31, 0.33]}), uvs=False)
    g.camera((0, 3.0, 5.6), (0, 0.25, -0.1), 40)
    return g


def rect_light():
    g = balls_of_models()
    g.area_light("rect", 22.0, 0.8, (-1.3, 2.4, 1.6), (0.45, -1, -0.6), aspect=2)
    return g


def disk_light():
    g = balls_of_models()
    g.area_light("disk", 32.0, 1.1, (1.6, 2.4, 1.4), (-0.5, -1, -0.55))
    return g


def sphere_light():
    g = balls_of_models()
    g.light("point", 20.0, position=(-0.9, 2.2, 1.9), shape={"shape": "sphere", "radius": 0.35})
    return g


def tube_light():
    g = balls_of_models()
    g.light("point", 18.0, position=(0, 1.9, 1.9), shape={"shape": "tube", "radius": 0.05, "length": 3.0})
    return g


def shadow_stage(g):
    """Casters of every kind on a floor: thin, round, pierced, one that touches the floor and one that floats."""
    place(g, ground(6), g.material("floor", (0.66, 0.65, 0.62), 0.0, 0.9), uvs=False)
    place(g, box(0.8, 1.6, 0.8), g.material("block", (0.55, 0.32, 0.2), 0.0, 0.7), translation=(-1.7, 0.8, -0.9), rotation=axis_rotation((0, 1, 0), 30),
          uvs=False)
    place(g, sphere(40, 0.6), g.material("ball", (0.2, 0.4, 0.6), 0.0, 0.35), translation=(0.1, 0.6, 0.2), uvs=False)
    place(g, sphere(24, 0.25), g.material("small ball", brdf={"model": "ward", "diffuse": [0.4, 0.1, 0.1], "specular": [0.15] * 3, "alpha": 0.2}),
          translation=(1.2, 1.3, 0.1), uvs=False)
    post = g.material("post", (0.5, 0.5, 0.5), 0.0, 0.5)
    for i in range(4):
        place(g, box(0.05, 1.5, 0.05), post, translation=(1.0 + 0.35 * i, 0.75, -1.2), uvs=False)
    place(g, box(1.2, 0.05, 0.05), post, translation=(1.52, 1.52, -1.2), uvs=False)
    g.camera((0.4, 2.6, 5.4), (0.1, 0.5, -0.2), 38)


def shadow_directional():
    """Two suns, one of them low."""
    g = Gltf()
    shadow_stage(g)
    g.light("directional", 2.2, (1.0, 0.95, 0.85), toward=(0.6, -0.8, -0.35))
    g.light("directional", 0.8, (0.6, 0.75, 1.0), toward=(-1.0, -0.28, 0.12))
    return g


def shadow_point():
    """A point light among the things, one with a range, and one that casts no shadows."""
    g = Gltf()
    shadow_stage(g)
    g.light("point", 7.0, (1.0, 0.85, 0.6), (-0.6, 1.5, 1.3))
    g.light("point", 6.0, (0.5, 0.7, 1.0), (2.6, 2.2, 0.4), range=5.0)
    g.light("point", 1.2, (1.0, 1.0, 1.0), (0.0, 4.0, 3.0))
    g.extension("LOBE_shadow")
    g.json["nodes"][-1]["extensions"]["LOBE_shadow"] = {"cast": False}
    return g


def shadow_spot():
    """Three spots whose cones cross."""
    g = Gltf()
    shadow_stage(g)
    g.light("spot", 70.0, (1.0, 0.4, 0.3), (-3.5, 3.4, 2.2), (0.75, -0.75, -0.5), cone=(12, 20))
    g.light("spot", 70.0, (0.35, 1.0, 0.45), (3.4, 3.4, 2.2), (-0.7, -0.75, -0.55), cone=(19, 20))
    g.light("spot", 60.0, (0.4, 0.55, 1.0), (0.4, 4.5, -2.6), (0, -1, 0.55), cone=(2, 24))
    return g


def shadow_fence():
    """Alpha-masked wire and a leaf, and blended panes, before a light of each type."""
    g = Gltf()
    shadow_stage(g)
    wire = g.texture(png(64, 64, lambda x, y: (120, 125, 120, 255 if min((x + y) % 32, (x - y) % 32) < 5 else 0), True))
    mesh = g.material("wire", roughness=0.5, alphaMode="MASK", alphaCutoff=0.5, doubleSided=True)
    g.json["materials"][mesh]["pbrMetallicRoughness"]["baseColorTexture"] = {"index": wire}
    positions, normals, uvs, indices = upright(1.6, 0.7)
    place(g, (positions, normals, [(u * 6.4, v * 2.8) for u, v in uvs], indices), mesh, translation=(-0.4, 0.7, 1.5), rotation=axis_rotation((0, 1, 0), -14))
    leaf = g.texture(png(32, 32, lambda x, y: (60, 150, 50, 255 * max(0, 1 - math.hypot(x - 15.5, y - 15.5) / 15)), True), wrapS=33071, wrapT=33071)
    cut = g.material("leaf", roughness=0.6, alphaMode="MASK", alphaCutoff=0.4, doubleSided=True)
    g.json["materials"][cut]["pbrMetallicRoughness"]["baseColorTexture"] = {"index": leaf}
    place(g, upright(0.5, 0.5), cut, translation=(2.1, 1.6, 0.9), rotation=axis_rotation((1, 0.2, 0), -60))
    for i, (x, color, alpha) in enumerate(((-2.6, (0.9, 0.5, 0.1), 0.6), (-2.1, (0.1, 0.4, 0.9), 0.3))):
        pane = g.material(f"pane {i}", color, 0.0, 0.3, alpha, alphaMode="BLEND", doubleSided=True)
        place(g, upright(0.5, 0.6), pane, uvs=False, translation=(x, 0.65, 0.6 - 0.5 * i), rotation=axis_rotation((0, 1, 0), 40))
    g.light("directional", 1.4, (1.0, 0.95, 0.85), toward=(0.35, -0.8, -0.75))
    g.light("point", 4.0, (1.0, 0.7, 0.45), (-1.4, 1.6, 2.9))
    g.light("spot", 50.0, (0.5, 0.7, 1.0), (3.6, 3.2, 2.6), (-0.7, -0.65, -0.6), cone=(14, 24))
    return g


# Fog, and surfaces that are seen through.

def colonnade(g):
    """Two rows of pillars that lead away, with a ball before them."""
    place(g, ground(60, 2), floor_material(g), translation=(0, 0, -40))
    stone = g.material("stone", (0.62, 0.58, 0.52), 0.0, 0.8)
    for i in range(12):
        for side in (-1, 1):
            place(g, box(0.6, 3.2, 0.6), stone, translation=(side * 2.0, 1.6, 1.0 - 3.0 * i), uvs=False)
    place(g, sphere(32, 0.7), g.material("ball", (0.75, 0.2, 0.12), 0.0, 0.35), translation=(0.2, 0.7, -1.5), uvs=False)
    g.light("directional", 2.6, (1.0, 0.95, 0.85), toward=(-0.5, -0.8, -0.35))
    g.ambient((0.16, 0.18, 0.2))
    g.camera((0, 1.7, 5.0), (0, 1.45, -5), 50)


def even_fog():
    g = Gltf()
    colonnade(g)
    g.fog((0.06, 0.055, 0.05), (0.5, 0.56, 0.62))
    return g


def height_fog():
    g = Gltf()
    colonnade(g)
    g.fog((0.35, 0.33, 0.3), (0.5, 0.56, 0.62), heightFalloff=1.6, height=0)
    return g


def airlight():
    """A lamp post, two spots and a lantern in haze at night."""
    g = Gltf()
    place(g, ground(30, 1), floor_material(g), translation=(0, 0, -10))
    stone = g.material("stone", (0.62, 0.58, 0.52), 0.0, 0.8)
    for x, z in ((-2.6, -3), (2.6, -3), (-2.6, -7), (2.6, -7)):
        place(g, box(0.5, 3.0, 0.5), stone, translation=(x, 1.5, z), uvs=False)
    place(g, sphere(32, 0.6), g.material("ball", (0.3, 0.45, 0.7), 0.0, 0.3), translation=(-0.6, 0.6, -2.0), uvs=False)
    g.light("spot", 90.0, (1.0, 0.85, 0.6), position=(-2.2, 4.4, -3.4), toward=(0.62, -1, 0.3), cone=(9, 16))
    g.light("spot", 70.0, (0.55, 0.7, 1.0), position=(2.4, 4.2, -5.0), toward=(-0.5, -1, 0.1), cone=(4, 10))
    g.light("point", 5.0, (1.0, 0.55, 0.25), position=(1.5, 1.4, -1.8))
    g.ambient((0.012, 0.014, 0.02))
    g.fog((0.07, 0.07, 0.07), (0.004, 0.005, 0.008), scattering=[0.06, 0.06, 0.06], anisotropy=0.35)
    g.camera((0.3, 1.6, 4.2), (0, 1.5, -4), 50)
    return g


def panes():
    """Panes that cut each other and a ball, which no order of whole objects gets right: --transparency peeled."""
    g = Gltf()
    place(g, ground(12, 1), floor_material(g))
    place(g, sphere(40, 0.8), g.material("ball", (0.85, 0.8, 0.7), 0.0, 0.4), translation=(0, 1.1, 0), uvs=False)
    for name, color, angle, alpha in (("red", (0.9, 0.12, 0.08), 20, 0.5), ("green", (0.1, 0.75, 0.2), 80, 0.45), ("blue", (0.12, 0.25, 0.9), 140, 0.55)):
        pane = g.material(name, color, 0.0, 0.25, alpha, alphaMode="BLEND", doubleSided=True)
        place(g, upright(1.5, 1.05), pane, translation=(0, 1.1, 0), rotation=axis_rotation((0, 1, 0), angle), uvs=False)
    shell = g.material("shell", (0.9, 0.75, 0.2), 0.0, 0.3, 0.35, alphaMode="BLEND", doubleSided=True)
    place(g, sphere(32, 0.45), shell, translation=(1.6, 0.46, 1.1), uvs=False)
    studio(g)
    g.camera((0.8, 2.3, 5.0), (0.1, 0.9, 0), 38)
    return g


def glass():
    """Coloured panes without thickness, one behind the other and across (KHR_materials_transmission)."""
    g = Gltf()
    place(g, ground(12, 1), floor_material(g))
    place(g, sphere(40, 0.7), g.material("ball", (0.85, 0.82, 0.78), 0.0, 0.5), translation=(0, 0.7, -0.8), uvs=False)
    place(g, sphere(40, 0.45), g.material("gold", (1.0, 0.77, 0.34), 1.0, 0.3), translation=(1.3, 0.45, -0.4), uvs=False)
    for name, color, x, angle in (("ruby", (0.95, 0.15, 0.12), -0.55, 12), ("amber", (0.98, 0.7, 0.15), 0.35, -25), ("emerald", (0.2, 0.85, 0.4), 0.15, 55)):
        pane = g.material(name, color, 0.0, 0.08, transmission=0.92, doubleSided=True)
        place(g, upright(0.75, 0.8), pane, translation=(x, 0.82, 0.7), rotation=axis_rotation((0, 1, 0), angle), uvs=False)
    studio(g)
    g.camera((0.4, 1.5, 4.4), (0.1, 0.75, 0), 38)
    return g


def extreme():
    shiny = {"model": "blinn_phong", "diffuse": [0.2] * 3, "specular": [0.8] * 3, "shininess": 1e6, "normalization": "energy"}
    yield "roughness_0", ball_scene(lambda g: g.material("mirror-like", (0.9, 0.9, 0.9), 1.0, 0.0))
    yield "roughness_1e-5", ball_scene(lambda g: g.material("nearly", (0.9, 0.9, 0.9), 1.0, 1e-5))
    yield "shininess_1e6", ball_scene(lambda g: g.material("shiny", brdf=shiny))
    for name, scale in (("tiny", 1e-6), ("huge", 1e6)):
        yield f"scale_{name}", ball_scene(lambda g: g.material("ball", (0.7, 0.4, 0.2), 0.3, 0.4), scale)
    yield "far_from_origin", ball_scene(lambda g: g.material("ball", (0.7, 0.4, 0.2), 0.3, 0.4), 1.0, (1e6, 1e6, -1e6))

    g = Gltf()
    place(g, ground(1), g.material("floor", (0.8, 0.8, 0.8), 0.0, 0.3), uvs=False)
    for x, height in ((-0.5, 1e-6), (0.0, 1e-3), (0.5, 0.0)):
        g.light("point", 1e-4, position=(x, height, 0))
    g.camera((0, 1.2, 2), (0, 0, 0))
    yield "light_on_surface", g

    g = ball_scene(lambda m: m.material("ball", (0.6, 0.6, 0.7), 0.0, 0.4, doubleSided=True), with_light=False)
    g.light("point", 5.0, position=(0, 0, 0))
    g.light("point", 5.0, position=(0, 0, 0.999))
    yield "light_inside", g

    g = ball_scene(lambda m: m.material("ball", (0.6, 0.6, 0.7), 0.0, 0.4), with_light=False)
    g.light("spot", 50.0, position=(0, 0, 3), toward=(0, 0, -1), cone=(10, 10))
    g.light("spot", 50.0, position=(1, 0, 3), toward=(-0.3, 0, -1), cone=(0, 0.01))
    g.light("spot", 5.0, position=(0, 3, 0), toward=(0, -1, 0), cone=(0, 90))
    yield "spot_edges", g

    g = ball_scene(lambda m: m.material("ball", (0.6, 0.6, 0.7), 0.0, 0.4), with_light=False)
    g.light("point", 5.0, position=(0, 0, 5), range=1.0)
    g.light("point", 5.0, position=(0, 2, 2), range=1e-6)
    g.light("point", 1e30, position=(1e12, 0, 1e12), range=1e15)
    yield "ranges", g

    g = Gltf()
    material = g.material("broken geometry", (0.8, 0.5, 0.2), 0.0, 0.5, doubleSided=True)
    positions = [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0), (0, 0, 0.5), (0, 0, 0.5), (0, 0, 0.5)]
    normals = [(0, 0, 1), (0, 0, 1), (0, 0, 0), (0, 0, 1), (0, 0, 0), (0, 0, 0), (0, 0, 0)]
    indices = [0, 1, 2, 0, 2, 3, 4, 5, 6, 0, 0, 1, 0, 4, 2]
    g.node(mesh=g.mesh({**g.geometry(positions, normals, indices), "material": material}))
    g.light("directional", 3.0, toward=(0.2, -0.3, -1))
    g.camera((0, 0, 4), (0, 0, 0))
    yield "degenerate_triangles", g


def main():
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else HERE
    for part in ("extreme", "data", "lights", "fog"):
        (folder / part).mkdir(parents=True, exist_ok=True)
    for part in ("data", "lights"):
        merl_table(folder / part / "metallic_paint.binary", (32, 24), metallic_paint)
    for name, make in (("white_plane", white_plane), ("spheres", spheres), ("lights", lights), ("teapot", teapots), ("textured", textured),
                       ("blend", blend), ("many_lights", many_lights), ("animated", animated), ("vases", vases),
                       ("teapot_normals", teapot_normals), ("models", models), ("lights/soft_light", soft_light),
                       ("lights/interior", interior), ("lights/rect", rect_light), ("lights/disk", disk_light),
                       ("lights/sphere", sphere_light), ("lights/tube", tube_light),
                       ("lights/shadow_directional", shadow_directional), ("lights/shadow_point", shadow_point),
                       ("lights/shadow_spot", shadow_spot), ("lights/shadow_fence", shadow_fence),
                       ("fog/even", even_fog), ("fog/height", height_fog),
                       ("fog/airlight", airlight), ("panes", panes), ("glass", glass)):
        make().write(folder / f"{name}.gltf")
    for name, scene in extreme():
        scene.write(folder / "extreme" / f"{name}.gltf")


if __name__ == "__main__":
    main()
