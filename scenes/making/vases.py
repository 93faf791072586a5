"""Sixteen vases of Cook and Torrance's materials, and a teapot with three kinds of normals."""
import math

from making.gltf_writer import Gltf, axis_rotation, cross, normalized
from making.shapes import box, ground, outward, place, studio, teapot, upright


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
