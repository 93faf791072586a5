#!/usr/bin/env python3
"""lobe plot: every kind to every format, the same bytes each time, and mistakes that end in one line."""
import csv
import io
import os
import pathlib
import struct
import subprocess
import unittest
import xml.etree.ElementTree

from lobe_test import LOBE, LobeTest, png_pixels

KINDS = {"lobes": ["--brdf", "phong,ggx", "--set", "alpha=0.2", "--set", "phong.shininess=20"],
         "table": ["--brdf", "phong"],
         "fresnel": ["--metal", "gold"],
         "albedo": ["--brdf", "lambert"],
         "lobe3d": ["--brdf", "cook_torrance", "-D", "m=0.2"],
         "slice": ["--brdf", "ggx"],
         "error": ["--brdf", "phong", "--steps", "4"]}


class Plot(LobeTest):
    def plot(self, *arguments, expect=0):
        return self.lobe("plot", *arguments, expect=expect)

    def read(self, name):
        return pathlib.Path(self.folder, name).read_bytes()

    def test_every_kind_in_every_format_twice_alike(self):
        for kind, options in KINDS.items():
            for extension in ("svg", "png", "csv"):
                with self.subTest(kind=kind, extension=extension):
                    for name in ("one", "two"):
                        result = self.plot(kind, *options, "-o", f"{name}.{extension}")
                        self.assertEqual(result.stdout + result.stderr, "")
                    data = self.read(f"one.{extension}")
                    self.assertEqual(data, self.read(f"two.{extension}"))
                    if extension == "svg":
                        root = xml.etree.ElementTree.fromstring(data)
                        self.assertTrue(root.tag.endswith("svg"))
                        self.assertGreater(len(root.findall(".//{http://www.w3.org/2000/svg}text")), 5)
                    elif extension == "png":
                        width, height = struct.unpack(">II", data[16:24])
                        self.assertGreaterEqual(width, 600)
                        self.assertGreaterEqual(height, 500)
                        _, _, _, rows = png_pixels(self.folder / "one.png")
                        self.assertGreater(len(set(b"".join(rows))), 50, "not blank")
                    else:
                        rows = list(csv.reader(io.StringIO(data.decode())))
                        self.assertGreater(len(rows), 40)
                        self.assertTrue(all(len(row) == len(rows[0]) for row in rows))
                        self.assertIn("[", rows[0][-1], "units")

    def test_every_model_has_lobes(self):
        names = self.plot("lobes", "--brdf", "nothing", "-o", "x.svg", expect=2).stderr.split("one of ")[1].split(", ")
        self.assertGreater(len(names), 10)
        for name in names:
            self.plot("lobes", "--brdf", name.strip(), "-o", f"{name.strip()}.svg")
            xml.etree.ElementTree.fromstring(self.read(f"{name.strip()}.svg"))

    def test_models_without_a_parameter_to_sweep(self):
        for kind in ("error", "albedo", "lobe3d", "slice"):
            self.plot(kind, "--brdf", "lambert", "-o", kind + ".svg")
        self.assertIn("no parameter", self.plot("albedo", "--brdf", "lambert", "--as", "map", "-o", "x.svg", expect=2).stderr)

    def test_values(self):
        rows = list(csv.DictReader(io.StringIO(self.plot(
            "lobes", "--brdf", "lambert", "-D", "diffuse=0.5", "--incidence", "60", "-o", "-", "--format", "csv").stdout)))
        for row in rows:
            self.assertEqual(row["model"], "lambert")
            self.assertAlmostEqual(float(row["f_r cos θ_i [1/sr]"]), 0.5 / 3.14159265 / 2, places=6)
        glsl, twin = (list(csv.reader(io.StringIO(self.plot(
            "albedo", "--brdf", "ggx", "--range", "0.1,1", "--steps=2", *extra, "-o", "-", "--format=csv").stdout)))
            for extra in ([], ["--twin"]))
        self.assertEqual(len(glsl), 1 + 2 * 45)
        for a, b in zip(glsl[1:], twin[1:]):
            self.assertEqual(a[:2], b[:2])
            self.assertAlmostEqual(float(a[2]), float(b[2]), delta=1e-4)

    def test_texts_are_shown_and_not_run(self):
        title = "`touch run` $(touch run) \"; system('touch run'); \" @x {/Symbol a} <b> & é"
        self.plot("fresnel", "--title", title, "-o", "odd 'name`touch run`.svg")
        text = "".join(xml.etree.ElementTree.fromstring(self.read("odd 'name`touch run`.svg")).itertext())
        self.assertIn("`touch run`", text)
        self.assertIn("{/Symbol a} <b> & é", text)
        self.plot("fresnel", "--title", "a\nset print 'run'\nprint 1\n", "-o", "lines.svg")
        self.assertFalse(os.path.exists(os.path.join(self.folder, "run")))

    def test_sizes(self):
        self.plot("fresnel", "--size", "640,480", "-o", "a.png")
        self.assertEqual(struct.unpack(">II", self.read("a.png")[16:24]), (640, 480))
        self.plot("fresnel", "--size", "1280x900", "-o", "a.svg")
        self.assertIn(b'width="1280" height="900"', self.read("a.svg"))

    def test_measured_tables(self):
        path = pathlib.Path(self.folder, "table.binary")
        path.write_bytes(struct.pack("<3i", 2, 1, 1) + struct.pack("<6d", 1500, 300, 1500, 300, 1500, 300))
        self.plot("slice", "--table", path.name, "-o", "slice.png")
        rows = list(csv.DictReader(io.StringIO(self.plot("slice", "--table", path.name, "-o", "-", "--format", "csv").stdout)))
        self.assertEqual(len(rows), 8100)
        self.assertAlmostEqual(float(rows[0]["f_r red [1/sr]"]), 1.0, places=5)
        path.write_bytes(path.read_bytes()[:-1])
        self.assertIn("table.binary", self.plot("slice", "--table", path.name, "-o", "b.png", expect=3).stderr)
        self.assertIn("missing.binary", self.plot("slice", "--table", "missing.binary", "-o", "b.png", expect=3).stderr)
        self.assertFalse(os.path.exists(os.path.join(self.folder, "b.png")))

    def test_mistakes(self):
        out = ["-o", "x.svg"]
        for arguments, hint in (([], "expected one of lobes"), (["lobs"], "did you mean 'lobes'"),
                                (["lobes", *out], "--brdf"), (["lobes", "--brdf", "wrd", *out], "expected one of"),
                                (["lobes", "--brdf", "lambert"], "-o"), (["lobes", "--brdf", "lambert", "-o", "x.pdf"], ".svg"),
                                (["lobes", "--brdf", "lambert", "-o", "-"], "--format"),
                                (["lobes", "--brdf", "lambert", "-o", "x.svg", "--format", "png"], "the same"),
                                (["lobes", "--brdf", "lambert,lambert", *out], "twice"),
                                (["lobes", "--brdf", "lambert", "--incidence", "90", *out], "89.9"),
                                (["lobes", "--brdf", "lambert", "--incidence", "1,x", *out], "numbers"),
                                (["lobes", "--brdf", "lambert", "--incidence", "nan", *out], "numbers"),
                                (["lobes", "--brdf", "phong", "--set", "shinines=3", *out], "did you mean 'shininess'"),
                                (["lobes", "--brdf", "phong", "--set", "shininess=-3", *out], "expected 0.."),
                                (["lobes", "--brdf", "phong", "--set", "shininess", *out], "PARAMETER=VALUE"),
                                (["lobes", "--brdf", "phong", "--set", "phon.shininess=3", *out], "did you mean 'phong'"),
                                (["lobes", "--brdf", "phong", "--radius", "lag", *out], "did you mean 'log'"),
                                (["lobes", "--brdf", "phong", "--size", "10,10", *out], "320 to 8192"),
                                (["lobes", "--brdf", "phong", "--size", "1e9,1e9", *out], "320 to 8192"),
                                (["lobes", "--brdf", "phong", "--bakend", "egl", *out], "did you mean '--backend'"),
                                (["lobes", "--brdf", "phong", "--backend", "vulkan", *out], "expected auto, egl"),
                                (["lobes", "--brdf", "phong", "--twin", "--backend", "egl", *out], "--backend"),
                                (["table", "--brdf", "lambert", *out], "expected one of"),
                                (["albedo", "--brdf", "phong", "--over", "shinines", *out], "did you mean 'shininess'"),
                                (["albedo", "--brdf", "phong", "--over", "diffuse", *out], "single number"),
                                (["albedo", "--brdf", "phong", "--range", "5,1", *out], "LOW,HIGH"),
                                (["albedo", "--brdf", "phong", "--range=-5,1", *out], "expected 0.."),
                                (["albedo", "--brdf", "phong", "--steps", "1", *out], "2 to 200"),
                                (["error", "--brdf", "mirror", *out], "scatters no light"),
                                (["error", "--brdf", "phong", "--twin", *out], "itself"),
                                (["slice", *out], "expected one of them"), (["fresnel", "--metal", "golt", *out], "did you mean 'gold'"),
                                (["fresnel", "--metal", "gold", "--eta", "1.5", *out], "expected one"),
                                (["fresnel", "--f0", "0.99", *out], "0..0.8"), (["fresnel", "--eta", "0", *out], "expected 0.01..20"),
                                (["fresnel", "extra", *out], "unexpected argument")):
            result = self.plot(*arguments, expect=2)
            self.assertIn(hint, result.stderr, arguments)
            self.assertEqual(len(result.stderr.strip().splitlines()), 1, result.stderr)
        self.assertFalse(os.path.exists(os.path.join(self.folder, "x.svg")))
        self.plot("fresnel", "-o", "/proc/nowhere/x.svg", expect=7)

    def test_without_gnuplot(self):
        environment = dict(os.environ, PATH="/nonexistent")
        def run(name):
            return subprocess.run([LOBE, "plot", "fresnel", "-o", name], cwd=self.folder, env=environment,
                                  capture_output=True, text=True, timeout=120)
        result = run("x.svg")
        self.assertEqual(result.returncode, 3)
        self.assertIn("gnuplot-nox", result.stderr)
        self.assertEqual(len(result.stderr.strip().splitlines()), 1)
        self.assertFalse(os.path.exists(os.path.join(self.folder, "x.svg")))
        self.assertEqual(run("x.csv").returncode, 0)

    def test_a_gnuplot_that_fails_leaves_nothing(self):
        for script, hint in (("echo half; echo 'line 3: out of order' >&2; exit 0", "out of order"), ("echo half; exit 4", "status 4"),
                             ("kill -9 $$", "signal 9"), ("exit 0", "nothing")):
            folder = pathlib.Path(self.folder, "bin")
            folder.mkdir(exist_ok=True)
            fake = folder / "gnuplot"
            fake.write_text("#!/bin/sh\n" + script + "\n")
            fake.chmod(0o755)
            result = subprocess.run([LOBE, "plot", "fresnel", "-o", "y.svg"], cwd=self.folder, capture_output=True, text=True,
                                    env=dict(os.environ, PATH=f"{folder}:{os.environ['PATH']}"), timeout=120)
            self.assertEqual(result.returncode, 1, script)
            self.assertIn(hint, result.stderr)
            self.assertFalse(os.path.exists(os.path.join(self.folder, "y.svg")))

    def test_help(self):
        text = self.plot("--help").stdout
        for kind in KINDS:
            self.assertIn(kind, text)
            self.assertIn("--output", self.plot(kind, "--help").stdout)


if __name__ == "__main__":
    unittest.main()
