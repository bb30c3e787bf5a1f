// SPDX-License-Identifier: GPL-3.0-or-later
import uPlot from "uplot";
import { axes, roomy } from "./charts.js";
import { short } from "./colours.js";
import { h, schemeColour } from "./dom.js";

const HEIGHT = 190;
const REACH = 14; // px, within which a point is meant

/** The whole powers of ten round two numbers. */
function decades([low, high]) {
  const from = Math.floor(Math.log10(low) - 0.05);
  return [10 ** from, 10 ** Math.max(from + 1, Math.ceil(Math.log10(high) + 0.05))];
}

/**
 * A chart of points with their errors, and of lines. What it shows:
 *
 *     title, unit, across     words; `across` is what goes to the right
 *     points                  { x, y, error, id }: numbers, a list each; id says which case a point is of
 *     lines                   [{ x, y, kind }]: kind is mean, guide or density
 *     shade                   [from, to] along x
 *     reach                   { x, y }: numbers that must be on the axes
 *     labels                  words in place of the numbers 0, 1, … along x
 *     log, logUp              whether x, or y, is logarithmic; what is not above 0 lies at the foot
 *     ring                    id of a point with a ring round it
 *     note                    a sentence below
 */
export class PointChart {
  /** @param cases what is known of the points: colour(id), tell(id, chart, k), which is pointed at, and open(id) */
  constructor(options, cases) {
    Object.assign(this, options, { cases });
    this.plot = h("div", { class: "plot" });
    this.element = h("figure", { class: "chart points" },
      h("div", { class: "head" }, h("h3", {}, this.title), h("span", { class: "unit" }, this.unit ?? "")), this.plot, h("p", { class: "note", hidden: !this.note }, this.note ?? ""));
  }

  draw(width) {
    this.u?.destroy();
    const [horizontal, vertical] = axes(this.logUp);
    const { labels } = this;
    Object.assign(horizontal, { label: this.across, labelFont: "11px system-ui, sans-serif", labelSize: 15, size: 24, space: 44 });
    if (labels) Object.assign(horizontal, { splits: () => labels.map((_, n) => n), values: () => labels });
    else if (this.log) horizontal.values = (u, values) => values.map((one) => (one === null ? "" : short(one)));
    const [x, y] = [this.span("x"), this.span("y")];
    this.u = new uPlot({
      width,
      height: HEIGHT,
      legend: { show: false },
      cursor: { drag: { setScale: false, x: false, y: false }, points: { show: false }, x: false, y: false },
      scales: { x: { time: false, distr: this.log ? 3 : 1, range: () => (this.logUp ? decades(x) : this.padded(x)) }, y: this.logUp ? { distr: 3, range: () => decades(y) } : { range: (u) => roomy(u, ...y) } },
      axes: [horizontal, vertical],
      series: [{}, { paths: () => null, points: { show: false } }],
      hooks: { draw: [(u) => this.paint(u)] },
    }, [x, y], this.plot);
    const { over } = this.u;
    over.addEventListener("pointermove", (event) => this.pointAt(event));
    over.addEventListener("pointerleave", () => this.cases.point(null));
    over.addEventListener("click", () => this.cases.open());
  }

  now() {}

  repaint() {
    this.u?.redraw(false);
  }

  /** From the smallest to the largest number of one axis. */
  span(axis) {
    const { points = {}, lines = [], labels } = this;
    if (axis === "x" && labels) return [0, labels.length - 1];
    const ends = [...(points[axis] ?? []), ...lines.flatMap((line) => line[axis]), ...(this.reach?.[axis] ?? []), ...(axis === "x" ? (this.shade ?? []) : [])];
    if (axis === "y" && !this.logUp) points.error?.forEach((one, k) => Number.isFinite(one) && Number.isFinite(points.y[k]) && ends.push(points.y[k] - one, points.y[k] + one));
    const known = ends.filter((one) => Number.isFinite(one) && (one > 0 || axis === "x" || !this.logUp));
    return known.length ? [known.reduce((a, b) => Math.min(a, b)), known.reduce((a, b) => Math.max(a, b))] : [0, 1];
  }

  padded([low, high]) {
    if (this.log) {
      const room = high > low ? (high / low) ** 0.05 : 2;
      return [low / room, high * room];
    }
    if (this.labels) return [low - 0.5, high + 0.5];
    const room = 0.05 * (high - low) || 0.1 * Math.abs(high) || 1;
    return [low - room, high + room];
  }

  /** Which point is under the pointer, if any. */
  pointAt(event) {
    const { points, u } = this;
    if (!points?.id) return;
    const frame = u.over.getBoundingClientRect();
    const [left, top] = [event.clientX - frame.left, event.clientY - frame.top];
    let best = null;
    let nearest = REACH ** 2;
    points.x.forEach((x, k) => {
      if (points.y[k] === null) return;
      const away = (u.valToPos(x, "x") - left) ** 2 + (u.valToPos(points.y[k], "y") - top) ** 2;
      if (away < nearest) [best, nearest] = [k, away];
    });
    u.over.style.cursor = best !== null && this.cases.hasPage(points.id[best]) ? "pointer" : "default";
    this.cases.point(best === null ? null : points.id[best], event, best === null ? "" : this.words(best));
  }

  /** The number of a point with its error. */
  words(k) {
    const error = this.points.error?.[k];
    return `${this.title} ${short(this.points.y[k])}${error ? ` ± ${Number(error.toPrecision(2))}` : ""} ${this.unit ?? ""}`.trim();
  }

  paint(u) {
    const pen = u.ctx;
    pen.save();
    pen.beginPath();
    pen.rect(u.bbox.left, u.bbox.top, u.bbox.width, u.bbox.height);
    pen.clip();
    const at = (x, y) => [u.valToPos(x, "x", true), u.valToPos(this.logUp ? Math.max(y, u.scales.y.min) : y, "y", true)];
    if (this.shade) {
      const [from, to] = this.shade.map((x) => u.valToPos(x, "x", true));
      pen.fillStyle = schemeColour("band");
      pen.fillRect(from, u.bbox.top, to - from, u.bbox.height);
    }
    for (const line of this.lines ?? []) this.paintLine(pen, line, at);
    if (this.points) this.paintPoints(pen, at);
    pen.restore();
  }

  paintLine(pen, { x, y, kind }, at) {
    pen.beginPath();
    x.forEach((_, k) => y[k] !== null && pen.lineTo(...at(x[k], y[k])));
    pen.strokeStyle = schemeColour(kind === "density" ? "curve0" : "soft");
    pen.lineWidth = (kind === "density" ? 1.8 : 1.2) * devicePixelRatio;
    pen.setLineDash(kind === "guide" ? [4 * devicePixelRatio, 4 * devicePixelRatio] : []);
    pen.globalAlpha = kind === "mean" ? 0.6 : 1;
    pen.stroke();
    pen.setLineDash([]);
    pen.globalAlpha = 1;
  }

  paintPoints(pen, at) {
    const { x, y, error, id, cloud } = this.points;
    const { pointed } = this.cases;
    const size = (cloud ? 1.6 : 3.6) * devicePixelRatio;
    const one = (k, marked) => {
      if (y[k] === null) return;
      const [left, top] = at(x[k], y[k]);
      const colour = id && !cloud ? this.cases.colour(id[k]) : schemeColour("curve0");
      pen.globalAlpha = marked ? 1 : cloud ? 0.35 : pointed === null || !id ? 0.9 : 0.3;
      if (error?.[k]) {
        pen.strokeStyle = colour;
        pen.lineWidth = 1.2 * devicePixelRatio;
        pen.beginPath();
        pen.moveTo(left, at(x[k], y[k] - error[k])[1]);
        pen.lineTo(left, at(x[k], y[k] + error[k])[1]);
        pen.stroke();
      }
      pen.fillStyle = colour;
      pen.beginPath();
      pen.arc(left, top, marked ? 1.5 * size : size, 0, 2 * Math.PI);
      pen.fill();
      pen.strokeStyle = schemeColour("ink");
      pen.lineWidth = 1.5 * devicePixelRatio;
      if (marked) pen.stroke();
      if (!id || id[k] !== this.ring) return;
      pen.beginPath();
      pen.arc(left, top, 2.1 * size, 0, 2 * Math.PI);
      pen.stroke();
    };
    x.forEach((_, k) => one(k, false));
    if (id && pointed !== null) x.forEach((_, k) => id[k] === pointed && one(k, true));
    pen.globalAlpha = 1;
  }
}
