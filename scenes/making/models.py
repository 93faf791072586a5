"""A ball of every model."""
import math
import pathlib
import struct

from making.gltf_writer import Gltf
from making.shapes import SCENES, ground, place, sphere, studio, upright
from making.vases import metal


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


def model_names():
    return sorted(path.stem for path in (SCENES / "../shaders/glsl/brdf").glob("*.glsl"))


def models():
    """A sphere for every model of shaders/glsl/brdf, which holds a file for each that is registered."""
    g = Gltf()
    positions, normals, uvs, indices = sphere(28)
    shape = g.geometry(positions, normals, indices, [uvs])
    names = model_names()
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


def balls_of_models():
    """A ball for every model on the ground, five a row in the order of their names, the first row at the back."""
    g = Gltf()
    positions, normals, uvs, indices = sphere(28)
    shape = g.geometry(positions, normals, indices, [uvs])
    for i, name in enumerate(model_names()):
        parameters = dict(MODELS.get(name, {}))
        if "file" in parameters:
            parameters["file"] = pathlib.Path(parameters["file"]).name  # beside the scene: paths may not leave its folder
        material = g.material(name, brdf={"model": name, **parameters})
        g.node(name=name, mesh=g.mesh({**shape, "material": material}), scale=[0.42] * 3,
               translation=[1.1 * (i % 5 - 2), 0.42, 1.2 * (i // 5 - 1)])
    place(g, ground(5), g.material("ground", brdf={"model": "lambert", "diffuse": [0.3, 0.31, 0.33]}), uvs=False)
    g.camera((0, 3.0, 5.6), (0, 0.25, -0.1), 40)
    return g
