"""The stiff ones: no NaN, no infinity, no crash."""

from making.gltf_writer import Gltf
from making.shapes import ground, place, sphere


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
