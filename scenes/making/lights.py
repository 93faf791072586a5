"""Lights with a body, and shadows of all kinds of light."""
import math

from making.gltf_writer import Gltf, axis_rotation, cross, png
from making.shapes import box, ground, place, sphere, upright
from making.models import balls_of_models


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


def window_picture(width=96, height=64):
    """Panes of coloured glass between leads, each row in other colours, with a white L in the pane at the top left."""
    panes = (((200, 40, 30), (240, 190, 40), (60, 160, 70), (40, 90, 200)),
             ((120, 50, 150), (230, 230, 220), (230, 110, 30), (30, 150, 160)),
             ((30, 60, 120), (90, 170, 60), (210, 60, 110), (240, 220, 120)))

    def pixel(x, y):
        column, row = 4 * x // width, 3 * y // height
        at_x, at_y = x - column * width // 4, y - row * height // 3
        if min(at_x, at_y) < 2 or x >= width - 2 or y >= height - 2:
            return 6, 6, 8
        if column == row == 0 and (6 <= at_x <= 8 and 4 <= at_y <= 17 or 6 <= at_x <= 15 and 15 <= at_y <= 17):
            return 255, 255, 255
        return panes[row][column]
    return png(width, height, pixel)


def screen():
    """A window of coloured glass, and one more behind the eye, light a floor of strips from matt to glossy, and balls."""
    g = Gltf()
    strips = (("chalk", {"model": "lambert", "diffuse": [0.7, 0.7, 0.7]}),
              ("lacquer", {"model": "phong", "diffuse": [0.15, 0.15, 0.15], "specular": [0.6, 0.6, 0.6], "shininess": 200, "normalization": "energy"}),
              ("polish", {"model": "cook_torrance", "m": 0.06, "fresnel": {"type": "metal", "name": "nickel"}}),
              ("mirror", {"model": "mirror", "fresnel": {"type": "schlick", "f0": [0.7, 0.7, 0.7]}}),
              ("satin", {"model": "ggx", "diffuse": [0.1, 0.1, 0.1], "alphaX": 0.25, "alphaY": 0.25, "fresnel": {"type": "schlick", "f0": [0.5, 0.5, 0.5]}}))
    positions, normals, uvs, indices = ground(1.0)
    for i, (name, brdf) in enumerate(strips):
        strip = [(0.56 * (x + 2 * i - 4) / 1.12, y, 2.6 * z) for x, y, z in positions]
        place(g, (strip, normals, uvs, indices), g.material(name, brdf=brdf), uvs=False)
    balls = (("plaster", {"model": "lambert", "diffuse": [0.8, 0.8, 0.8]}),
             ("gold", {"model": "beckmann_smith", "m": 0.25, "fresnel": {"type": "metal", "name": "gold"}}),
             ("glaze", {"model": "ward", "diffuse": [0.25, 0.25, 0.3], "specular": [0.25, 0.25, 0.25], "alpha": 0.1}))
    for i, (name, brdf) in enumerate(balls):
        place(g, sphere(32, 0.3), g.material(name, brdf=brdf), translation=(-1.3 + 1.3 * i, 0.3, 0.35), uvs=False)
    g.area_light("rect", 5.0, 1.6, (0, 1.0, -1.6), (0, 0, 1), aspect=1.5, image="window.png", visible=True)
    g.area_light("rect", 2.5, 1.2, (-1.6, 2.2, 3.2), (0.5, -0.6, -1), aspect=1.5, image="window.png")
    g.camera((0.4, 1.5, 4.2), (0, 0.5, -0.4), 42)
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
