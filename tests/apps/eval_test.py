#!/usr/bin/env python3
"""lobe-check eval as people use it: tables in, tables out; one line and a documented exit code for every mistake.

LOBE_CHECK_BIN names the program. Needs the standard library only."""
import csv
import io
import math
import os
import pathlib
import random
import re
import struct
import subprocess
import tempfile
import unittest

CHECK = str(pathlib.Path(os.environ.get("LOBE_CHECK_BIN", "build/bin/lobe-check")).resolve())
AXES = ["lx", "ly", "lz", "vx", "vy", "vz"]
DIRECTIONS = ",".join(AXES)
PAIR = "0.6,0,0.8,-0.36,0.48,0.8"
FLOAT = 2.0 ** -24


def hemisphere(rng):
    z, phi = rng.uniform(0.05, 1), rng.uniform(0, 2 * math.pi)
    return [math.sqrt(1 - z * z) * math.cos(phi), math.sqrt(1 - z * z) * math.sin(phi), z]


class Eval(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.addCleanup(self.temporary.cleanup)
        self.folder = pathlib.Path(self.temporary.name)

    def check(self, *arguments, expect=0, stdin="", env=None):
        result = subprocess.run([CHECK, "eval", *map(str, arguments)], cwd=self.folder, input=stdin, capture_output=True, text=True,
                                timeout=300, env={**os.environ, **(env or {})})
        self.assertEqual(result.returncode, expect, (arguments, result.stdout[-500:], result.stderr))
        return result

    def write(self, name, content):
        path = self.folder / name
        path.write_bytes(content) if isinstance(content, bytes) else path.write_text(content)
        return path

    def model(self, model, columns, rows, *arguments):
        text = io.StringIO()
        writer = csv.writer(text)
        writer.writerow(columns)
        writer.writerows(rows)
        result = self.check("--model", model, "--inputs", "-", *arguments, stdin=text.getvalue())
        self.assertEqual(result.stderr, "")
        return list(csv.reader(io.StringIO(result.stdout)))

    def refused(self, arguments, text, expect, *hints):
        """One line on standard error, nothing written."""
        before = sorted(self.folder.iterdir())
        result = self.check(*arguments, expect=expect, stdin=text)
        self.assertEqual(len(result.stderr.strip().splitlines()), 1, result.stderr)
        self.assertEqual(result.stdout, "")
        for hint in hints:
            self.assertIn(hint, result.stderr)
        self.assertEqual(sorted(self.folder.iterdir()), before)

    def test_every_model_agrees_with_its_twin(self):
        """16 x 2^-24 (4 + c), c the condition number with respect to the six components, by differences on the twin."""
        known = self.check("--model", "none", "--inputs", "-", expect=2).stderr
        models = re.search(r"expected one of (.*)", known).group(1).split(", ")
        self.assertGreater(len(models), 10)
        rng = random.Random(7)
        rows = [[i, *hemisphere(rng), *hemisphere(rng)] for i in range(100)]
        step = 2.0 ** -20
        for model in models:
            table = {"lafortune": ["--table", "brushedmetal"], "measured": ["--table", "uneven"]}.get(model, [])
            glsl = self.model(model, ["id"] + AXES, rows, *table)
            exact = self.model(model, ["id"] + AXES, rows, *table, "--twin")
            moved = []
            for axis in range(6):
                turned = [row[:1 + axis] + [row[1 + axis] * (1 + step)] + row[2 + axis:] for row in rows]
                moved.append(self.model(model, ["id"] + AXES, turned, *table, "--twin"))
            self.assertEqual(glsl[0], ["id", "f_cos_r", "f_cos_g", "f_cos_b"])
            self.assertEqual([line[0] for line in glsl], [line[0] for line in exact])
            self.assertNotEqual(glsl[1:], exact[1:]) if model not in ("mirror",) else None
            for i in range(1, len(rows) + 1):
                for channel in (1, 2, 3):
                    got, twin = float(glsl[i][channel]), float(exact[i][channel])
                    # Nine digits of the twin are not enough for differences below 1e-9 / step.
                    slope = sum(max(abs(float(m[i][channel]) - twin) - 1e-8 * twin, 0) for m in moved) / step
                    if twin < 1e-36:  # floats end here
                        self.assertLess(got, 1e-30)
                        continue
                    self.assertLessEqual(abs(got - twin), 16 * FLOAT * (4 * twin + slope), (model, rows[i - 1]))

    def test_tables_pass_through_files_streams_and_backends_alike(self):
        text = f'{DIRECTIONS},id,diffuse\r\n{PAIR},"a, ""b""",0.5\r\n\r\n{PAIR},2,0x1p-2\r\n'
        self.write("in.csv", b"\xef\xbb\xbf" + text.encode())
        by_stream = self.check("--model=lambert", "--inputs=-", stdin=text).stdout
        for backend in ("auto", "egl", "osmesa"):
            out = f"new/{backend}.csv"
            result = self.check("--model", "lambert", "--inputs", "in.csv", "-o", out, "--backend", backend)
            self.assertEqual(result.stdout + result.stderr, "")
            self.assertEqual((self.folder / out).read_text(), by_stream)
        rows = list(csv.reader(io.StringIO(by_stream)))
        self.assertEqual([row[0] for row in rows], ["id", 'a, "b"', "2"])
        self.assertAlmostEqual(float(rows[1][1]), 0.5 * 0.8 / math.pi, delta=1e-8)
        self.assertEqual(self.check("--model=lambert", "--inputs=-", stdin=DIRECTIONS + "\n").stdout, "f_cos_r,f_cos_g,f_cos_b\n")

    def test_many_rows_in_order_and_bounded_memory(self):
        count = 200000
        with open(self.folder / "many.csv", "w") as many:
            many.write(f"id,{DIRECTIONS},cx0,cy0,cz0,n0\n")
            many.writelines(f"{i},{PAIR},-1,-1,1,{1 + i % 7}\n" for i in range(count))
        limited = ["bash", "-c", 'ulimit -d 2000000; exec "$@"', "-", CHECK, "eval", "--model", "lafortune", "--inputs", "many.csv", "-o"]
        subprocess.run([*limited, "many_out.csv"], cwd=self.folder, check=True, timeout=300)
        subprocess.run([*limited, "many_twin.csv", "--twin"], cwd=self.folder, check=True, timeout=300)
        with open(self.folder / "many_out.csv") as glsl, open(self.folder / "many_twin.csv") as twin:
            rows = list(zip(csv.reader(glsl), csv.reader(twin)))
        self.assertEqual(len(rows), count + 1)
        for i, (got, exact) in enumerate(rows[1:]):
            self.assertEqual((got[0], exact[0]), (str(i), str(i)))
            self.assertLess(abs(float(got[1]) / float(exact[1]) - 1), 1e-5)

    def test_measured_tables_are_read_from_files_and_damaged_ones_refused(self):
        sizes = (2, 3, 4)
        header = struct.pack("<3i", *sizes)
        values = struct.pack("<72d", *([1500.0] * 24 + [3000.0 / 1.15] * 24 + [0.0] * 24))
        self.write("flat.binary", header + values)
        row = self.model("measured", AXES, [PAIR.split(",")], "--table", "flat.binary")[1]
        for got, expected in zip(row, (0.8, 1.6, 0.0)):
            self.assertAlmostEqual(float(got), expected, delta=1e-6)
        text = f"{DIRECTIONS}\n{PAIR}\n"
        self.write("short.binary", header + values[:-8])
        self.write("long.binary", header + values + b"1")
        self.write("size.binary", struct.pack("<3i", 2, -3, 4) + values)
        self.write("empty.binary", b"")
        self.write("nan.binary", header + struct.pack("<d", math.nan) + values[8:])
        for name in ("short", "long", "size", "empty", "nan"):
            self.refused(["--model", "measured", "--inputs", "-", "--table", f"{name}.binary"], text, 3, f"{name}.binary: ", "expected")
        self.refused(["--model", "measured", "--inputs", "-", "--table", "absent.binary"], text, 3, "absent.binary: can't be read")
        self.refused(["--model", "measured", "--inputs", "-", "--table", "."], text, 3)
        self.refused(["--model", "measured", "--inputs", "-"], text, 3, "--table")
        self.refused(["--model", "lambert", "--inputs", "-", "--table", "flat.binary"], text, 2, "lambert has no table")

    def test_tables_that_do_not_fit_name_line_and_column(self):
        for columns, cells, *hints in (("", "", ":1: no column"), ("lx,ly,lz,vx,vy,vy", "", ":1: column 'vy' is there twice"),
                                       (DIRECTIONS + ",m,roughnes", PAIR + ",1,1", ":1: column 'roughnes' is none of cook_torrance"),
                                       (DIRECTIONS + ",specullar", PAIR + ",1", "did you mean 'specular'?"),
                                       (DIRECTIONS + ",m", PAIR, ":2: 6 cells; expected 7"),
                                       (DIRECTIONS + ",m", PAIR + ",11", ":2: m: 11; expected 1e-05..10"),
                                       (DIRECTIONS + ",m", PAIR + ",nan", ":2: m: NaN; expected 1e-05..10"),
                                       (DIRECTIONS + ",m", PAIR + ",1 m", ":2: m: '1 m'; expected a number"),
                                       (DIRECTIONS + ",f0_r", PAIR + ",1", "no column f0_g"),
                                       (DIRECTIONS, PAIR.replace("0.48", "nan"), ":2: vy: nan; expected a finite number"),
                                       (DIRECTIONS, "0,0,0,0,0,1", ":2: lx: a direction of length 0"),
                                       (DIRECTIONS, PAIR.replace("0.48", '"0.48'), ":2: a quote")):
            hints = [hint if not hint.startswith(":") else "standard input" + hint for hint in hints]
            text = f"{columns}\n{cells}\n" if columns else "x\n1\n"
            self.refused(["--model", "cook_torrance", "--inputs", "-"], text, 3, *hints)
            self.refused(["--model", "cook_torrance", "--inputs", "-", "--twin"], text, 3, *hints)
        # Late in the file, nothing is written either.
        late = DIRECTIONS + "\n" + f"{PAIR}\n" * 70000 + "0,0,0,0,0,0\n"
        self.write("late.csv", late)
        self.refused(["--model", "lambert", "--inputs", "late.csv", "-o", "out.csv"], "", 3, "late.csv:70002: lx")
        self.refused(["--model", "lambert", "--inputs", "-"], "", 3, "standard input: empty")
        self.refused(["--model", "lambert", "--inputs", "absent.csv"], "", 3, "absent.csv: can't be read")
        self.refused(["--model", "lambert", "--inputs", "."], "", 3, "is a folder")

    def test_functions_of_files(self):
        self.write("inc.glsl", "struct Lobe { vec3 tint; float n; };\n")
        self.write("f.glsl", '#version 330 core\n#include "inc.glsl"\nfloat wave(float x, vec2 k) { return sin(k.x * x) + k.y; }\n'
                             "vec3 shade(Lobe p, float c, out int steps) { steps = int(c * 10.0); return p.tint * pow(c, p.n); }\n")
        out = self.check("wave", "--file", "f.glsl", "--inputs", "-", stdin="id,x,k.x,k.y\nq,0,1,0.1\nr,nan,1,1\ns,1,1,inf\n").stdout
        self.assertEqual(out, "id,result\nq,0.100000001\nr,nan\ns,inf\n")
        out = self.check("shade", "--file", "f.glsl", "--inputs", "-", stdin="c,p_n,p.tint.r,p.tint.g,p.tint.b\n0.5,1,1,2,4\n").stdout
        self.assertEqual(out, "result.x,result.y,result.z,steps\n0.5,1,2,5\n")

    def test_mistakes_in_files_and_options(self):
        good = self.write("good.glsl", "float square(float x) { return x * x; }\n")
        self.write("part.glsl", "\nfloat part(float x) { return x + undeclared; }\n")
        self.write("broken.glsl", '#include "part.glsl"\nfloat f(float x) { return part(x); }\n')
        self.write("include.glsl", '\n#include "nowhere.glsl"\nfloat f(float x) { return x; }\n')
        text = "x\n1\n"
        base = ["--inputs", "-"]
        self.refused(["sqare", "--file", good, *base], text, 2, "no function 'sqare'; did you mean 'square'?")
        broken = self.check("f", "--file", "broken.glsl", *base, expect=5, stdin=text)
        self.assertIn("part.glsl:2", broken.stderr)
        self.refused(["f", "--file", "include.glsl", *base], text, 5, "include.glsl:2", "nowhere.glsl")
        self.refused(["f", "--file", "absent.glsl", *base], text, 3, "absent.glsl: can't be read")
        # llvmpipe ends endless loops by itself after 65536 rounds; what takes longer than the limit is ended here.
        self.refused(["square", "--file", good, *base, "--time-limit", "1e-6", "-o", "out.csv"], text, 1, "good.glsl: square: no result after 1e-06 s")
        for arguments, hint in (([], "--inputs"), (base, "--model"), ([*base, "--file", good], "no function"),
                                ([*base, "--file", good, "--model", "lambert"], "both"), (["f", *base, "--model", "lambert"], "unexpected"),
                                ([*base, "--model", "lambrt"], "did you mean 'lambert'?"), ([*base, "--modle", "lambert"], "did you mean '--model'?"),
                                (["f", *base, "--file", good, "--twin"], "--twin"), ([*base, "--model", "lambert", "--backend", "vulkan"], "expected auto, egl, osmesa or glfw"),
                                ([*base, "--model", "lambert", "--device", "x"], "--device"),
                                ([*base, "--model", "lambert", "--time-limit", "0"], "--time-limit")):
            self.refused(arguments, f"{DIRECTIONS}\n{PAIR}\n", 2, hint)
        absent = {"LOBE_EGL_LIBRARY": "/nowhere/a.so", "LOBE_OSMESA_LIBRARY": "/nowhere/b.so", "LOBE_GLFW_LIBRARY": "/nowhere/c.so"}
        table = f"{DIRECTIONS}\n{PAIR}\n"
        self.check("--model", "lambert", *base, expect=4, stdin=table, env=absent)
        self.check("--model", "lambert", *base, "--twin", stdin=table, env=absent)

    def test_output_appears_whole_or_not_at_all(self):
        table = f"{DIRECTIONS}\n{PAIR}\n"
        self.write("file", "in the way")
        (self.folder / "folder").mkdir()
        for out in ("file/x.csv", "folder"):
            self.refused(["--model", "lambert", "--inputs", "-", "-o", out], table, 7, out, "can't be written")
        with open("/dev/full", "w") as full:
            result = subprocess.run([CHECK, "eval", "--model", "lambert", "--inputs", "-", "--twin"], input=table, stdout=full,
                                    stderr=subprocess.PIPE, text=True, timeout=60)
        self.assertEqual(result.returncode, 7, result.stderr)
        self.assertIn("standard output: can't be written", result.stderr)

    def test_directions_of_other_lengths_are_normalised_with_a_warning(self):
        table = f"{DIRECTIONS}\n0,0,2,0,3,4\n0,0,9,0,3,4\n"
        result = self.check("--model", "lambert", "--inputs", "-", "--twin", stdin=table)
        self.assertEqual(len(result.stderr.splitlines()), 1)
        self.assertIn("standard input:2: directions of lengths 2 and 5", result.stderr)
        self.assertEqual(set(result.stdout.splitlines()[1:]), {"0.318309886,0.318309886,0.318309886"})


if __name__ == "__main__":
    unittest.main(verbosity=1)
