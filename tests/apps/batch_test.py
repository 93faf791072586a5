#!/usr/bin/env python3
"""Batches, settings from files and flags, and the other commands."""
import json
import os
import pathlib
import pty
import struct
import subprocess
import unittest

from lobe_test import LOBE, LobeTest, dark_scene, png_pixels, quad_scene

class Batches(LobeTest):
    def batch(self, **extra):
        return self.write("jobs.json", {"presets": {"small": {"resolution": [32, 18]}},
                                        "shots": [{"scene": "quad.gltf", "preset": "small", "frames": 5, "orbit": 50,
                                                   "output": "s_{frame}.png", **extra}]})

    def test_shards_together_make_every_picture_once(self):
        self.batch()
        made = []
        for shard in ("1/2", "2/2"):
            before = set(self.files())
            self.lobe("render", "--batch", "jobs.json", "--shard", shard)
            made += sorted(set(self.files()) - before)
        self.assertEqual(sorted(made), [f"s_{i}.png" for i in range(5)])

    def test_list_and_filter(self):
        self.batch()
        listed = self.lobe("render", "--batch", "jobs.json", "--list", "--filter", "s_[13].png").stdout
        self.assertEqual([line.split("\t")[0] for line in listed.splitlines()], ["s_1.png", "s_3.png"])
        self.assertNotIn("s_1.png", self.files())

    def test_one_bad_scene_does_not_stop_the_others(self):
        self.write("bad.gltf", "{")
        self.write("jobs.json", {"shots": [{"scene": s, "resolution": [32, 18], "output": f"{s}.png"}
                                           for s in ("bad.gltf", "quad.gltf", "absent.gltf")]})
        result = self.lobe("render", "--batch", "jobs.json", expect=3)
        self.assertIn("quad.gltf.png", self.files())
        self.assertIn("bad.gltf", result.stderr)
        self.assertIn("absent.gltf", result.stderr)
        self.assertIn("1 of 3 pictures written, 2 failed", result.stderr)

    def test_a_scene_that_is_not_there_does_not_stop_the_others(self):
        result = self.lobe("render", "absent.gltf", "quad.gltf", "-r", "32,18", "-o", "{model}.png", expect=3)
        self.assertIn("quad.png", self.files())
        self.assertIn("absent.gltf: can't be read (No such file", result.stderr)
        self.assertIn("1 of 2 pictures written, 1 failed", result.stderr)

    def test_a_scene_may_come_on_standard_input(self):
        text = pathlib.Path(self.folder, "quad.gltf").read_bytes()
        json_chunk = text + b" " * (-len(text) % 4)
        glb = struct.pack("<4sIIII", b"glTF", 2, 20 + len(json_chunk), len(json_chunk), 0x4E4F534A) + json_chunk
        for scene in (text, glb):
            done = subprocess.run([LOBE, "render", "-", "-r", "16,16", "-o", "{model}.png", "--no-config"], input=scene,
                                  cwd=self.folder, capture_output=True, timeout=60, check=False)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("stdin.png", self.files())
            os.remove(os.path.join(self.folder, "stdin.png"))
        empty = subprocess.run([LOBE, "render", "-", "-o", "{model}.png"], input=b"", cwd=self.folder, capture_output=True,
                               timeout=60, check=False)
        self.assertEqual(empty.returncode, 3)
        self.assertIn(b"standard input: empty", empty.stderr)

    def test_json_has_one_stable_object_a_shot(self):
        result = self.render("--frames=2", "-o", "j{frame}.png", "--json")
        lines = [json.loads(line) for line in result.stdout.splitlines()]
        self.assertEqual([line["output"] for line in lines], ["j0.png", "j1.png"])
        for line in lines:
            self.assertEqual(list(line), ["schema", "output", "scene", "status", "camera", "frame", "resolution", "milliseconds",
                                          "pass_milliseconds", "peak_memory_mib", "non_finite_pixels", "backend", "renderer", "warnings"])
            self.assertEqual((line["schema"], line["status"], line["resolution"], line["non_finite_pixels"]), (1, "done", [64, 36], 0))
            self.assertEqual(list(line["milliseconds"]), ["load", "upload", "render", "encode"])
            self.assertIn("light.directional", line["pass_milliseconds"])
            self.assertGreater(line["peak_memory_mib"], 1)


    def test_a_bad_scene_of_many_frames_is_reported_once(self):
        self.write("bad.gltf", "{")
        result = self.lobe("render", "bad.gltf", "--frames=40", expect=3)
        self.assertEqual(result.stderr.count("bad.gltf"), 1, result.stderr)
        self.assertIn("0 of 40 pictures written, 40 failed", result.stderr)

    def test_list_for_programs(self):
        self.batch()
        lines = [json.loads(line) for line in self.lobe("render", "--batch", "jobs.json", "--list", "--json").stdout.splitlines()]
        self.assertEqual([list(line) for line in lines], [["schema", "output", "scene", "number", "frame", "settings"]] * 5)
        self.assertEqual([line["number"] for line in lines], [1, 2, 3, 4, 5])
        self.assertEqual(lines[0]["settings"]["resolution"], [32, 18])

    def test_a_folder_stands_for_the_scenes_below_it(self):
        (self.folder / "many/deep").mkdir(parents=True)
        for name in ("many/b.gltf", "many/a.gltf", "many/deep/c.gltf", "many/other.txt"):
            self.write(name, quad_scene())
        listed = self.lobe("render", "many", "--list").stdout.splitlines()
        self.assertEqual([line.split("\t")[0] for line in listed], ["out/a.png", "out/b.png", "out/c.png"])
        self.write("jobs.json", {"shots": [{"scene": "many", "resolution": [32, 18], "output": "{n}.png"},
                                           {"scene": "many/deep/none", "output": "none.png"}]})
        self.lobe("render", "--batch", "jobs.json", expect=3)
        self.assertTrue({"1.png", "2.png", "3.png"} < set(self.files()))
        (self.folder / "many/deep/none").mkdir()
        self.assertIn("folder without", self.lobe("render", "many/deep/none", expect=3).stderr)
        self.assertEqual(self.lobe("render", "--batch", "jobs.json", "-q", expect=3).stderr.count("none"), 1)

    def test_the_order_of_shots_does_not_change_pictures(self):
        self.write("dark.gltf", dark_scene())
        shots = [{"scene": "dark.gltf", "camera_azimuth": 30, "camera_elevation": 10, "resolution": [48, 27]},
                 {"scene": "dark.gltf", "resolution": [64, 27]}, {"scene": "quad.gltf", "resolution": [48, 27]},
                 {"scene": "dark.gltf", "brdf": "phong", "resolution": [48, 27]}, {"scene": "dark.gltf", "frames": 2, "orbit": 40, "resolution": [48, 27]},
                 {"scene": "dark.gltf", "camera_position": [0, 0, 3], "resolution": [48, 27]}]
        together, alone = {}, {}
        for number, shot in enumerate(shots):
            shot["output"] = f"{number}_{{frame}}.png"
        for order in (shots, shots[::-1]):
            self.write("jobs.json", {"shots": order})
            self.lobe("render", "--batch", "jobs.json")
            for path in self.folder.glob("*.png"):
                together.setdefault(path.name, []).append(png_pixels(path))
        for shot in shots:
            self.write("jobs.json", {"shots": [shot]})
            self.lobe("render", "--batch", "jobs.json")
        for path in self.folder.glob("*.png"):
            alone[path.name] = png_pixels(path)
        self.assertEqual(len(alone), 7)
        for name, pictures in together.items():
            for picture in pictures:
                self.assertEqual(picture, alone[name], name)

    def test_progress_is_a_bar_on_a_terminal_and_lines_elsewhere(self):
        arguments = ["render", "quad.gltf", "-r", "32", "18", "--frames=3", "--orbit=20"]
        plain = self.lobe(*arguments).stderr
        self.assertEqual(plain.count("wrote"), 3)
        self.assertNotIn("\r", plain)
        self.assertEqual(self.lobe(*arguments, "--quiet").stderr, "")
        master, slave = pty.openpty()
        subprocess.run([LOBE, *arguments], cwd=self.folder, stderr=slave, timeout=60, check=True)
        os.close(slave)
        shown = ""
        try:
            while part := os.read(master, 4096):
                shown += part.decode()
        except OSError:  # Linux's way to say that the other end is closed
            os.close(master)
        self.assertIn("3/3", shown)
        self.assertNotIn("wrote", shown)


class SettingsFromFilesAndFlags(LobeTest):
    def test_precedence_of_files_and_flags(self):
        (self.folder / "config/lobe/config.d").mkdir(parents=True)
        self.write("config/lobe/config.json", {"exposure": 1, "time": 1, "frames": 1})
        self.write("config/lobe/config.d/10.json", {"exposure": 2})
        self.write("c.json", [{"match": "*quad*", "settings": {"exposure": 3}}])
        self.write("s.json", {"exposure": 4})

        def exposure(*arguments):
            chain = self.render("-o", "p.png", "-v", *arguments).stderr
            return next(line for line in chain.splitlines() if line.startswith("exposure"))
        self.assertIn("= 2.0", exposure())
        self.assertIn("= 3.0", exposure("--config", "c.json"))
        self.assertIn("= 4.0", exposure("--settings", "s.json", "--config", "c.json"))
        self.assertIn("= 5.0", exposure("--exposure=5", "--settings", "s.json"))
        self.assertIn("= 7.0", exposure("--exposure=6", "-D", "exposure=7"))
        self.assertIn("= 6.0", exposure("-D", "exposure=7", "--exposure", "6"))
        self.assertIn("= 0.0", exposure("--exposure=6", "-R", "exposure"))
        self.assertIn("= 0.0", exposure("--no-config"))
        self.write("s.json", {"!exposure": 4})
        self.assertIn("= 4.0", exposure("--settings", "s.json", "--exposure=5"))


    def test_every_setting_has_a_flag_a_key_and_a_line_in_the_documentation(self):
        table = self.lobe("help", "--markdown").stdout
        documented = (pathlib.Path(__file__).resolve().parents[2] / "docs/cli.md").read_text()
        self.assertIn(table, documented, "docs/cli.md holds what lobe help --markdown prints")
        options = self.lobe("render", "--help").stdout
        for line in table.splitlines()[2:]:
            key, flag = (field.strip(" `") for field in line.split("|")[1:3])
            self.assertIn(flag, options)
            self.assertEqual(flag, "--" + key.replace("_", "-"))

    def test_examples_in_the_documentation_are_accepted(self):
        documents = pathlib.Path(__file__).resolve().parents[2] / "docs"
        for name, option, count in (("batch.md", "--batch", 39), ("cli.md", "--config", 1)):
            example = (documents / name).read_text().split("```json\n")[1].split("```")[0]
            self.write("example.json", example)
            scenes = [] if option == "--batch" else [self.scene]
            listed = self.lobe("render", *scenes, option, "example.json", "--list").stdout
            self.assertEqual(len(listed.splitlines()), count, name)

    def test_spellings_of_options(self):
        size = ["--list", "--json"]
        for spelling in (["-r", "64", "36"], ["-r", "64x36"], ["-r64,36"], ["--resolution=64,36"], ["--resolution", "64", "36"],
                         ["-D", "resolution=64x36"], ["-Dresolution=64,36"]):
            line = json.loads(self.lobe("render", *spelling, self.scene, *size).stdout)
            self.assertEqual(line["settings"]["resolution"], [64, 36], spelling)
        for spelling, value in ((["--exposure", "-1.5"], -1.5), (["--exposure=+2"], 2.0), (["--exposure=!3", "--exposure=4"], 3.0),
                                (["-D", "!exposure=5", "--exposure=6"], 5.0), (["-D", "!exposure=5", "-R", "exposure"], 0.0)):
            line = json.loads(self.lobe("render", self.scene, *spelling, *size).stdout)
            self.assertEqual(line["settings"]["exposure"], value, spelling)
        for flags, lines in ((["--list", "--no-json"], 0), (["--list", "--json=true"], 1), (["--list=true", "--json", "--no-json", "--json"], 1)):
            self.assertEqual(self.lobe("render", self.scene, *flags).stdout.count("schema"), lines, flags)
        (self.folder / "-odd.gltf").write_text(json.dumps(quad_scene()))
        self.assertIn("-odd.png", self.lobe("render", "--list", "--", "-odd.gltf").stdout)

    def test_configuration_files_are_refused_with_file_and_key(self):
        for content, hint in (({"exposre": 1}, "c.json: unknown setting 'exposre'; did you mean 'exposure'"),
                              ([{"mach": "*", "settings": {}}], "c.json: [0]: unknown key 'mach'"),
                              ([{"match": "no such scene", "settings": {"frames": 0}}], "c.json: [0]: frames '0'"),
                              ([{"match": {"regex": "("}, "settings": {}}], "regular expression"), ("[", "c.json:1"), ("3", "expected an object"),
                              ('{"exposure": 1e999}', "out of range")):
            self.write("c.json", content)
            for option in ("--config", "--settings"):
                code = 3 if isinstance(content, str) and content != "3" else 2
                self.assertIn(hint, self.lobe("render", self.scene, "--list", option, "c.json", expect=code).stderr)
        self.lobe("render", self.scene, "--list", "--config", "absent.json", expect=3)
        (self.folder / "config/lobe/config.d").mkdir(parents=True)
        self.write("config/lobe/config.d/1.json", {"exposre": 1})
        self.lobe("render", self.scene, "--list", expect=2)
        self.lobe("render", self.scene, "--list", "--no-config")

    def test_verbose_prints_what_won_over_what(self):
        self.write("c.json", {"!exposure": 1})
        chain = self.render("-v", "--config=c.json", "--exposure=2", "--quality=high", "-o", "v.png").stderr
        self.assertIn("exposure = 1.0 (c.json) must win over 2.0 (command line), 0.0 (built-in)\n", chain)
        self.assertIn('quality = "high" (command line) over "balanced" (built-in)\n', chain)
        self.assertIn('gbuffer_bits = "32" (quality)\n', chain)


class OtherCommands(LobeTest):
    def test_plan_and_info_for_people_and_programs(self):
        text = self.lobe("plan", self.scene).stdout
        self.assertIn("light.directional", text)
        self.assertIn("pass light.spot: the scene has no spot light", text)
        self.assertEqual(json.loads(self.lobe("plan", self.scene, "--json").stdout)["schema"], 1)
        contexts = json.loads(self.lobe("info", "--json").stdout)["contexts"]
        self.assertTrue(any(context["usable"] for context in contexts))
        self.assertIn("OpenGL", self.lobe("info").stdout)

    def test_backends_give_the_same_picture(self):
        for backend in ("egl", "osmesa"):
            self.render("--backend", backend, "-o", f"{backend}.png")
        self.assertEqual(png_pixels(self.folder / "egl.png"), png_pixels(self.folder / "osmesa.png"))
        self.render("--device", "99", expect=2)


if __name__ == "__main__":
    unittest.main(verbosity=1)
