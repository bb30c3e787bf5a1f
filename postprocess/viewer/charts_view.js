// SPDX-License-Identifier: GPL-3.0-or-later
import { Charts } from "./charts.js";
import { rampBytes, short } from "./colours.js";
import { h, schemeColour } from "./dom.js";
import { PointChart } from "./point_chart.js";

const BRIGHTEST = 210; // of 255 colours: what comes after is hard to see on paper

/**
 * A page of charts of points, as of many runs. A case that is pointed at is marked in all charts, and a click opens its
 * page.
 */
export class ChartsView {
  /** @param data groups: id of an element, and its charts; cases: what the points are of, by their numbers, and their pages, if they have any */
  constructor(data) {
    this.data = data;
    this.pointed = null;
    this.ramp = rampBytes("viridis");
    this.colouring = data.cases?.colourings[data.cases.coloured] ?? null;
  }

  async start() {
    this.charts = new Charts(document.body, new EventTarget());
    this.tip = h("div", { class: "tip", hidden: true });
    document.body.append(this.tip);
    if (this.data.cases?.colourings.length) document.getElementById("colours").append(this.chooser());
    for (const { id, charts } of this.data.groups) {
      const place = document.getElementById(id);
      for (const options of charts) this.charts.add(new PointChart(options, this), place);
    }
    document.querySelectorAll("tr[data-case]").forEach((row) => {
      row.addEventListener("pointerenter", () => this.point(Number(row.dataset.case)));
      row.addEventListener("pointerleave", () => this.point(null));
    });
    document.documentElement.dataset.ready = "all";
  }

  chooser() {
    const { colourings, coloured } = this.data.cases;
    const select = h("select", { onchange: () => {
      this.colouring = colourings[Number(select.value)] ?? null;
      this.drawLegend();
      this.repaint();
    } }, h("option", { value: "-1" }, "nothing"), ...colourings.map((one, n) => h("option", { value: String(n), selected: n === coloured }, one.title)));
    this.legend = h("small", { class: "scale" });
    this.drawLegend();
    return h("label", { class: "field" }, h("span", {}, "Colour by"), select, this.legend);
  }

  drawLegend() {
    this.legend.replaceChildren();
    if (!this.colouring) return;
    const stops = Array.from({ length: 8 }, (_, n) => this.rampColour(n / 7)).join(", ");
    const { range, words } = this.colouring;
    this.legend.append(words ? words[0] : short(range[0]), h("i", { style: `background: linear-gradient(to right, ${stops})` }), words ? words.at(-1) : short(range[1]));
  }

  rampColour(share) {
    const at = 4 * Math.round(BRIGHTEST * share);
    return `rgb(${this.ramp[at]} ${this.ramp[at + 1]} ${this.ramp[at + 2]})`;
  }

  colour(id) {
    const value = this.colouring?.values[id];
    if (value === undefined) return schemeColour("curve0");
    if (value === null) return schemeColour("soft");
    const [low, high] = this.colouring.range;
    return this.rampColour(high > low ? (value - low) / (high - low) : 0.5);
  }

  hasPage(id) {
    return Boolean(this.data.cases?.pages?.[id]);
  }

  /** Marks a case, or none, and tells of it beside the pointer. */
  point(id, event = null, words = "") {
    if (id !== this.pointed) {
      this.pointed = id;
      document.querySelectorAll("tr[data-case]").forEach((row) => row.classList.toggle("pointed", Number(row.dataset.case) === id));
      this.repaint();
    }
    this.tip.hidden = id === null || !event;
    if (this.tip.hidden) return;
    const { pages } = this.data.cases;
    this.tip.replaceChildren(h("b", {}, this.data.cases.names[id]), h("div", {}, words), ...(pages ? [h("small", {}, this.hasPage(id) ? "a click opens its page" : "it has no page")] : []));
    this.tip.style.left = `${Math.max(8, Math.min(event.clientX + 14, innerWidth - this.tip.offsetWidth - 8))}px`;
    this.tip.style.top = `${event.clientY + 14 + this.tip.offsetHeight > innerHeight ? event.clientY - 14 - this.tip.offsetHeight : event.clientY + 14}px`;
  }

  open() {
    if (this.pointed !== null && this.hasPage(this.pointed)) location.href = this.data.cases.pages[this.pointed];
  }

  repaint() {
    for (const chart of this.charts.list) chart.repaint();
  }
}
