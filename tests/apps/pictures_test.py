#!/usr/bin/env python3
"""Pictures: what is in them, and the record of how they were made."""
import os
import re
import unittest

from lobe_test import LobeTest, dark_scene, png_pixels, quad_scene

class Pictures(LobeTest):
    def test_picture_has_the_size_and_the_value_that_was_asked_for(self):
        self.render("-o", "a.png")
        width, height, channels, rows = png_pixels(self.folder / "a.png")
        self.assertEqual((width, height, channels), (64, 36, 3))
        # Radiance 3/pi is 0.9549 linear, sRGB 250.
        self.assertEqual(tuple(rows[18][32 * 3:33 * 3]), (250, 250, 250))

    def test_every_format_is_written_and_its_extension_decides(self):
        for extension, magic in (("png", b"\x89PNG"), ("jpg", b"\xff\xd8"), ("exr", b"\x76\x2f\x31\x01"), ("hdr", b"#?RADIANCE")):
            self.render("-o", f"x.{extension}")
            self.assertTrue((self.folder / f"x.{extension}").read_bytes().startswith(magic), extension)

    def test_default_output_is_out_model_png(self):
        self.render()
        self.assertIn("out/quad.png", self.files())

    def test_turntable_writes_a_file_a_frame(self):
        self.render("--frames", 3, "--orbit=90", "-o", "t_{frame:2}.png")
        self.assertEqual([f for f in self.files() if f.startswith("t_")], ["t_00.png", "t_01.png", "t_02.png"])
        self.assertNotEqual((self.folder / "t_00.png").read_bytes(), (self.folder / "t_02.png").read_bytes())

    def test_cameras_by_name_index_position_and_orbit_differ(self):
        pictures = set()
        for number, options in enumerate((["--camera", "near"], ["--camera", "1"], ["--camera-position", "1,1,3"],
                                          ["--camera-azimuth", "40", "--camera-elevation", "10"],
                                          ["--camera-position=0,0,3", "--camera-focal-point=0.5,0,0", "--camera-view-angle=60"])):
            self.render(*options, "-o", f"c{number}.png")
            pictures.add(str(png_pixels(self.folder / f"c{number}.png")))
        self.assertEqual(len(pictures), 5)
        error = self.render("--camera", "fra", expect=2).stderr
        self.assertIn("did you mean 'far'", error)

    def test_every_quality_tone_curve_and_model_renders(self):
        for flag, values in (("--quality", ("draft", "balanced", "high", "converged")),
                             ("--tone-mapping", ("none", "reinhard", "aces", "agx", "neutral")),
                             ("--anti-aliasing", ("none", "ssaa4", "ssaa16")),
                             ("--brdf", ("lambert", "phong", "blinn_phong", "metallic_roughness")),
                             ("--shading", ("deferred", "forward")), ("--normals", ("file", "smooth", "flat"))):
            for value in values:
                self.render(flag, value, "-o", "v.png")

    def test_background_shows_where_nothing_is(self):
        self.render("--camera", "far", "--background", "#204060", "-o", "b.png")
        self.assertEqual(tuple(png_pixels(self.folder / "b.png")[3][0][:3]), (0x20, 0x40, 0x60))
        self.render("--camera", "far", "--background", "transparent", "-o", "t.png")
        width, _, channels, rows = png_pixels(self.folder / "t.png")
        self.assertEqual(channels, 4)
        self.assertEqual((rows[0][3], rows[18][32 * 4 + 3]), (0, 255))

    def test_exposure_doubles_radiance_per_stop(self):
        self.render("-D", "exposure=-1", "-o", "half.png")
        # 3/(2 pi) = 0.4775 linear, sRGB 184.
        self.assertEqual(png_pixels(self.folder / "half.png")[3][18][96], 184)

    def test_cameras_of_no_use_are_refused(self):
        flat = quad_scene()
        flat["cameras"][0] = {"type": "orthographic", "orthographic": {"xmag": 1, "ymag": 1, "znear": 0.1, "zfar": 10}}
        self.write("flat.gltf", flat)
        self.lobe("render", "flat.gltf", "-r", 64, 36, "-o", "flat.png")
        self.assertIn("orthographic", self.lobe("render", "flat.gltf", "--camera-view-angle=30", expect=2).stderr)

    def test_scenes_without_light_camera_or_anything(self):
        self.write("dark.gltf", dark_scene())
        self.assertNotIn("warning", self.lobe("render", "dark.gltf", "-r", 64, 36, "-o", "dark.png").stderr)
        rows = png_pixels(self.folder / "dark.png")[3]
        self.assertGreater(rows[18][32 * 3], 100, "lit by the default light")
        self.assertEqual(rows[0][0], 0, "framed with a margin")
        self.write("void.gltf", {"asset": {"version": "2.0"}})
        self.assertIn("every pixel has the same colour", self.lobe("render", "void.gltf", "-r", 64, 36, "-o", "void.png").stderr)

    def test_an_unlit_picture_is_told_though_its_layers_vary(self):
        black = quad_scene(materials=[{"extensions": {"LOBE_materials_brdf": {"model": "lambert", "diffuse": [0, 0, 0]}}}])
        self.write("black.gltf", black)
        error = self.lobe("render", "black.gltf", "--camera=far", "-r", 64, 36, "--aov=radiance,depth,position", "-o", "b.exr").stderr
        self.assertIn("every pixel has the same colour", error)

    def test_names_are_filled_in(self):
        self.render("--camera=far", "--brdf=phong", "--quality=draft", "-o", "a{{b}}/{model}_{camera}_{brdf}_{quality}_{n:3}_{frame:2}_##.png")
        self.assertIn("a{b}/quad_far_phong_draft_001_00_01.png", self.files())
        listed = self.render("-o", "{date}.png", "--list").stdout
        self.assertRegex(listed, r"^\d{4}-\d\d-\d\d\.png\t")
        self.assertTrue(self.render("--camera", "a/../b", "-o", "{camera}.png", "--list").stdout.startswith("a_.._b.png"))

    def test_extensions_in_capitals(self):
        self.render("-o", "A.PNG")
        self.assertEqual(png_pixels(self.folder / "A.PNG")[:2], (64, 36))

    def test_output_to_standard_output(self):
        result = self.render("-o", "-", text=False)
        self.assertTrue(result.stdout.startswith(b"\x89PNG"))
        self.assertEqual(self.files(), ["quad.gltf"])
        (self.folder / "piped.png").write_bytes(result.stdout)
        self.render("-o", "filed.png")
        self.assertEqual(png_pixels(self.folder / "piped.png"), png_pixels(self.folder / "filed.png"))
        temporary = self.folder / "temporary"
        temporary.mkdir()
        self.render("-o", "-", text=False, env={"TMPDIR": str(temporary)})
        self.assertEqual(list(temporary.iterdir()), [])

    def test_layers_in_one_exr(self):
        self.render("--aov", "radiance,depth,normal,position,albedo,material_id,roughness,contributions", "-o", "all.exr")
        content = (self.folder / "all.exr").read_bytes()
        for channel in (b"depth.Z", b"normal.X", b"position.Y", b"albedo.G", b"material.id", b"roughness.Y", b"directional.R", b"transparent.B"):
            self.assertIn(channel, content)


class Records(LobeTest):
    def test_reproduce_gives_the_same_pixels(self):
        self.render("--exposure", "-0.5", "--camera", "far", "--brdf", "phong", "--frames=2", "--orbit=60", "-o", "first{frame}.png")
        for extension in ("png", "exr"):
            self.render("--exposure", "-0.5", "--camera", "far", "--frames=2", "--orbit=60", "-o", f"r{{frame}}.{extension}")
            self.lobe("render", "--reproduce", f"r1.{extension}", "-o", f"again.{extension}")
            first, again = ((self.folder / f"{name}.{extension}").read_bytes() for name in ("r1", "again"))
            # All but the moment of writing, which formats store as 2026:01:31 12:00:00.
            moment = re.compile(rb"\d{4}:\d\d:\d\d \d\d:\d\d:\d\d")
            self.assertEqual(moment.sub(b"", first), moment.sub(b"", again))
        self.lobe("render", "--reproduce", "first1.png", "-o", "again1.png")
        self.assertEqual(png_pixels(self.folder / "first1.png"), png_pixels(self.folder / "again1.png"))

    def test_a_picture_without_record_cannot_be_reproduced(self):
        self.write("plain.txt", "not a picture")
        self.lobe("render", "--reproduce", "plain.txt", "-o", "x.png", expect=3)
        self.lobe("render", "--reproduce", "absent.png", "-o", "x.png", expect=3)

    def test_reproduce_tells_what_has_changed(self):
        self.render("--frames=2", "--orbit=20", "-o", "p{frame}.png")
        self.assertIn("--output", self.lobe("render", "--reproduce", "p1.png", expect=2).stderr)
        self.assertIn("frame 1", self.lobe("render", "--reproduce", "p1.png", "-R", "frames", "-o", "q.png", expect=3).stderr)
        self.assertNotIn("warning", self.lobe("render", "--reproduce", "p1.png", "-o", "q.png", "--exposure=1").stderr)
        self.assertNotEqual(png_pixels(self.folder / "q.png"), png_pixels(self.folder / "p1.png"))
        os.rename(self.scene, self.folder / "moved.gltf")
        self.lobe("render", "--reproduce", "p1.png", "-o", "q.png", expect=3)
        self.assertNotIn("warning", self.lobe("render", "moved.gltf", "--reproduce", "p1.png", "-o", "q.png").stderr)
        self.assertEqual(png_pixels(self.folder / "q.png"), png_pixels(self.folder / "p1.png"))
        self.write("quad.gltf", quad_scene(asset={"version": "2.0", "generator": "another"}))
        self.assertIn("content of the scene", self.lobe("render", "--reproduce", "p1.png", "-o", "q.png").stderr)

    def test_every_format_resumes_and_reproduces(self):
        for extension in ("png", "jpg", "exr", "hdr"):
            self.render("-o", f"x.{extension}")
            self.assertIn("skipped", self.render("-o", f"x.{extension}", "--resume").stderr, extension)
            self.lobe("render", "--reproduce", f"x.{extension}", "-o", f"y.{extension}", "--resume")
            self.assertIn("skipped", self.lobe("render", "--reproduce", f"x.{extension}", "-o", f"y.{extension}", "--resume").stderr)

    def test_resume_makes_a_damaged_picture_again(self):
        self.render("-o", "d.png")
        whole = (self.folder / "d.png").read_bytes()
        for damaged in (b"", b"junk", whole[:200]):
            (self.folder / "d.png").write_bytes(damaged)
            self.render("-o", "d.png", "--resume")
            self.assertEqual(png_pixels(self.folder / "d.png")[:2], (64, 36))
        self.write("quad.gltf", quad_scene(asset={"version": "2.0", "generator": "another"}))
        self.assertIn("wrote", self.render("-o", "d.png", "--resume").stderr, "the scene has changed")

    def test_resume_renders_only_what_changed(self):
        self.render("--frames=3", "--orbit=30", "-o", "f{frame}.png")
        stamps = {f: os.stat(self.folder / f).st_mtime_ns for f in self.files() if f.endswith("png")}
        os.remove(self.folder / "f1.png")
        self.render("--frames=3", "--orbit=30", "-o", "f{frame}.png", "--resume")
        self.assertEqual(os.stat(self.folder / "f0.png").st_mtime_ns, stamps["f0.png"])
        self.assertTrue((self.folder / "f1.png").exists())
        self.render("--frames=3", "--orbit=30", "--exposure=1", "-o", "f{frame}.png", "--resume")
        self.assertNotEqual(os.stat(self.folder / "f0.png").st_mtime_ns, stamps["f0.png"])


if __name__ == "__main__":
    unittest.main(verbosity=1)
