#!/usr/bin/env python3
"""report.html in a browser: it draws, answers to mouse, keyboard and touch, asks nothing of the network, and whatever is in
the report stays text.

LOBE_TEST_PAGE makes the page, LOBE_BROWSER (Chromium) shows it."""
import os
import pathlib
import subprocess
import tempfile
import unittest

from browser import Browser
from page_fixture import HOSTILE, write_report

MAKER = str(pathlib.Path(os.environ.get("LOBE_TEST_PAGE", "build/bin/lobe-test-page")).resolve())
BROWSER = os.environ.get("LOBE_BROWSER", "/usr/bin/chromium-headless-shell")
ROWS = "[...document.querySelectorAll('#table tbody tr')]"
# Place of a point in the window, and how many pixels of the canvas are not its background.
PLACE = "(i => {{const r = byId('chart').getBoundingClientRect(), p = chart.getDatasetMeta(0).data[i]; return [r.left + p.x, r.top + p.y]}})({})"
PAINTED = """(() => {const c = byId('chart'), d = c.getContext('2d').getImageData(0, 0, c.width, c.height).data;
    let n = 0; for (let i = 3; i < d.length; i += 4) n += d[i] > 0; return n / (d.length / 4)})()"""


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="lobe_page_")
        cls.addClassCleanup(cls.folder.cleanup)
        cls.report = write_report(pathlib.Path(cls.folder.name) / "report")
        cls.page = pathlib.Path(cls.folder.name, "report", "report.html")
        subprocess.run([MAKER, cls.page.parent], check=True)
        cls.browser = Browser(BROWSER)
        cls.addClassCleanup(cls.browser.close)

    def setUp(self):
        self.open()

    def tearDown(self):
        self.assertEqual(self.browser.errors, [])
        self.assertEqual([url for url in self.browser.requests if not url.startswith("data:")], [self.page.as_uri()])

    def open(self, **how):
        self.browser.open(self.page.as_uri(), **how)
        self.browser.wait("chart !== null")
        self.settle()

    def settle(self):
        """Until layout and scrolling have reached what is shown: only then does the mouse hit what was measured."""
        self.run_js("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")

    def scroll_to(self, selector):
        self.run_js(f"document.querySelector({selector!r}).scrollIntoView({{block: 'center'}})")
        self.settle()

    def run_js(self, expression):
        return self.browser.run(expression)

    def place(self, index):
        self.scroll_to("#plot")
        return self.run_js(PLACE.format(index))

    def box(self, selector):
        """Left, middle of the height, width."""
        self.scroll_to(selector)
        return self.run_js(f"(r => [r.left, r.top + r.height / 2, r.width])(document.querySelector({selector!r}).getBoundingClientRect())")

    def centre(self, selector):
        left, middle, width = self.box(selector)
        return left + width / 2, middle

    def points(self):
        return self.run_js("chart.points.map(p => p.setting.id)")

    def click(self, x, y):
        self.browser.click(x, y)
        self.settle()  # the chart library answers in the next frame

    def press(self, selector):
        self.click(*self.centre(selector))

    def test_chart_is_drawn_with_every_measured_point(self):
        measured = [s for s in self.report["scenes"][0]["settings"] if s["error"]["relmse"] is not None]
        self.assertEqual(self.points(), [s["id"] for s in sorted(measured, key=lambda s: s["time"]["median_ms"])])
        self.assertGreater(self.run_js(PAINTED), 0.02)
        self.assertEqual(self.run_js("[chart.scales.x.type, chart.scales.y.type]"), ["logarithmic"] * 2)
        # An axis of decades: a factor of ten has the same length everywhere.
        axis = self.run_js("[2, 20, 4, 40].map(t => chart.scales.x.getPixelForValue(t))")
        self.assertAlmostEqual(axis[1] - axis[0], axis[3] - axis[2], delta=0.01)
        front = {s["id"] for s in measured if s["front"]}
        self.assertEqual(set(self.run_js("chart.data.datasets[1].data.map(p => p.setting.id)")), front)
        self.assertLess(len(front), len(measured))
        self.assertIn("no error at all (1)", self.run_js("byId('chart_note').textContent"))
        self.assertIn("1 of 20 settings lack", self.run_js("byId('chart_note').textContent"))

    def test_intervals_and_points_are_painted_where_they_belong(self):
        # Read once: the browser warns of canvases that are read often.
        self.run_js("""(() => {const c = byId('chart'), d = c.getContext('2d').getImageData(0, 0, c.width, c.height).data;
            window.alphaAt = (x, y) => d[4 * (y * c.width + x) + 3]})()""")
        for index, point in enumerate(self.run_js("chart.points.map(p => [p.setting.time.low_ms, p.setting.time.high_ms, p.y])")):
            low, high, row = self.run_js(f"[chart.scales.x.getPixelForValue({point[0]}), chart.scales.x.getPixelForValue({point[1]}), "
                                         f"chart.scales.y.getPixelForValue({point[2]})]")
            for end in (low, high):
                ink = self.run_js(f"Math.max(...[-1, 0, 1].map(i => alphaAt(Math.round({end}) + i, Math.round({row}))))")
                self.assertGreater(ink, 0, f"point {index}")

    def test_hover_shows_label_time_error_and_knobs(self):
        x, y = self.place(4)
        self.assertFalse(self.run_js("chart.tooltip.opacity > 0"))
        self.browser.mouse("mouseMoved", x, y)
        self.browser.wait("chart.tooltip.opacity > 0")
        setting = self.run_js("chart.points[4].setting")
        shown = self.run_js("[chart.tooltip.title, ...chart.tooltip.body.map(b => b.lines), chart.tooltip.afterBody].flat()")
        self.assertEqual(shown[0], setting["label"])
        self.assertRegex(shown[1], r"^[\d.]+ ms \[[\d.]+, [\d.]+\] at 95 %$")
        self.assertRegex(shown[2], r"^Root relative MSE: [\d.]+$")
        self.assertIn(f"Anti-aliasing: {setting['knobs']['anti_aliasing']} samples", shown)

    def test_click_shows_the_setting_and_pins_go_to_the_wipe(self):
        for index, side in ((3, "a"), (8, "b")):
            self.click(*self.place(index))
            setting = self.run_js(f"chart.points[{index}].setting")
            self.assertEqual(self.run_js("byId('detail_title').textContent"), setting["label"])
            self.assertEqual(self.run_js("[...byId('detail').querySelectorAll('img')].map(i => i.naturalWidth)"), [160, 160])
            self.assertEqual(self.run_js(f"{ROWS}.filter(r => r.ariaCurrent === 'true').map(r => r.dataset.id)"), [str(setting["id"])])
            self.assertIn("gbuffer", self.run_js("byId('passes').textContent"))
            self.press(f"#detail [data-pin={side}]")
            self.assertEqual(self.run_js(f"chart.pins.{side}.id"), setting["id"])
            image = "left" if side == "a" else "right"
            self.assertTrue(self.run_js(f"byId('wipe_{image}').src === pictures[{setting['picture']!r}]"))
        ends = self.run_js("[byId('left').value, byId('right').value]")
        self.press("#swap")
        self.assertEqual(self.run_js("[byId('right').value, byId('left').value]"), ends)

    def test_filters_take_points_away_and_bring_them_back(self):
        before = self.points()
        self.press("#knobs [data-knob=area_samples][value='1']")
        after = self.points()
        kept = [s["id"] for s in self.report["scenes"][0]["settings"] if s["knobs"]["area_samples"] != "1"]
        self.assertEqual(set(after), set(kept) & set(before))
        self.assertLess(len(after), len(before))
        self.assertEqual(self.run_js(f"{ROWS}.length"), len(kept))
        # What was behind a hidden point may now be on the front: no point shown beats one of it.
        self.assertTrue(self.run_js("""chart.points.filter(p => p.front).every(f => !chart.points.some(p => p.x < f.x && p.y < f.y))
            && chart.points.filter(p => !p.front).every(p => chart.points.some(f => f.front && f.x <= p.x && f.y <= p.y))"""))
        self.press("#knobs [data-knob=area_samples][value='1']")
        self.assertEqual(self.points(), before)
        for knob in ("8", "64", "1"):
            self.press(f"#knobs [data-knob=area_samples][value='{knob}']")
        self.assertEqual(self.points(), [])

    def test_metric_changes_the_axis(self):
        for name in self.run_js("[...byId('metric').options].map(o => o.value)"):
            self.run_js(f"byId('metric').value = {name!r}; byId('metric').dispatchEvent(new Event('change'))")
            title = self.run_js("byId('metric').selectedOptions[0].textContent")
            self.assertEqual(self.run_js("chart.options.scales.y.title.text"), title)
            self.assertTrue(self.run_js("chart.points.every(p => p.zero || Math.abs(p.y - state.metric.of(p.setting)) < 1e-12)"), name)
        first = self.report["scenes"][0]["settings"][0]
        self.assertAlmostEqual(self.run_js("metrics[0].of(scenes[0].settings[0])"), first["error"]["relmse"] ** 0.5)

    def test_table_sorts_both_ways_with_missing_figures_last(self):
        def column(title):
            index = self.run_js("[...document.querySelectorAll('#table th')].findIndex(h => h.textContent.startsWith(%r))" % title)
            self.press(f"#table th:nth-child({index + 1}) button")
            return self.run_js(f"{ROWS}.map(r => r.children[{index}].textContent)")
        errors = sorted(s["error"]["rmse"] for s in self.report["scenes"][0]["settings"] if s["error"]["rmse"] is not None)
        up = column("RMSE")
        self.assertEqual(up[-1], "–")
        for text, error in zip(up, errors):
            self.assertAlmostEqual(float(text), error, delta=0.005 * error)  # three digits are shown
        down = column("RMSE")
        self.assertEqual(down, up[-2::-1] + ["–"])
        self.assertEqual(self.run_js("document.querySelector('#table [aria-sort]').ariaSort"), "descending")
        self.assertEqual(column("PSNR")[-2:], ["∞", "–"])

    def seam(self):
        return self.run_js("byId('wipe_left').style.clipPath")

    def test_wipe_by_keyboard_mouse_and_touch(self):
        self.assertEqual(self.seam(), "inset(0px 50% 0px 0px)")
        self.run_js("byId('slider').focus()")
        self.browser.key("ArrowRight", 39)
        self.assertEqual(self.seam(), "inset(0px 49.5% 0px 0px)")
        box = self.box("#stage")
        self.browser.click(box[0] + 0.25 * box[2], box[1])
        self.assertEqual(self.seam(), "inset(0px 75% 0px 0px)")
        self.open(width=400, height=800, mobile=True)
        box = self.box("#stage")
        self.browser.touch("touchStart", (box[0] + 0.5 * box[2], box[1]))
        for share in (0.6, 0.7, 0.8):
            self.browser.touch("touchMove", (box[0] + share * box[2], box[1]))
        self.browser.touch("touchEnd")
        self.assertGreater(float(self.run_js("byId('slider').value")), 70)

    def test_chart_by_keyboard(self):
        self.run_js("byId('chart').focus()")
        for _ in range(3):
            self.browser.key("ArrowRight", 39)
        self.assertTrue(self.run_js("chart.tooltip.opacity > 0 && byId('announce').textContent.startsWith(labelOf(chart.points[2].setting))"))
        self.browser.key("Enter", 13)
        self.browser.key("b", 66, "b")
        self.assertTrue(self.run_js("state.chosen === chart.points[2].setting && chart.pins.b === state.chosen"))

    def test_hostile_strings_are_text(self):
        self.assertEqual(self.run_js("[document.title, document.querySelectorAll('[onerror]').length]"), ["Error against run time", 0])
        self.assertTrue(self.run_js(f"byId('facts').textContent.includes({HOSTILE!r}) && byId('plan').textContent.includes({HOSTILE!r})"))
        self.assertEqual(self.run_js("report.command"), self.report["command"])
        self.run_js("choose(scenes[0].settings[1])")
        self.assertEqual(self.run_js("byId('detail_title').textContent"), HOSTILE)
        self.assertIn("cannot be told from that of", self.run_js("byId('detail').textContent"))

    def test_scenes_with_little_in_them(self):
        self.run_js("byId('tab_0').focus()")
        self.browser.key("ArrowRight", 39)
        self.assertEqual(self.points(), [0])
        self.assertEqual(self.run_js("document.activeElement.textContent"), HOSTILE)
        self.assertIn("noisy", self.run_js("byId('noise').textContent"))
        self.run_js("choose(scenes[1].settings[1])")
        self.assertIn("not measured", self.run_js("byId('detail').textContent"))
        self.browser.key("ArrowRight", 39)
        self.assertEqual(self.points(), [])
        self.assertIn("No setting", self.run_js("byId('detail').textContent"))

    def test_fits_every_width_scheme_and_paper(self):
        backgrounds = set()
        for how in ({}, {"width": 400, "height": 800, "mobile": True}, {"scheme": "dark"}, {"media": "print", "width": 800}):
            self.open(**how)
            with self.subTest(**how):
                self.assertLessEqual(self.run_js("document.documentElement.scrollWidth"), how.get("width", 1280))
                self.assertGreater(self.run_js(PAINTED), 0.02)
                backgrounds.add(self.run_js("getComputedStyle(document.body).backgroundColor"))
        self.assertEqual(len(backgrounds), 2)

    def test_everything_has_a_name(self):
        self.assertEqual(self.run_js("[...document.querySelectorAll('img')].filter(i => !i.hidden && !i.alt).length"), 0)
        self.assertEqual(self.run_js("""[...document.querySelectorAll('button, select, input')].filter(e =>
            !e.textContent.trim() && !e.ariaLabel && !e.labels?.length).length"""), 0)
        self.assertIn("on the front: draft", self.run_js("byId('chart').ariaLabel"))

    def test_this_test_sees_requests_and_errors(self):
        bad = self.page.with_name("bad.html")
        bad.write_text("<img src='http://127.0.0.1:9/x.png'><script>console.error('planted'); throw Error('thrown')</script>")
        self.browser.open(bad.as_uri())
        self.browser.wait("document.images[0].complete")
        self.assertIn("http://127.0.0.1:9/x.png", self.browser.requests)
        self.assertIn("planted", str(self.browser.errors))
        self.assertIn("thrown", str(self.browser.errors))
        self.browser.requests, self.browser.errors = [self.page.as_uri()], []


if __name__ == "__main__":
    unittest.main()
