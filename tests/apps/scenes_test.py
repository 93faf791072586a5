#!/usr/bin/env python3
"""The project's own scenes, the stiff ones among them: no NaN, no infinity, and the same look at every scale."""
import json
import pathlib
import unittest

from lobe_test import LobeTest, png_pixels

SCENES = pathlib.Path(__file__).resolve().parents[2] / "scenes"


class Scenes(LobeTest):
    def test_every_scene_is_finite_under_every_model_and_path(self):
        for options in ([], ["--brdf", "phong"], ["--brdf", "blinn_phong"], ["--brdf", "metallic_roughness"], ["--brdf", "lambert"],
                        ["--shading", "forward"], ["--quality", "converged", "--anti-aliasing", "none"]):
            result = self.lobe("render", SCENES, *options, "-r", 160, 90, "-o", "{model}.exr", "--json", "-q")
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
