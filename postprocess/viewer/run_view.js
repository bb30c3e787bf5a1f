// SPDX-License-Identifier: GPL-3.0-or-later
import { Charts, decades } from "./charts.js";
import { Clock } from "./clock.js";
import { h } from "./dom.js";
import { Link } from "./link.js";
import { Player } from "./player.js";
import { Recording } from "./recording.js";
import { heapProfile, packingOverHeight, slopeProfile } from "./surfaces.js";
import { followKeys, transport } from "./transport.js";
import { floats } from "./unpack.js";

/** Columns of metrics.csv by name. */
export async function columnsOf(charts, blob) {
  if (!charts.rows) return {};
  const numbers = floats(await blob(charts.blob));
  return Object.fromEntries(charts.columns.map((name, n) => [name, numbers.subarray(n * charts.rows, (n + 1) * charts.rows)]));
}

/** The first and the last time of a run. */
export function span(data, columns) {
  const times = [...data.frames.times, ...(columns.time_s?.length ? [columns.time_s.at(-1)] : [])];
  return times.length ? [Math.min(...times), Math.max(...times)] : [0, 0];
}

/** Calls tick for every picture of the screen. */
export function everyPicture(tick) {
  let last = performance.now();
  const next = (now) => {
    tick(now, Math.max(0, (now - last) / 1000));
    last = now;
    requestAnimationFrame(next);
  };
  requestAnimationFrame(next);
}

/** The page of one run. */
export class RunView {
  constructor(data, blob) {
    this.data = data;
    this.blob = blob;
  }

  async start() {
    const { data, blob } = this;
    const columns = await columnsOf(data.charts, blob);
    const clock = (this.clock = new Clock(...span(data, columns)));
    const place = document.getElementById("stage");
    new ResizeObserver(([entry]) => document.documentElement.style.setProperty("--above", `${Math.ceil(entry.target.getBoundingClientRect().bottom + scrollY)}px`)).observe(document.querySelector("header"));
    this.chartPlace = document.getElementById("charts");
    this.charts = new Charts(this.chartPlace, clock);
    if (data.frames.times.length) await this.startPlayer(place);
    else place.append(h("p", { class: "empty" }, "The run has written no frames yet."));
    this.makeCharts(columns);
    everyPicture((now, seconds) => {
      clock.advance(seconds);
      this.player?.tick(now);
      this.charts.tick();
    });
    if (this.player) {
      await this.recording.loadAll(this.bestFrame, () => this.player.update());
      await this.recording.loadContacts();
      this.player.complete();
      this.makeSurfaceCharts();
    }
    document.documentElement.dataset.ready = "all";
  }

  get bestFrame() {
    return Math.min(this.data.frames.best, this.data.frames.times.length - 1);
  }

  async startPlayer(place) {
    const { clock } = this;
    try {
      this.player = new Player(place, clock);
    } catch (error) {
      place.append(h("p", { class: "empty" }, "This browser draws no WebGL, so the picture above stands still."));
      place.classList.add("no-webgl");
      return;
    }
    clock.time = this.data.status === "running" && document.body.dataset.mode === "watch" ? clock.to : this.data.frames.times[this.bestFrame];
    const wanted = Number(new URLSearchParams(location.hash.slice(1)).get("t") ?? NaN);
    this.recording = await Recording.open(this.data, this.blob);
    const { k } = this.recording.at(Number.isFinite(wanted) ? wanted : clock.time);
    await this.recording.load(k);
    await this.recording.load(Math.min(k + 1, this.recording.length - 1));
    clock.addEventListener("time", () => this.player.update());
    await this.player.show(this.recording);
    place.classList.add("plays");
    const link = (this.link = new Link(clock, this.player));
    const { bar, help } = transport(clock, this.player, link);
    this.toolbar = this.player.toolbar();
    place.prepend(this.toolbar);
    place.append(bar);
    followKeys(clock, [this.player], help);
    link.read();
    this.player.tick(performance.now());
    performance.mark("first picture");
    document.documentElement.dataset.ready = "first";
  }

  makeCharts(columns) {
    this.timeCharts = this.data.charts.panels.map((panel) => this.charts.addTime(panel, columns));
    this.chartPlace.hidden = !this.timeCharts.length && !this.data.heaps.length && !this.data.profiles.length;
  }

  /** Charts of what the grains of the frame shown are like. */
  makeSurfaceCharts() {
    const { clock, data } = this;
    // What is found in a frame is kept while it is shown; a run that goes on has a new recording now and then.
    const keep = (find) => {
      let known = null;
      return () => {
        const { recording } = this;
        const { k, f } = recording.at(clock.time);
        const nearest = f < 0.5 ? k : Math.min(k + 1, recording.length - 1);
        if (known?.k !== nearest || known.recording !== recording) known = { k: nearest, recording, found: find(nearest, recording) };
        return known.found;
      };
    };
    const first = this.chartPlace.firstChild;
    const front = h("div", { class: "front" });
    this.chartPlace.insertBefore(front, first);
    for (const sensor of data.heaps) {
      const isHeap = sensor.kind === "repose";
      this.charts.addPlain({
        title: `Profile of ${sensor.name}`, unit: "m", across: isHeap ? "distance from the axis [m]" : "along [m]",
        curves: [{ label: "surface", dots: true }, { label: "fit" }],
        note: isHeap ? "Where a grain that is let down meets the heap, means of rings; the line is the sensor's." : "Means of the highest grains in strips a diameter wide, with the line through them.",
        make: keep((k, recording) => {
          const { places, heights, line } = (isHeap ? heapProfile : slopeProfile)(recording, k, sensor);
          return [places, heights, line];
        }),
      }, front);
    }
    const packing = document.getElementById("part-packing");
    const charts = h("div", { class: "pair" });
    packing.append(charts);
    packing.hidden = false;
    this.charts.addPlain({
      title: "Packing over height", unit: "share of space", across: "height [m]", curves: [{ label: "packing" }],
      note: "Of the convex outline of the grains at that height, so it is low where a container is not convex.",
      make: keep((k, recording) => {
        const { heights, shares } = packingOverHeight(recording, k);
        return [heights, shares];
      }),
    }, charts);
    if (data.contacts.length) {
      const nearest = (k) => this.data.contacts.reduce((best, one) => (Math.abs(one.frame - k) < Math.abs(best.frame - k) ? one : best));
      const force = this.charts.addPlain({
        title: "Distribution of forces", unit: "P(f / ⟨f⟩)", across: "f / ⟨f⟩", curves: [{ label: "P", dots: true }],
        note: "Of the normal forces in the frame of contacts nearest to the time shown.",
        make: keep((k) => {
          const one = nearest(k);
          return [one.density.map((_, n) => (n + 0.5) * one.bin), one.density.map((share) => (share > 0 ? share : null))];
        }),
      }, charts);
      force.scale = { distr: 3, range: decades };
      force.log = true;
      if (data.contacts.some((one) => one.touching))
        this.charts.addPlain({
          title: "Contacts of a grain", unit: "share of the grains", across: "contacts that carry force", curves: [{ label: "share" }],
          note: "In the same frame of contacts, walls included; grains that touch nothing are left out.",
          make: keep((k, recording) => {
            const { touching } = recording.contactFrames.get(nearest(k).blob);
            const counts = new Array(13).fill(0);
            for (const one of touching) if (one > 0) ++counts[Math.min(12, one)];
            const all = counts.reduce((sum, one) => sum + one, 0) || 1;
            return [counts.map((_, n) => n).slice(1), counts.slice(1).map((one) => one / all)];
          }),
        }, charts);
    }
    for (const profile of data.profiles)
      for (const curve of profile.curves)
        this.charts.addPlain({
          title: `${profile.sensor}: ${curve.title}`, unit: curve.unit, across: "position [m]",
          curves: curve.errors ? [{ label: "mean" }, { label: "± standard error" }, { label: "" }] : [{ label: "mean" }],
          make: () => [profile.place, curve.values, ...(curve.errors ? [1, -1].map((sign) => curve.values.map((one, n) => (one === null || curve.errors[n] === null ? null : one + sign * curve.errors[n]))) : [])],
        });
  }
}
