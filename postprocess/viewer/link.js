// SPDX-License-Identifier: GPL-3.0-or-later
// The address of the page keeps time, view and colours: #t=1.8&view=…

export class Link {
  constructor(clock, player) {
    Object.assign(this, { clock, player });
    this.touched = false;
    const changed = () => {
      if (!this.touched || clock.playing) return;
      clearTimeout(this.timer);
      this.timer = setTimeout(() => this.write(), 300);
    };
    for (const kind of ["pointerdown", "keydown", "wheel"]) addEventListener(kind, () => (this.touched = true), { capture: true, passive: true });
    clock.addEventListener("time", changed);
    clock.addEventListener("state", changed);
    player.addEventListener("view", changed);
    player.addEventListener("options", changed);
    addEventListener("hashchange", () => this.read());
  }

  get text() {
    const { clock, player } = this;
    const { clip } = player.stage;
    const parts = [`t=${Number(clock.time.toPrecision(6))}`];
    if (!player.stage.isHome) parts.push(`view=${player.stage.view.map((one) => Number(one.toPrecision(5))).join(",")}`);
    if (player.options.colour !== "speed") parts.push(`colour=${player.options.colour}`);
    if (player.options.ramp !== "sand") parts.push(`ramp=${player.options.ramp}`);
    if (clip.axis !== "off") parts.push(`clip=${clip.axis},${clip.at},${clip.flip ? 1 : 0}`);
    if (!player.options.walls) parts.push("walls=0");
    if (player.options.chains) parts.push("chains=1");
    return `#${parts.join("&")}`;
  }

  write() {
    history.replaceState(null, "", this.text);
  }

  /** Goes where the address says, as far as it makes sense. */
  read() {
    const words = new URLSearchParams(location.hash.slice(1));
    const { player, clock } = this;
    const numbers = (name) => (words.get(name) ?? "").split(",").map(Number);
    const options = {};
    if (player.colourings.some((one) => one.key === words.get("colour"))) options.colour = words.get("colour");
    if (["viridis", "cividis", "sand"].includes(words.get("ramp"))) options.ramp = words.get("ramp");
    if (words.has("walls")) options.walls = words.get("walls") !== "0";
    if (words.has("chains")) options.chains = words.get("chains") === "1";
    if (Object.keys(options).length) player.set(options);
    const [axis, at, flip] = (words.get("clip") ?? "").split(",");
    if (["x", "y", "z"].includes(axis) && Number(at) >= 0 && Number(at) <= 1) player.setClip({ axis, at: Number(at), flip: flip === "1" });
    const view = numbers("view");
    if (view.length === 6 && view.every(Number.isFinite) && view[2] > 0) player.stage.view = view;
    const [time] = numbers("t");
    if (words.has("t") && Number.isFinite(time)) clock.seek(time);
  }
}
