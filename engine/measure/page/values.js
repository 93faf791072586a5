"use strict";
// What the report says, as text. Whatever may be missing is null and shown as a dash; text goes in as text, never as HTML.
const report = JSON.parse(document.getElementById("report").textContent);
const pictures = JSON.parse(document.getElementById("pictures").textContent);
const scenes = (report.scenes ?? []).map(scene => ({...scene, settings: scene.settings ?? []}));
const byId = id => document.getElementById(id);

/** An element: `make("td", {class: "number"}, "1.5")`. Children are nodes or text. */
function make(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === "function") element.addEventListener(name, value);
    else if (value === true) element.setAttribute(name, "");
    else if (value !== false && value != null) element.setAttribute(name, value);
  }
  element.append(...children.filter(child => child != null));
  return element;
}

const isNumber = value => typeof value === "number" && Number.isFinite(value);
const number = (value, digits = 3) => !isNumber(value) ? "–"
  : value === 0 ? "0"
  : Math.abs(value) < 1e-3 || Math.abs(value) >= 1e6 ? value.toExponential(digits - 1)
  : String(Number(value.toPrecision(digits)));
const ms = value => isNumber(value) ? number(value) + " ms" : "–";
const root = value => isNumber(value) && value >= 0 ? Math.sqrt(value) : null;
const errorOf = (setting, name) => setting.error?.[name];

// Each is zero for a perfect picture and greater for a worse one, so that all can be on a logarithmic axis.
const metrics = [
  {name: "relmse", title: "Root relative MSE", of: s => root(errorOf(s, "relmse"))},
  {name: "relmse_trimmed", title: "Root relative MSE, trimmed", of: s => root(errorOf(s, "relmse_trimmed"))},
  {name: "shading_relmse", title: "Root relative MSE without edges", of: s => root(errorOf(s, "shading_relmse"))},
  {name: "edge_relmse", title: "Root relative MSE at edges", of: s => root(errorOf(s, "edge_relmse"))},
  {name: "rmse", title: "RMSE", of: s => errorOf(s, "rmse")},
  {name: "p95", title: "95th percentile", of: s => errorOf(s, "p95")},
  {name: "max", title: "Maximum", of: s => errorOf(s, "max")},
  {name: "flip", title: "FLIP", of: s => errorOf(s, "flip")},
  {name: "ssim", title: "1 − SSIM", of: s => isNumber(errorOf(s, "ssim")) ? Math.max(0, 1 - errorOf(s, "ssim")) : null},
];

const timeOf = setting => setting.time?.median_ms;
const labelOf = setting => String(setting.label ?? "setting " + setting.id);

function timeText(setting) {
  const time = setting.time ?? {};
  if (!isNumber(time.median_ms)) return "not measured";
  if (!isNumber(time.low_ms) || !isNumber(time.high_ms)) return ms(time.median_ms);
  const share = isNumber(time.confidence) ? ` at ${number(100 * time.confidence)} %` : "";
  return `${ms(time.median_ms)} [${number(time.low_ms)}, ${number(time.high_ms)}]${share}`;
}

/** PSNR of two equal pictures is infinite, which JSON cannot hold. */
function psnrText(error = {}) {
  if (isNumber(error.psnr)) return number(error.psnr) + " dB";
  return error.rmse === 0 ? "∞ dB" : "–";
}

const knobTitle = name => String((report.knobs ?? []).find(knob => knob.name === name)?.title ?? name);
function knobValue(name, value) {
  const unit = (report.knobs ?? []).find(knob => knob.name === name)?.unit;
  return value == null ? "–" : unit ? `${value} ${unit}` : String(value);
}

/** Knobs whose value differs between settings of the scene, with the values in the report's order. */
function varyingKnobs(scene) {
  const found = new Map();
  for (const setting of scene.settings)
    for (const [name, value] of Object.entries(setting.knobs ?? {})) {
      if (!found.has(name)) found.set(name, new Set());
      found.get(name).add(String(value));
    }
  const order = (report.knobs ?? []).map(knob => knob.name);
  const rank = (list, value) => list.includes(value) ? list.indexOf(value) : list.length;
  return [...found].filter(([, values]) => values.size > 1)
    .sort(([a], [b]) => rank(order, a) - rank(order, b))
    .map(([name, values]) => {
      const listed = ((report.knobs ?? []).find(knob => knob.name === name)?.values ?? []).map(String);
      return {name, values: [...values].sort((a, b) => rank(listed, a) - rank(listed, b))};
    });
}

/** Those that no other beats in time and error both, by time. */
function paretoFront(settings, metric) {
  const known = settings.filter(s => isNumber(timeOf(s)) && isNumber(metric.of(s)));
  known.sort((a, b) => timeOf(a) - timeOf(b) || metric.of(a) - metric.of(b));
  let least = Infinity;
  return known.filter(s => metric.of(s) < least && ((least = metric.of(s)), true));
}
