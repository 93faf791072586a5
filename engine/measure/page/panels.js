"use strict";
// The chosen setting, the wipe, the table and what was left out.

/** A data URI of the report's pictures, or null. */
const pictureOf = name => typeof name === "string" && Object.hasOwn(pictures, name) ? pictures[name] : null;

function picture(name, alt) {
  const source = pictureOf(name);
  return source ? make("figure", {}, make("img", {src: source, alt}), make("figcaption", {}, alt))
    : make("p", {class: "hint"}, `${alt}: not in the report.`);
}

function figures(pairs) {
  return make("dl", {class: "figures"}, ...pairs.map(([name, text]) => make("div", {}, make("dt", {}, name), make("dd", {}, text))));
}

function simpleTable(headings, rows) {
  return make("div", {class: "scroll", tabindex: 0}, make("table", {},
    headings.length ? make("thead", {}, make("tr", {}, ...headings.map(text => make("th", {scope: "col"}, text)))) : "",
    make("tbody", {}, ...rows.map(row => make("tr", {}, ...row.map(cell =>
      cell instanceof Node ? make("td", {}, cell) : make("td", {class: "wrap"}, cell)))))));
}

function showDetail(scene, setting, metric, pin) {
  const panel = byId("detail");
  if (!setting) return panel.replaceChildren(make("h2", {id: "detail_title"}, "No setting was measured"));
  const error = setting.error ?? {};
  const ties = (setting.tied_with ?? []).map(id => scene.settings.find(other => other.id === id)).filter(Boolean);
  panel.replaceChildren(
    make("div", {class: "bar"}, make("h2", {id: "detail_title"}, labelOf(setting)),
      ...["a", "b"].map(side => make("button", {type: "button", class: "act", "data-pin": side, click: () => pin(side, setting)},
        "Pin as ", make("b", {class: "pin " + side}, side.toUpperCase())))),
    figures([["Time", timeText(setting)], [metric.title, number(metric.of(setting))], ["PSNR", psnrText(error)],
      ["FLIP", number(error.flip)], ["SSIM", number(error.ssim, 4)], ["Greatest error", number(error.max)]]),
    ...(error.non_finite > 0 ? [make("p", {class: "notice"}, `${error.non_finite} pixels are not finite.`)] : []),
    ...(ties.length ? [make("p", {class: "hint"}, "Its time cannot be told from that of " + ties.map(labelOf).join(", ") + ".")] : []),
    picture(setting.picture, "Picture: " + labelOf(setting)),
    picture(setting.difference, "Difference from the truth: " + labelOf(setting)),
    make("details", {open: true}, make("summary", {}, "Knobs"), simpleTable(["Knob", "Value"],
      Object.entries(setting.knobs ?? {}).map(([name, value]) => [knobTitle(name), knobValue(name, value)]))));
}

/** Every picture of the scene: [name, text]. */
function choices(scene) {
  const all = [[scene.truth?.picture, "Truth"]];
  for (const s of scene.settings) all.push([s.picture, labelOf(s)]);
  for (const s of scene.settings) all.push([s.difference, "Difference: " + labelOf(s)]);
  return all.filter(([name]) => pictureOf(name));
}

function fillWipe(scene) {
  const all = choices(scene);
  for (const id of ["left", "right"]) byId(id).replaceChildren(...all.map(([name, text]) => make("option", {value: name}, text)));
}

function showWipe() {
  const text = id => byId(id).selectedOptions[0]?.textContent ?? "";
  for (const side of ["left", "right"]) {
    const image = byId("wipe_" + side), source = pictureOf(byId(side).value);
    image.hidden = !source;
    if (source) image.src = source;
    image.alt = text(side);
  }
  byId("wipe_note").textContent = byId("left").value ? `Left of the seam: ${text("left")}. Right: ${text("right")}.`
    : "The report has no pictures of this scene.";
  moveSeam();
}

function moveSeam() {
  const at = Number(byId("slider").value);
  byId("wipe_left").style.clipPath = `inset(0 ${100 - at}% 0 0)`;
  byId("seam").style.left = at + "%";
}

function columnsOf(scene) {
  const figure = metric => ({title: metric.title, number: true, of: metric.of, text: s => number(metric.of(s))});
  return [
    {title: "Setting", of: labelOf, text: labelOf},
    {title: "Front", of: (s, front) => front.includes(s) ? 0 : 1, text: (s, front) => front.includes(s) ? "●\u00a0front" : ""},
    {title: "Time (ms)", number: true, of: timeOf, text: s => number(timeOf(s))},
    {title: "Interval (ms)", number: true, of: s => s.time?.low_ms, text: s => `${number(s.time?.low_ms)} – ${number(s.time?.high_ms)}`},
    ...metrics.filter(metric => scene.settings.some(s => isNumber(metric.of(s)))).map(figure),
    {title: "PSNR (dB)", number: true, of: s => s.error?.psnr ?? (s.error?.rmse === 0 ? Infinity : null), text: s => psnrText(s.error).replace(" dB", "")},
    ...varyingKnobs(scene).map(({name, values}) => ({title: knobTitle(name), of: s => values.indexOf(String(s.knobs?.[name])),
      text: s => knobValue(name, s.knobs?.[name])})),
  ];
}

/** What is missing comes last, whichever way is sorted. */
function ordered(settings, column, front, down) {
  const missing = value => value == null || Number.isNaN(value);
  return [...settings].sort((first, second) => {
    const a = column.of(first, front), b = column.of(second, front);
    if (missing(a) || missing(b)) return missing(a) - missing(b);
    const order = typeof a === "string" ? a.localeCompare(b, "en", {numeric: true}) : a < b ? -1 : a > b ? 1 : 0;
    return down ? -order : order;
  });
}

function showTable(scene, settings, front, state, choose, sortBy) {
  const columns = columnsOf(scene);
  const sorted = columns.find(column => column.title === state.sort) ?? columns[2];
  const head = columns.map(column => make("th", {scope: "col", class: column.number ? "number" : null,
    "aria-sort": column === sorted ? (state.down ? "descending" : "ascending") : null},
    make("button", {type: "button", click: () => sortBy(column.title)}, column.title, column === sorted ? (state.down ? " ▼" : " ▲") : "")));
  const rows = ordered(settings, sorted, front, state.down).map(setting => make("tr",
    {"data-id": setting.id, "aria-current": setting === state.chosen ? "true" : null, click: () => choose(setting)},
    ...columns.map((column, index) => make("td", {class: column.number ? "number" : null},
      index ? column.text(setting, front) : make("button", {type: "button", class: "link"}, column.text(setting))))));
  byId("table").replaceChildren(make("thead", {}, make("tr", {}, ...head)), make("tbody", {}, ...rows));
}

function showPasses(setting) {
  const passes = setting?.passes ?? [];
  const longest = Math.max(...passes.map(pass => pass.median_ms).filter(isNumber), Number.MIN_VALUE);
  const share = value => Math.min(100, 100 * value / longest) + "%";
  const bar = pass => {
    const meter = make("div", {class: "meter", "aria-hidden": "true"});
    if (isNumber(pass.median_ms)) meter.append(make("i"));
    if (isNumber(pass.median_ms)) meter.lastChild.style.width = share(pass.median_ms);
    if (isNumber(pass.floor_ms)) meter.append(make("b"));
    if (isNumber(pass.floor_ms)) meter.lastChild.style.left = share(pass.floor_ms);
    return meter;
  };
  byId("passes").replaceChildren(passes.length
    ? make("p", {class: "hint"}, `Of ${labelOf(setting)}. Bar: the time; mark: the floor, what moving its bytes alone would take.`)
    : make("p", {}, "No passes were timed."),
    ...(passes.length ? [simpleTable(["Pass", "", "Time", "Floor", "Bytes per pixel"], passes.map(pass =>
      [String(pass.pass), bar(pass), ms(pass.median_ms), ms(pass.floor_ms), number(pass.bytes_per_pixel)]))] : []));
}

function showPlan(scene) {
  const out = scene.left_out ?? [], idle = scene.knobs_without_effect ?? [];
  byId("plan").replaceChildren(
    make("h3", {}, "By the plan"), out.length ? simpleTable(["Kind", "Name", "Why"], out.map(o => [String(o.kind), String(o.name), String(o.reason)]))
      : make("p", {}, "Nothing."),
    make("h3", {}, "Knobs without effect here"), idle.length
      ? simpleTable(["Knob", "Why"], idle.map(k => [knobTitle(k.knob), String(k.reason)])) : make("p", {}, "None."));
}

function showFacts() {
  const machine = report.machine ?? {}, context = report.context ?? {};
  const gib = isNumber(machine.memory_bytes) ? number(machine.memory_bytes / 2 ** 30) + " GiB" : null;
  const rows = [["Program", [report.program, report.version].filter(Boolean).join(" ")], ["Created", report.created],
    ["Command", report.command], ["Processor", [machine.cpu, machine.cores && machine.cores + " cores"].filter(Boolean).join(", ")],
    ["Memory", gib], ["System", machine.os], ["Load before", isNumber(machine.load) ? number(machine.load) : null],
    ["Renderer", context.renderer], ["OpenGL", context.version], ["Driver", context.driver], ["Context", context.backend],
    ["Clock", context.clock]].filter(([, value]) => value != null && value !== "");
  byId("facts").replaceChildren(simpleTable([], rows.map(([name, value]) => [name, String(value)])));
  byId("machine").textContent = [context.renderer, machine.cpu, report.created?.slice?.(0, 10)].filter(Boolean).join(" · ");
}
