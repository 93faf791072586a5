#!/usr/bin/env python3
"""The project's own scenes, the stiff ones among them: no NaN, no infinity, and the same look at every scale."""
import json
import pathlib
import subprocess
import sys
import unittest

from lobe_test import LobeTest, SHADERS, png_pixels

SCENES = pathlib.Path(__file__).resolve().parents[2] / "scenes"


class Scenes(LobeTest):
    def test_the_script_writes_the_scenes_that_are_there(self):
        subprocess.run([sys.executable, "-B", SCENES / "make_scenes.py", self.folder / "made"], check=True, timeout=300)
        made = sorted(p for p in (self.folder / "made").rglob("*") if p.is_file())
        self.assertGreater(len(made), 20)
        for path in made:
            self.assertEqual(path.read_bytes(), (SCENES / path.relative_to(self.folder / "made")).read_bytes(), path.name)

    def test_there_is_a_sphere_for_every_model_and_a_source_for_every_vase(self):
        models = json.loads((SCENES / "models.gltf").read_text())
        drawn = {m["extensions"]["LOBE_materials_brdf"]["model"] for m in models["materials"]}
        self.assertGreaterEqual(drawn, {p.stem for p in (SHADERS / "brdf").glob("*.glsl")})
        vases = [m for m in json.loads((SCENES / "vases.gltf").read_text())["materials"] if m["name"] not in ("shelf", "back", "wall")]
        self.assertEqual(len(vases), 16)
        table = (SCENES / "README.md").read_text()
        for vase in vases:
            self.assertIn(f"| {vase['name']} |", table)
            self.assertIn(f"| {vase['extras']['source']} |", table)

    # Some hundred programs, about a second each where none is in the driver's cache.
    def test_every_scene_is_finite_under_every_model_and_path(self):
        for options in ([], ["--brdf", "phong"], ["--brdf", "blinn_phong"], ["--brdf", "metallic_roughness"], ["--brdf", "lambert"],
                        ["--shading", "forward"], ["--quality", "converged", "--anti-aliasing", "none"]):
            result = self.lobe("render", SCENES, *options, "-r", 160, 90, "-o", "{model}.exr", "--json", "-q", seconds=600)
            shots = [json.loads(line) for line in result.stdout.splitlines()]
            self.assertEqual(len(shots), len(list(SCENES.rglob("*.gltf"))))
            for shot in shots:
                self.assertEqual((shot["status"], shot["non_finite_pixels"]), ("done", 0), shot["scene"])

    def test_scale_and_place_do_not_change_the_picture(self):
        pictures = {}
        for name in ("scale_tiny", "scale_huge", "far_from_origin"):
            self.lobe("render", SCENES / "extreme" / f"{name}.gltf", "-r", 160, 90, "-o", f"{name}.png")
            pictures[name] = b"".join(png_pixels(self.folder / f"{name}.png")[3])
        for name in ("scale_huge", "far_from_origin"):
            differences = [abs(a - b) for a, b in zip(pictures["scale_tiny"], pictures[name])]
            # Positions rounded to float move an edge by less than a pixel; elsewhere codes may differ by rounding.
            self.assertLess(sum(d > 1 for d in differences), len(differences) * 0.002, name)

    def test_animation_moves_what_it_poses(self):
        pictures = []
        for time in ("0", "0.5", "1"):
            self.lobe("render", SCENES / "animated.gltf", "-r", 160, 90, "--time", time, "-o", f"t{time}.png")
            pictures.append(png_pixels(self.folder / f"t{time}.png"))
        self.assertNotEqual(pictures[0], pictures[1])
        self.assertNotEqual(pictures[1], pictures[2])


if __name__ == "__main__":
    unittest.main(verbosity=1)
