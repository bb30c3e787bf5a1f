// SPDX-License-Identifier: GPL-3.0-or-later
// The page of a run that goes on: asks the server that it came from what is new.
import { Recording } from "./recording.js";
import { columnsOf, span } from "./run_view.js";
import { inflate } from "./unpack.js";

const INTERVAL = 2000; // ms

export async function follow(view) {
  const here = location.pathname.replace(/[^/]*$/, "");
  const status = document.querySelector(".status");
  const blobs = new Map();
  const blob = (key) => {
    if (document.getElementById(`blob-${key}`)) return view.blob(key);
    if (!blobs.has(key)) blobs.set(key, fetch(`${here}blob/${key}`).then(async (answer) => inflate(await answer.arrayBuffer())));
    return blobs.get(key);
  };
  let version = view.data.version;
  for (;;) {
    await new Promise((next) => setTimeout(next, INTERVAL));
    let answer;
    try {
      answer = await fetch(`${here}run.json?after=${version}`);
    } catch {
      status.textContent = "no longer watched";
      status.dataset.status = "ended";
      return;
    }
    if (answer.status !== 200) continue;
    const data = await answer.json();
    version = data.version;
    if (!view.player && data.frames.times.length) return location.reload(); // its first frame
    await take(view, data, blob);
    if (data.status !== "running") return;
  }
}

/** Puts what is new into the page; who looked at the newest frame goes on doing so. */
async function take(view, data, blob) {
  const { clock } = view;
  const atEnd = clock.time >= clock.to - 1e-9;
  const samePanels = JSON.stringify(data.charts.panels.map((one) => one.curves)) === JSON.stringify(view.data.charts.panels.map((one) => one.curves));
  view.data = data;
  const columns = await columnsOf(data.charts, blob);
  if (view.player) {
    const recording = await Recording.open(data, blob, view.recording);
    await recording.loadAll(recording.at(clock.time).k);
    await recording.loadContacts();
    view.recording = recording;
    await view.player.show(recording);
  }
  [clock.from, clock.to] = span(data, columns);
  if (samePanels) view.timeCharts.forEach((chart, n) => chart.take(data.charts.panels[n], columns));
  for (const [name, html] of Object.entries(data.sections)) {
    const place = document.querySelector(`[data-section="${name}"]`);
    if (place && place.innerHTML !== html) place.innerHTML = html; // made and escaped by run_page/sections.py
    const part = place?.closest(".part");
    if (part) part.hidden = !html;
  }
  const status = document.querySelector(".status");
  status.textContent = data.status_word;
  status.dataset.status = data.status;
  if (atEnd && !clock.playing) clock.seek(clock.to);
  else clock.seek(clock.time);
}
