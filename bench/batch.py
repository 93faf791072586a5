#!/usr/bin/env python3
"""The batch tool as a whole: first picture, throughput against the pure render rate, growth of memory.

usage: batch.py [--lobe build/bin/lobe] [--scene FILE] [--shots 10000] [--json FILE]

Ratios are taken within one run. Standard library only."""
import argparse
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent


def run(lobe, *arguments):
    started = time.monotonic()
    result = subprocess.run([lobe, "render", *map(str, arguments), "--no-config"], capture_output=True, text=True, check=True)
    return time.monotonic() - started, result


def first_picture(lobe, scene, folder):
    """Seconds from process start to a written picture, disk and shader cache warm: median and least of 7."""
    times = [run(lobe, scene, "-o", folder / "first.png", "-q")[0] for _ in range(8)][1:]
    return {"median_s": statistics.median(times), "least_s": min(times)}


def throughput(lobe, scene, folder):
    """Pictures a second of a turntable against the rate of rendering alone, from the same run's own times."""
    frames = 40
    _, result = run(lobe, scene, "--frames", frames, "--orbit", 360, "-o", folder / "t_{frame:3}.png", "--json", "-q")
    render = [json.loads(line)["milliseconds"]["render"] for line in result.stdout.splitlines()]
    seconds_one, _ = run(lobe, scene, "--frames", 1, "-o", folder / "one.png", "-q")
    seconds_all, _ = run(lobe, scene, "--frames", frames, "--orbit", 360, "-o", folder / "u_{frame:3}.png", "-q")
    pure = 1000.0 / statistics.median(render)
    steady = (frames - 1) / (seconds_all - seconds_one)
    return {"pure_render_per_s": pure, "batch_per_s": steady, "ratio": steady / pure}


def memory(lobe, scene, folder, shots):
    """Peak memory after 5 % of the shots and at the end."""
    process = subprocess.Popen([lobe, "render", scene, "--frames", str(shots), "--orbit", "360", "-r", "64", "36", "--quality", "draft",
                                "-o", str(folder / "m_{frame:6}.png"), "--json", "-q", "--no-config"], stdout=subprocess.PIPE, text=True)
    peaks = []
    for line in process.stdout:
        shot = json.loads(line)
        peaks.append(shot["peak_memory_mib"])
        pathlib.Path(shot["output"]).unlink()
    if process.wait() != 0 or len(peaks) != shots:
        sys.exit(f"batch.py: lobe ended with {process.returncode} after {len(peaks)} of {shots} shots")
    early = peaks[len(peaks) // 20]
    return {"shots": shots, "early_mib": early, "final_mib": peaks[-1], "growth_mib": peaks[-1] - early}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--lobe", default=str(ROOT / "build/bin/lobe"))
    parser.add_argument("--scene", default=str(ROOT / "scenes/teapot.gltf"))
    parser.add_argument("--shots", type=int, default=10000)
    parser.add_argument("--json", help="write the results here as well")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="lobe-bench-") as name:
        folder = pathlib.Path(name)
        results = {"schema": 1, "scene": options.scene}
        for key, measure in (("first_picture", lambda: first_picture(options.lobe, options.scene, folder)),
                             ("throughput", lambda: throughput(options.lobe, options.scene, folder)),
                             ("memory", lambda: memory(options.lobe, options.scene, folder, options.shots))):
            results[key] = measure()
            print(key, " ".join(f"{k} {v:.3f}" if isinstance(v, float) else f"{k} {v}" for k, v in results[key].items()), flush=True)
    if options.json:
        pathlib.Path(options.json).write_text(json.dumps(results, indent=2) + "\n")


if __name__ == "__main__":
    main()
