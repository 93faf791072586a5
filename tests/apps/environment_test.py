#!/usr/bin/env python3
"""Environments of the command line: skies, the sun of a panorama, image-based lights of scenes."""
import base64
import json
import math
import struct
import unittest
import zlib

from lobe_test import LobeTest, dark_scene, png_pixels, quad_scene


def png(width, height, pixel):
    """8-bit, as many channels as pixel(x, y) gives."""
    channels = len(pixel(0, 0))
    rows = b"".join(b"\0" + b"".join(bytes(pixel(x, y)) for x in range(width)) for y in range(height))

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    header = struct.pack(">IIBBBBB", width, height, 8, {3: 2, 4: 6}[channels], 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")


def hdr(width, height, pixel):
    """Radiance's format, not run-length coded."""
    def texel(rgb):
        most = max(rgb)
        if most < 1e-32:
            return bytes(4)
        mantissa, exponent = math.frexp(most)
        return bytes([int(c * mantissa * 256 / most) for c in rgb] + [exponent + 128])
    head = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n" % (height, width)
    return head + b"".join(texel(pixel(x, y)) for y in range(height) for x in range(width))


class Environments(LobeTest):
    def setUp(self):
        super().setUp()
        self.dark = self.write("dark.gltf", dark_scene())

    def picture(self, name, *arguments, scene=None):
        self.lobe("render", scene or self.dark, "-r", 64, 36, "-o", name, "-q", *arguments)
        return png_pixels(self.folder / name)

    def plan(self, *arguments, scene=None):
        return self.lobe("plan", scene or self.dark, *arguments)

    def test_mistakes_are_one_line(self):
        self.write("a.hdr", "x")
        for arguments, hint in ((["--sky", "hosek"], "expected one of constant"),
                                (["--sky", "preetham", "--env", "a.hdr"], "env and sky are both set"),
                                (["--sun-elevation", "20"], "sun_elevation without a sky"),
                                (["--sky-ground", "1,0,0"], "sky_ground without a sky"),
                                (["--sky", "preetham", "--sun-elevation", "-1"], "0 to 90 degrees"),
                                (["--sky", "preetham", "--sky-turbidity", "1.5"], "1.7 to 10"),
                                (["--sky", "preetham", "--sky-turbidity", "nan"], "1.7 to 10"),
                                (["--sky", "constant", "--sky-zenith", "transparent"], "expected a colour"),
                                (["--env-sun", "away"], "expected one of auto")):
            result = self.render("-o", "a.png", *arguments, expect=2)
            self.assertIn(hint, result.stderr, arguments)
            self.assertEqual(len(result.stderr.strip().splitlines()), 1, result.stderr)

    def test_a_constant_sky_lights_a_white_wall_to_its_own_colour(self):
        width, height, channels, rows = self.picture("a.png", "--sky", "constant", "--sky-zenith", "0.5,0.25,0.75")
        for x, y in ((width // 2, height // 2), (0, 0)):  # the wall, which reflects all, and the sky beside it
            pixel = rows[y][x * channels:x * channels + 3]
            for value, expected in zip(pixel, (128, 64, 191)):
                self.assertAlmostEqual(value, expected, delta=1)

    def test_preethams_sky_has_a_sun_that_turns_with_it(self):
        # The wall faces +Z. The sun before it lights it; from behind it cannot.
        def brightness(*arguments):
            width, height, channels, rows = self.picture("a.png", "--sky", "preetham", "--sun-elevation", 20, "--exposure", -8,
                                                         *arguments)
            return rows[height // 2][width // 2 * channels + 1]
        front, back = brightness("--sun-azimuth", 0), brightness("--sun-azimuth", 180)
        self.assertGreater(front, 1.5 * back)
        self.assertAlmostEqual(brightness("--sun-azimuth", 180, "--env-rotation", 180), front, delta=1)
        self.assertAlmostEqual(brightness("--sun-size", 0), front, delta=2)
        plan = self.plan("--sky", "preetham", "--sun-elevation", 20).stdout
        self.assertIn("turbidity 3, sun at 20 degrees", plan)
        self.assertIn("light.disk", plan)
        self.assertIn("light.directional", self.plan("--sky", "preetham", "--sun-size", 0).stdout)

    def test_a_scenes_own_sky_can_be_changed(self):
        scene = dark_scene()
        scene["extensionsUsed"].append("LOBE_environment")
        scene["scenes"][0]["extensions"] = {"LOBE_environment": {"intensity": 0.01, "sky": {
            "model": "preetham", "sunElevation": 0.5, "sunDiameter": 0}}}
        own = self.write("sky.gltf", scene)
        self.assertIn("sun at 28.65 degrees", self.plan(scene=own).stdout)
        plan = self.plan("--sun-elevation", 70, "--sun-size", 0.5, scene=own).stdout
        self.assertIn("sun at 70 degrees", plan)
        self.assertIn("disk of 0.5 degrees", plan)
        self.assertIn("pass light.directional: the scene has no directional light", plan)
        constant = self.plan("--sky", "constant", scene=own).stdout  # the sun goes with its sky
        self.assertIn("a constant sky", constant)
        self.assertIn("pass light.directional: the scene has no directional light", constant)

    def test_the_sun_is_taken_out_of_a_panorama_and_the_truth_keeps_it(self):
        def texel(x, y):
            return (3e4, 3e4, 3e4) if (x, y) == (64, 20) else (1.0, 1.0, 1.0)  # before the wall, above
        (self.folder / "sun.hdr").write_bytes(hdr(128, 64, texel))
        taken = self.plan("--env", "sun.hdr").stdout
        self.assertIn("the sun is taken out of the picture as a directional light, since", taken)
        self.assertIn("light.directional", taken)
        kept = self.plan("--env", "sun.hdr", "--env-sun", "keep").stdout
        self.assertNotIn("the sun is taken out", kept)
        level = self.folder / "level.hdr"
        level.write_bytes(hdr(128, 64, lambda x, y: (1.0, 1.0, 1.0)))
        self.assertIn("no sun is taken out of the picture: no spot of it stands out", self.plan("--env", "level.hdr").stdout)
        common = ["-r", 32, 18, "--env", "sun.hdr", "-q", "--shadows", "none"]
        self.lobe("reference", self.dark, "-o", "truth.exr", "--error", 0.01, "--no-cache", *common)
        self.lobe("reference", self.dark, "-o", "taken.exr", "--error", 0.01, "--no-cache", "--env-sun", "take", *common)
        self.assertNotEqual((self.folder / "truth.exr").read_bytes(), (self.folder / "taken.exr").read_bytes())
        self.lobe("render", self.dark, "-o", "picture.exr", "--anti-aliasing", "none", *common)
        for truth in ("truth.exr", "taken.exr"):  # of a Lambert wall: the same to what a texel's width is
            self.lobe("compare", "picture.exr", truth, "--max", "rel_mse=1e-3")

    def test_bake_writes_a_folder_that_explains_itself(self):
        (self.folder / "level.hdr").write_bytes(hdr(32, 16, lambda x, y: (1.0, 0.5, 0.25)))
        cache = {"XDG_CACHE_HOME": str(self.folder / "cache")}
        result = self.lobe("bake", "level.hdr", "--models", "lambert,metallic_roughness", "--widths", "0.3,0.8", "-o", "out", env=cache)
        self.assertIn("out/environment.json, README.md", result.stderr)
        facts = json.loads((self.folder / "out/environment.json").read_text())
        self.assertEqual([model["name"] for model in facts["models"]], ["lambert", "metallic_roughness"])
        self.assertIsNone(facts["sun"])
        for value, expected in zip(facts["irradiance"]["harmonics_order_2"][0], (1.0, 0.5, 0.25)):
            self.assertAlmostEqual(value * 0.28209479, expected, delta=1e-3)
        files = {str(p.relative_to(self.folder / "out")) for p in (self.folder / "out").rglob("*") if p.is_file()}
        layers = {layer["file"] for model in facts["models"] for layer in model["layers"]}
        splits = {model["split"]["file"] for model in facts["models"]}
        self.assertEqual(files, layers | splits | {"README.md", "environment.json", "environment.exr", "irradiance.exr"})
        for arguments, code, hint in ((["level.hdr", "--models", "mirror"], 2, "environment.exr is what it shows; expected some of"),
                                      (["level.hdr", "--models", "lambrt"], 2, "did you mean 'lambert'"),
                                      (["level.hdr", "--widths", "3,1"], 2, "FROM at most TO"),
                                      (["level.hdr", "--widths", "x"], 2, "expected one width above 0"), ([], 2, "nothing to bake"),
                                      (["none.hdr"], 3, "none.hdr: cannot be read"),
                                      (["level.hdr", "--models", "lambert", "-o", "/proc/none"], 7, "/proc/none")):
            result = self.lobe("bake", *arguments, expect=code, env=cache)
            self.assertIn(hint, result.stderr)
            self.assertEqual(len(result.stderr.strip().splitlines()), 1, result.stderr)

    def test_image_based_light_of_a_scene(self):
        scene = quad_scene(nodes=[{"mesh": 0}], scenes=[{"nodes": [0], "extensions": {"EXT_lights_image_based": {"light": 0}}}],
                           extensionsUsed=["LOBE_materials_brdf", "EXT_lights_image_based"])
        del scene["cameras"]
        # RGBD: white over 1/2 is 2, on the face before the wall (+Z); black elsewhere.
        def face(value):
            return "data:image/png;base64," + base64.b64encode(png(4, 4, lambda x, y: (value, value, value, 128))).decode()
        scene["images"] = [{"uri": face(0)}, {"uri": face(255)}]
        light = {"specularImages": [[0, 0, 0, 0, 1, 0]], "specularImageSize": 4, "intensity": 0.5}
        scene["extensions"] = {"EXT_lights_image_based": {"lights": [light]}}
        path = self.write("ibl.gltf", scene)
        plan = self.plan(scene=path)
        self.assertIn("EXT_lights_image_based: of the largest of its images", plan.stdout)
        self.assertIn("has no irradianceCoefficients", plan.stderr)
        width, height, channels, rows = self.picture("a.png", "--env-background", "hide", scene=path)
        # Irradiance of a cube's face before a wall, over pi: 4 atan(1 / sqrt 2) / (pi sqrt 2) of its radiance.
        linear = 255 / 128 * 0.5 * 4 / (math.pi * math.sqrt(2)) * math.atan(1 / math.sqrt(2))
        value = rows[height // 2][width // 2 * channels] / 255
        shown = value / 12.92 if value <= 0.04045 else ((value + 0.055) / 1.055) ** 2.4
        self.assertAlmostEqual(shown, linear, delta=0.06 * linear)  # faces of four texels are blurred at their edges
        scene["scenes"][0]["extensions"]["EXT_lights_image_based"]["light"] = 2
        result = self.lobe("plan", self.write("bad.gltf", scene), expect=3)
        self.assertIn("light: 2; expected the index of one of the 1 lights", result.stderr)


if __name__ == "__main__":
    unittest.main()
