#!/usr/bin/env python3
"""lobe-check as people use it: exit codes, messages, shrinking, reports. LOBE_CHECK_BIN names the program."""
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import tempfile
import time
import unittest
import xml.etree.ElementTree

CHECK = str(pathlib.Path(os.environ.get("LOBE_CHECK_BIN", "build/bin/lobe-check")).resolve())

PASSES = """
/// @test halves @tag easy
/// @in x: uniform(0, 1)
/// @expect bounded(0, 0.5)
float halves(float x) { return 0.5 * x; }
"""
FAILS = """
/// @test too_large @tag easy wrong
/// @in x: uniform(0, 100)
/// @expect bounded(0, 10)
float too_large(float x) { return x * x; }
"""


class CheckTest(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="lobe-check-test-"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def write(self, name, content):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(content)
        return name

    def check(self, *arguments, expect=0, env=None):
        result = subprocess.run([CHECK, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True, timeout=120,
                                env=dict(os.environ, **(env or {})))
        self.assertEqual(result.returncode, expect, f"{arguments}\n{result.stdout}\n{result.stderr}")
        return result

    def only(self, *arguments, **keywords):
        """The JSON entry of the only test."""
        tests = json.loads(self.check(*arguments, "--json", "-", **keywords).stdout)["tests"]
        self.assertEqual(len(tests), 1, tests)
        return tests[0]


class Mistakes(CheckTest):
    def test_usage_errors_exit_with_2_in_one_line(self):
        self.write("a_test.glsl", PASSES)
        for arguments, hint in ((["--lst", "."], "did you mean '--list'"), (["--backend", "vulkan", "."], "expected auto, egl"),
                                (["--filter", "(", "."], "regular expression"), (["--filter", "nothing", "."], "none of 1 tests"),
                                (["--tag", "easi", "."], "did you mean 'easy'"), (["--repeat", "0", "."], "repeat"),
                                (["--time-limit", "-1", "."], "time-limit"), (["modls"], "did you mean 'models'"),
                                (["--json", "-", "--tap", "-", "."], "expected one"), ([], "no test file")):
            result = self.check(*arguments, expect=2)
            self.assertIn(hint, result.stderr, arguments)
            self.assertEqual(len(result.stderr.strip().splitlines()), 1, result.stderr)

    def test_help_and_version(self):
        self.assertIn("--watch", self.check("--help").stdout)
        self.assertIn("lobe-check 0", self.check("--version").stdout)

    def test_paths_without_tests_exit_with_3(self):
        self.write("empty/plain.glsl", "float f() { return 1.0; }")
        self.assertIn("no such file", self.check("missing.glsl", expect=3).stderr)
        self.assertIn("no tests", self.check("empty", expect=3).stderr)
        self.assertIn("no tests", self.check("empty/plain.glsl", expect=3).stderr)

    def test_wrong_directives_exit_with_3_and_name_the_line(self):
        head = "/// @test t\n/// @in x: uniform(0, 1)\n/// @expect finite\n"
        body = "float t(float x) { return x; }\n"
        cases = [
            ("/// @test t\n/// @inn x: uniform(0, 1)\n" + body, ":2: unknown directive @inn; did you mean '@in'"),
            ("/// @test t\n/// @in y: uniform(0, 1)\n/// @expect finite\n" + body, ":2: "),
            ("/// @test t\n/// @in x: unifrm(0, 1)\n/// @expect finite\n" + body, "did you mean 'uniform'"),
            ("/// @test t\n/// @in x: uniform(1, 0)\n/// @expect finite\n" + body, "the smaller first"),
            ("/// @test t\n/// @in x: uniform(0, zero)\n/// @expect finite\n" + body, "'zero' is not a number"),
            ("/// @test t\n/// @in x: log_uniform(-1, 1)\n/// @expect finite\n" + body, "one sign"),
            ("/// @test t\n/// @in x: vec3 uniform(0, 1)\n/// @expect finite\n" + body, "x is a float, not a vec3"),
            ("/// @test t\n/// @in x: unit_sphere\n/// @expect finite\n" + body, "gives vec3"),
            ("/// @test t\n/// @in x: csv(\"none.csv\", x)\n/// @expect finite\n" + body, "none.csv"),
            ("/// @test t\n/// @expect finite\n" + body, "no generator for input 'x'"),
            ("/// @test t\n/// @in x: any\n" + body, "nothing is expected"),
            ("/// @test t\n/// @in x: any\n/// @expect finit\n" + body, "did you mean 'finite'"),
            ("/// @test t\n/// @in x: any\n/// @expect equals 1 within 3\n" + body, "'N ulp', 'rel R' or 'abs A'"),
            ("/// @test t\n/// @in x: any\n/// @expect bounded(0, 1) always\n" + body, "was not expected"),
            ("/// @test t\n/// @in x: any\n/// @expect twin lambret\n" + body, "did you mean 'lambert'"),
            ("/// @test t\n/// @in x: any\n/// @expect finite\nint y = 3;\n", "no function follows"),
            ("/// @test t\n/// @in x: any\n/// @expect finite\nfloat t(inout float x) { return x; }\n", "parameter"),
            ("/// @test t\n/// @in m: any\n/// @expect finite\nfloat t(mat3 m) { return 0.0; }\n", "mat3"),
            ("/// @in x: any\n" + body, "without @test"), (head + body + head + "float u(float x) { return x; }", "a second test named t"),
            (head + "/// @stage vertx\n" + body, "did you mean 'vertex'"), (head + "/// @inputs none\n" + body, "not a number"),
            (head + "/// @must_fail\n" + body, "reason")]
        for text, message in cases:
            self.write("bad_test.glsl", text)
            result = self.check("bad_test.glsl", expect=3)
            self.assertIn(message, result.stdout, text)
            self.assertRegex(result.stdout, r"bad_test\.glsl:\d+: |none\.csv", text)

    def test_csv_faults_name_file_and_place(self):
        for content, message in (("a,b\n1,2\n", "no column 'x'"), ("x\n1\nabc\n", "abc"), ("x\n", "no rows"), ("", "t.csv")):
            self.write("t.csv", content)
            self.write("csv_test.glsl", "/// @test t\n/// @in x: csv(\"t.csv\", x)\n/// @expect finite\nfloat t(float x) { return x; }\n")
            self.assertIn(message, self.check(".", expect=3).stdout)

    def test_wrong_glsl_exits_with_5_and_the_other_files_run(self):
        self.write("lib/broken.glsl", "float fine() { return 1.0; }\nfloat broken() { return undefined_name; }\n")
        self.write("a_test.glsl", "#include \"lib/broken.glsl\"\n/// @test t\n/// @in x: any\n/// @expect finite\nfloat t(float x) { return broken(); }\n")
        self.write("b_test.glsl", PASSES)
        self.write("c_test.glsl", FAILS)
        result = self.check(".", expect=5)
        self.assertIn("lib/broken.glsl:2:", result.stdout)
        self.assertIn("undefined_name", result.stdout)
        self.assertIn("1 passed, 1 failed, 1 error", result.stdout)

    def test_missing_include_names_where_it_stands(self):
        self.write("a_test.glsl", "\n#include \"nowhere.glsl\"\n" + PASSES)
        result = self.check(".", expect=5)
        self.assertIn("a_test.glsl:2: shader file nowhere.glsl not found in", result.stdout)

    def test_full_or_closed_outputs_exit_with_7(self):
        self.write("a_test.glsl", PASSES)
        with open("/dev/full", "w") as full:
            result = subprocess.run([CHECK, "."], cwd=self.folder, stdout=full, stderr=subprocess.PIPE, text=True, timeout=60)
        self.assertEqual(result.returncode, 7, result.stderr)
        self.write("file", "in the way")
        self.check(".", "--json", "file/x.json", expect=7)

    def test_an_unknown_device_is_a_usage_error(self):
        self.write("a_test.glsl", PASSES)
        result = self.check(".", "--backend", "egl", "--device", "99", expect=2)
        self.assertEqual(len(result.stderr.strip().splitlines()), 1)


class TimeLimits(CheckTest):
    ENDLESS = """
/// @test endless
/// @in x: uniform(1, 2)
/// @expect finite
float endless(float x) { while (x > 0.0) x += 1e-9; return x; }
"""

    def test_an_endless_loop_costs_its_test_only(self):
        self.write("a_test.glsl", self.ENDLESS)
        self.write("b_test.glsl", PASSES)
        started = time.time()
        # softpipe, unlike llvmpipe, has no limit of its own.
        result = self.check(".", "--time-limit", "6", "--backend", "osmesa", expect=1, env={"GALLIUM_DRIVER": "softpipe"})
        self.assertLess(time.time() - started, 60)
        self.assertIn("exceeded the time limit of 6 s", result.stdout)
        self.assertIn("1 passed, 1 failed", result.stdout)


class Failures(CheckTest):
    def failure(self, text, *arguments):
        self.write("f_test.glsl", text)
        test = self.only("f_test.glsl", *arguments, expect=1)
        self.assertEqual(test["status"], "failed")
        return test["failure"]

    def test_a_failure_is_shrunk_and_explained(self):
        failure = self.failure(FAILS)
        x = float.fromhex(failure["inputs"][0]["literal"])
        self.assertIn(x, (4.0, 5.0, 10.0), "the simplest input whose square is above 10")
        self.assertEqual(failure["expected"], "bounded(0, 10)")
        self.assertEqual(failure["place"], "f_test.glsl:4")
        text = self.check("f_test.glsl", expect=1).stdout
        for part in ("f_test.glsl:5", "bounded(0, 10)", "0x1", "/// @in x: values(" + failure["inputs"][0]["literal"] + ")"):
            self.assertIn(part, text)

    def test_the_regression_test_fails_alike(self):
        """Pasted as it is, it runs the one input, which fails as before."""
        texts = [FAILS,
                 "/// @test v @stage vertex\n/// @in v: unit_sphere\n/// @in i: uniform(0, 9)\nvoid v(vec3 v, int i) { check_less(v.x * float(i), 0.3); }\n",
                 "/// @test m\n/// @in x: uniform(0, 1)\n/// @expect monotone increasing\nfloat m(float x) { return x > 0.5 ? x - 0.25 : x; }\n",
                 "/// @test n\n/// @in x: values(bits(0x7fc00123))\n/// @expect equals 3 within 2 ulp\nfloat n(float x) { return x; }\n",
                 "/// @test d\n/// @in x: values(0x1p-149)\n/// @expect equals 0\nfloat d(float x) { return x; }\n",
                 "#include \"brdf/lambert.glsl\"\n/// @test b\n/// @expect twin\nvec3 b(Dirs d, LambertParams p) { return 1.001 * lambert_f_cos(d, p); }\n"]
        for text in texts:
            failure = self.failure(text)
            self.write("f_test.glsl", text + failure["regression"])
            again = self.only("f_test.glsl", "--filter", "_regression$", expect=1)
            self.assertEqual([i["literal"] for i in again["failure"]["inputs"]], [i["literal"] for i in failure["inputs"]], text)
            self.assertEqual(again["failure"]["values"], failure["values"], text)
            self.assertEqual(again["failing"], again["inputs"])

    def test_a_reference_of_a_table_becomes_a_constant(self):
        self.write("t.csv", "x,y\n1,1\n2,3\n")
        failure = self.failure("/// @test t\n/// @in x: csv(\"t.csv\", x)\n/// @expect equals csv(\"t.csv\", y) within 1 ulp\nfloat t(float x) { return x; }\n")
        self.assertIn("/// @expect equals 0x1.8p+1 within 1 ulp", failure["regression"])

    def test_the_line_of_the_failing_check_is_named_through_includes(self):
        self.write("lib/half.glsl", "void helper(float x)\n{\n    check(x < 2.0);\n    check_less(x, 0.5);\n}\n")
        failure = self.failure("#include \"lib/half.glsl\"\n/// @test t\n/// @in x: uniform(0, 1)\nvoid t(float x) { helper(x); }\n")
        self.assertEqual(failure["place"], "lib/half.glsl:4")
        self.assertEqual(failure["expected"], "check_less(x, 0.5);")

    def test_every_bit_pattern_arrives_as_it_is(self):
        words = [0x00000000, 0x80000000, 0x00000001, 0x807fffff, 0x00800000, 0x7f7fffff, 0x7f800000, 0xff800000, 0x7fc00001, 0xffc12345]
        for stage in ("fragment", "vertex"):
            for word in words:
                literal = f"bits(0x{word:08x})"
                self.write("b_test.glsl", f"/// @test t @stage {stage}\n/// @in x: values({literal})\n"
                           f"void t(float x) {{ check_equal(floatBitsToUint(x), {word}u); }}\n")
                self.only("b_test.glsl")

    def test_must_fail_turns_verdicts_round(self):
        self.write("m_test.glsl", FAILS.replace("/// @test", "/// @must_fail squares are larger\n/// @test"))
        test = self.only("m_test.glsl")
        self.assertEqual((test["status"], test["must_fail"]), ("passed", "squares are larger"))
        self.write("m_test.glsl", PASSES.replace("/// @test", "/// @must_fail it should not\n/// @test"))
        self.assertIn("passed, but must fail: it should not", self.check("m_test.glsl", expect=1).stdout)

    def test_unmet_assumptions_are_a_failure(self):
        self.write("a_test.glsl", "/// @test t\n/// @in x: uniform(0, 1)\nvoid t(float x) { assume(x > 2.0); check(false); }\n")
        self.assertIn("assume() left no input", self.check(".", expect=1).stdout)


class Runs(CheckTest):
    def test_must_fail_without_inputs_is_a_failure_too(self):
        self.write("none_test.glsl", "/// @test none @must_fail nothing left\n/// @in x: uniform(0, 1)\n"
                                     "void none(float x) { assume(x > 2.0); check(false); }\n")
        self.assertIn("assume() left no input", self.check(".", expect=1).stdout)

    def test_byte_order_marks_and_links_to_nowhere(self):
        self.write("mark_test.glsl", "\ufeff#version 330\n/// @test mark\n/// @in x: values(1)\n/// @expect finite\nfloat mark(float x) { return x; }\n")
        self.check(".")
        (self.folder / "gone_test.glsl").symlink_to("/nonexistent")
        self.assertIn("gone_test.glsl: can't be read", self.check(".", expect=3).stdout)

    def test_foreign_glsl_with_versions_and_relative_includes(self):
        """A project that knows nothing of Lobe."""
        self.write("src/maths/square.glsl", "#version 410 core\n#extension GL_ARB_gpu_shader5 : enable\n#include \"constants.glsl\"\nfloat square(float x) { return ONE * x * x; }\n")
        self.write("src/maths/constants.glsl", "#version 330\n#define ONE 1.0\n")
        self.write("tests/square_test.glsl", "#version 330 core\n#include \"../src/maths/square.glsl\"\n/// @test s\n/// @in x: uniform(-9, 9)\n/// @expect bounded(0, 81)\nfloat s(float x) { return square(x); }\n")
        self.check("tests")
        self.write("tests/square_test.glsl", "#include \"maths/square.glsl\"\n/// @test s\n/// @in x: any\n/// @expect bounded(0, inf)\nfloat s(float x) { return square(x); }\n")
        self.check("tests", "-I", "src")
        self.write("src/maths/constants.glsl", "#version 300 es\n#define ONE 1.0\n")
        self.assertIn("constants.glsl:1: #version 300 es; expected", self.check("tests", "-I", "src", expect=5).stdout)

    def test_selection_and_lists(self):
        self.write("a_test.glsl", PASSES)
        self.write("deep/b_test.glsl", FAILS)
        self.assertEqual(self.check(".", "--list").stdout, "a_test.glsl:5: halves [easy]\ndeep/b_test.glsl:5: too_large [easy] [wrong]\n")
        self.assertEqual(self.check(".", "--list-tags").stdout, "easy\nwrong\n")
        self.check(".", "--filter", "^halves$")
        self.check(".", "--tag", "wrong", expect=1)
        self.check(".", "--tag", "wrong", "--filter", "halves", expect=2)

    def test_inputs_seed_and_repeat(self):
        self.write("a_test.glsl", PASSES)
        self.assertEqual(self.only(".")["inputs"], 65536)
        self.assertEqual(self.only(".", "--inputs", 1500000)["inputs"], 1500000)
        self.assertEqual(self.only(".", "--inputs", 10, "--repeat", 5)["inputs"], 50)
        self.write("a_test.glsl", "/// @test t @inputs 4\n/// @in x: any\n/// @expect bounded(0, 1)\nfloat t(float x) { return x; }\n")
        first = self.only(".", "--seed", 7, expect=1)
        self.assertEqual(first["inputs"], 4)
        again = self.only(".", "--seed", 7, expect=1)
        first.pop("milliseconds"), again.pop("milliseconds")
        self.assertEqual(first, again, "the same seed gives the same run")

    def test_reports_are_what_their_formats_say(self):
        self.write("a_test.glsl", PASSES + FAILS)
        self.write("b_test.glsl", "/// @test c & d <\n/// @in x: any\n/// @expect finite\nfloat t(float x) { return nothing; }\n".replace(" & d <", "&<"))
        self.check(".", "--junit", "j.xml", "--json", "j.json", "--tap", "t.tap", expect=5)
        suite = xml.etree.ElementTree.parse(self.folder / "j.xml").getroot().find("testsuite")
        self.assertEqual((suite.get("tests"), suite.get("failures"), suite.get("errors")), ("3", "1", "1"))
        self.assertEqual([case.get("name") for case in suite.iter("testcase")], ["halves", "too_large", "c&<"])
        self.assertIn("values(", suite.find(".//failure").text)
        self.assertIn("nothing", suite.find(".//error").text)
        report = json.loads((self.folder / "j.json").read_text())
        self.assertEqual((report["schema"], report["passed"], report["failed"], report["errors"]), (1, 1, 1, 1))
        lines = (self.folder / "t.tap").read_text().splitlines()
        self.assertEqual(lines[:2], ["TAP version 13", "1..3"])
        self.assertEqual([line[:8] for line in lines if re.match(r"(not )?ok \d", line)], ["ok 1 - a", "not ok 2", "not ok 3"])
        self.assertTrue(all(re.match(r"(not )?ok \d+ - |# |#$", line) for line in lines[2:]), lines)
        self.assertEqual(self.check(".", "--tap", "-", expect=5).stdout.splitlines()[1], "1..3")

    def test_quiet_prints_failures_and_the_sum(self):
        self.write("a_test.glsl", PASSES + FAILS)
        text = self.check(".", "-q", expect=1).stdout
        self.assertNotIn("halves", text)
        self.assertIn("too_large", text)

    def test_watch_runs_again_when_an_include_changes(self):
        self.write("lib.glsl", "float f(float x) { return x; }\n")
        self.write("a_test.glsl", "#include \"lib.glsl\"\n/// @test t\n/// @in x: uniform(0, 1)\n/// @expect bounded(0, 1)\nfloat t(float x) { return f(x); }\n")
        process = subprocess.Popen([CHECK, ".", "--watch"], cwd=self.folder, stdout=subprocess.PIPE, text=True)
        try:
            def until_waiting():
                lines = []
                for line in process.stdout:
                    lines.append(line)
                    if "Waiting" in line:
                        return "".join(lines)
                return "".join(lines)
            self.assertIn("1 passed, 0 failed", until_waiting())
            time.sleep(0.05)
            self.write("lib.glsl", "float f(float x) { return 2.0 * x; }\n")
            self.assertIn("0 passed, 1 failed", until_waiting())
        finally:
            process.send_signal(signal.SIGINT)
            process.wait(timeout=10)
            process.stdout.close()


class Models(CheckTest):
    def models(self, *arguments, **keywords):
        return json.loads(self.check("models", *arguments, "--json", "-", **keywords).stdout)

    def test_a_model_is_measured(self):
        report = self.models("lambert", "ggx", "--inputs", 3000)
        self.assertEqual((report["schema"], [m["name"] for m in report["models"]]), (1, ["lambert", "ggx"]))
        for model in report["models"]:
            self.assertEqual((model["rows"], model["values"], model["failing"]), (3000, 9000, 0))
            self.assertGreater(model["worst_units"], 0.0)
            self.assertLess(model["worst_units"], 16.0)
            self.assertLess(model["asymmetry"], 1e-5)
        self.assertAlmostEqual(report["models"][0]["albedo"][0]["value"], 1.0, places=6)

    def test_time_stops_at_fewer_rows_and_says_so(self):
        model = self.models("he", "--inputs", 10000000, "--time-limit", 0.1)["models"][0]
        self.assertTrue(model["stopped_by_time"])
        self.assertLess(model["rows"], 10000000)

    def test_a_wrong_model_fails(self):
        shaders = pathlib.Path(__file__).resolve().parents[2] / "shaders/glsl"
        shutil.copytree(shaders, self.folder / "glsl")
        lambert = self.folder / "glsl/brdf/lambert.glsl"
        lambert.write_text(lambert.read_text().replace("INV_PI * d.wi.z", "1.00001 * INV_PI * d.wi.z"))
        env = {"LOBE_SHADER_DIR": str(self.folder / "glsl")}
        model = self.models("lambert", "--inputs", 1000, expect=1, env=env)["models"][0]
        self.assertGreater(model["failing"], 500)
        self.assertIn("expected", model["message"])
        self.assertIn("FAILED", self.check("models", "lambert", "--inputs", 1000, expect=1, env=env).stdout)
        lambert.write_text("nonsense")
        self.assertIn("lambert.glsl:1", self.check("models", "lambert", expect=5, env=env).stderr)

    def test_mistakes_exit_with_2(self):
        self.assertIn("did you mean 'lambert'", self.check("models", "lambret", expect=2).stderr)
        self.assertIn("did you mean '--inputs'", self.check("models", "--input", "3", expect=2).stderr)
        self.check("models", "--time-limit", "0", expect=2)


if __name__ == "__main__":
    unittest.main()
