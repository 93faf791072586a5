#!/usr/bin/env python3
"""Random mouse and key input: no crash, no error that is lobe-view's own, no growth of memory.

LOBE_VIEW_RANDOM_SECONDS (10) says for how long, LOBE_VIEW_RANDOM_SEED with what."""
import os
import pathlib
import random
import time
import unittest

from driver import SCENES
from view_test import ViewTest

KEYS = ["f", "Return", "c", "1", "3", "7", "v", "shift+v", "b", "p", "Escape", "x", "t", "shift+t", "i", "h", "g", "r", "m",
        "ctrl+z", "ctrl+y", "ctrl+c", "ctrl+shift+c", "ctrl+o", "ctrl+1", "ctrl+2", "ctrl+3", "ctrl+4", "ctrl+5", "ctrl+6",
        "ctrl+7", "ctrl+8", "w", "a", "s", "d", "e", "q", "Tab", "Down", "Up", "Left", "Right", "space", "ctrl+shift+r"]


class Random(ViewTest):
    def memory(self, view):
        text = pathlib.Path(f"/proc/{view.process.pid}/status").read_text()
        return int(text.split("VmRSS:")[1].split()[0]) / 1024  # MiB

    def test_random_input_does_no_harm(self):
        seconds = float(os.environ.get("LOBE_VIEW_RANDOM_SECONDS", "10"))
        seed = int(os.environ.get("LOBE_VIEW_RANDOM_SEED", "1"))
        draw = random.Random(seed)
        view = self.ready(SCENES / "spheres.gltf", "--quality=draft", window="800x500")
        start = time.monotonic()
        samples = []
        while time.monotonic() - start < seconds:
            x, y = draw.randrange(800), draw.randrange(500)
            what = draw.random()
            if what < 0.35:
                view.key(draw.choice(KEYS))
            elif what < 0.7:
                view.click(x, y, button=draw.choice([1, 1, 1, 2, 3]), times=draw.choice([1, 1, 2]))
            elif what < 0.9:
                view.drag(x, y, draw.randrange(800), draw.randrange(500), button=draw.choice([1, 2, 3]), steps=5,
                          shift=draw.random() < 0.3)
            else:
                view.move(x, y)
                view.input("click", draw.choice([4, 5]))
            view.poll()
            samples.append(self.memory(view))
        view.key("Escape")
        view.poll()
        self.assertIsNone(view.process.poll())
        bad = [e["text"] for e in view.events if e["event"] == "message" and e["error"]
               and ("unexpected" in e["text"] or "GL_" in e["text"] or "out of memory" in e["text"])]
        self.assertEqual(bad, [], f"seed {seed}")
        if seconds >= 600:  # caches are filled by then
            half = len(samples) // 2
            early, late = max(samples[half // 2:half]), max(samples[half:])
            self.assertLess(late, 1.3 * early + 100, f"{early:.0f} MiB, later {late:.0f} MiB; seed {seed}")


if __name__ == "__main__":
    unittest.main(verbosity=2)
