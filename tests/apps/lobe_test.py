"""What the tests of the batch tool share: small scenes, a PNG reader, and a way to run the program.

LOBE_BIN names the program. Needs the standard library only."""
import base64
import json
import os
import pathlib
import shutil
import struct
import subprocess
import tempfile
import unittest
import zlib

LOBE = str(pathlib.Path(os.environ.get("LOBE_BIN", "build/bin/lobe")).resolve())
SHADERS = pathlib.Path(__file__).resolve().parents[2] / "shaders/glsl"


def quad_scene(**extra):
    """A white Lambert square of 2 m, facing +Z, under a directional light of irradiance 3."""
    positions = struct.pack("<12f", -1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0)
    indices = struct.pack("<6H", 0, 1, 2, 0, 2, 3)
    data = base64.b64encode(positions + indices).decode()
    scene = {
        "asset": {"version": "2.0"},
        "extensionsUsed": ["KHR_lights_punctual", "LOBE_materials_brdf"],
        "extensions": {"KHR_lights_punctual": {"lights": [{"type": "directional", "intensity": 3.0}]}},
        "scene": 0,
        "scenes": [{"nodes": [0, 1, 2, 3]}],
        "nodes": [
            {"mesh": 0},
            {"extensions": {"KHR_lights_punctual": {"light": 0}}},
            {"camera": 0, "translation": [0, 0, 2]},
            {"camera": 1, "translation": [0, 0, 4], "name": "far"},
        ],
        "cameras": [
            {"type": "perspective", "name": "near", "perspective": {"yfov": 0.8, "znear": 0.1}},
            {"type": "perspective", "name": "far", "perspective": {"yfov": 0.8, "znear": 0.1}},
        ],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
        "materials": [{"extensions": {"LOBE_materials_brdf": {"model": "lambert"}}}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [-1, -1, 0], "max": [1, 1, 0]},
            {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"},
        ],
        "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12}],
        "buffers": [{"byteLength": 60, "uri": "data:application/octet-stream;base64," + data}],
    }
    scene.update(extra)
    return scene


def png_pixels(path):
    """Width, height and rows of an 8-bit PNG's samples."""
    data = pathlib.Path(path).read_bytes()
    assert data[:8] == b"\x89PNG\r\n\x1a\n", path
    at, body = 8, b""
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        chunk = data[at + 8:at + 8 + length]
        if kind == b"IHDR":
            width, height, _, colour = struct.unpack(">IIBB", chunk[:10])
        if kind == b"IDAT":
            body += chunk
        at += 12 + length
    channels = {0: 1, 2: 3, 4: 2, 6: 4}[colour]
    raw, stride, rows, above = zlib.decompress(body), width * channels, [], bytes(width * channels)
    for y in range(height):
        kind, line = raw[y * (stride + 1)], bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        for i in range(stride):
            left = line[i - channels] if i >= channels else 0
            corner = above[i - channels] if i >= channels else 0
            if kind == 1:
                line[i] = (line[i] + left) & 255
            elif kind == 2:
                line[i] = (line[i] + above[i]) & 255
            elif kind == 3:
                line[i] = (line[i] + (left + above[i]) // 2) & 255
            elif kind == 4:
                p = left + above[i] - corner
                nearest = min((abs(p - left), 0, left), (abs(p - above[i]), 1, above[i]), (abs(p - corner), 2, corner))
                line[i] = (line[i] + nearest[2]) & 255
        rows.append(bytes(line))
        above = rows[-1]
    return width, height, channels, rows


def dark_scene():
    """The square without light or camera: both are then Lobe's own."""
    scene = quad_scene(nodes=[{"mesh": 0}], scenes=[{"nodes": [0]}], extensionsUsed=["LOBE_materials_brdf"])
    del scene["extensions"], scene["cameras"]
    return scene


class LobeTest(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="lobe-test-"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        self.scene = self.write("quad.gltf", quad_scene())

    def write(self, name, content):
        path = self.folder / name
        path.write_text(content if isinstance(content, str) else json.dumps(content))
        return str(path)

    def lobe(self, *arguments, expect=0, env=None, text=True, seconds=120):
        environment = dict(os.environ, XDG_CONFIG_HOME=str(self.folder / "config"), **(env or {}))
        result = subprocess.run([LOBE, *map(str, arguments)], cwd=self.folder, capture_output=True, text=text, timeout=seconds,
                                env=environment)
        self.assertEqual(result.returncode, expect, f"{arguments}\n{result.stdout}\n{result.stderr}")
        if expect not in (0, 6) and text:
            self.assertIn("error", result.stderr)
        return result

    def render(self, *arguments, **keywords):
        return self.lobe("render", self.scene, "-r", 64, 36, *arguments, **keywords)

    def shaders_with(self, name, change):
        """A copy of the shaders in which one file's text went through `change`; as environment of lobe."""
        folder = self.folder / "glsl"
        shutil.copytree(SHADERS, folder)
        before = (folder / name).read_text()
        after = change(before)
        self.assertNotEqual(before, after)
        (folder / name).write_text(after)
        return {"LOBE_SHADER_DIR": str(folder)}

    def files(self):
        return sorted(str(p.relative_to(self.folder)) for p in self.folder.rglob("*") if p.is_file())
