#!/usr/bin/env python3
"""lobe compare: figures, thresholds, maps, and mistakes that end in one line."""
import json
import unittest

from lobe_test import LobeTest, png_pixels


class Compare(LobeTest):
    def setUp(self):
        super().setUp()
        aov = ["--aov", "radiance,depth,normal,material_id,contributions", "--exr-precision", "float"]
        for name, *more in (("a",), ("dark", "--brdf-set", "diffuse=0.5,0.5,0.5")):
            self.render(*aov, *more, "-o", name + ".exr")
        self.render("-o", "a.png")
        self.render("-D", "exposure=-1", "-o", "b.png")

    def compare(self, *arguments, expect=0):
        return self.lobe("compare", *arguments, expect=expect)

    def test_a_picture_is_itself(self):
        found = json.loads(self.compare("a.exr", "a.exr", "--json", "-", "--max", "max=0", "--max", "hdr_flip=0").stdout)
        self.assertEqual(found["schema"], 1)
        self.assertEqual(found["parts"][0]["metrics"]["rmse"], 0)
        self.assertIsNone(found["parts"][0]["metrics"]["psnr"])
        kinds = [part["kind"] for part in found["parts"]]
        for kind in ("all", "edges", "shading", "material", "light"):
            self.assertIn(kind, kinds)

    def test_half_the_albedo_is_found_and_fails(self):
        result = self.compare("dark.exr", "a.exr", "--metric", "bias", "--max", "rmse=0.01", "--json", "x.json", expect=1)
        self.assertIn("FAILS: rmse <= 0.01", result.stdout)
        found = json.loads((self.folder / "x.json").read_text())
        self.assertFalse(found["thresholds"][0]["holds"])
        self.assertLess(found["parts"][0]["metrics"]["bias"], -0.05)

    def test_maps(self):
        self.compare("dark.exr", "a.exr", "-o", "d.png")
        self.assertEqual(png_pixels(self.folder / "d.png")[:3], (64, 36, 3))
        self.compare("dark.exr", "a.exr", "--metric", "rel_mse", "-o", "d.exr")
        self.assertIn("d.exr", self.files())

    def test_display_pictures_have_display_metrics(self):
        result = self.compare("--metric", "flip", "b.png", "a.png", "--min", "psnr=60", expect=1)
        self.assertIn("note: display pictures", result.stdout)
        self.compare("b.png", "a.png", "--metric", "rel_mse", expect=2)

    def test_mistakes(self):
        self.render("-r", "32,36", "-o", "small.exr")
        for arguments, code, text in ((("small.exr", "a.exr"), 3, "32x36; expected 64x36"),
                                      (("a.png", "a.exr"), 2, "expected two of a kind"),
                                      (("a.exr", "none.exr"), 3, "none.exr"),
                                      (("a.exr", "a.exr", "--metric", "rel_msx"), 2, "did you mean 'rel_mse'"),
                                      (("a.exr", "a.exr", "--max", "psnr=3"), 2, "--min psnr=3"),
                                      (("a.exr", "a.exr", "--max", "rmse"), 2, "METRIC=VALUE"),
                                      (("a.exr", "a.exr", "-o", "x.gif"), 2, ".exr"),
                                      (("a.exr", "a.exr", "--subtract-truth-variance"), 3, "error.R")):
            self.assertIn(text, self.compare(*arguments, expect=code).stderr, arguments)


if __name__ == "__main__":
    unittest.main()
