// SPDX-License-Identifier: GPL-3.0-or-later
import "./page.css";
import "uplot/dist/uPlot.min.css";
import { ChartsView } from "./charts_view.js";
import { CompareView } from "./compare_view.js";
import { follow } from "./live.js";
import { pictureOf } from "./save.js";
import { RunView } from "./run_view.js";
import { embeddedBlob } from "./unpack.js";

const data = JSON.parse(document.getElementById("data").textContent);
const { mode } = document.body.dataset;
const views = { compare: CompareView, charts: ChartsView };
const view = new (views[mode] ?? RunView)(data, embeddedBlob);
window.talus = view; // for a look from the browser's console, and for the tests

document.querySelectorAll("pre.copy").forEach((pre) => pre.addEventListener("click", () => getSelection().selectAllChildren(pre)));

// Paper shows the picture as it is now.
addEventListener("beforeprint", () => {
  view.charts.fitPaper();
  for (const player of [view.player, ...(view.players ?? [])].filter(Boolean)) {
    const still = player.place.querySelector("img.still") ?? player.frame.appendChild(Object.assign(new Image(), { className: "still" }));
    still.src = pictureOf(player).toDataURL("image/png");
  }
});
addEventListener("afterprint", () => view.charts.fitScreen());

view.start().then(() => mode === "watch" && follow(view));
