// SPDX-License-Identifier: GPL-3.0-or-later
import { categoryBytes, colourings, CATEGORIES, RAMP_NAMES, rampBytes, rgb, short, UNKNOWN } from "./colours.js";
import { button, h, schemeColour, tell } from "./dom.js";
import { saveFilm, savePicture } from "./save.js";
import { Stage } from "./stage.js";

const CHAIN_RADIUS = 0.85; // of the strongest force, in mean radii

/** What is seen of a run: its stage, the colours, the clip plane, walls, chains, the grain that was clicked. */
export class Player extends EventTarget {
  /** @param place the element to fill */
  constructor(place, clock) {
    super();
    this.clock = clock;
    this.place = place;
    this.options = { colour: "speed", ramp: "sand", walls: true, chains: false };
    this.picked = -1;
    this.canvas = h("canvas", { tabindex: "0", "aria-label": "The grains. Drag to turn, wheel or pinch to zoom, right button or two fingers to move, click a grain for its numbers." });
    this.legend = h("div", { class: "legend" });
    this.unknown = h("div", { class: "legend", hidden: true }, h("i", { style: `background:${UNKNOWN}` }), "not known yet");
    this.caption = h("div", { class: "time", "aria-live": "off" });
    this.card = h("aside", { class: "grain", hidden: true, "aria-label": "A grain" });
    this.frame = h("div", { class: "frame" }, this.canvas, h("div", { class: "corner" }, this.caption, this.legend, this.unknown), this.card);
    place.append(this.frame);
    this.stage = new Stage(this.canvas, () => this.dispatchEvent(new Event("view")));
    this.stage.controls.enableZoom = false; // the page scrolls over it until it is clicked
    this.canvas.addEventListener("focus", () => (this.stage.controls.enableZoom = true));
    this.canvas.addEventListener("blur", () => (this.stage.controls.enableZoom = false));
    this.followClicks();
    this.applyScheme();
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.applyScheme());
  }

  applyScheme() {
    const colours = Object.fromEntries(["stage", "back", "wall", "ink"].map((name) => [name, rgb(schemeColour(name)).map((c) => c / 255)]));
    this.stage.setScheme({ back: colours.stage, page: colours.back, face: colours.wall, edge: colours.ink });
    this.stage.spheres.material.uniforms.accent.value.fromArray(rgb(schemeColour("accent")).map((c) => c / 255));
  }

  /** Takes a recording. @param box [m] that is seen at first, where it is not that of the recording alone */
  async show(recording, box) {
    const first = !this.recording;
    this.recording = recording;
    await this.stage.show(recording, box);
    this.colourings = colourings(recording);
    this.pair = null;
    if (first) {
      this.stage.fit();
      this.stage.lookFrom(this.stage.home);
    }
    this.drawLegend();
    this.update();
  }

  get colouring() {
    return this.colourings.find((one) => one.key === this.options.colour) ?? this.colourings[0];
  }

  /** All frames are there now: what needs all of them is known. */
  complete() {
    this.colourings = colourings(this.recording);
    this.pair = null;
    this.drawLegend();
    this.update();
  }

  set(options) {
    Object.assign(this.options, options);
    this.pair = null;
    this.drawLegend();
    this.update();
    this.dispatchEvent(new Event("options"));
  }

  setClip(clip) {
    Object.assign(this.stage.clip, clip);
    this.stage.stir();
    this.dispatchEvent(new Event("options"));
  }

  /** Brings the stage to the clock's time. */
  update() {
    const { recording, stage, clock } = this;
    if (!recording?.length) return;
    const { k, f } = recording.at(clock.time);
    if (!recording.frame(k) || (k + 1 < recording.length && !recording.frame(k + 1))) return;
    if (this.pair !== k) {
      if (!stage.spheres.setPair(recording, k, this.colouring, stage.toStage)) return;
      this.pair = k;
      stage.spheres.mark(this.picked);
      this.drawPath();
    }
    this.unknown.hidden = !recording.isUnknown(this.colouring, f < 0.5 || k + 1 === recording.length ? k : k + 1);
    stage.spheres.mixing = f;
    stage.spheres.material.uniforms.shrink.value = this.options.chains ? 0.22 : 1;
    stage.spheres.material.uniforms.fade.value = this.options.chains ? 0.85 : 0;
    stage.walls.group.visible = this.options.walls;
    stage.walls.move(clock.time, k, f);
    this.drawChains(k, f);
    this.caption.textContent = `${clock.time.toFixed(decimals(clock))} s`;
    if (this.picked >= 0) this.tellGrain(k, f);
    stage.stir();
  }

  drawChains(k, f) {
    const { recording, stage } = this;
    const listed = this.options.chains ? recording.contactsAt(f < 0.5 ? k : k + 1) : null;
    const contacts = listed ? recording.contactFrames.get(listed.blob) : null;
    this.frame.toggleAttribute("data-no-chains", this.options.chains && !contacts);
    if (!contacts) return stage.chains.draw([]);
    const tubes = [];
    const most = this.strongForce;
    for (let n = 0; n < contacts.a.length; ++n) {
      const a = this.placeOfId(contacts.a[n], k, f);
      if (!a) continue;
      const b = contacts.b[n] < 0 ? a.map((one, axis) => one + contacts.arms[3 * n + axis]) : this.placeOfId(contacts.b[n], k, f);
      if (!b || recording.jumps(a, b)) continue;
      const share = Math.min(1, contacts.force[n] / most);
      tubes.push({ a: a.map(stage.toStage.point), b: b.map(stage.toStage.point), radius: CHAIN_RADIUS * stage.meanRadius * (0.12 + 0.88 * share ** 0.7), value: share });
    }
    stage.chains.draw(tubes);
  }

  placeOfId(id, k, f) {
    const slot = this.recording.slotOf(id);
    return slot < 0 ? null : this.recording.place(slot, k, f);
  }

  /** The way of the grain that was clicked, through all frames. */
  drawPath() {
    const { recording, stage, picked } = this;
    const tubes = [];
    for (let k = 0; picked >= 0 && k + 1 < recording.length; ++k) {
      const [a, b] = [recording.frame(k) && recording.placeIn(picked, k), recording.frame(k + 1) && recording.placeIn(picked, k + 1)];
      if (!a || !b || recording.jumps(a, b)) continue;
      tubes.push({ a: a.map(stage.toStage.point), b: b.map(stage.toStage.point), radius: 0.16 * stage.meanRadius, value: k / (recording.length - 1) });
    }
    stage.path.draw(tubes);
  }

  followClicks() {
    let down = null;
    this.canvas.addEventListener("pointerdown", (event) => (down = { x: event.clientX, y: event.clientY, at: event.timeStamp }));
    this.canvas.addEventListener("pointerup", (event) => {
      if (down && Math.hypot(event.clientX - down.x, event.clientY - down.y) < 5 && event.timeStamp - down.at < 600 && event.button === 0)
        this.choose(this.stage.pick(event.clientX, event.clientY));
      down = null;
    });
    this.canvas.addEventListener("dblclick", () => this.goHome());
  }

  goHome() {
    this.stage.lookFrom(this.stage.home);
    this.stage.stir();
  }

  choose(slot) {
    this.picked = slot === this.picked ? -1 : slot;
    this.stage.spheres.mark(this.picked);
    this.card.hidden = this.picked < 0;
    this.drawPath();
    this.update();
    this.stage.stir();
  }

  tellGrain(k, f) {
    const { recording, picked: slot } = this;
    const place = recording.place(slot, k, f);
    const nearest = f < 0.5 || k + 1 >= recording.length ? k : k + 1;
    const frame = recording.frame(nearest);
    const value = (key) => {
      const colouring = this.colourings.find((one) => one.key === key);
      const i = frame.local[slot];
      return colouring && i >= 0 ? recording.values(colouring, nearest)[i] : NaN;
    };
    const rows = [["Radius", `${short(1e3 * recording.radii[slot])} mm`]];
    if (recording.data.materials.length) rows.push(["Material", recording.data.materials[recording.materials[slot]] ?? "–"]);
    if (place) {
      rows.push(["Speed", `${short(value("speed"))} m/s`], ["Place", `${place.map((one) => short(one)).join(", ")} m`]);
      const contacts = value("coordination");
      if (contacts === contacts) rows.push(["Contacts", String(Math.floor(contacts))]);
    } else {
      rows.push(["Place", "not inside"]);
    }
    if (recording.firstSeen[slot] > recording.times[0]) rows.push(["Since", `${short(recording.firstSeen[slot])} s`]);
    this.card.replaceChildren(
      h("button", { type: "button", class: "close", "aria-label": "Close", onclick: () => this.choose(-1) }, "×"),
      h("b", {}, `Grain ${recording.ids[slot]}`),
      h("dl", {}, ...rows.flatMap(([name, text]) => [h("dt", {}, name), h("dd", {}, text)])),
      h("small", {}, "Speed is the mean between frames; the line is its way."),
    );
  }

  drawLegend() {
    const { colouring, options } = this;
    const bytes = colouring.categories ? categoryBytes(Math.max(1, colouring.categories.length))
      : rampBytes(options.ramp, colouring.bands ?? 0);
    this.stage.spheres.setRamp(bytes);
    const parts = [];
    if (options.chains && this.recording.data.contacts.length)
      parts.push(this.legendBar(rampBytes("sand")), this.legendEnds("0", "N, force", `≥ ${short(this.strongForce)}`));
    else if (colouring.categories)
      parts.push(h("ul", {}, ...colouring.categories.map((name, n) => h("li", {}, h("i", { style: `background:${CATEGORIES[n % CATEGORIES.length]}` }), name))));
    else if (!colouring.plain) {
      const [low, high] = colouring.range;
      parts.push(this.legendBar(bytes), this.legendEnds(short(low), colouring.unit, `${colouring.open ? "≥ " : ""}${short(high)}`));
    }
    this.legend.replaceChildren(...parts);
  }

  legendBar(bytes) {
    const bar = h("canvas", { width: 256, height: 1, "aria-hidden": "true" });
    bar.getContext("2d").putImageData(new ImageData(new Uint8ClampedArray(bytes), 256, 1), 0, 0);
    return bar;
  }

  legendEnds(...ends) {
    return h("div", { class: "ends" }, ...ends.map((one) => h("span", {}, one)));
  }

  /** The force of the last colour: five times the greatest mean [N]. */
  get strongForce() {
    return 5 * this.recording.data.contacts.reduce((top, one) => Math.max(top, one.mean), 0);
  }

  /** The choices of what is seen: the toolbar. */
  toolbar() {
    const choice = (label, values, current, onchange) => {
      const select = h("select", { "aria-label": label, title: label, onchange: () => onchange(select.value) }, ...values.map(([value, name]) => h("option", { value, selected: value === current }, name)));
      return select;
    };
    const colour = choice("Colour of the grains", this.colourings.map(({ key, name }) => [key, name]), this.options.colour, (value) => this.set({ colour: value }));
    const ramp = choice("Colours", RAMP_NAMES.map((name) => [name, name]), this.options.ramp, (value) => this.set({ ramp: value }));
    const toggle = (name, icon, label, key) => button(icon, label, () => this.set({ [name]: !this.options[name] }), { "aria-pressed": String(this.options[name]), "data-toggle": name, "aria-keyshortcuts": key });
    const walls = toggle("walls", "walls", "Walls (W)", "w");
    const chains = this.recording.data.contacts.length ? toggle("chains", "chains", "Force chains (F)", "f") : null;
    const clipAxis = choice("Cut away", [["off", "No cut"], ["x", "Cut x"], ["y", "Cut y"], ["z", "Cut z"]], this.stage.clip.axis, (value) => this.setClip({ axis: value }));
    const clipAt = h("input", { type: "range", min: "0", max: "1", step: "0.005", value: String(this.stage.clip.at), "aria-label": "Where it is cut", oninput: () => this.setClip({ at: Number(clipAt.value) }) });
    const flip = h("button", { type: "button", class: "small", title: "Show the other side", "aria-label": "Show the other side of the cut", onclick: () => this.setClip({ flip: !this.stage.clip.flip }) }, "⇄");
    const clip = h("span", { class: "clip" }, clipAxis, clipAt, flip);
    const bar = h("div", { class: "toolbar", role: "toolbar", "aria-label": "What is seen" }, h("label", { class: "field" }, h("span", {}, "Colour"), colour), ramp, clip, h("span", { class: "gap" }), walls, chains,
      button("home", "First view (R)", () => this.goHome()));
    const refresh = () => {
      colour.value = this.options.colour;
      ramp.value = this.options.ramp;
      clipAxis.value = this.stage.clip.axis;
      clipAt.value = String(this.stage.clip.at);
      clip.toggleAttribute("data-on", this.stage.clip.axis !== "off");
      ramp.hidden = Boolean(this.colouring.categories) || Boolean(this.colouring.plain);
      for (const one of [walls, chains]) one?.setAttribute("aria-pressed", String(this.options[one.dataset.toggle]));
    };
    this.addEventListener("options", refresh);
    refresh();
    return bar;
  }

  savePicture() {
    savePicture(this);
  }

  async saveFilm() {
    if (!window.MediaRecorder || !this.canvas.captureStream) return tell("This browser cannot record a film.");
    await saveFilm(this);
  }

  tick(now) {
    this.stage.tick(now, this.clock.playing);
  }
}

/** Places after the point that the time is shown with. */
export function decimals(clock) {
  return Math.max(0, Math.min(6, 3 - Math.floor(Math.log10(Math.max(1e-9, clock.to - clock.from)))));
}
