"""Writes glTF 2.0 files with embedded buffers and images. Standard library only; the same input gives the same bytes."""
import base64
import json
import math
import struct
import zlib


def png(width, height, pixel, alpha=False):
    """An 8-bit PNG whose colours are pixel(x, y) -> (r, g, b[, a]), each 0..255."""
    channels = 4 if alpha else 3
    rows = bytearray()
    for y in range(height):
        rows.append(0)
        for x in range(width):
            rows += bytes(max(0, min(255, round(c))) for c in pixel(x, y)[:channels])

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    header = struct.pack(">IIBBBBB", width, height, 8, 6 if alpha else 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(bytes(rows), 9)) + chunk(b"IEND", b"")


def normalized(v):
    length = math.sqrt(sum(c * c for c in v))
    return tuple(c / length for c in v)


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def look_rotation(forward, up=(0, 1, 0)):
    """Quaternion that turns -Z to `forward`, as cameras and lights look."""
    z = tuple(-c for c in normalized(forward))
    if abs(sum(a * b for a, b in zip(z, up))) > 0.9999:
        up = (0, 0, 1)
    x = normalized(cross(up, z))
    y = cross(z, x)
    m = (x, y, z)  # columns
    trace = m[0][0] + m[1][1] + m[2][2]
    if trace > 0:
        s = 2 * math.sqrt(trace + 1)
        return [(m[1][2] - m[2][1]) / s, (m[2][0] - m[0][2]) / s, (m[0][1] - m[1][0]) / s, s / 4]
    i = max(range(3), key=lambda k: m[k][k])
    j, k = (i + 1) % 3, (i + 2) % 3
    s = 2 * math.sqrt(1 + m[i][i] - m[j][j] - m[k][k])
    q = [0.0] * 4
    q[i], q[j], q[k] = s / 4, (m[j][i] + m[i][j]) / s, (m[k][i] + m[i][k]) / s
    q[3] = (m[j][k] - m[k][j]) / s
    return q


def axis_rotation(axis, degrees):
    half = math.radians(degrees) / 2
    return [c * math.sin(half) for c in normalized(axis)] + [math.cos(half)]


class Gltf:
    """One file under construction. Indices are returned by every add_ method."""

    def __init__(self):
        self.json = {"asset": {"version": "2.0", "generator": "scenes/make_scenes.py"}, "scene": 0, "scenes": [{"nodes": []}],
                     "nodes": [], "meshes": [], "materials": [], "accessors": [], "bufferViews": [], "cameras": []}
        self.data = bytearray()
        self.lights = []
        self.area_lights = []

    def extension(self, name):
        used = self.json.setdefault("extensionsUsed", [])
        if name not in used:
            used.append(name)

    def _view(self, payload, **more):
        while len(self.data) % 4:
            self.data.append(0)
        self.json["bufferViews"].append({"buffer": 0, "byteOffset": len(self.data), "byteLength": len(payload), **more})
        self.data += payload
        return len(self.json["bufferViews"]) - 1

    def accessor(self, values, kind, component="f", bounds=False):
        """values: flat numbers; kind: SCALAR, VEC2, ...; component: f float, H u16, I u32, B u8."""
        size = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}[kind]
        payload = struct.pack(f"<{len(values)}{component}", *values)
        entry = {"bufferView": self._view(payload), "componentType": {"f": 5126, "H": 5123, "I": 5125, "B": 5121}[component],
                 "count": len(values) // size, "type": kind}
        if bounds:
            stored = struct.unpack(f"<{len(values)}{component}", payload)
            entry["min"] = [min(stored[i::size]) for i in range(size)]
            entry["max"] = [max(stored[i::size]) for i in range(size)]
        self.json["accessors"].append(entry)
        return len(self.json["accessors"]) - 1

    def geometry(self, positions, normals=None, indices=None, uvs=(), colors=None):
        """Attributes and indices of a primitive, as a dictionary to be completed with a material."""
        attributes = {"POSITION": self.accessor([c for p in positions for c in p], "VEC3", bounds=True)}
        if normals:
            attributes["NORMAL"] = self.accessor([c for n in normals for c in n], "VEC3")
        for set_number, uv in enumerate(uvs):
            attributes[f"TEXCOORD_{set_number}"] = self.accessor([c for p in uv for c in p], "VEC2")
        if colors:
            attributes["COLOR_0"] = self.accessor([c for p in colors for c in p], "VEC4")
        primitive = {"attributes": attributes}
        if indices:
            primitive["indices"] = self.accessor(indices, "SCALAR", "H" if max(indices) < 65535 else "I")
        return primitive

    def mesh(self, *primitives):
        self.json["meshes"].append({"primitives": list(primitives)})
        return len(self.json["meshes"]) - 1

    def material(self, name, base=(1, 1, 1), metallic=0.0, roughness=0.5, alpha=1.0, brdf=None, transmission=0.0, **more):
        entry = {"name": name, "pbrMetallicRoughness": {"baseColorFactor": [*base, alpha], "metallicFactor": metallic,
                                                        "roughnessFactor": roughness}, **more}
        if brdf:
            self.extension("LOBE_materials_brdf")
            entry["extensions"] = {"LOBE_materials_brdf": brdf}
        if transmission:
            self.extension("KHR_materials_transmission")
            entry["extensions"] = {"KHR_materials_transmission": {"transmissionFactor": transmission}}
        self.json["materials"].append(entry)
        return len(self.json["materials"]) - 1

    def texture(self, png_bytes, **sampler):
        self.json.setdefault("samplers", []).append({"magFilter": 9729, "minFilter": 9987, **sampler})
        self.json.setdefault("images", []).append({"bufferView": self._view(png_bytes), "mimeType": "image/png"})
        self.json.setdefault("textures", []).append({"source": len(self.json["images"]) - 1, "sampler": len(self.json["samplers"]) - 1})
        return len(self.json["textures"]) - 1

    def node(self, root=True, **content):
        self.json["nodes"].append(content)
        index = len(self.json["nodes"]) - 1
        if root:
            self.json["scenes"][0]["nodes"].append(index)
        return index

    def light(self, kind, intensity, color=(1, 1, 1), position=None, toward=None, range=None, cone=None, shape=None):
        """toward: the way a directional or spot light shines; cone: inner and outer angle in degrees; shape: the object of
        LOBE_light_shape."""
        self.extension("KHR_lights_punctual")
        entry = {"type": kind, "intensity": intensity, "color": list(color)}
        if range is not None:
            entry["range"] = range
        if cone is not None:
            entry["spot"] = {"innerConeAngle": math.radians(cone[0]), "outerConeAngle": math.radians(cone[1])}
        if shape is not None:
            self.extension("LOBE_light_shape")
            entry["extensions"] = {"LOBE_light_shape": shape}
        self.lights.append(entry)
        content = {"extensions": {"KHR_lights_punctual": {"light": len(self.lights) - 1}}}
        if position is not None:
            content["translation"] = list(position)
        if toward is not None:
            content["rotation"] = look_rotation(toward)
        self.node(**content)

    def area_light(self, kind, radiance, size, position, toward, color=(1, 1, 1), aspect=1, image=None, visible=False):
        """EXT_lights_area: kind is rect (size: its height; aspect: width / height) or disk (size: its diameter). image: of
        LOBE_light_image, on a rect; visible: its body is drawn."""
        self.extension("EXT_lights_area")
        entry = {"type": kind, "intensity": radiance, "color": list(color), "size": size}
        if kind == "rect":
            entry["rect"] = {"aspect": aspect}
        if image is not None:
            self.extension("LOBE_light_image")
            entry["extensions"] = {"LOBE_light_image": {"image": image}}
        self.area_lights.append(entry)
        extensions = {"EXT_lights_area": {"light": len(self.area_lights) - 1}}
        if visible:
            self.extension("LOBE_visible_light")
            extensions["LOBE_visible_light"] = {"visible": True}
        self.node(translation=list(position), rotation=look_rotation(toward), extensions=extensions)

    def scene_extension(self, name, **content):
        self.extension(name)
        self.json["scenes"][0].setdefault("extensions", {})[name] = content

    def ambient(self, radiance):
        self.scene_extension("LOBE_ambient", radiance=list(radiance))

    def fog(self, extinction, radiance, **more):
        """extinction: 1/m; more: heightFalloff, height, scattering, anisotropy."""
        self.scene_extension("LOBE_fog", extinction=list(extinction), radiance=list(radiance), **more)

    def camera(self, position, target, degrees=40, near=0.05):
        self.json["cameras"].append({"type": "perspective", "name": "main",
                                     "perspective": {"yfov": math.radians(degrees), "znear": near}})
        self.node(camera=len(self.json["cameras"]) - 1, translation=list(position),
                  rotation=look_rotation([t - p for t, p in zip(target, position)]))

    def write(self, path):
        content = {key: value for key, value in self.json.items() if value or key in ("scene", "scenes", "nodes")}
        if self.lights:
            content.setdefault("extensions", {})["KHR_lights_punctual"] = {"lights": self.lights}
        if self.area_lights:
            content.setdefault("extensions", {})["EXT_lights_area"] = {"lights": self.area_lights}
        content["buffers"] = [{"byteLength": len(self.data),
                               "uri": "data:application/octet-stream;base64," + base64.b64encode(self.data).decode()}]

        def rounded(value):
            if isinstance(value, float):
                return float(f"{value:.9g}")
            if isinstance(value, dict):
                return {key: rounded(v) for key, v in value.items()}
            if isinstance(value, list):
                return [rounded(v) for v in value]
            return value
        path.write_text(json.dumps(rounded(content), separators=(",", ":")) + "\n")
