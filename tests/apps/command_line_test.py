#!/usr/bin/env python3
"""The batch tool as people use it: every flag, exit code and promise, on small scenes that the test writes.

LOBE_BIN names the program. Needs the standard library only."""
import base64
import json
import os
import pathlib
import re
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import zlib

LOBE = os.environ.get("LOBE_BIN", "build/bin/lobe")


def quad_scene(**extra):
    """A white Lambert square of 2 m, facing +Z, under a directional light of irradiance 3."""
    positions = struct.pack("<12f", -1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0)
    indices = struct.pack("<6H", 0, 1, 2, 0, 2, 3)
    data = base64.b64encode(positions + indices).decode()
    scene = {
        "asset": {"version": "2.0"},
        "extensionsUsed": ["KHR_lights_punctual", "LOBE_materials_brdf"],
        "extensions": {"KHR_lights_punctual": {"lights": [{"type": "directional", "intensity": 3.0}]}},
        "scene": 0,
        "scenes": [{"nodes": [0, 1, 2, 3]}],
        "nodes": [
            {"mesh": 0},
            {"extensions": {"KHR_lights_punctual": {"light": 0}}},
            {"camera": 0, "translation": [0, 0, 2]},
            {"camera": 1, "translation": [0, 0, 4], "name": "far"},
        ],
        "cameras": [
            {"type": "perspective", "name": "near", "perspective": {"yfov": 0.8, "znear": 0.1}},
            {"type": "perspective", "name": "far", "perspective": {"yfov": 0.8, "znear": 0.1}},
        ],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
        "materials": [{"extensions": {"LOBE_materials_brdf": {"model": "lambert"}}}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [-1, -1, 0], "max": [1, 1, 0]},
            {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"},
        ],
        "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12}],
        "buffers": [{"byteLength": 60, "uri": "data:application/octet-stream;base64," + data}],
    }
    scene.update(extra)
    return scene


def png_pixels(path):
    """Width, height and rows of an 8-bit PNG's samples."""
    data = pathlib.Path(path).read_bytes()
    assert data[:8] == b"\x89PNG\r\n\x1a\n", path
    at, body = 8, b""
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        chunk = data[at + 8:at + 8 + length]
        if kind == b"IHDR":
            width, height, _, colour = struct.unpack(">IIBB", chunk[:10])
        if kind == b"IDAT":
            body += chunk
        at += 12 + length
    channels = {0: 1, 2: 3, 4: 2, 6: 4}[colour]
    raw, stride, rows, above = zlib.decompress(body), width * channels, [], bytes(width * channels)
    for y in range(height):
        kind, line = raw[y * (stride + 1)], bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        for i in range(stride):
            left = line[i - channels] if i >= channels else 0
            corner = above[i - channels] if i >= channels else 0
            if kind == 1:
                line[i] = (line[i] + left) & 255
            elif kind == 2:
                line[i] = (line[i] + above[i]) & 255
            elif kind == 3:
                line[i] = (line[i] + (left + above[i]) // 2) & 255
            elif kind == 4:
                p = left + above[i] - corner
                nearest = min((abs(p - left), 0, left), (abs(p - above[i]), 1, above[i]), (abs(p - corner), 2, corner))
                line[i] = (line[i] + nearest[2]) & 255
        rows.append(bytes(line))
        above = rows[-1]
    return width, height, channels, rows


class CommandLine(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="lobe-test-"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        self.scene = self.write("quad.gltf", quad_scene())

    def write(self, name, content):
        path = self.folder / name
        path.write_text(content if isinstance(content, str) else json.dumps(content))
        return str(path)

    def lobe(self, *arguments, expect=0, env=None, text=True):
        environment = dict(os.environ, XDG_CONFIG_HOME=str(self.folder / "config"), **(env or {}))
        result = subprocess.run([LOBE, *map(str, arguments)], cwd=self.folder, capture_output=True, text=text, timeout=120,
                                env=environment)
        self.assertEqual(result.returncode, expect, f"{arguments}\n{result.stdout}\n{result.stderr}")
        if expect not in (0, 6) and text:
            self.assertIn("error", result.stderr)
        return result

    def render(self, *arguments, **keywords):
        return self.lobe("render", self.scene, "-r", 64, 36, *arguments, **keywords)

    def files(self):
        return sorted(str(p.relative_to(self.folder)) for p in self.folder.rglob("*") if p.is_file())

    # Pictures

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

    def test_output_to_standard_output(self):
        result = self.render("-o", "-", text=False)
        self.assertTrue(result.stdout.startswith(b"\x89PNG"))
        self.assertEqual(self.files(), ["quad.gltf"])

    def test_layers_in_one_exr(self):
        self.render("--aov", "radiance,depth,normal,position,albedo,material_id,roughness,contributions", "-o", "all.exr")
        content = (self.folder / "all.exr").read_bytes()
        for channel in (b"depth.Z", b"normal.X", b"position.Y", b"albedo.G", b"material.id", b"roughness.Y", b"directional.R", b"transparent.B"):
            self.assertIn(channel, content)

    # Records

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
        self.lobe("render", "--reproduce", "plain.txt", expect=3)
        self.lobe("render", "--reproduce", "absent.png", expect=3)

    def test_resume_renders_only_what_changed(self):
        self.render("--frames=3", "--orbit=30", "-o", "f{frame}.png")
        stamps = {f: os.stat(self.folder / f).st_mtime_ns for f in self.files() if f.endswith("png")}
        os.remove(self.folder / "f1.png")
        self.render("--frames=3", "--orbit=30", "-o", "f{frame}.png", "--resume")
        self.assertEqual(os.stat(self.folder / "f0.png").st_mtime_ns, stamps["f0.png"])
        self.assertTrue((self.folder / "f1.png").exists())
        self.render("--frames=3", "--orbit=30", "--exposure=1", "-o", "f{frame}.png", "--resume")
        self.assertNotEqual(os.stat(self.folder / "f0.png").st_mtime_ns, stamps["f0.png"])

    # Batches

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

    # Settings

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

    # Mistakes

    def test_usage_errors_exit_with_2_and_help(self):
        for arguments, hint in ((["--qualty", "high"], "did you mean '--quality'"),
                                (["--tone-mapping", "acse"], "did you mean 'aces'"),
                                (["--resolution", "0x5"], "1 to 16384"), (["-D", "exposre=1"], "did you mean 'exposure'"),
                                (["-D", "exposure"], "KEY=VALUE"), (["-o", "a.bmp"], ".png, .jpg, .exr or .hdr"),
                                (["-o", "{modl}.png"], "did you mean 'model'"), (["--frames=2", "-o", "a.png"], "two pictures"),
                                (["--aov", "depth", "-o", "a.png"], ".exr"), (["--shard", "3/2"], "I/N"),
                                (["--camera", "0", "--camera-azimuth", "3"], "expected one of them"),
                                (["--backend", "vulkan"], "expected one of"), (["--batch", "x.json"], "exclude each other")):
            result = self.render(*arguments, expect=2)
            self.assertIn(hint, result.stderr, arguments)
            self.assertEqual(len(result.stderr.strip().splitlines()), 1, result.stderr)
        self.lobe("rendr", expect=2)
        self.lobe("render", expect=2)
        self.assertEqual(self.files(), ["quad.gltf"], "nothing was written")

    def test_no_command_prints_usage_and_exits_with_2(self):
        result = subprocess.run([LOBE], capture_output=True, text=True)
        self.assertEqual(result.returncode, 2)
        self.assertIn("usage", result.stderr)
        for arguments in (["--help"], ["--version"], ["render", "--help"], ["plan", "--help"], ["help"], ["help", "--markdown"]):
            self.assertTrue(self.lobe(*arguments).stdout)

    def test_unreadable_scenes_exit_with_3(self):
        cases = {"missing.gltf": None, "empty.gltf": "", "text.gltf": "hello", "truncated.glb": "glTF\x02",
                 "nan.gltf": json.dumps(quad_scene(nodes=[{"mesh": 0, "translation": [float("nan"), 0, 0]}], scenes=[{"nodes": [0]}])),
                 "cycle.gltf": json.dumps(quad_scene(nodes=[{"children": [1]}, {"children": [0]}], scenes=[{"nodes": [0]}])),
                 "count.gltf": json.dumps(quad_scene(accessors=[{"bufferView": 0, "componentType": 5126, "count": 1 << 40, "type": "VEC3"}] * 2)),
                 "escape.gltf": json.dumps(quad_scene(buffers=[{"byteLength": 60, "uri": "../../etc/passwd"}])),
                 "remote.gltf": json.dumps(quad_scene(buffers=[{"byteLength": 60, "uri": "http://127.0.0.1/x.bin"}])),
                 "model.gltf": json.dumps(quad_scene(materials=[{"extensions": {"LOBE_materials_brdf": {"model": "lambret"}}}])),
                 "value.gltf": json.dumps(quad_scene(materials=[{"extensions": {"LOBE_materials_brdf": {"model": "phong", "shininess": -1}}}])),
                 "required.gltf": json.dumps(quad_scene(extensionsRequired=["EXT_unheard_of"]))}
        for name, content in cases.items():
            if content is not None:
                self.write(name, content)
            started = time.time()
            result = self.lobe("render", name, "-o", "x.png", expect=3)
            self.assertIn(name, result.stderr)
            self.assertLess(time.time() - started, 60)
        self.assertNotIn("x.png", self.files())

    def test_unwritable_outputs_exit_with_7_and_leave_nothing(self):
        self.write("file", "in the way")
        self.render("-o", "file/x.png", expect=7)
        os.mkdir(self.folder / "folder.png")
        self.render("-o", "folder.png", expect=7)
        self.assertEqual(self.files(), ["file", "quad.gltf"])

    def test_full_disk_exits_with_7_and_leaves_nothing(self):
        disk = self.folder / "disk"
        disk.mkdir()
        if os.geteuid() != 0 or subprocess.run(["mount", "-t", "tmpfs", "-o", "size=16k", "tmpfs", disk], capture_output=True).returncode:
            self.skipTest("a small file system can only be mounted as root")
        try:
            self.lobe("render", self.scene, "--aov", "radiance,position", "--exr-precision=float", "-r", 512, 512, "--camera-azimuth=40", "-o", "disk/x.exr", expect=7)
            self.assertEqual(list(disk.iterdir()), [])
        finally:
            subprocess.run(["umount", disk], check=True)

    def test_no_context_exits_with_4_and_says_what_was_tried(self):
        absent = {"LOBE_EGL_LIBRARY": "/nowhere/libEGL.so", "LOBE_OSMESA_LIBRARY": "/nowhere/libOSMesa.so", "LOBE_GLFW_LIBRARY": "/nowhere/libglfw.so"}
        error = self.render(expect=4, env=absent).stderr
        for tried in ("EGL", "osmesa", "glfw"):
            self.assertIn(tried, error)
        self.lobe("info", expect=4, env=absent)

    def test_broken_shader_exits_with_5_and_names_file_and_line(self):
        source = pathlib.Path(__file__).resolve().parents[2] / "shaders/glsl"
        shaders = self.folder / "glsl"
        shutil.copytree(source, shaders)
        file = shaders / "brdf/lambert.glsl"
        file.write_text(file.read_text() + "\nfloat broken( {\n")
        error = self.render(expect=5, env={"LOBE_SHADER_DIR": str(shaders)}).stderr
        self.assertIn("brdf/lambert.glsl:", error)

    def test_non_finite_pixels_exit_with_6_and_are_written(self):
        source = pathlib.Path(__file__).resolve().parents[2] / "shaders/glsl"
        shaders = self.folder / "glsl"
        shutil.copytree(source, shaders)
        file = shaders / "pass/light.frag"
        text = file.read_text()
        planted = text.replace("0.0);\n}", "0.0);\n    if (gl_FragCoord.x < 33.0 && gl_FragCoord.x > 32.0) oRadiance.y = uintBitsToFloat(0x7fc00000u);\n}")
        self.assertNotEqual(text, planted)
        file.write_text(planted)
        result = self.render("-o", "n.exr", "--anti-aliasing=none", "--json", expect=6, env={"LOBE_SHADER_DIR": str(shaders)})
        self.assertGreater(json.loads(result.stdout)["non_finite_pixels"], 10)
        self.assertIn("NaN or infinite", result.stderr)
        self.assertIn("n.exr", self.files())

    def test_interrupt_leaves_no_temporary_files(self):
        process = subprocess.Popen([LOBE, "render", self.scene, "--frames=500", "--orbit=360", "-o", "i/{frame:3}.png"],
                                   cwd=self.folder, stderr=subprocess.PIPE, text=True)
        time.sleep(3)
        process.send_signal(signal.SIGINT)
        _, error = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130, error)
        self.assertIn("interrupted", error)
        made = [f for f in self.files() if f.startswith("i/")]
        self.assertTrue(made)
        for name in made:
            self.assertRegex(name, r"^i/\d{3}\.png$")
            png_pixels(self.folder / name) if name == made[-1] else None

    # Other commands

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
