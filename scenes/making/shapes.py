"""Shapes: positions, normals, texture coordinates, indices; and what most scenes stand on and under."""
import math
import pathlib

from making.gltf_writer import cross, normalized, png

SCENES = pathlib.Path(__file__).resolve().parent.parent


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
    lines = [line for line in (SCENES / "data/teapot_bezier.txt").read_text().splitlines() if line and not line.startswith("#")]
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
