// SPDX-License-Identifier: GPL-3.0-or-later
import { h, schemeColour, tell } from "./dom.js";

function hand(blob, name) {
  const link = h("a", { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60000);
  tell(`Saved as ${name}`);
}

function nameFor(player, ending) {
  const base = player.recording.data.title.normalize("NFKD").replace(/[^A-Za-z0-9]+/g, "-").replace(/^-|-$/g, "").slice(0, 60).toLowerCase() || "run";
  return `${base}-${player.clock.time.toFixed(3)}s.${ending}`;
}

/** Draws the stage with title, time and colours onto a canvas of its own. */
export function pictureOf(player, ratio = 2) {
  const { stage, clock } = player;
  stage.draw(ratio, true, 0);
  const { width, height } = stage.canvas;
  const paper = h("canvas", { width, height });
  const pen = paper.getContext("2d");
  pen.drawImage(stage.canvas, 0, 0);
  const unit = (ratio * stage.height) / 100;
  const size = Math.max(13 * ratio, 2.6 * unit);
  pen.fillStyle = schemeColour("ink");
  pen.textBaseline = "top";
  pen.font = `600 ${size}px system-ui, sans-serif`;
  pen.fillText(`${player.recording.data.title}`, 2 * unit, 2 * unit, width - 4 * unit);
  pen.font = `${0.85 * size}px system-ui, sans-serif`;
  pen.fillText(`t = ${clock.time.toFixed(3)} s`, 2 * unit, 2 * unit + 1.4 * size);
  const bar = player.legend.querySelector("canvas");
  if (bar) {
    pen.drawImage(bar, 2 * unit, 2 * unit + 2.9 * size, 12 * size, 0.7 * size);
    pen.font = `${0.7 * size}px system-ui, sans-serif`;
    const ends = [...player.legend.querySelectorAll(".ends span")].map((one) => one.textContent);
    pen.fillText(`${player.options.chains ? "" : `${player.colouring.name.toLowerCase()}  `}${ends[0]} to ${ends[2]} ${ends[1]}`, 2 * unit, 2 * unit + 3.8 * size);
  }
  stage.isFine = false;
  stage.stir();
  return paper;
}

export function savePicture(player) {
  pictureOf(player).toBlob((blob) => hand(blob, nameFor(player, "png")), "image/png");
}

/** Plays the run once from its beginning, and records it. */
export async function saveFilm(player) {
  const { clock, stage } = player;
  const type = ["video/webm;codecs=vp9", "video/webm;codecs=vp8", "video/webm"].find((one) => MediaRecorder.isTypeSupported(one));
  if (!type) return tell("This browser cannot record a WebM film.");
  const ratio = stage.ratio;
  const recorder = new MediaRecorder(player.canvas.captureStream(30), { mimeType: type, videoBitsPerSecond: 8e6 });
  const parts = [];
  recorder.addEventListener("dataavailable", (event) => parts.push(event.data));
  const over = new Promise((done) => recorder.addEventListener("stop", done));
  clock.play(false);
  clock.seek(clock.from);
  stage.fixedRatio = Math.max(1, ratio); // a film keeps its size
  stage.draw(stage.fixedRatio, true, 0);
  recorder.start();
  tell("Recording the run from its beginning; press play to stop early");
  clock.play(true);
  await new Promise((done) => {
    const stopped = () => {
      if (clock.playing) return;
      clock.removeEventListener("state", stopped);
      done();
    };
    clock.addEventListener("state", stopped);
  });
  recorder.stop();
  await over;
  stage.fixedRatio = null;
  hand(new Blob(parts, { type: "video/webm" }), nameFor(player, "webm"));
}
