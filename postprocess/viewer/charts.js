// SPDX-License-Identifier: GPL-3.0-or-later
import uPlot from "uplot";
import { short } from "./colours.js";
import { h, schemeColour } from "./dom.js";

const HEIGHT = 150;
const PAPER_WIDTH = 320; // px, of half a page

/** Of curves, told apart by the colour-blind; page.css has them, lighter on a dark page. */
function curveColour(n) {
  return schemeColour(`curve${n % 6}`);
}

/** Dragging in a chart moves the clock. */
function dragMovesClock(over, timeAt, clock) {
  over.addEventListener("pointerdown", (event) => {
    over.setPointerCapture(event.pointerId);
    clock.play(false);
    clock.seek(timeAt(event));
  });
  over.addEventListener("pointermove", (event) => {
    if (over.hasPointerCapture(event.pointerId)) clock.seek(timeAt(event));
  });
}

export function axes(log) {
  const soft = schemeColour("soft");
  const grid = { stroke: schemeColour("grid"), width: 1 };
  const font = "11px system-ui, sans-serif";
  return [
    { stroke: soft, grid: { show: false }, ticks: { ...grid, size: 4 }, font, size: 24, gap: 3, values: (u, values) => values.map((one) => (one === null ? "" : short(one))) },
    { stroke: soft, grid, ticks: { show: false }, font, size: 52, gap: 4, space: 28,
      ...(log ? { filter: (u, splits) => splits.map((one) => (power(one) ? one : null)), grid: { ...grid, filter: (u, splits) => splits.map((one) => (power(one) ? one : null)) } } : {}),
      values: (u, values) => values.map((one) => (one === null ? "" : log ? power(one) : short(one))) },
  ];
}

function power(value) {
  const exponent = Math.log10(value);
  return Math.abs(exponent - Math.round(exponent)) < 1e-9 ? (Math.abs(exponent) <= 2 ? short(value) : `1e${Math.round(exponent)}`) : "";
}

/** What all but the lowest hundredth are above: the first step of a run, hardly solved, must not squeeze the others. */
function usualLow(values) {
  const sorted = values.flat().filter((one) => one !== null).sort((a, b) => a - b);
  return sorted[Math.floor(sorted.length / 100)];
}

/** Whole decades, of which the lowest of very many are left out. */
export function decades(u, low, high) {
  if (!(high > 0)) return [0.1, 1];
  const top = Math.ceil(Math.log10(high) + 1e-9);
  return [10 ** Math.max(Math.floor(Math.log10(low)), top - 9), 10 ** top];
}

/** A range with a little room, even where all values are the same. */
export function roomy(u, low, high) {
  if (low === null || high === null || !Number.isFinite(low) || !Number.isFinite(high)) return [0, 1];
  const room = 0.06 * (high - low) || 0.1 * Math.abs(high) || 1;
  return [low >= 0 && low < 0.5 * high ? Math.min(0, low) : low - room, high + room];
}

/** A chart over time whose cursor is the clock. */
class TimeChart {
  /** @param panel its curves have the colours 0, 1, …, unless they name others; @param columns numbers by name */
  constructor(panel, columns, clock) {
    this.clock = clock;
    this.panel = panel;
    this.columns = columns;
    this.numbers = panel.curves.map(() => h("b"));
    const swatch = (curve, n) => h("i", { "data-curve": (curve.colour ?? n) % 6 });
    const many = panel.curves.length > 1 || panel.curves[0].label !== panel.title;
    this.head = h("div", { class: "head" }, h("h3", {}, panel.title.charAt(0).toUpperCase() + panel.title.slice(1)), h("span", { class: "unit" }, panel.unit),
      h("span", { class: "values" }, ...panel.curves.map((curve, n) => h("span", {}, swatch(curve, n), many ? `${curve.label} ` : "", this.numbers[n]))));
    this.plot = h("div", { class: "plot" });
    this.note = h("p", { class: "note", hidden: !panel.result });
    if (panel.result) this.note.textContent = `Shaded: what was averaged, ${short(panel.result.from)} to ${short(panel.result.to)} s; ${panel.result.told} ${panel.unit}`;
    this.element = h("figure", { class: "chart" }, this.head, this.plot, this.note);
  }

  draw(width) {
    const { panel } = this;
    this.u?.destroy();
    this.u = null;
    const positive = (values) => values.map((one) => (one > 0 ? one : null));
    const series = panel.curves.map((curve) => Array.from(this.columns[curve.column], (one) => (Number.isFinite(one) ? one : null)));
    const data = [Array.from(this.columns.time_s), ...(panel.log ? series.map(positive) : series)];
    const empty = panel.log && data.slice(1).every((one) => one.every((value) => value === null));
    const log = panel.log && !empty;
    const low = log && usualLow(data.slice(1));
    this.data = data;
    const u = new uPlot({
      width,
      height: HEIGHT,
      legend: { show: false },
      cursor: { drag: { setScale: false, x: false, y: false }, points: { show: false }, x: false, y: false },
      scales: { x: { time: false, range: () => [this.clock.from, this.clock.to] }, y: log ? { distr: 3, range: (u, least, greatest) => decades(u, low, greatest) } : { range: roomy } },
      axes: axes(log),
      series: [{}, ...panel.curves.map((curve, n) => ({ stroke: curveColour(curve.colour ?? n), width: 1.5, points: { show: false }, dash: n > 2 ? [6, 3] : undefined }))],
      hooks: { drawAxes: [(u) => this.shade(u)], ready: [(u) => this.putCursor(u)] },
    }, data, this.plot);
    dragMovesClock(u.over, (event) => u.posToVal(event.clientX - u.over.getBoundingClientRect().left, "x"), this.clock);
  }

  /** Takes other numbers, as of a run that goes on. */
  take(panel, columns) {
    Object.assign(this, { panel, columns });
    if (this.u) this.draw(this.width);
  }

  /** The steady part, with its means. */
  shade(u) {
    const { result } = this.panel;
    if (!result) return;
    const pen = u.ctx;
    const [x0, x1] = [result.from, result.to].map((one) => u.valToPos(one, "x", true));
    pen.save();
    pen.fillStyle = schemeColour("band");
    pen.fillRect(x0, u.bbox.top, x1 - x0, u.bbox.height);
    pen.strokeStyle = schemeColour("ink");
    pen.setLineDash([4, 4]);
    pen.lineWidth = devicePixelRatio;
    pen.beginPath();
    for (const value of result.values) {
      const y = u.valToPos(value, "y", true);
      pen.moveTo(x0, y);
      pen.lineTo(x1, y);
    }
    pen.stroke();
    pen.restore();
  }

  putCursor(u) {
    this.cursor = h("div", { class: "now" });
    u.over.append(this.cursor);
    this.u = u;
    this.now();
  }

  /** Puts the cursor to the clock's time, and tells the values there. */
  now() {
    if (!this.u) return; // not drawn yet
    const { time } = this.clock;
    this.cursor.style.transform = `translateX(${this.u.valToPos(time, "x")}px)`;
    const row = nearest(this.data[0], time);
    this.numbers.forEach((one, n) => (one.textContent = short(this.data[n + 1]?.[row] ?? NaN)));
  }
}

function nearest(times, time) {
  let low = 0;
  let high = times.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle] <= time) low = middle;
    else high = middle;
  }
  return Math.abs((times[low] ?? 0) - time) <= Math.abs((times[high] ?? 0) - time) ? low : high;
}

/** A chart that is not over time: its curves are made anew by `make()`. */
export class PlainChart {
  /** @param curves label, and whether it is drawn as dots; @param make gives places and a list of values for each curve */
  constructor({ title, unit, across, curves, make, note }) {
    Object.assign(this, { make, curves, across });
    const many = curves.length > 1;
    this.note = h("p", { class: "note", hidden: !note }, note ?? "");
    this.plot = h("div", { class: "plot" });
    this.element = h("figure", { class: "chart" }, h("div", { class: "head" }, h("h3", {}, title), h("span", { class: "unit" }, unit),
      h("span", { class: "values" }, ...(many ? curves.map((curve, n) => h("span", {}, h("i", { "data-curve": n % 6 }), curve.label)) : []))), this.plot, this.note);
  }

  draw(width) {
    this.u?.destroy();
    const [horizontal, vertical] = axes(this.log);
    horizontal.label = this.across;
    horizontal.labelFont = "11px system-ui, sans-serif";
    horizontal.labelSize = 15;
    horizontal.size = 24;
    this.u = new uPlot({
      width,
      height: HEIGHT + 12,
      legend: { show: false },
      cursor: { show: false },
      scales: { x: { time: false }, y: this.scale ?? { range: roomy } },
      axes: [horizontal, vertical],
      series: [{}, ...this.curves.map((curve, n) => ({ stroke: curveColour(n), width: curve.dots ? 0 : 1.7, spanGaps: true,
        points: { show: Boolean(curve.dots), size: 5, fill: curveColour(n), width: 0 }, paths: curve.dots ? () => null : undefined }))],
    }, this.make(), this.plot);
  }

  now() {
    this.u?.setData(this.make());
  }
}

/** All charts of a page, drawn when they come into sight. */
export class Charts {
  constructor(place, clock) {
    this.place = place;
    this.clock = clock;
    this.list = [];
    this.inSight = new Set();
    this.watcher = new IntersectionObserver((entries) => entries.forEach(({ target, isIntersecting }) => {
      const chart = this.list.find((one) => one.element === target);
      if (!chart) return;
      if (isIntersecting) {
        this.inSight.add(chart);
        this.size(chart);
        chart.now();
      } else {
        this.inSight.delete(chart);
      }
    }), { rootMargin: "200px" });
    this.sizes = new ResizeObserver(() => this.list.forEach((chart) => chart.u && this.size(chart)));
    this.sizes.observe(place);
    clock.addEventListener("time", () => (this.isLate = true));
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.redraw());
  }

  addTime(panel, columns, place = this.place) {
    return this.add(new TimeChart(panel, columns, this.clock), place);
  }

  addPlain(options, place = this.place) {
    return this.add(new PlainChart(options), place);
  }

  add(chart, place) {
    this.list.push(chart);
    place.append(chart.element);
    this.watcher.observe(chart.element);
    return chart;
  }

  size(chart) {
    const width = Math.floor(chart.plot.clientWidth);
    if (width > 40 && chart.width !== width) {
      chart.width = width;
      chart.draw(width);
    }
  }

  /** On paper all charts are drawn, in two columns. */
  fitPaper() {
    for (const chart of this.list) {
      chart.width = PAPER_WIDTH;
      chart.draw(PAPER_WIDTH);
    }
  }

  fitScreen() {
    for (const chart of this.list) this.size(chart);
  }

  redraw() {
    for (const chart of this.list) if (chart.u) chart.draw(chart.width);
  }

  clear() {
    this.watcher.disconnect();
    for (const chart of this.list) {
      chart.u?.destroy();
      chart.element.remove();
    }
    this.list = [];
    this.inSight.clear();
  }

  tick() {
    if (!this.isLate) return;
    this.isLate = false;
    for (const chart of this.inSight) chart.now();
  }
}
