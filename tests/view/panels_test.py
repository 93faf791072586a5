#!/usr/bin/env python3
"""The panels of lobe-view, by mouse and keys."""
import json
import os
import pathlib
import shutil
import time
import unittest

from driver import ROOT, SCENES
from view_test import ViewTest, lobe
from lobe_test import png_pixels, quad_scene


class Panels(ViewTest):
    def open_file(self, view, path):
        view.key("ctrl+o")
        time.sleep(0.4)
        view.key("ctrl+a")
        view.input("type", "--delay", 2, str(path))
        time.sleep(0.2)
        view.key("Return")

    def assert_nearly(self, shown, rows):
        """What was written and read again may have other last digits, which rounding to 8 bits may show."""
        self.assertEqual((len(shown[0]), len(shown)), (len(rows[0]), len(rows)))
        worst = max(abs(a - b) for left, right in zip(shown, rows) for a, b in zip(left, right))
        self.assertLessEqual(worst, 1)

    def test_settings_change_the_picture_and_undo_takes_it_back(self):
        view = self.ready(self.scene, "--camera=far")
        before = view.settle()
        view.press("setting filter")
        view.input("type", "tone")
        time.sleep(0.4)
        view.press("setting tone_mapping")
        view.press("choice agx")
        changed = view.wait_for(lambda e: e["settings"]["tone_mapping"] != "none" and not e["moving"], "picture")
        self.assert_shows(view, view.settle())
        view.click(200, 200)
        view.key("ctrl+z")
        view.wait_for(lambda e: e["settings"]["tone_mapping"] == "none", "picture", view.events.index(changed))
        self.assertEqual(view.settle()["settings"], before["settings"])
        mark = view.mark()
        view.key("ctrl+y")
        view.picture(mark, tone_mapping=changed["settings"]["tone_mapping"])

    def test_a_material_is_picked_edited_and_exported(self):
        view = self.ready(self.scene, "--camera=far")
        view.key("ctrl+2")
        view.click(200, 240)
        picked = view.wait_for(lambda e: True, "picked")
        self.assertEqual(picked["material"], 0)
        first = view.settle()
        mark = view.mark()
        view.drag(*view.place("parameter diffuse"), view.place("parameter diffuse")[0] - 60, view.place("parameter diffuse")[1])
        time.sleep(0.5)
        view.key("ctrl+1")  # the mark of what was picked goes
        view.settle()
        view.move(2, 850)
        time.sleep(0.3)
        edited = view.image()
        self.assertFalse(edited == self.rendered(first))
        view.key("ctrl+e")
        view.message("wrote out/quad_1.gltf", mark)
        exported = view.cwd / "out/quad_1.gltf"
        extension = json.loads(exported.read_text())["materials"][0]["extensions"]["LOBE_materials_brdf"]
        self.assertEqual(extension["model"], "lambert")
        self.assertNotEqual(extension["diffuse"], [1.0, 1.0, 1.0])
        self.assertEqual(view.settle()["settings"], first["settings"])  # Ctrl+E is not E, which flies
        self.assert_nearly(edited, self.rendered(view.settle(), exported))
        view.key("ctrl+z")
        time.sleep(0.3)
        self.assert_shows(view, view.settle())

    def test_lights_are_added_moved_by_their_handle_and_exported(self):
        view = self.ready(self.scene, "--camera-position=0,1,14")
        view.key("ctrl+3")
        view.press("add light")
        time.sleep(0.3)
        view.places.pop("add point", None)
        view.press("add point")
        mark = view.mark()
        view.settle()
        mark = view.mark()
        x, y = view.place("handle center")
        before = view.settle()
        view.drag(x, y, x + 30, y + 40)
        view.wait_for(lambda e: True, "picture", mark)
        event = view.settle()
        self.assertEqual(event["settings"], before["settings"])  # it was the light that moved, not the camera
        view.key("ctrl+1")  # the handles go
        view.key("ctrl+e")
        view.message("wrote out/quad_1.gltf")
        exported = view.cwd / "out/quad_1.gltf"
        lights = json.loads(exported.read_text())["extensions"]["KHR_lights_punctual"]["lights"]
        self.assertEqual([light["type"] for light in lights], ["directional", "point"])
        view.move(2, 850)
        time.sleep(0.3)
        self.assert_nearly(view.image(), self.rendered(event, exported))

    def test_the_truth_is_computed_beside_and_the_error_is_shown(self):
        view = self.ready(self.scene, "--camera=far", "--anti-aliasing=none")
        view.key("shift+t")
        view.wait_for(lambda e: e["rounds"] >= 2, "truth")
        error = view.wait_for(lambda e: True, "error")
        self.assertLess(error["mean"], 1e-3)
        view.key("t")
        view.wait_for(lambda e: e["name"] == "With the truth", "command")
        time.sleep(0.5)
        # Right of the wipe is the truth, left of it the picture: here they agree.
        view.move(2, 850)
        time.sleep(0.5)
        rows = view.image()
        middle = rows[len(rows) // 2]
        width = len(middle) // 3
        self.assertLessEqual(abs(middle[3 * (width // 2 - 20)] - middle[3 * (width // 2 + 20)]), 1)

    def test_other_models_are_wiped_and_quantities_shown(self):
        view = self.ready(self.scene, "--camera=far")
        view.key("ctrl+4")
        view.press("compare all in another model")
        other = view.wait_for(lambda e: True, "other")
        self.assertIn("brdf", other["settings"])
        mark = view.mark()
        view.press("compare nothing")
        view.press("shown")
        time.sleep(0.3)
        view.press("shown normal")
        view.wait_for(lambda e: e["shown"] == "normal", "picture", mark)
        view.settle()
        view.move(2, 850)
        time.sleep(0.3)
        rows = view.image()
        middle = rows[len(rows) // 2]
        self.assertEqual(tuple(middle[3 * (len(middle) // 6):][:3]), (128, 128, 255))  # towards the camera

    def test_shaders_reload_and_the_last_good_ones_stay(self):
        shaders = self.folder / "glsl"
        shutil.copytree(ROOT / "shaders/glsl", shaders)
        view = self.ready(self.scene, "--camera=far", environment={"LOBE_SHADER_DIR": str(shaders)})
        before = view.settle()
        self.assert_shows(view, before)
        file = shaders / "brdf/lambert.glsl"
        good = file.read_text()
        file.write_text(good + "\nfloat broken( { return 1.0; }\n")
        message = view.message("shaders not reloaded")
        self.assertIn("lambert.glsl:", message["text"])
        self.assertIn("broken", message["text"])
        self.assert_shows(view, view.settle())
        mark = view.mark()
        file.write_text(good.replace("INV_PI * d.wi.z", "0.5 * INV_PI * d.wi.z"))
        view.message("shaders reloaded", mark)
        view.picture(mark)
        view.settle()
        view.move(2, 850)
        time.sleep(0.3)
        self.assertFalse(view.image() == self.rendered(before))

    def test_a_model_of_ones_own_and_a_batch_open(self):
        view = self.ready(self.scene, "--camera=far")
        mark = view.mark()
        self.open_file(view, ROOT / "docs/examples/brdf/minnaert.glsl")
        view.picture(mark, brdf="minnaert")
        self.assert_shows(view, view.settle())
        batch = self.folder / "batch.json"
        batch.write_text(json.dumps({"shots": [{"scene": "quad.gltf", "camera": "far", "exposure": -1},
                                               {"scene": "quad.gltf", "camera": "near"}]}))
        self.open_file(view, batch)
        view.message("2 shots")
        view.wait_for(lambda e: e["settings"]["exposure"] == -1, "picture")

    def test_the_gallery_opens_a_scene(self):
        gallery = self.folder / "gallery"
        gallery.mkdir()
        (gallery / "one.gltf").write_text(json.dumps(quad_scene()))
        (gallery / "two.gltf").write_text("broken")
        view = self.view(environment={"LOBE_SCENE_DIR": str(gallery)})
        view.focus()
        time.sleep(1.0)
        view.press("card one")
        view.wait_for(lambda e: e["file"].endswith("one.gltf"), "scene")
        view.settle()
        self.assertIsNone(view.process.poll())


if __name__ == "__main__":
    unittest.main(verbosity=2)
