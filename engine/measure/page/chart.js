"use strict";
// The chart: points, the front as a step line, intervals, pins and names of presets.
const colour = name => getComputedStyle(document.documentElement).getPropertyValue("--" + name).trim();

/** Intervals of time under the points; names of presets and the letters of pins over them. */
const marks = {
  id: "marks",
  beforeDatasetsDraw(chart) {
    const {ctx, scales: {x, y}} = chart;
    ctx.save();
    for (const point of chart.points ?? []) {
      const {low_ms: low, high_ms: high} = point.setting.time;
      if (!isNumber(low) || !isNumber(high) || low <= 0) continue;
      const row = y.getPixelForValue(point.y), from = x.getPixelForValue(low), to = x.getPixelForValue(high);
      ctx.strokeStyle = colour(point.front ? "front" : "other");
      ctx.lineWidth = 1.5;
      ctx.beginPath();
      ctx.moveTo(from, row); ctx.lineTo(to, row);
      for (const end of [from, to]) { ctx.moveTo(end, row - 4); ctx.lineTo(end, row + 4); }
      ctx.stroke();
    }
    ctx.restore();
  },
  afterDatasetsDraw(chart) {
    const {ctx, scales: {x, y}, chartArea: area} = chart;
    ctx.save();
    ctx.font = "12px system-ui, sans-serif";
    ctx.textBaseline = "middle";
    const taken = [];
    for (const point of chart.points ?? []) {
      const left = x.getPixelForValue(point.x), top = y.getPixelForValue(point.y);
      const pin = chart.pins.a === point.setting ? "a" : chart.pins.b === point.setting ? "b" : null;
      if (chart.chosen === point.setting || pin) {
        ctx.strokeStyle = colour(pin ?? "ink");
        ctx.lineWidth = 2.5;
        ctx.beginPath(); ctx.arc(left, top, 10, 0, 2 * Math.PI); ctx.stroke();
      }
      const text = [pin?.toUpperCase(), point.setting.preset].filter(Boolean).join(" ");
      if (!text) continue;
      const width = ctx.measureText(text).width;
      const start = left + 14 + width > area.right ? left - 14 - width : left + 14;
      // The first of these rows that is free.
      const row = [top - 9, top + 11, top - 24, top + 26].find(at => at > area.top && at < area.bottom &&
        !taken.some(box => Math.abs(box.row - at) < 14 && start < box.end && start + width > box.start));
      if (row === undefined) continue;
      taken.push({row, start, end: start + width});
      ctx.lineWidth = 4;
      ctx.strokeStyle = colour("page");
      ctx.strokeText(text, start, row);
      ctx.fillStyle = colour(pin ?? "ink");
      ctx.fillText(text, start, row);
    }
    ctx.restore();
  },
};

/** Whole axis in decades of 1, 2, 5, so that there are numbers on axes shorter than a decade too. */
function logAxis(title, minimum, maximum) {
  const span = Math.log10(maximum / minimum);
  const steps = span > 3 ? [1] : span > 1.3 ? [1, 3] : span > 0.5 ? [1, 2, 5] : [1, 1.5, 2, 3, 4, 5, 6, 7, 8, 9];
  return {
    type: "logarithmic", min: minimum, max: maximum,
    title: {display: true, text: title, color: colour("ink")},
    grid: {color: colour("grid")}, border: {color: colour("line")},
    ticks: {color: colour("quiet"), maxRotation: 0, callback: value => number(value, 2)},
    afterBuildTicks(axis) {
      axis.ticks = [];
      for (let decade = Math.floor(Math.log10(minimum)); decade <= Math.log10(maximum); ++decade)
        for (const step of steps) {
          const value = step * 10 ** decade;
          if (value >= minimum && value <= maximum) axis.ticks.push({value});
        }
    },
  };
}

/** Draws `settings`; returns {chart, missing, zero}: how many lack a figure, and how many have no error at all. */
function drawChart(canvas, previous, settings, front, metric, state, choose) {
  previous?.destroy();
  const known = settings.filter(s => isNumber(timeOf(s)) && timeOf(s) > 0 && isNumber(metric.of(s)));
  const positive = known.map(metric.of).filter(value => value > 0);
  const least = positive.length ? Math.min(...positive) : 1e-3;
  const floor = least / 3;  // where an error of 0 is drawn: a logarithmic axis has no 0
  const points = known.map(setting => {
    const error = metric.of(setting);
    return {setting, x: timeOf(setting), y: error > 0 ? error : floor, zero: error === 0, front: front.includes(setting)};
  }).sort((a, b) => a.x - b.x);
  const line = points.filter(point => point.front);
  const zero = points.filter(point => point.zero).length;
  const times = points.flatMap(p => [p.x, p.setting.time.low_ms, p.setting.time.high_ms]).filter(t => isNumber(t) && t > 0);
  const [fastest, slowest] = times.length ? [Math.min(...times), Math.max(...times)] : [1, 10];
  const worst = positive.length ? Math.max(...positive) : 1;
  const fill = point => colour(point?.front ? "front" : "other");
  const chart = new Chart(canvas, {
    data: {datasets: [
      {type: "scatter", data: points, pointRadius: c => c.raw?.front ? 6 : 4.5, pointHoverRadius: 8,
        pointStyle: c => c.raw?.zero ? "triangle" : "circle", rotation: 180,
        backgroundColor: c => c.raw?.front ? fill(c.raw) : colour("page"), borderColor: c => fill(c.raw), borderWidth: 2},
      {type: "line", data: line, stepped: "before", borderColor: colour("front"), borderWidth: 2, pointRadius: 0,
        pointHitRadius: 0, pointHoverRadius: 0},
    ]},
    options: {
      animation: false, maintainAspectRatio: false,
      interaction: {mode: "nearest", intersect: true},
      layout: {padding: {right: 12, top: 6}},
      scales: {x: logAxis("Time of a picture (ms)", fastest / 1.25, slowest * 1.25),
        y: logAxis(metric.title, (zero ? floor : least) / 1.5, worst * 1.6)},
      plugins: {legend: {display: false}, tooltip: {
        filter: item => item.datasetIndex === 0, displayColors: false,
        callbacks: {
          title: items => items.map(item => labelOf(item.raw.setting)),
          label: item => [timeText(item.raw.setting), `${metric.title}: ${number(metric.of(item.raw.setting))}`],
          // Long lists of knobs would cover the chart: only those that differ between settings.
          afterBody: items => items.slice(0, 1).flatMap(item => state.knobs.map(({name}) =>
            `${knobTitle(name)}: ${knobValue(name, item.raw.setting.knobs?.[name])}`)).slice(0, 14),
        }}},
      onHover: (event, items) => { canvas.style.cursor = items.length ? "pointer" : "default"; },
      onClick: (event, items) => {
        const hit = items.find(item => item.datasetIndex === 0);
        if (hit) choose(points[hit.index].setting);
      },
    },
    plugins: [marks],
  });
  chart.points = points;
  chart.pins = state.pins;
  chart.chosen = state.chosen;
  chart.draw();
  return {chart, missing: settings.length - known.length, zero};
}

/** Shows the tooltip of a point, as hovering it does; for the keyboard. */
function hoverPoint(chart, index) {
  const {x, y} = chart.getDatasetMeta(0).data[index];
  chart.setActiveElements([{datasetIndex: 0, index}]);
  chart.tooltip.setActiveElements([{datasetIndex: 0, index}], {x, y});
  chart.update("none");
}
