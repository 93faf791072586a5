"""The scenes of the gallery."""
import math
import random

from making.gltf_writer import Gltf, axis_rotation, normalized, png
from making.shapes import box, floor_material, ground, outward, place, sphere, studio, teapot, upright


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
