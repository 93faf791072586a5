"""Fog, and surfaces that are seen through."""

from making.gltf_writer import Gltf, axis_rotation
from making.shapes import box, floor_material, ground, place, sphere, studio, upright


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
