#!/usr/bin/env python3
"""lobe report as people use it, and lobe render that chooses quality by error or time."""
import csv
import json
import os
import signal
import subprocess
import unittest

from lobe_test import LOBE, LobeTest, png_pixels, quad_scene


def changed(report, change):
    """A copy of a report with all settings of all scenes changed."""
    copy = json.loads(json.dumps(report))
    for scene in copy["scenes"]:
        for setting in scene["settings"]:
            change(setting)
    return copy


def slower(setting):
    for key in ("median_ms", "low_ms", "high_ms", "minimum_ms", "wall_ms"):
        setting["time"][key] *= 100


def wronger(setting):
    setting["error"]["relmse"] += 1.0


class Report(LobeTest):
    SIZE = ("-r", 48, 32, "--camera-azimuth", 33, "--camera-elevation", 21)  # edges along no row of pixels

    def report(self, *arguments, **keywords):
        return self.lobe("report", *arguments, "--max-settings", 6, "--max-time", 20, *self.SIZE, **keywords)

    def read(self, name="out/report.json"):
        return json.loads((self.folder / name).read_text())

    def test_files_hold_together(self):
        second = self.write("other.gltf", quad_scene())
        result = self.report(self.scene, second, "-o", "out")
        self.assertIn("setting 6 of at most 6", result.stderr)
        report = self.read()
        self.assertEqual(report["schema"], 1)
        self.assertEqual([scene["scene"] for scene in report["scenes"]], ["quad", "other"])
        for name in ("report.html", "report.png", "report.csv"):
            self.assertGreater((self.folder / "out" / name).stat().st_size, 100, name)
        for file in report["pictures"].values():
            self.assertEqual(png_pixels(self.folder / "out" / file)[:2], (48, 32), file)
        with (self.folder / "out/report.csv").open(newline="") as file:
            rows = list(csv.DictReader(file))
        settings = [setting for scene in report["scenes"] for setting in scene["settings"]]
        self.assertEqual(len(rows), len(settings))
        for row, setting in zip(rows, settings):
            self.assertEqual(float(row["relmse"]), setting["error"]["relmse"])
            self.assertEqual(float(row["median_ms"]), setting["time"]["median_ms"])
            self.assertEqual(row["anti_aliasing"], setting["knobs"]["anti_aliasing"])
        for scene in report["scenes"]:
            self.check_scene(scene, report)

    def check_scene(self, scene, report):
        self.assertEqual(scene["search"]["tried"], len(scene["settings"]))
        self.assertIn("texture_bits", [entry["knob"] for entry in scene["knobs_without_effect"]])
        self.assertIn("spot", json.dumps(scene["left_out"]))
        self.assertLessEqual({"draft", "balanced", "high", "converged"}, {s["preset"] for s in scene["settings"]})
        front = [s for s in scene["settings"] if s["front"]]
        self.assertTrue(front)
        for i, setting in enumerate(scene["settings"]):
            self.assertEqual(setting["id"], i)
            self.assertEqual(list(setting["knobs"]), sorted(knob["name"] for knob in report["knobs"]))
            span = setting["time"]
            self.assertLessEqual(0, span["minimum_ms"])
            self.assertLessEqual(span["minimum_ms"], span["low_ms"])
            self.assertLessEqual(span["low_ms"], span["median_ms"])
            self.assertLessEqual(span["median_ms"], span["high_ms"])
            self.assertEqual(setting["error"]["non_finite"], 0)
            self.assertGreater(setting["error"]["edge_pixels"], 0, "the square's outline")
            self.assertLess(setting["error"]["shading_relmse"], setting["error"]["edge_relmse"] + 1e-12)
            passes = {entry["pass"]: entry for entry in setting["passes"]}
            if setting["knobs"]["shading"] == "deferred":
                self.assertGreater(passes["gbuffer"]["floor_ms"], 0.0)
                self.assertGreater(passes["gbuffer"]["bytes_per_pixel"], 0)
            for key in ("picture", "difference"):
                self.assertIn(setting[key], report["pictures"])
        # More samples are less wrong at the outline.
        worst = {s["preset"]: s["error"]["edge_relmse"] for s in scene["settings"] if s["preset"]}
        self.assertLess(worst["converged"], worst["balanced"])
        self.assertLess(worst["balanced"], worst["draft"])

    def test_against_flags_what_got_worse(self):
        self.report(self.scene, "-o", "out", "-q")
        old = self.read()
        same = self.lobe("report", "--from", "out/report.json", "--against", "out/report.json")
        self.assertIn("6 settings compared, 0 regressions, 0 improvements", same.stdout)
        for change, word in ((slower, "time"), (wronger, "error")):
            self.write("worse.json", changed(old, change))
            result = self.lobe("report", "--from", "worse.json", "--against", "out/report.json", expect=1)
            self.assertIn("6 regressions against out/report.json", result.stderr)
            self.assertIn("worse: quad, draft: " + word, result.stdout)
            better = self.lobe("report", "--from", "out/report.json", "--against", "worse.json")
            self.assertIn("6 improvements", better.stdout)

    def test_render_chooses_by_a_report(self):
        self.report(self.scene, "-o", "out", "-q")
        by_preset = {s["preset"]: s for s in self.read()["scenes"][0]["settings"] if s["preset"]}
        error = by_preset["balanced"]["error"]["relmse"]
        shots = self.render("-o", "a.png", "--list", "--json", "--report", "out/report.json", "--max-error",
                            error * 1.0001)
        settings = json.loads(shots.stdout)["settings"]
        self.assertIn("measured on this scene", shots.stderr)
        chosen = next(s for s in self.read()["scenes"][0]["settings"]
                      if all(str(settings[k]) == v for k, v in s["knobs"].items()))
        self.assertLessEqual(chosen["error"]["relmse"], error * 1.0001)
        self.assertEqual(settings["anti_aliasing"], "ssaa4")
        # A budget that everything keeps gives the least error.
        shots = self.render("-o", "a.png", "--list", "--json", "--report", "out/report.json", "--budget", "1000s")
        self.assertEqual(json.loads(shots.stdout)["settings"]["anti_aliasing"], "ssaa16")
        result = self.render("-o", "a.png", "--report", "out/report.json", "--max-error", 1e-30, expect=2)
        self.assertIn("can't be kept; the best that can be had is relmse", result.stderr)
        self.assertNotIn("a.png", self.files())

    def test_render_calibrates_where_there_is_no_report(self):
        result = self.lobe("render", self.scene, "-r", 256, 256, "-o", "a.png", "--max-error", 0.5)
        self.assertIn("expect relmse", result.stderr)
        self.assertIn("two small pictures", result.stderr)
        self.assertIn("a.png", self.files())

    def test_interrupted_work_leaves_what_is_done(self):
        other = self.write("other.gltf", quad_scene())
        arguments = [LOBE, "report", self.scene, other, "-o", "out", "--max-settings", "12", "-r", "640", "360"]
        with subprocess.Popen(arguments, cwd=self.folder, stderr=subprocess.PIPE, text=True,
                              env=dict(os.environ, XDG_CONFIG_HOME=str(self.folder))) as process:
            for line in process.stderr:
                if line.startswith("other: setting 2"):
                    process.send_signal(signal.SIGINT)
            self.assertEqual(process.wait(60), 130)
        report = self.read()
        self.assertEqual([scene["scene"] for scene in report["scenes"]], ["quad", "other"])
        self.assertIn(len(report["scenes"][1]["settings"]), range(2, 12))
        self.assertFalse([name for name in self.files() if name.startswith("out/.")])

    def test_the_reference_and_the_converged_picture_agree_where_nothing_casts_shadows(self):
        pictures = {}
        for truth in ("converged", "reference", "unshadowed"):
            self.report(self.scene, "-o", truth, "-q", "--truth", truth)
            scene = self.read(truth + "/report.json")["scenes"][0]
            pictures[truth] = scene
            self.assertEqual(scene["truth"]["method"], "converged" if truth == "converged" else "reference")
        by_truth = {truth: next(s["error"]["shading_relmse"] for s in scene["settings"] if s["preset"] == "converged")
                    for truth, scene in pictures.items()}
        self.assertLess(max(by_truth.values()), 1e-5, "inside the square all three agree to 0.3 %")

    def test_cost_is_fitted(self):
        self.lobe("report", "--cost", "pixels", self.scene, "-o", "out", "-r", 160, 120, "--max-time", 10, "-q")
        cost = self.read("out/cost_pixels.json")["costs"][0]
        self.assertEqual([point["count"] for point in cost["points"]], [1200, 4800, 10800, 19200, 43200])
        self.assertLessEqual(cost["fit"]["exponent_low"], cost["fit"]["exponent_high"])
        self.assertGreater((self.folder / "out/cost_pixels.png").stat().st_size, 1000)

    def test_mistakes_end_in_one_line(self):
        self.write("none.json", "{}")
        self.write("schema.json", {"schema": 99})
        self.write("damaged.json", {"schema": 1, "scenes": [{"scene": "quad", "settings": [{}]}]})
        for arguments, code, text in (
                (["report"], 2, "nothing to measure"),
                (["report", "missing.gltf"], 3, "missing.gltf"),
                (["report", self.scene, "--anti-aliasing", "none"], 2, "anti_aliasing is set"),
                (["report", self.scene, "--max-settings", "1"], 2, "--max-settings"),
                (["report", self.scene, "--error-metric", "nonsense"], 2, "--error-metric"),
                (["report", "--from", "none.json"], 2, "--from goes with --against"),
                (["report", "--from", "none.json", "--against", "none.json"], 3, "is no report"),
                (["report", "--from", "schema.json", "--against", "none.json"], 3, "schema 99; expected 1"),
                (["report", "--from", "damaged.json", "--against", "none.json"], 3, "damaged"),
                (["report", self.scene, "--against", "missing.json"], 3, "missing.json"),
                (["report", self.scene, "--cost", "light"], 2, "did you mean 'lights'?"),
                (["report", self.scene, "--cost", "lights", "--against", "none.json"], 2, "--cost goes without"),
                (["render", self.scene, "--report", "none.json"], 2, "--report without"),
                (["render", self.scene, "--max-error", "-1"], 2, "--max-error"),
                (["render", self.scene, "--budget", "fast"], 2, "expected a time above 0"),
                (["render", self.scene, "--budget", "1s", "--quality", "draft"], 2, "quality is set"),
                (["render", self.scene, "--budget", "1s", "--report", "missing.json"], 3, "missing.json")):
            with self.subTest(arguments=arguments):
                result = self.lobe(*arguments, expect=code)
                self.assertIn(text, result.stderr)
                self.assertEqual(len(result.stderr.strip().splitlines()), 1, result.stderr)


if __name__ == "__main__":
    unittest.main()
