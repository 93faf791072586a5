#!/usr/bin/env python3
"""Reflectance models from GLSL files of one's own: what they draw, and one clear line for each way to get one wrong."""
import os
import pathlib
import shutil
import unittest

from lobe_test import LobeTest, SHADERS, png_pixels, quad_scene

EXAMPLE = pathlib.Path(__file__).resolve().parents[2] / "docs/examples/brdf/minnaert.glsl"
HOW_TO = pathlib.Path(__file__).resolve().parents[2] / "docs/how_to/add_a_brdf.md"
MINIMAL = """/// flat_grey.glsl - Grey.
///
/// params level  0..1  no unit, default 0.25: radiance factor
#include "common/dirs.glsl"
struct FlatGreyParams { float level; };
vec3 flat_grey_f_cos(Dirs d, FlatGreyParams p) { return d.wi.z > 0.0 && d.wo.z > 0.0 ? vec3(p.level * d.wi.z) : vec3(0.0); }
"""
LOOP_FREE = ("-r", 64, 36, "--anti-aliasing=none")


def material(model, **parameters):
    return {"extensions": {"LOBE_materials_brdf": {"model": model, **parameters}}}


class BrdfFile(LobeTest):
    def radiance(self, path):
        """Of the middle pixel, decoded from an sRGB PNG."""
        width, height, channels, rows = png_pixels(self.folder / path)
        at = width // 2 * channels
        return [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in (b / 255 for b in rows[height // 2][at:at + 3])]

    def draw(self, *arguments, scene=None, output="a.png", **keywords):
        return self.lobe("render", scene or self.scene, *LOOP_FREE, "-o", output, *arguments, **keywords)

    def test_the_example_draws_what_its_formula_says(self):
        # Seen and lit along the normal: rho (k + 1) / (2 pi) E; the square is white.
        for k, rho in ((0.7, 1.0), (1.0, 0.5), (2.0, 0.25)):
            self.draw("--brdf-file", EXAMPLE, "--brdf-set", f"k={k}", "--brdf-set", f"rho={rho}", "--exposure=-1")
            expected = 0.5 * 3 * rho * (k + 1) / (2 * 3.14159265)
            for value in self.radiance("a.png"):
                self.assertAlmostEqual(value, expected, delta=0.008 * expected + 0.002)
        # The header's default of k, and the scene's white as what takes glTF's base colour.
        self.draw("--brdf-file", EXAMPLE, "--exposure=-1")
        self.assertAlmostEqual(self.radiance("a.png")[0], 0.5 * 3 * 1.7 / 6.2831853, delta=0.006)

    def test_the_how_to_shows_the_example_as_it_is(self):
        self.assertIn(EXAMPLE.read_text(), HOW_TO.read_text())

    def test_a_scene_that_names_the_model_gives_its_parameters(self):
        two = quad_scene(materials=[material("minnaert", rho=[0.5, 0.25, 0.125], k=1.0)])
        scene = self.write("own.gltf", two)
        self.draw("--brdf-file", EXAMPLE, scene=scene)
        for value, rho in zip(self.radiance("a.png"), (0.5, 0.25, 0.125)):
            self.assertAlmostEqual(value, 3 * rho / 3.14159265, delta=0.006)
        self.assertIn("minnaert", self.draw(scene=scene, expect=3).stderr, "without the file the name is unknown")
        wrong = self.write("wrong.gltf", quad_scene(materials=[material("minnaert", k=7)]))
        self.assertIn("k: 7", self.draw("--brdf-file", EXAMPLE, scene=wrong, expect=3).stderr)

    def test_bundled_files_under_another_name_draw_the_same_bits(self):
        for model, parameters in (("ggx", {"specular": [0.9, 0.7, 0.5], "diffuse": [0.1, 0.1, 0.2], "alphaX": 0.4, "alphaY": 0.2, "rotation": 0.3,
                                           "fresnel": {"type": "metal", "name": "copper"}}),
                                  ("phong", {"ambient": [0] * 3, "diffuse": [0.2] * 3, "specular": [0.3] * 3, "shininess": 20, "normalization": "energy"})):
            copy = (SHADERS / f"brdf/{model}.glsl").read_text()
            for old, new in ((f"{model}_", f"my_{model}_"), (f"{model.capitalize()}Params", f"My{model.capitalize()}Params")):
                copy = copy.replace(old, new)
            self.write(f"my_{model}.glsl", copy)
            for name, output in ((model, "bundled.png"), (f"my_{model}", "loaded.png")):
                scene = self.write("s.gltf", quad_scene(materials=[material(name, **parameters)]))
                self.draw(*(["--brdf-file", f"my_{model}.glsl"] if name != model else []), scene=scene, output=output)
            self.assertEqual(png_pixels(self.folder / "bundled.png"), png_pixels(self.folder / "loaded.png"), model)

    def test_functions_that_a_file_lacks_are_written_for_it(self):
        self.write("flat_grey.glsl", MINIMAL)
        lit = quad_scene()
        lit["scenes"][0]["extensions"] = {"LOBE_ambient": {"radiance": [1, 1, 1]}}
        scene = self.write("lit.gltf", lit)
        self.draw("--brdf-file", "flat_grey.glsl", scene=scene)
        self.assertAlmostEqual(self.radiance("a.png")[0], 0.75, delta=0.006)  # ambient 0: nothing takes the base colour
        self.draw("--brdf-file", "flat_grey.glsl", "--aov=radiance,roughness", output="a.exr", scene=scene)

    def test_several_files_and_the_plan(self):
        self.write("flat_grey.glsl", MINIMAL)
        both = ("--brdf-file", "flat_grey.glsl", "--brdf-file", EXAMPLE)
        plan = self.lobe("plan", self.scene, *both, "--brdf", "flat_grey").stdout
        self.assertIn("model flat_grey: loaded from flat_grey.glsl", plan)
        self.assertIn("RG32F", plan, "no sharpness in its header: normals as fine as can be")
        self.assertIn("[lambert]", self.lobe("plan", self.scene, *both).stdout, "of two, none is used unless named")
        self.assertIn("RG16", self.lobe("plan", self.scene, "--brdf-file", EXAMPLE).stdout)

    def test_batch_files_name_files_beside_them(self):
        (self.folder / "jobs").mkdir()
        shutil.copy(EXAMPLE, self.folder / "jobs/minnaert.glsl")
        self.write("jobs/flat_grey.glsl", MINIMAL)
        batch = {"presets": {"a": {"brdf": "minnaert", "inherits": "b"}, "b": {"brdf_file": ["minnaert.glsl", "flat_grey.glsl"]}},
                 "shots": [{"scene": "../quad.gltf", "preset": "a", "brdf_set": {"k": 1, "rho": [0.5, 0.5, 0.5]}, "output": "one.png"},
                           {"scene": "../quad.gltf", "preset": "a", "brdf": "flat_grey", "output": "two.png"},
                           {"scene": "../quad.gltf", "output": "three.png"}]}
        self.write("jobs/batch.json", batch)
        self.lobe("render", "--batch", "jobs/batch.json", *LOOP_FREE)
        self.assertAlmostEqual(self.radiance("one.png")[0], 1.5 / 3.14159265, delta=0.006)
        self.assertAlmostEqual(self.radiance("two.png")[0], 0.75, delta=0.006)
        self.assertAlmostEqual(self.radiance("three.png")[0], 3 / 3.14159265, delta=0.006)
        batch["shots"][2]["brdf"] = "minnaert"
        self.write("jobs/batch.json", batch)
        self.assertIn("other pictures", self.lobe("render", "--batch", "jobs/batch.json", *LOOP_FREE, expect=2).stderr)

    def test_the_record_knows_the_file(self):
        copy = self.write("minnaert.glsl", EXAMPLE.read_text())
        self.draw("--brdf-file", copy)
        again = self.lobe("render", "--reproduce", "a.png", "-o", "b.png")
        self.assertNotIn("warning", again.stderr)
        self.assertEqual(png_pixels(self.folder / "a.png"), png_pixels(self.folder / "b.png"))
        self.assertIn("skipped", self.draw("--brdf-file", copy, "--resume", "--json").stdout)
        self.write("minnaert.glsl", EXAMPLE.read_text() + "// changed\n")
        self.assertIn("content of the files of models", self.lobe("render", "--reproduce", "a.png", "-o", "b.png").stderr)
        self.assertIn("done", self.draw("--brdf-file", copy, "--resume", "--json").stdout)
        os.rename(copy, self.folder / "moved.glsl")
        self.assertIn("minnaert.glsl", self.lobe("render", "--reproduce", "a.png", "-o", "b.png", expect=3).stderr)
        (self.folder / "elsewhere").mkdir()
        os.rename(self.folder / "moved.glsl", self.folder / "elsewhere/minnaert.glsl")
        self.lobe("render", "--reproduce", "a.png", "-o", "b.png", "--brdf-file", "elsewhere/minnaert.glsl")

    def test_included_files_lie_below_the_file_or_in_the_library(self):
        (self.folder / "models").mkdir()
        self.write("outside.glsl", "const float LEVEL = 1.0;\n")
        self.write("models/inside.glsl", "const float LEVEL = 0.5;\n")
        including = MINIMAL.replace("#include \"common/dirs.glsl\"\n", "#include \"common/dirs.glsl\"\n#include \"%s\"\n").replace("p.level", "LEVEL")
        self.write("models/flat_grey.glsl", including % "inside.glsl")
        self.draw("--brdf-file", "models/flat_grey.glsl", "--exposure=-1")
        self.assertAlmostEqual(self.radiance("a.png")[0], 0.75, delta=0.006)
        self.write("models/inside.glsl", "const float LEVEL = 0.5;\nfloat broken( {\n")
        self.assertIn("models/inside.glsl:2", self.draw("--brdf-file", "models/flat_grey.glsl", expect=5).stderr)
        os.symlink("../outside.glsl", self.folder / "models/link.glsl")
        for name, hint in (("../outside.glsl", "leads out"), (str(self.folder / "outside.glsl"), "leads out"), ("link.glsl", "by a link"),
                           ("a/../../outside.glsl", "leads out"), ("nowhere.glsl", "not found")):
            self.write("models/flat_grey.glsl", including % name)
            error = self.draw("--brdf-file", "models/flat_grey.glsl", expect=5).stderr
            self.assertIn(hint, error, name)
            self.assertIn("models/flat_grey.glsl:5", error)
        os.mkfifo(self.folder / "models/pipe.glsl")
        self.write("models/flat_grey.glsl", including % "pipe.glsl")
        self.draw("--brdf-file", "models/flat_grey.glsl", expect=5)

    def test_mistakes_in_the_file_are_one_line(self):
        def changed(old, new):
            self.assertIn(old, MINIMAL)
            return MINIMAL.replace(old, new)
        params = "/// params level  0..1  no unit, default 0.25: radiance factor"
        cases = {"no header": (changed("///", "//"), "no header that declares parameters"),
                 "range": (changed("0..1 ", "1..0 "), "flat_grey.glsl:3: params: level: '1..0'; expected a range"),
                 "default": (changed("default 0.25", "default 2"), "default '2'"),
                 "attribute": (changed("default", "defualt"), "'defualt 0.25'; expected per channel"),
                 "takes": (changed("default 0.25", "takes base colour"), "takes base colour; expected"),
                 "same name": (changed(params, params + "\n///        level  0..1  no unit"), "is taken"),
                 "reserved": (changed(params, params + "\n///        model  0..1  no unit"), "is taken"),
                 "table": (changed(params, "/// params level  0..9  first row of the table"), "read tables"),
                 "struct": (changed("struct FlatGreyParams", "struct Other"), "no struct FlatGreyParams"),
                 "type": (changed("{ float level; }", "{ vec3 level; }"), "flat_grey.glsl:5: struct FlatGreyParams: 'vec3 level' does not say"),
                 "undeclared": (changed("{ float level; }", "{ float level; float more; }"), "'float more' is not among the header's params"),
                 "missing field": (changed(params, params + "\n///        more  0..1  no unit"), "ends before the header's 'more'"),
                 "order": (changed(params, params + "\n///        b  0..1  no unit").replace("float level;", "float b, level;"), "'float b' does not say"),
                 "function": (changed("flat_grey_f_cos(", "flat_grey_value("), "no function flat_grey_f_cos"),
                 "sharpness": (changed(params, params + "\n/// sharpness much"), "flat_grey.glsl:4: sharpness 'much'"),
                 "long line": (changed("radiance factor", "x" * 100000), "longer than"),
                 "empty": ("", "no header"), "bytes": ("\x00\x01\x02", "no header"), "large": ("/" * (1 << 20) + "\n", "larger than 1 MiB")}
        for what, (text, hint) in cases.items():
            self.write("flat_grey.glsl", text)
            error = self.draw("--brdf-file", "flat_grey.glsl", expect=3).stderr
            self.assertIn(hint, error, what)
            self.assertEqual(len(error.strip().splitlines()), 1, error)
        for name, hint in (("Grey.glsl", "no name for a model"), ("a__b.glsl", "no name for a model"), ("1st.glsl", "no name for a model")):
            self.write(name, MINIMAL)
            self.assertIn(hint, self.draw("--brdf-file", name, expect=3).stderr)
        self.assertIn("is no regular file", self.draw("--brdf-file", self.folder, expect=3).stderr)
        self.assertIn("no such file", self.draw("--brdf-file", "nowhere.glsl", expect=3).stderr)
        (self.folder / "other").mkdir()
        for name in ("phong.glsl", "minnaert.glsl", "other/minnaert.glsl"):
            self.write(name, EXAMPLE.read_text())
        self.assertIn("phong.glsl", self.draw("--brdf-file", "phong.glsl", expect=3).stderr)  # it declares no struct PhongParams
        shutil.copy(SHADERS / "brdf/phong.glsl", self.folder)
        self.assertIn("comes with Lobe", self.draw("--brdf-file", "phong.glsl", expect=2).stderr)
        self.assertIn("loaded from", self.draw("--brdf-file", "minnaert.glsl", "--brdf-file", "other/minnaert.glsl", expect=2).stderr)
        self.assertNotIn("a.png", self.files())

    def test_mistakes_in_glsl_exit_with_5_and_non_finite_values_with_6(self):
        self.write("flat_grey.glsl", MINIMAL.replace("p.level *", "p.levl *"))
        self.assertIn("flat_grey.glsl:6:", self.draw("--brdf-file", "flat_grey.glsl", expect=5).stderr)
        self.write("flat_grey.glsl", MINIMAL.replace("p.level * d.wi.z", "uintBitsToFloat(0x7fc00000u)"))
        self.assertIn("NaN or infinite", self.draw("--brdf-file", "flat_grey.glsl", expect=6).stderr)

    def test_an_endless_loop_ends_and_loses_nothing_that_was_drawn(self):
        self.write("flat_grey.glsl", MINIMAL.replace("struct", "float waited(float x) { float y = 0.0; while (x > 0.5 && y < 2.0) "
                                                     "y = min(y + 1.0, 1.0); return y; }\nstruct").replace("p.level * d", "(p.level + waited(p.level)) * d"))
        self.write("jobs.json", {"shots": [{"scene": "quad.gltf", "resolution": [16, 16], "brdf_file": "flat_grey.glsl",
                                            "brdf_set": f"level={level}", "output": f"{i}.png"} for i, level in enumerate((0.25, 1, 0.25))]})
        # softpipe, unlike llvmpipe, has no limit of its own.
        result = self.lobe("render", "--batch", "jobs.json", "--time-limit", 8, expect=5, env={"GALLIUM_DRIVER": "softpipe"})
        self.assertIn("1.png: not drawn after 8 s (--time-limit); an endless loop in ", result.stderr)
        self.assertIn("1 of 3 pictures written, 1 failed, interrupted with 1 to go", result.stderr)
        self.assertIn("0.png", self.files())
        self.assertFalse([f for f in self.files() if f.startswith(".") or "tmp" in f], self.files())
        self.assertIn("--time-limit", self.draw("--time-limit=0", expect=2).stderr)

    def test_values_for_the_whole_scene(self):
        half = ("--brdf-set", "diffuse=0.5", "--brdf", "lambert")
        self.draw(*half)
        self.assertAlmostEqual(self.radiance("a.png")[1], 1.5 / 3.14159265, delta=0.006)
        self.draw("--brdf", "lambert", "--brdf-set", "diffuse=0.5,0.25,0")
        self.assertEqual(self.radiance("a.png")[2], 0.0)
        self.draw("--brdf=phong", "--brdf-set=normalization=energy", "--brdf-set=shininess=5", "-D", "brdf_set=diffuse=0.1")
        self.draw("--brdf=ggx", "--brdf-set=metal=gold", "--brdf-set=alpha_x=0.2")
        self.draw("--brdf=ggx", "--brdf-set=fresnel=conductor", "--brdf-set=k=3,2,1")
        for arguments, hint in ((["shininess=5"], "no model that"), (["diffuse"], "NAME=VALUE"), (["diffuse=2"], "diffuse[0]: 2; expected 0..1"),
                                (["diffuse=red"], "expected a number"), (["diffuse=1,2"], "expected a number"), (["=1"], "NAME=VALUE"),
                                (["diffuse="], "NAME=VALUE"), (["difuse=1"], "did you mean 'diffuse'"), (["metal=gold"], "no model that")):
            error = self.draw(*(f"--brdf-set={a}" for a in arguments), expect=2).stderr
            self.assertIn(hint, error, arguments)
            self.assertEqual(len(error.strip().splitlines()), 1, error)
        self.assertIn("did you mean 'gold'", self.draw("--brdf=ggx", "--brdf-set=metal=golt", expect=2).stderr)
        self.assertIn("did you mean 'energy'", self.draw("--brdf=phong", "--brdf-set=normalization=enrgy", expect=2).stderr)


if __name__ == "__main__":
    unittest.main(verbosity=1)
