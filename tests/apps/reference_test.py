#!/usr/bin/env python3
"""lobe reference and lobe explain: what they write, their cache, and mistakes that end in one line."""
import json
import os
import pathlib
import subprocess
import unittest

from lobe_test import LOBE, LobeTest, quad_scene

CHECK = os.environ.get("LOBE_CHECK_BIN")


class Reference(LobeTest):
    def setUp(self):
        super().setUp()
        os.environ["XDG_CACHE_HOME"] = str(self.folder / "cache")

    def reference(self, *arguments, expect=0, scene="quad.gltf"):
        return self.lobe("reference", scene, "-r", "64,36", *arguments, expect=expect)

    def kept(self):
        return sorted((self.folder / "cache/lobe/truth").glob("*.exr"))

    def test_the_engine_agrees_with_it(self):
        found = json.loads(self.reference("-o", "truth.exr", "--json").stdout)
        self.assertEqual((found["schema"], found["width"], found["unfinished_pixels"]), (1, 64, 0))
        self.assertEqual(found["relative_error"], 0)  # a directional light has none
        self.render("-D", "anti_aliasing=none", "--exr-precision", "float", "-o", "picture.exr")
        self.lobe("compare", "picture.exr", "truth.exr", "--max", "rmse=1e-6", expect=0)

    def test_it_is_kept_and_gone_on_with(self):
        scene = quad_scene()
        scene["extensionsUsed"].append("EXT_lights_area")
        scene["extensions"]["EXT_lights_area"] = {"lights": [{"type": "disk", "intensity": 5}]}
        scene["nodes"][1]["extensions"] = {"EXT_lights_area": {"light": 0}}
        scene["nodes"][1]["translation"] = [0, 0, 1.5]
        (self.folder / "disk.gltf").write_text(json.dumps(scene))
        self.reference("-o", "a.exr", "--error", "0.05", scene="disk.gltf")
        self.assertEqual(len(self.kept()), 1)
        self.reference("-o", "b.exr", "--error", "0.05", scene="disk.gltf")
        self.lobe("compare", "a.exr", "b.exr", "--max", "max=0")
        self.reference("-o", "c.exr", "--filter", "box", "--error", "0.2", scene="disk.gltf")
        self.assertEqual(len(self.kept()), 2)
        self.kept()[0].write_bytes(b"damaged")
        self.reference("-o", "d.exr", "--error", "0.05", scene="disk.gltf")
        self.reference("-o", "e.exr", "--error", "0.05", "--no-cache", "--shadows", "none", scene="disk.gltf")
        self.assertEqual(len(self.kept()), 2)

    def test_mistakes(self):
        for arguments, code, text in ((("-o", "a.png"), 2, "expected .exr"), ((), 2, "output"),
                                      (("-o", "a.exr", "--error", "0"), 2, "--error"),
                                      (("-o", "a.exr", "--filter", "gauss"), 2, "--filter"),
                                      (("-o", "quad.gltf/a.exr"), 7, "quad.gltf/a.exr")):
            self.assertIn(text, self.reference(*arguments, expect=code).stderr, arguments)
        self.assertIn("expected one", self.lobe("reference", "-o", "a.exr", expect=2).stderr)

    def test_explain(self):
        text = self.lobe("explain", "quad.gltf", "-r", "64,36", "--pixel", "32,18").stdout
        for part in ("model lambert", "directional", "visible 100.0 %", "truth     0.95493", "difference", "@test"):
            self.assertIn(part, text)
        found = json.loads(self.lobe("explain", "quad.gltf", "-r", "64,36", "--pixel", "32,18", "--json").stdout)
        self.assertAlmostEqual(found["truth"][0], 3 / 3.14159265358979, places=6)
        self.assertAlmostEqual(found["rendered"][0], found["truth"][0], places=6)
        nothing = self.lobe("explain", "quad.gltf", "-r", "64,36", "--pixel", "0,0").stdout
        self.assertIn("no surface", nothing)
        for pixel in ("64,0", "1", "a,b", "-1,0"):
            self.assertIn("--pixel", self.lobe("explain", "quad.gltf", "-r", "64,36", "--pixel=" + pixel, expect=2).stderr)

    @unittest.skipUnless(CHECK, "LOBE_CHECK_BIN is not set")
    def test_its_test_runs(self):
        scenes = pathlib.Path(__file__).resolve().parents[2] / "scenes"
        for x in range(30, 290, 52):
            for y in (50, 90, 130):
                file = self.folder / f"pixel_{x}_{y}_test.glsl"
                found = subprocess.run([LOBE, "explain", scenes / "models.gltf", "-r", "320,180", "--pixel", f"{x},{y}",
                                        "--test", file], capture_output=True, text=True)
                # Of measured tables and what no light reaches there is none.
                self.assertTrue(found.returncode == 0 or "no test can be written" in found.stderr, found.stderr)
        files = sorted(self.folder.glob("pixel_*_test.glsl"))
        self.assertGreater(len(files), 5)
        run = subprocess.run([CHECK, *map(str, files)], capture_output=True, text=True)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        # And they can fail.
        text = files[0].read_text()
        broken = text.replace("equals (", "equals (9")
        files[0].write_text(broken)
        self.assertEqual(subprocess.run([CHECK, str(files[0])], capture_output=True).returncode, 1)


if __name__ == "__main__":
    unittest.main()
