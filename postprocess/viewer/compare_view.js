// SPDX-License-Identifier: GPL-3.0-or-later
import { Charts } from "./charts.js";
import { Clock } from "./clock.js";
import { h } from "./dom.js";
import { Player } from "./player.js";
import { Recording } from "./recording.js";
import { boxOf } from "./stage.js";
import { columnsOf, everyPicture, span } from "./run_view.js";
import { followKeys, transport } from "./transport.js";

/** Several runs: two of them beside each other, with one camera and one clock, and the charts of all. */
export class CompareView {
  constructor(data, blob) {
    this.data = data;
    this.blob = blob;
    this.recordings = new Map();
  }

  async start() {
    const { runs } = this.data;
    const columns = await Promise.all(runs.map((run) => columnsOf(run.charts, this.blob)));
    const spans = runs.map((run, n) => span(run, columns[n]));
    const clock = (this.clock = new Clock(Math.min(...spans.map(([from]) => from)), Math.max(...spans.map(([, to]) => to))));
    this.charts = new Charts(document.getElementById("charts"), clock);
    const place = document.getElementById("stage");
    const pair = h("div", { class: "beside" });
    place.append(pair);
    this.box = runs.map(boxOf).reduce((all, one) => all.union(one)); // the same for all
    const able = runs.map((run, n) => n).filter((n) => runs[n].frames.times.length);
    this.players = [];
    try {
      for (const n of able.slice(0, 2)) this.players.push(await this.makePlayer(pair, n));
    } catch (error) {
      place.append(h("p", { class: "empty" }, "This browser draws no WebGL, so the runs are not shown."));
    }
    if (this.players.length) this.join(place);
    this.makeCharts(columns);
    everyPicture((now, seconds) => {
      clock.advance(seconds);
      for (const player of this.players) player.tick(now);
      this.charts.tick();
    });
    for (const player of this.players) await this.loadAll(player);
    document.documentElement.dataset.ready = "all";
  }

  async makePlayer(pair, n) {
    const { runs } = this.data;
    const side = h("div", { class: "side" });
    const which = h("select", { "aria-label": "Which run", onchange: () => this.change(player, Number(which.value)) },
      ...runs.map((run, m) => h("option", { value: String(m), selected: m === n, disabled: !run.frames.times.length }, run.label)));
    side.append(h("div", { class: "which" }, which));
    pair.append(side);
    const player = new Player(side, this.clock);
    this.clock.addEventListener("time", () => player.update());
    this.clock.time = runs[n].frames.times[Math.min(runs[n].frames.best, runs[n].frames.times.length - 1)];
    await this.change(player, n, false);
    return player;
  }

  async change(player, n, all = true) {
    if (!this.recordings.has(n)) this.recordings.set(n, await Recording.open(this.data.runs[n], this.blob));
    const recording = this.recordings.get(n);
    const { k } = recording.at(this.clock.time);
    await recording.load(k);
    await recording.load(Math.min(k + 1, recording.length - 1));
    const view = player.recording ? player.stage.view : null;
    await player.show(recording, this.box.clone());
    if (view) player.stage.view = view;
    this.sameColours();
    if (all) await this.loadAll(player);
  }

  async loadAll(player) {
    const { recording } = player;
    await recording.loadAll(recording.at(this.clock.time).k, () => player.update());
    await recording.loadContacts();
    player.complete();
    this.sameColours();
  }

  /** The same colour is the same speed, or height, in both. */
  sameColours() {
    const shown = (this.players ?? []).filter((player) => player.recording);
    if (shown.length < 2) return;
    for (const colouring of shown[0].colourings) {
      const both = shown.map((player) => player.colourings.find((one) => one.key === colouring.key)).filter(Boolean);
      const range = [Math.min(...both.map((one) => one.range[0])), Math.max(...both.map((one) => one.range[1]))];
      for (const one of both) one.range = range;
    }
    for (const player of shown) {
      player.pair = null;
      player.drawLegend();
      player.update();
    }
  }

  /** One camera, one set of choices, one bar. */
  join(place) {
    const [first, ...others] = this.players;
    let busy = false;
    const copy = (from) => () => {
      if (busy) return;
      busy = true;
      for (const player of this.players) if (player !== from) player.stage.view = from.stage.view;
      busy = false;
    };
    for (const player of this.players) player.addEventListener("view", copy(player));
    first.addEventListener("options", () => {
      for (const player of others) {
        player.setClip({ ...first.stage.clip });
        player.set({ ...first.options });
      }
    });
    place.prepend(first.toolbar());
    const { bar, help } = transport(this.clock, first, null);
    place.append(bar);
    followKeys(this.clock, [first], help);
    first.goHome();
  }

  makeCharts(columns) {
    const { runs } = this.data;
    for (const panel of this.data.panels) {
      const curves = [];
      const all = {};
      const time = merged(columns.map((one) => one.time_s ?? []));
      all.time_s = time;
      runs.forEach((run, n) => {
        const values = columns[n][panel.column];
        if (!values) return;
        all[`${n}`] = resampled(time, columns[n].time_s, values);
        curves.push({ column: `${n}`, label: run.label, colour: n }); // each run has one colour on the whole page
      });
      if (curves.length) this.charts.addTime({ title: panel.title, unit: panel.unit, log: panel.log, curves, result: null }, all);
    }
  }
}

/** All times of several runs, each once, in order. */
function merged(lists) {
  return Float32Array.from([...new Set(lists.flatMap((list) => [...list]))].sort((a, b) => a - b));
}

/** The values of a curve at other times, on straight lines; not a number outside. */
function resampled(times, own, values) {
  let k = 0;
  return Float32Array.from(times, (time) => {
    if (!own.length || time < own[0] || time > own.at(-1)) return NaN;
    while (k + 1 < own.length && own[k + 1] < time) ++k;
    const next = Math.min(k + 1, own.length - 1);
    const share = own[next] > own[k] ? (time - own[k]) / (own[next] - own[k]) : 0;
    return values[k] + share * (values[next] - values[k]);
  });
}
