"""Drives lobe-view as a person does: a display of its own, a real mouse and real keys, and looks at the screen.

LOBE_VIEW_BIN and LOBE_BIN name the programs. Needs Xvfb and xdotool."""
import ctypes
import json
import os
import pathlib
import shutil
import struct
import subprocess
import tempfile
import time
import zlib

VIEW = str(pathlib.Path(os.environ.get("LOBE_VIEW_BIN", "build/bin/lobe-view")).resolve())
LOBE = str(pathlib.Path(os.environ.get("LOBE_BIN", "build/bin/lobe")).resolve())
ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENES = ROOT / "scenes"


class Display:
    """An X server whose screen lies in a file."""

    def __init__(self, width=1280, height=800):
        self.folder = tempfile.mkdtemp(prefix="lobe-display-")
        read, write = os.pipe()
        self.server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(write), "-screen", "0", f"{width}x{height}x24", "-fbdir", self.folder, "-noreset",
             "-nolisten", "tcp"], pass_fds=[write], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(write)
        with os.fdopen(read) as stream:
            number = stream.readline().strip()
        if not number:
            raise RuntimeError("Xvfb does not start")
        self.name = ":" + number

    def set_dots_per_inch(self, dpi):
        """As desktops tell it to programs."""
        x11 = ctypes.CDLL("libX11.so.6")
        x11.XOpenDisplay.restype = ctypes.c_void_p
        x11.XDefaultRootWindow.restype = ctypes.c_ulong
        display = ctypes.c_void_p(x11.XOpenDisplay(self.name.encode()))
        root = ctypes.c_ulong(x11.XDefaultRootWindow(display))
        text = f"Xft.dpi:\t{dpi}\n".encode()
        resource_manager, string = ctypes.c_ulong(23), ctypes.c_ulong(31)
        x11.XChangeProperty(display, root, resource_manager, string, 8, 0, text, len(text))
        x11.XCloseDisplay(display)

    def close(self):
        self.server.terminate()
        self.server.wait()
        shutil.rmtree(self.folder, ignore_errors=True)

    def screen(self):
        """Width, height and rows of RGB bytes."""
        data = pathlib.Path(self.folder, "Xvfb_screen0").read_bytes()
        head = struct.unpack(">25I", data[:100])
        width, height, stride, colours = head[4], head[5], head[12], head[19]
        start = head[0] + 12 * colours
        rows = []
        for y in range(height):
            line = data[start + y * stride:start + y * stride + 4 * width]
            rgb = bytearray(3 * width)
            rgb[0::3], rgb[1::3], rgb[2::3] = line[2::4], line[1::4], line[0::4]
            rows.append(bytes(rgb))
        return width, height, rows


def write_png(path, rows):
    """8-bit RGB rows."""
    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
    head = struct.pack(">IIBBBBB", len(rows[0]) // 3, len(rows), 8, 2, 0, 0, 0)
    raw = b"".join(b"\0" + row for row in rows)
    pathlib.Path(path).write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(raw, 6))
                                   + chunk(b"IEND", b""))


class View:
    """A running lobe-view with what it has said."""

    def __init__(self, *arguments, display=None, window="1280x800", environment=None, home=None):
        self.own_display = display is None
        self.display = display or Display()
        self.own_home = home is None
        self.home = pathlib.Path(home or tempfile.mkdtemp(prefix="lobe-view-"))
        self.cwd = self.home / "work"
        self.cwd.mkdir(exist_ok=True)
        self.events_file = self.home / "events.jsonl"
        self.events_file.unlink(missing_ok=True)
        self.environment = dict(os.environ, DISPLAY=self.display.name, XDG_CONFIG_HOME=str(self.home / "config"),
                                XDG_CACHE_HOME=os.environ.get("LOBE_TEST_CACHE", str(self.home / "cache")), **(environment or {}))
        self.environment.pop("WAYLAND_DISPLAY", None)
        with open(self.home / "stderr", "wb") as stderr:
            self.process = subprocess.Popen(
                [VIEW, *map(str, arguments), "--window", window, "--events", str(self.events_file), "--no-config"], cwd=self.cwd,
                env=self.environment, stderr=stderr)
        self.events, self.read_to = [], 0
        self.places = {}

    def close(self):
        """Ends it as a person would, and returns its exit code."""
        if self.process.poll() is None:
            self.process.terminate()
            try:
                self.process.wait(20)
            except subprocess.TimeoutExpired:
                self.process.kill()
                self.process.wait()
        if self.own_display:
            self.display.close()
        if self.own_home:
            shutil.rmtree(self.home, ignore_errors=True)
        return self.process.returncode

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def poll(self):
        """Reads what has been written since."""
        if self.events_file.exists():
            with open(self.events_file, "rb") as stream:
                stream.seek(self.read_to)
                data = stream.read()
            end = data.rfind(b"\n") + 1
            self.read_to += end
            for line in data[:end].splitlines():
                event = json.loads(line)
                if event["event"] == "control":
                    self.places[event["name"]] = event
                else:
                    self.events.append(event)
        if self.process.poll() is not None:
            raise AssertionError(f"lobe-view ended with {self.process.returncode}: {self.stderr()}")

    def stderr(self):
        return (self.home / "stderr").read_text(errors="replace")

    def wait_for(self, what, kind=None, since=0, seconds=60):
        """The first event from number `since` on of that kind of which what(event) is true."""
        deadline = time.monotonic() + seconds
        while True:
            self.poll()
            for event in self.events[since:]:
                if (kind is None or event["event"] == kind) and what(event):
                    return event
            if time.monotonic() > deadline:
                tail = [e for e in self.events[since:] if e["event"] != "picture"][-8:]
                raise AssertionError(f"no such {kind} event within {seconds} s; last: {tail}")
            time.sleep(0.02)

    def mark(self):
        self.poll()
        return len(self.events)

    def picture(self, since=0, seconds=60, **settings):
        """Waits for a picture in full with these settings."""
        return self.wait_for(lambda e: not e["moving"] and all(e["settings"].get(k) == v for k, v in settings.items()),
                             "picture", since, seconds)

    def settle(self, seconds=60, quiet=0.6):
        """Waits until no more pictures come and the last is one in full. Returns it."""
        deadline = time.monotonic() + seconds
        count, since = -1, time.monotonic()
        while time.monotonic() < deadline:
            self.poll()
            seen = [e for e in self.events if e["event"] in ("picture", "rest")]
            if len(seen) != count:
                count, since = len(seen), time.monotonic()
            elif seen and seen[-1]["event"] == "rest" and time.monotonic() - since > quiet:
                return [e for e in seen if e["event"] == "picture"][-1]
            time.sleep(0.03)
        raise AssertionError("the picture does not come to rest")

    def message(self, part, since=0, seconds=30):
        return self.wait_for(lambda e: part in e["text"], "message", since, seconds)

    def input(self, *words):
        subprocess.run(["xdotool", *map(str, words)], env=self.environment, check=True, stdout=subprocess.DEVNULL)

    def focus(self):
        """There is no window manager that would."""
        deadline = time.monotonic() + 10
        while True:
            found = subprocess.run(["xdotool", "search", "--onlyvisible", "--name", "Lobe"], env=self.environment,
                                   capture_output=True, text=True).stdout.split()
            if found:
                return self.input("windowfocus", "--sync", found[0])
            if time.monotonic() > deadline:
                raise AssertionError("there is no window")
            time.sleep(0.1)

    def key(self, *keys):
        for key in keys:
            self.input("key", key)
            time.sleep(0.06)

    def move(self, x, y):
        self.input("mousemove", round(x), round(y))

    def drag(self, x0, y0, x1, y1, button=1, steps=10, shift=False):
        self.move(x0, y0)
        time.sleep(0.1)
        if shift:
            self.input("keydown", "shift")
        self.input("mousedown", button)
        for i in range(1, steps + 1):
            self.move(x0 + (x1 - x0) * i / steps, y0 + (y1 - y0) * i / steps)
            time.sleep(0.03)
        self.input("mouseup", button)
        if shift:
            self.input("keyup", "shift")

    def click(self, x, y, button=1, times=1):
        self.move(x, y)
        time.sleep(0.12)
        for _ in range(times):
            self.input("mousedown", button)
            time.sleep(0.06)
            self.input("mouseup", button)
            time.sleep(0.06)

    def place(self, control, seconds=10):
        """Middle of a control, once it is on the screen."""
        deadline = time.monotonic() + seconds
        while control not in self.places:
            self.poll()
            if time.monotonic() > deadline:
                raise AssertionError(f"no control '{control}'; there are {sorted(self.places)}")
            time.sleep(0.02)
        place = self.places[control]
        return place["x"] + place["width"] / 2, place["y"] + place["height"] / 2

    def press(self, control):
        self.click(*self.place(control))

    def image(self):
        """What the window shows of the picture: rows of RGB."""
        self.poll()
        place = self.places["image"]
        x, y, width, height = (round(place[k]) for k in ("x", "y", "width", "height"))
        _, _, rows = self.display.screen()
        return [row[3 * x:3 * (x + width)] for row in rows[y:y + height]]

    def shot(self, path):
        write_png(path, self.display.screen()[2])
