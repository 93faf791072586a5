#!/usr/bin/env python3
"""Metals in bands of wavelength: the colours that docs/bands.md states, on the screen; only where a scene needs them."""
import pathlib
import re
import unittest

from lobe_test import LobeTest, SHADERS, png_pixels, quad_scene

PAGE = (pathlib.Path(__file__).resolve().parents[2] / "docs/bands.md").read_text()


def documented(metal):
    """Normal reflectance: of 64 bands, of three wavelengths, of 16 bands."""
    cells = re.search(rf"^\| {metal} \| 0° \|(.*)\|$", PAGE, re.M).group(1).split("|")
    exact, _, three, _, some = ([float(v) for v in cell.split()] for cell in cells)
    return exact, [a + b for a, b in zip(exact, three)], [a + b for a, b in zip(exact, some)]


def mirror_scene(*fresnels, model="mirror"):
    """The square under ambient radiance 1 alone, which such a model returns as its normal reflectance."""
    scene = quad_scene(materials=[{"name": str(i), "extensions": {"LOBE_materials_brdf": {"model": model, "fresnel": f}}} for i, f in enumerate(fresnels)])
    scene["scenes"] = [{"nodes": [0, 2], "extensions": {"LOBE_ambient": {"radiance": [1, 1, 1]}}}]
    scene["meshes"][0]["primitives"] = [{**scene["meshes"][0]["primitives"][0], "material": i} for i in range(len(fresnels))]
    return scene


class Bands(LobeTest):
    def colour(self, *arguments, scene, **keywords):
        result = self.lobe("render", scene, "-r", 64, 36, "--anti-aliasing=none", "--exposure=-1", "-o", "a.png", *arguments, **keywords)
        width, height, channels, rows = png_pixels(self.folder / "a.png")
        pixel = [b / 255 for b in rows[height // 2][width // 2 * channels:][:3]]
        return [2 * (c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4) for c in pixel], result.stderr

    def expect(self, got, wanted):
        for a, b in zip(got, wanted):
            self.assertAlmostEqual(a, b, delta=0.01)  # eight bits

    def test_reflectance_is_that_of_the_documentation(self):
        for backend in ("egl", "osmesa"):
            for metal in ("gold", "copper", "titanium nitride"):
                scene = self.write("m.gltf", mirror_scene({"type": "metal", "name": metal}))
                exact, three, some = documented(metal)
                for count, wanted in ((64, exact), (16, some), (3, three)):
                    colour, messages = self.colour(f"--bands={count}", f"--backend={backend}", scene=scene)
                    self.expect(colour, wanted)
                    self.assertNotIn("warning", messages)

    def test_models_from_files_have_bands_too(self):
        copy = (SHADERS / "brdf/mirror.glsl").read_text().replace("mirror_", "shiny_").replace("MirrorParams", "ShinyParams")
        self.write("shiny.glsl", copy)
        scene = self.write("m.gltf", mirror_scene({"type": "metal", "name": "gold"}, model="shiny"))
        self.expect(self.colour("--bands=64", "--brdf-file=shiny.glsl", scene=scene)[0], documented("gold")[0])

    def test_only_metals_with_a_spectrum_and_one_line_for_the_others(self):
        own = {"type": "conductor", "eta": [0.2, 0.4, 1.4], "k": [3.0, 2.4, 1.8]}
        scene = self.write("m.gltf", mirror_scene({"type": "metal", "name": "platinum"}, own, {"type": "schlick", "name": "gold"}))
        messages = self.colour("--bands=16", scene=scene)[1]
        self.assertIn("no spectrum of platinum", messages)
        self.assertIn("given for red, green and blue only", messages)
        self.assertIn("nothing is evaluated in bands", messages)
        self.assertNotIn("FRESNEL_BANDS", self.lobe("plan", scene, "--bands=16").stdout)

    def test_the_plan_names_them_and_leaves_them_out_elsewhere(self):
        scene = self.write("m.gltf", mirror_scene({"type": "metal", "name": "gold"}, {"type": "metal", "name": "gold"}))
        plan = self.lobe("plan", scene, "--bands=16").stdout
        self.assertIn("gold in 16 bands of wavelength, for 2 materials", plan)
        self.assertIn("FRESNEL_BANDS", plan)
        plan = self.lobe("plan", scene).stdout
        self.assertNotIn("FRESNEL_BANDS", plan)
        self.assertIn("bands of wavelength: no metal is to be", plan)
        for wrong in ("2", "65", "4.5", "many"):
            self.assertIn("3 to 64", self.lobe("plan", scene, f"--bands={wrong}", expect=2).stderr)


if __name__ == "__main__":
    unittest.main(verbosity=1)
