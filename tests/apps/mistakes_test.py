#!/usr/bin/env python3
"""Mistakes: one line that says what is wrong, a documented exit code, and nothing half-written."""
import json
import os
import shutil
import signal
import subprocess
import time
import unittest

from lobe_test import LOBE, LobeTest, png_pixels, quad_scene

class Mistakes(LobeTest):
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
        self.assertIn("did you mean 'render'", self.lobe("rendr", expect=2).stderr)
        for arguments in (["render", ""], ["plan"], ["plan", self.scene, self.scene], ["info", "extra"],
                          ["render", self.scene, "--json=perhaps"], ["render", self.scene, "--resolution"],
                          ["render", self.scene, "--json", "-o", "-"], ["render", self.scene, self.scene, "-o", "-"],
                          ["render", self.scene, self.scene, "-o", "a.png"],
                          ["render", self.scene, "quad.gltf", "--list", "-o", "{n:2}/../a.png"],
                          ["render", self.scene, "--background=transparent", "-o", "a.jpg"],
                          ["render", self.scene, "--aov=depth", "-o", "-"],
                          ["render", self.scene, "--camera-focal-point=0,0,0"],
                          ["render", self.scene, "--camera-position=1,2,3", "--camera-focal-point=1,2,3"],
                          ["render", self.scene, "--shard=1x/2"], ["render", self.scene, "--shard=1/2/3"],
                          ["render", self.scene, "--filter", "nothing*"], ["render", self.scene, "--device=99"]):
            result = self.lobe(*arguments, expect=2)
            self.assertEqual(len(result.stderr.strip().splitlines()), 1, result.stderr)
        self.lobe("render", expect=2)
        self.assertEqual(self.files(), ["quad.gltf"], "nothing was written")

    def test_no_command_prints_usage_and_exits_with_2(self):
        result = subprocess.run([LOBE], capture_output=True, text=True, timeout=60)
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

    def test_full_standard_output_exits_with_7(self):
        for arguments in (["render", self.scene, "-r", "64", "36", "-o", "-"], ["render", self.scene, "-r", "64", "36", "-o", "a.png", "--json"],
                          ["info"], ["plan", self.scene], ["help"], ["render", self.scene, "--list"], ["--version"]):
            with open("/dev/full", "w") as full:
                result = subprocess.run([LOBE, *arguments], cwd=self.folder, stdout=full, stderr=subprocess.PIPE, text=True, timeout=60)
            self.assertEqual(result.returncode, 7, (arguments, result.stderr))
            self.assertIn("standard output", result.stderr)

    def test_closed_standard_streams_harm_no_file(self):
        command = f"'{LOBE}' render quad.gltf -r 64 36 --json -o c.png >&- 2>&- <&-"
        self.assertEqual(subprocess.run(["sh", "-c", command], cwd=self.folder, timeout=60).returncode, 0)
        self.assertEqual(png_pixels(self.folder / "c.png")[:2], (64, 36))

    def test_missing_parts_of_the_installation_are_errors_and_no_hang(self):
        empty = self.folder / "empty"
        empty.mkdir()
        self.assertIn("worker", self.render("-o", "a.png", expect=3, env={"LOBE_WORKER_DIR": str(empty)}).stderr)
        self.render("-o", "a.png", expect=5, env={"LOBE_SHADER_DIR": str(empty)})
        self.render("-o", "a.png", expect=3, env={"LOBE_SHADER_DIR": str(self.folder / "nowhere")})
        self.assertNotIn("a.png", self.files())

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
        self.assertIn("Kept", self.lobe("plan", self.scene, env=absent).stdout)
        self.assertIn("OpenGL 3.3 guarantees", self.lobe("plan", self.scene, env=absent).stderr)
        self.lobe("plan", self.scene, "--backend=egl", expect=4, env=absent)

    def test_broken_shader_exits_with_5_and_names_file_and_line(self):
        broken = self.shaders_with("brdf/lambert.glsl", lambda text: text + "\nfloat broken( {\n")
        error = self.render(expect=5, env=broken).stderr
        self.assertIn("brdf/lambert.glsl:", error)

    def test_non_finite_pixels_exit_with_6_and_are_written(self):
        planted = self.shaders_with("pass/light.frag", lambda text: text.replace(
            "light_alpha(0.0));\n", "light_alpha(0.0));\n    if (gl_FragCoord.x < 33.0 && gl_FragCoord.x > 32.0) oRadiance.y = uintBitsToFloat(0x7fc00000u);\n"))
        result = self.render("-o", "n.exr", "--anti-aliasing=none", "--json", expect=6, env=planted)
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


if __name__ == "__main__":
    unittest.main(verbosity=1)
