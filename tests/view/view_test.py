#!/usr/bin/env python3
"""lobe-view as a person uses it: under Xvfb, with a real mouse and real keys."""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "apps"))
from driver import LOBE, ROOT, SCENES, VIEW, Display, View  # noqa: E402
from lobe_test import dark_scene, png_pixels, quad_scene  # noqa: E402

SMALL = "900x520"  # the window; the picture is what the panels leave


def lobe(*arguments, cwd, environment=None):
    return subprocess.run([LOBE, *map(str, arguments)], cwd=cwd, capture_output=True, text=True, check=True,
                          env=dict(os.environ, **(environment or {})))


class ViewTest(unittest.TestCase):
    """One display for all tests; programs and compiled shaders are kept from test to test by Mesa."""

    @classmethod
    def setUpClass(cls):
        cls.display = Display(1300, 860)
        cls.cache = tempfile.mkdtemp(prefix="lobe-view-cache-")
        os.environ.setdefault("LOBE_TEST_CACHE", cls.cache)

    @classmethod
    def tearDownClass(cls):
        cls.display.close()
        shutil.rmtree(cls.cache, ignore_errors=True)

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="lobe-view-scene-"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        self.scene = self.folder / "quad.gltf"
        self.scene.write_text(json.dumps(quad_scene()))

    def view(self, *arguments, **more):
        more.setdefault("window", SMALL)
        view = View(*arguments, display=self.display, **more)
        self.addCleanup(view.close)
        return view

    def ready(self, *arguments, **more):
        """Started, focused, with a whole picture."""
        view = self.view(*(arguments or (self.scene,)), **more)
        view.settle()
        view.focus()
        return view

    def rendered(self, event, scene=None):
        """What `lobe render` makes of the settings of a picture."""
        settings = self.folder / "settings.json"
        values = {k: v for k, v in event["settings"].items() if k != "output"}
        settings.write_text(json.dumps(values))
        lobe("render", scene or self.scene, "--no-config", "--settings", settings, "-o", "x.png", "-q", cwd=self.folder)
        width, height, channels, rows = png_pixels(self.folder / "x.png")
        self.assertEqual(channels, 3)
        return rows

    def assert_rows(self, shown, rows):
        self.assertEqual((len(shown[0]), len(shown)), (len(rows[0]), len(rows)))
        different = sum(a != b for left, right in zip(shown, rows) for a, b in zip(left, right))
        self.assertEqual(different, 0, f"{different} bytes differ from lobe render's")

    def assert_shows(self, view, event, scene=None):
        """The window shows what `lobe render` makes, pixel for pixel."""
        view.move(2, 850)  # the pointer is drawn over the picture
        time.sleep(0.3)
        rows = self.rendered(event, scene)
        self.assertGreater(len(set(b"".join(rows))), 1, "the picture has one colour")
        self.assert_rows(view.image(), rows)


class Pictures(ViewTest):
    def test_the_window_shows_what_lobe_render_makes_before_and_after_turning(self):
        view = self.ready(SCENES / "spheres.gltf")
        first = view.settle()
        self.assert_shows(view, first, SCENES / "spheres.gltf")
        mark = view.mark()
        view.drag(200, 250, 320, 290)
        turned = view.settle()
        self.assertTrue(any(e["event"] == "picture" and e["moving"] for e in view.events[mark:]))
        self.assertNotEqual(turned["settings"]["camera_position"], first["settings"].get("camera_position"))
        self.assert_shows(view, turned, SCENES / "spheres.gltf")

    def test_settings_of_the_command_line_are_shown(self):
        view = self.ready(self.scene, "--exposure=-1", "--tone-mapping=agx", "--resolution=300,200", "--background=#204060",
                          "--camera-position=0.4,0.3,5")
        event = view.settle()
        self.assertEqual((event["width"], event["height"]), (300, 200))
        self.assert_shows(view, event)

    def test_resizing_the_window_resizes_the_picture(self):
        view = self.ready()
        before = view.settle()
        windows = subprocess.run(["xdotool", "getwindowfocus"], env=view.environment, capture_output=True, text=True).stdout.split()
        view.input("windowsize", windows[0], 1100, 640)
        view.wait_for(lambda e: e["width"] == before["width"] + 200 and e["height"] == before["height"] + 120, "picture")
        self.assert_shows(view, view.settle())

    def test_a_scene_without_light_has_lobes_own_after_turning_too(self):
        self.scene.write_text(json.dumps(dark_scene()))
        view = self.ready()
        view.drag(200, 200, 260, 240)
        self.assert_shows(view, view.settle())

    def test_high_dpi_makes_text_and_panels_larger_and_keeps_pixels(self):
        display = Display(1300, 860)
        self.addCleanup(display.close)
        display.set_dots_per_inch(192)
        view = View(self.scene, display=display, window="640x400")
        self.addCleanup(view.close)
        view.settle()
        self.assertGreater(view.places["picture"]["y"], 35)  # the menu's height
        view.focus()
        view.key("c")  # the far one, which sees more than the square
        event = view.settle()
        self.assert_shows(view, event)


class Camera(ViewTest):
    def position(self, view):
        return view.settle()["settings"].get("camera_position")

    def test_mouse_and_keys_move_the_camera(self):
        view = self.ready()
        places = [self.position(view)]

        def moved(what):
            places.append(self.position(view))
            self.assertNotEqual(places[-1], places[-2], what)
            return places[-1]

        view.drag(200, 200, 260, 220)
        x, y, z = moved("left drag")
        view.drag(200, 200, 240, 220, shift=True)
        moved("Shift and left drag")
        view.drag(200, 200, 230, 240, button=2)
        moved("middle drag")
        view.drag(200, 200, 200, 160, button=3)
        nearer = moved("right drag")
        view.move(200, 200)
        view.input("click", 4)
        moved("wheel")
        view.key("f")
        moved("F")
        view.key("1")
        x, y, z = moved("1: from the front")
        self.assertAlmostEqual(x, 0, places=6)
        self.assertGreater(z, 1)
        view.key("3")
        x, y, z = moved("3: from the right")
        self.assertGreater(x, 1)
        self.assertAlmostEqual(z, 0, places=2)
        view.key("7")
        x, y, z = moved("7: from above")
        self.assertGreater(y, 1)
        for key in "wasdeq":
            view.input("keydown", key)
            time.sleep(0.25)
            view.input("keyup", key)
            moved(key)
        view.key("Return")
        self.assertIsNone(self.position(view))
        view.key("c")
        event = view.settle()
        self.assertEqual(event["settings"]["camera"], "1")
        self.assert_shows(view, event)

    def test_double_click_sets_the_pivot(self):
        view = self.ready()
        view.click(260, 240, times=2)
        event = view.settle()
        focal = event["settings"]["camera_focal_point"]
        self.assertAlmostEqual(focal[2], 0.0, places=3)  # the square's plane
        self.assertNotEqual(focal[:2], [0.0, 0.0])


class Keys(ViewTest):
    def test_every_command_without_a_dialog_is_reached_by_its_key_and_every_panel_by_its_own(self):
        view = self.ready(self.scene)
        names = {"f": "Frame the scene", "Return": "Camera as at first", "c": "Next camera of the scene", "1": "From the front",
                 "3": "From the right", "7": "From above", "v": "Show the next quantity", "shift+v": "Show the previous quantity",
                 "b": "Show the picture", "Escape": "Messages", "x": "Keep this picture and wipe", "i": "Explain a pixel",
                 "h": "Keys", "p": "Panels", "r": "Load the scene again", "ctrl+z": "Undo", "ctrl+y": "Redo",
                 "ctrl+shift+c": "Copy command line", "ctrl+c": "Copy state", "ctrl+s": "Save state", "ctrl+F12": "Save the picture",
                 "F12": "Save the window", "ctrl+shift+r": "Reload shaders", "Right": "Next scene of the folder", "m": "All models",
                 "t": "With the truth", "shift+t": "Error against the truth"}
        view.move(200, 200)
        for key, name in names.items():
            mark = view.mark()
            view.key(key)
            view.wait_for(lambda e: e["name"] == name, "command", mark, 20)
            if key in ("h", "p", "m"):
                view.key(key)  # off again
        for number, panel in enumerate(("Settings", "Materials", "Lights", "Compare", "Plan", "Time", "Pixel", "Messages"), 1):
            mark = view.mark()
            view.key(f"ctrl+{number}")
            view.wait_for(lambda e: e["name"] == panel, "panel", mark, 20)
        view.settle()
        self.assertFalse([e for e in view.events if e["event"] == "message" and e["error"]])

    def test_f12_saves_the_window_and_control_f12_the_picture_as_lobe_render_makes_it(self):
        view = self.ready()
        event = view.settle()
        view.key("ctrl+F12")
        view.message("wrote out/quad_1.png")
        self.assert_rows(png_pixels(view.cwd / "out/quad_1.png")[3], self.rendered(event))
        again = lobe("render", "--reproduce", view.cwd / "out/quad_1.png", "-o", "again.png", "-q", cwd=self.folder)
        self.assertEqual(again.stderr, "")
        self.assert_rows(png_pixels(self.folder / "again.png")[3], self.rendered(event))
        view.key("F12")
        view.message("wrote out/quad_1_window.png")
        width, height, _, rows = png_pixels(view.cwd / "out/quad_1_window.png")
        self.assertEqual((width, height), (900, 520))
        self.assertGreater(len(set(b"".join(rows))), 20)

    def test_a_saved_state_is_taken_by_lobe_render_and_by_the_window(self):
        view = self.ready()
        view.drag(200, 200, 260, 240)
        event = view.settle()
        view.key("ctrl+s")
        view.message("wrote out/quad_1.json")
        state = view.cwd / "out/quad_1.json"
        lobe("render", self.scene, "--no-config", "--settings", state, "-o", "s.png", "-q", cwd=self.folder)
        self.assert_rows(png_pixels(self.folder / "s.png")[3], self.rendered(event))
        view.key("Return")
        view.settle()
        view.key("ctrl+o")
        view.place("open path")
        time.sleep(0.3)
        view.key("ctrl+a")
        view.input("type", str(state))
        view.key("Return")
        view.message("settings taken over")
        back = view.settle()
        self.assertEqual(back["settings"]["camera_position"], event["settings"]["camera_position"])
        self.assert_shows(view, back)


class Mistakes(ViewTest):
    def test_without_display_it_says_so_and_names_the_batch_tool(self):
        for display in ("", ":97531"):
            environment = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY")}
            if display:
                environment["DISPLAY"] = display
            run = subprocess.run([VIEW, str(self.scene)], env=environment, capture_output=True, text=True)
            self.assertEqual(run.returncode, 4, run.stderr)
            self.assertIn("lobe render", run.stderr)
            self.assertEqual(run.stderr.count("\n"), 1)

    def test_usage_errors_have_their_codes(self):
        for arguments, part in ((["--windw", "1x1"], "unknown option --windw"), (["--window", "big"], "--window 'big'"),
                                (["--exposure=x"], "exposure 'x'")):
            run = subprocess.run([VIEW, *arguments], env=dict(os.environ, DISPLAY=self.display.name), capture_output=True, text=True)
            self.assertEqual(run.returncode, 2, run.stderr)
            self.assertIn(part, run.stderr)

    def test_bad_files_are_refused_with_a_message_and_the_scene_stays(self):
        view = self.ready(self.scene, "--camera=far")
        event = view.settle()
        bad = {"bad.gltf": "{\"asset\":", "bad.json": "[1,", "bad.binary": "abc", "bad.glsl": "void main() {", "what.xyz": "?"}
        for name, content in bad.items():
            file = self.folder / name
            file.write_text(content)
            mark = view.mark()
            view.key("ctrl+o")
            view.places.pop("open path", None)
            time.sleep(0.4)
            view.key("ctrl+a")
            view.input("type", "--delay", 2, str(file))
            view.key("Return")
            view.wait_for(lambda e: e["error"] and name in e["text"], "message", mark, 20)
        self.assert_shows(view, view.settle(), self.scene)
        self.assertEqual(view.settle()["settings"], event["settings"])

    def test_the_batch_programs_are_linked_with_none_of_it(self):
        for program in (LOBE, str(pathlib.Path(LOBE).with_name("lobe-check"))):
            libraries = subprocess.run(["ldd", program], capture_output=True, text=True, check=True).stdout
            self.assertNotIn("glfw", libraries)
            symbols = pathlib.Path(program).read_bytes()
            self.assertNotIn(b"ImGui_ImplGlfw", symbols)
            self.assertNotIn(b"Dear ImGui", symbols)


if __name__ == "__main__":
    unittest.main(verbosity=2)
