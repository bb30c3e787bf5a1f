// SPDX-License-Identifier: GPL-3.0-or-later
import { short } from "./colours.js";
import { button, h, icon, tell } from "./dom.js";
import { RATES } from "./clock.js";
import { decimals } from "./player.js";

const KEYS = [["Space", "play or stop"], ["← →", "a frame back or on"], ["Home End", "first and last frame"], ["⇧ + arrows", "turn"], ["+ −", "zoom"],
  ["R", "first view"], ["1 2 3", "from the front, the side, above"], ["C", "next colour"], ["X", "cut"], ["W", "walls"], ["F", "force chains"], ["P", "save a picture"], ["Esc", "let go of the grain"]];

/** The bar under the stage: play, scrub, speed, and what can be saved. */
export function transport(clock, player, link) {
  const play = button("play", "Play (space)", () => clock.play(), { class: "icon play" });
  const scrub = h("input", { type: "range", class: "scrub", "aria-label": "Time", oninput: () => {
    clock.play(false);
    clock.seek(Number(scrub.value));
  } });
  const speed = h("select", { "aria-label": "Speed", title: "Speed", onchange: () => (clock.rate = Number(speed.value)) }, ...RATES.map((rate) => h("option", { value: String(rate), selected: rate === clock.rate }, `${short(rate)} ×`)));
  const now = h("output", { class: "clock" });
  const help = h("dialog", { class: "help", "aria-label": "Keys" }, h("h2", {}, "Keys"), h("dl", {}, ...KEYS.flatMap(([key, what]) => [h("dt", {}, key), h("dd", {}, what)])),
    h("p", {}, "Drag turns, wheel or pinch zooms, right button or two fingers move. A click on a grain tells its numbers. Dragging in a chart moves the time."), h("form", { method: "dialog" }, h("button", { class: "small" }, "Close")));
  const tools = [
    button("picture", "Save a picture (P)", () => player.savePicture(), { "data-tool": "picture" }),
    button("film", "Record a film (WebM)", () => player.saveFilm(), { "data-tool": "film" }),
    link ? button("link", "Copy a link to this moment and view", async () => {
      link.write();
      try {
        await navigator.clipboard.writeText(location.href);
        tell("The link is in the clipboard");
      } catch {
        tell("The address of the page is the link");
      }
    }) : null,
    document.fullscreenEnabled ? button("full", "Full screen", () => (document.fullscreenElement ? document.exitFullscreen() : player.place.requestFullscreen())) : null,
    button("help", "Keys (?)", () => help.showModal(), { "data-tool": "help" }),
  ];
  const bar = h("div", { class: "transport" }, play, scrub, now, speed, h("span", { class: "tools" }, ...tools), help);
  const refresh = () => {
    Object.assign(scrub, { min: String(clock.from), max: String(clock.to), step: String((clock.to - clock.from) / 2000 || 1) });
    scrub.value = String(clock.time);
    scrub.setAttribute("aria-valuetext", `${clock.time.toFixed(decimals(clock))} seconds`);
    scrub.style.setProperty("--done", `${(100 * (clock.time - clock.from)) / (clock.to - clock.from || 1)}%`);
    now.textContent = `${clock.time.toFixed(decimals(clock))} s`;
  };
  clock.addEventListener("time", refresh);
  clock.addEventListener("state", () => {
    play.replaceChildren(icon(clock.playing ? "pause" : "play"));
    play.setAttribute("aria-label", clock.playing ? "Stop (space)" : "Play (space)");
    refresh();
  });
  refresh();
  return { bar, help };
}

/** Keys of the whole page. */
export function followKeys(clock, players, help) {
  const step = (frames) => {
    const { times } = players[0].recording;
    clock.play(false);
    const { k, f } = players[0].recording.at(clock.time);
    const next = frames > 0 ? k + (f > 0.999 ? 2 : 1) : f > 0.001 ? k : k - 1;
    clock.seek(times[Math.min(times.length - 1, Math.max(0, next))]);
  };
  const each = (act) => () => players.forEach(act);
  const toggle = (name) => each((player) => player.set({ [name]: !player.options[name] }));
  const look = (azimuth, elevation) => each((player) => {
    player.stage.lookFrom({ azimuth, elevation });
    player.stage.stir();
  });
  const turn = (right, up) => () => players[0].stage.turn(right, up);
  const actions = {
    " ": () => clock.play(), k: () => clock.play(), ArrowLeft: () => step(-1), ArrowRight: () => step(1), Home: () => clock.seek(clock.from), End: () => clock.seek(clock.to),
    "⇧ArrowLeft": turn(-0.15, 0), "⇧ArrowRight": turn(0.15, 0), "⇧ArrowUp": turn(0, 0.1), "⇧ArrowDown": turn(0, -0.1),
    "+": () => players[0].stage.zoom(0.85), "=": () => players[0].stage.zoom(0.85), "-": () => players[0].stage.zoom(1.18), r: each((player) => player.goHome()),
    1: look(-90, 0), 2: look(0, 0), 3: look(-90, 90), w: toggle("walls"), f: toggle("chains"), p: () => players[0].savePicture(),
    c: each((player) => {
      const { colourings } = player;
      player.set({ colour: colourings[(colourings.indexOf(player.colouring) + 1) % colourings.length].key });
    }),
    x: each((player) => player.setClip({ axis: player.stage.clip.axis === "off" ? "y" : "off" })),
    Escape: each((player) => player.picked >= 0 && player.choose(-1)), "?": () => help.showModal(),
  };
  addEventListener("keydown", (event) => {
    const { target } = event;
    if (event.ctrlKey || event.metaKey || event.altKey || target.closest?.("select, textarea, dialog[open]")) return;
    if (target.closest?.("input") && ["ArrowLeft", "ArrowRight", "Home", "End"].includes(event.key)) return;
    if (event.key === " " && target.closest?.("button, summary, a")) return;
    const action = actions[event.shiftKey && event.key.startsWith("Arrow") ? `⇧${event.key}` : event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!action) return;
    event.preventDefault();
    action();
  });
}
