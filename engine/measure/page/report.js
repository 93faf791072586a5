"use strict";
// What the page shows now, and what changes it.
const state = {scene: null, metric: metrics[0], knobs: [], off: new Map(), chosen: null, pins: {}, sort: "Time (ms)", down: false};
let chart = null, cursor = -1;

const shown = () => state.scene.settings.filter(setting =>
  state.knobs.every(({name}) => !state.off.get(name)?.has(String(setting.knobs?.[name]))));

/** The report's own front, which knows of noise, while all settings are shown under the report's own metric. */
function front(settings) {
  const all = state.scene.settings;
  if (state.metric.name === "relmse" && settings.length === all.length && all.some(s => s.front)) return all.filter(s => s.front);
  return paretoFront(settings, state.metric);
}

function redraw() {
  const settings = shown(), best = front(settings);
  const drawn = drawChart(byId("chart"), chart, settings, best, state.metric, state, choose);
  chart = drawn.chart;
  cursor = -1;
  byId("chart").setAttribute("aria-label", `Chart of ${state.metric.title} against time: ${chart.points.length} settings, ` +
    `${best.length} on the front: ${best.map(labelOf).join(", ")}.`);
  const notes = [];
  if (drawn.zero) notes.push(`Triangles at the bottom: no error at all (${drawn.zero}).`);
  if (drawn.missing) notes.push(`${drawn.missing} of ${settings.length} settings lack this figure or a time and are not drawn.`);
  if (!settings.length) notes.push("No setting passes the filters.");
  byId("chart_note").textContent = notes.join(" ");
  byId("filters").querySelector("summary").textContent = `Filter by knob: ${settings.length} of ${state.scene.settings.length} settings shown`;
  showTable(state.scene, settings, best, state, choose, sortBy);
}

function choose(setting) {
  state.chosen = setting;
  showDetail(state.scene, setting, state.metric, pin);
  showPasses(setting);
  chart.chosen = setting;
  chart.draw();
  for (const row of byId("table").querySelectorAll("tbody tr")) {
    if (row.dataset.id === String(setting?.id)) row.setAttribute("aria-current", "true");
    else row.removeAttribute("aria-current");
  }
}

function pin(side, setting) {
  if (!setting || !pictureOf(setting.picture)) return;
  byId(side === "a" ? "left" : "right").value = setting.picture;
  readPins();
}

/** The pins are what the two lists say, so that lists, buttons and chart agree. */
function readPins() {
  const of = id => state.scene.settings.find(s => s.picture != null && s.picture === byId(id).value);
  state.pins = {a: of("left"), b: of("right")};
  chart.pins = state.pins;
  chart.draw();
  showWipe();
}

function sortBy(title) {
  state.down = state.sort === title && !state.down;
  state.sort = title;
  const settings = shown();
  showTable(state.scene, settings, front(settings), state, choose, sortBy);
  for (const button of byId("table").querySelectorAll("thead button"))
    if (button.parentNode.hasAttribute("aria-sort")) button.focus();
}

function showFilters() {
  state.off = new Map(state.knobs.map(({name}) => [name, new Set()]));
  byId("knobs").replaceChildren(...state.knobs.map(({name, values}) => make("fieldset", {}, make("legend", {}, knobTitle(name)),
    ...values.map(value => make("label", {class: "chip"}, make("input", {type: "checkbox", checked: true, "data-knob": name, value,
      change: event => {
        if (event.target.checked) state.off.get(name).delete(value);
        else state.off.get(name).add(value);
        redraw();
      }}), make("span", {}, knobValue(name, value)))))));
}

function showScene(index) {
  const scene = state.scene = scenes[index], settings = scene.settings;
  [...byId("tabs").children].forEach((tab, at) => {
    tab.setAttribute("aria-selected", String(at === index));
    tab.tabIndex = at === index ? 0 : -1;
  });
  byId("scene").setAttribute("aria-labelledby", "tab_" + index);
  const truth = scene.truth ?? {};
  byId("about").textContent = [`${scene.width ?? "?"} × ${scene.height ?? "?"} pixels`, scene.camera && `camera ${scene.camera}`,
    truth.method && `truth: ${truth.method}` + (isNumber(truth.standard_error) ? `, standard error ${number(truth.standard_error)}` : "") +
      (isNumber(truth.seconds) ? `, ${number(truth.seconds)} s` : ""), truth.note,
    scene.search && `${scene.search.tried ?? "?"} of ${scene.search.possible ?? "?"} settings tried` +
      (scene.search.method ? `: ${scene.search.method}` : "")].filter(Boolean).join(" · ");
  const noise = scene.noise ?? {}, noisy = noise.verdict != null && noise.verdict !== "quiet";
  byId("noise").className = noisy ? "notice" : "hint";
  byId("noise").textContent = [noise.verdict && (noise.verdict === "unknown" ? "How noisy the machine was is not known:" : noisy ? `The machine was ${noise.verdict}: some times cannot be told apart.`
    : "The machine was quiet."), noise.detail].filter(Boolean).join(" ");
  state.knobs = varyingKnobs(scene);
  state.pins = {};
  showFilters();
  fillWipe(scene);
  const best = front(settings).sort((a, b) => timeOf(a) - timeOf(b));
  state.chosen = best[Math.floor(best.length / 2)] ?? settings[0] ?? null;
  if (pictureOf(best[0]?.picture)) byId("left").value = best[0].picture;
  if (pictureOf(scene.truth?.picture)) byId("right").value = scene.truth.picture;
  byId("slider").value = 50;
  redraw();
  choose(state.chosen);
  readPins();
  showPlan(scene);
}

function onTabKey(event) {
  const step = {ArrowLeft: -1, ArrowRight: 1}[event.key];
  if (!step) return;
  const next = (scenes.indexOf(state.scene) + step + scenes.length) % scenes.length;
  showScene(next);
  byId("tab_" + next).focus();
}

function onChartKey(event) {
  const step = {ArrowLeft: -1, ArrowRight: 1}[event.key], points = chart.points;
  if (event.ctrlKey || event.metaKey || event.altKey || !points.length) return;
  if (step) {
    cursor = cursor < 0 ? (step > 0 ? 0 : points.length - 1) : Math.min(points.length - 1, Math.max(0, cursor + step));
    hoverPoint(chart, cursor);
    const {setting} = points[cursor];
    byId("announce").textContent = `${labelOf(setting)}: ${timeText(setting)}, ${state.metric.title} ${number(state.metric.of(setting))}`;
    event.preventDefault();
  } else if (cursor >= 0 && event.key === "Enter") choose(points[cursor].setting);
  else if (cursor >= 0 && ["a", "b"].includes(event.key.toLowerCase())) pin(event.key.toLowerCase(), points[cursor].setting);
}

function wipeTo(event) {
  const box = byId("stage").getBoundingClientRect();
  byId("slider").value = 100 * (event.clientX - box.left) / box.width;
  moveSeam();
}

function start() {
  showFacts();
  if (!scenes.length) {
    byId("scene").replaceChildren(make("p", {class: "notice"}, "The report has no scenes."));
    return;
  }
  byId("tabs").append(...scenes.map((scene, index) => make("button", {type: "button", role: "tab", id: "tab_" + index,
    "aria-controls": "scene", click: () => showScene(index), keydown: onTabKey}, String(scene.scene ?? "scene " + index))));
  byId("metric").append(...metrics.filter(metric => scenes.some(scene => scene.settings.some(s => isNumber(metric.of(s)))))
    .map(metric => make("option", {value: metric.name}, metric.title)));
  state.metric = metrics.find(metric => metric.name === byId("metric").value) ?? metrics[0];
  byId("metric").addEventListener("change", () => {
    state.metric = metrics.find(metric => metric.name === byId("metric").value);
    redraw();
    choose(state.chosen);
  });
  byId("chart").addEventListener("keydown", onChartKey);
  for (const id of ["left", "right"]) byId(id).addEventListener("change", readPins);
  byId("swap").addEventListener("click", () => {
    [byId("left").value, byId("right").value] = [byId("right").value, byId("left").value];
    readPins();
  });
  byId("slider").addEventListener("input", moveSeam);
  byId("stage").addEventListener("pointerdown", event => { byId("stage").setPointerCapture(event.pointerId); wipeTo(event); });
  byId("stage").addEventListener("pointermove", event => { if (event.buttons) wipeTo(event); });
  for (const query of ["(prefers-color-scheme: dark)", "print"]) matchMedia(query).addEventListener("change", redraw);
  Chart.defaults.font.family = getComputedStyle(document.body).fontFamily;
  showScene(0);
}
start();
