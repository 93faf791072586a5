"""A report with pictures, for the test of its page: values that are missing, zero, infinite or hostile among them."""
import itertools
import json
import math
import pathlib
import struct
import zlib

HOSTILE = "</script><img src=x onerror=\"document.title='pwned'\"><!-- {{report}} ${1}"
SIZE = 160, 90


def png(path, pixel):
    """`pixel(x, y)` gives three bytes."""
    width, height = SIZE
    rows = b"".join(b"\0" + b"".join(bytes(pixel(x, y)) for x in range(width)) for y in range(height))
    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)) +
                     chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def noise(x, y, seed):
    return zlib.crc32(struct.pack("<3I", x, y, seed)) / 2**31 - 1


def sphere(error, seed):
    def pixel(x, y):
        u, v = (x - 80) / 36, (45 - y) / 36
        inside = u * u + v * v < 1
        z = math.sqrt(1 - u * u - v * v) if inside else 0
        light = max(0, 0.5 * u + 0.6 * v + 0.62 * z) if inside else 0.12 + 0.001 * y
        value = min(1, max(0, light + error * noise(x, y, seed))) ** (1 / 2.2)
        return [int(255 * value * tint) for tint in ((1, 0.72, 0.4) if inside else (0.8, 0.9, 1))]
    return pixel


def difference(error, seed):
    return lambda x, y: [int(255 * min(1, 3 * error * abs(noise(x, y, seed)))), int(60 * min(1, error)), 40]


def write_report(folder):
    """Writes `folder`/report.json and its pictures; returns the report."""
    folder = pathlib.Path(folder)
    (folder / "pictures").mkdir(parents=True)
    pictures, settings = {}, []

    def picture(name, pixel):
        png(folder / "pictures" / f"{name}.png", pixel)
        pictures[name] = f"pictures/{name}.png"
        return name

    def setting(scene, knobs, time, error, **more):
        identity = len(scene)
        passes = [("gbuffer", 0.8), ("lights", time - 1.1), ("tone", 0.3)]
        relmse = None if error is None else error * error
        scene.append({
            "id": identity, "label": " ".join(knobs.values()), "preset": None, "knobs": knobs,
            "time": {"median_ms": time, "low_ms": time * 0.94, "high_ms": time * 1.09, "confidence": 0.95, "repeats": 15,
                     "minimum_ms": time * 0.92, "cpu_ms": 0.2},
            "passes": [{"pass": name, "median_ms": t, "floor_ms": None if name == "tone" else t * 0.6,
                        "bytes_per_pixel": 32 if name == "gbuffer" else None} for name, t in passes],
            "error": {"relmse": relmse, "relmse_trimmed": relmse and relmse * 0.8, "rmse": error, "max": error and error * 9,
                      "p95": error and error * 2.4, "psnr": None if not error else -20 * math.log10(error),
                      "flip": error and error * 0.7, "ssim": None if error is None else 1 - error / 2, "non_finite": 0,
                      "shading_relmse": relmse and relmse * 0.5, "edge_relmse": relmse and relmse * 6, "edge_pixels": 410},
            "front": False, "picture": f"s{identity}", "difference": f"s{identity}_diff", "tied_with": [], **more})
        return scene[-1]

    for aa, samples, shadow in itertools.product((1, 4, 16), (1, 8, 64), (512, 2048)):
        error = math.hypot(0.3 / aa, 0.5 * samples**-0.9, 0.004 if shadow == 2048 else 0.04)
        time = 1.2 + 0.35 * aa**0.8 * samples**0.6 + (0.9 if shadow == 2048 else 0.2)
        knobs = {"anti_aliasing": str(aa), "area_samples": str(samples), "shadow_size": str(shadow), "fog": "on"}
        made = setting(settings, knobs, time, error)
        picture(made["picture"], sphere(error, made["id"]))
        picture(made["difference"], difference(error, made["id"]))
    for name, at in {"draft": 0, "preview": 8, "reference": len(settings) - 1}.items():
        settings[at].update(preset=name, label=name)
    settings[1]["tied_with"], settings[1]["label"] = [2, 0], HOSTILE
    settings[1]["knobs"][HOSTILE] = HOSTILE
    exact = setting(settings, {"anti_aliasing": "64", "area_samples": "64", "shadow_size": "2048", "fog": "on"}, 90, 0.0)
    exact.update(label="exact", picture=None, difference="not there")
    broken = setting(settings, {"anti_aliasing": "64", "area_samples": "8", "shadow_size": "512", "fog": "on"}, 40, None)
    broken.update(label="no figures")
    broken["error"]["non_finite"] = 7
    best = math.inf
    for made in sorted(settings, key=lambda s: s["time"]["median_ms"]):
        if made["error"]["rmse"] is not None and made["error"]["rmse"] < best:
            made["front"], best = True, made["error"]["rmse"]

    other = []
    setting(other, {"anti_aliasing": "1"}, 2, 0.1, label="one", picture=None, difference=None, passes=[])
    other.append({"id": 1, "label": "bare"})
    knobs = [{"name": "anti_aliasing", "title": "Anti-aliasing", "values": ["1", "4", "16", "64"], "unit": "samples", "description": ""},
             {"name": "area_samples", "title": "Area-light samples", "values": ["1", "8", "64"], "unit": "", "description": ""},
             {"name": "shadow_size", "title": "Shadow size", "values": ["512", "2048"], "unit": "", "description": ""}]
    report = {
        "schema": 1, "program": "lobe", "version": "0.1.0", "command": "lobe report " + HOSTILE, "created": "2026-11-27T21:40:00Z",
        "machine": {"cpu": "Fixture CPU", "cores": 2, "memory_bytes": 2**33, "os": HOSTILE, "load": 0.4},
        "context": {"backend": "egl", "renderer": "llvmpipe", "version": "4.5", "driver": "Mesa", "clock": "process cpu"},
        "knobs": knobs, "pictures": pictures,
        "scenes": [
            {"scene": "models", "file": "models.gltf", "camera": "main", "width": 160, "height": 90, "settings": settings,
             "truth": {"method": "reference", "picture": picture("truth", sphere(0, 0)), "standard_error": 0.002, "seconds": 12, "note": ""},
             "knobs_without_effect": [{"knob": "environment_samples", "reason": "no environment in the scene"}],
             "left_out": [{"kind": "pass", "name": HOSTILE, "reason": "no spot light"}],
             "noise": {"verdict": "quiet", "detail": "times repeat within 3 %"},
             "search": {"tried": 20, "possible": 432, "method": "coordinate search"}},
            {"scene": HOSTILE, "settings": other, "noise": {"verdict": "noisy", "detail": "times repeat within 40 %"}},
            {"scene": "empty"}]}
    (folder / "report.json").write_text(json.dumps(report))
    return report
