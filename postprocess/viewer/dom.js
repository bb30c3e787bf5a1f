// SPDX-License-Identifier: GPL-3.0-or-later

/** An element with attributes and children; text of a run goes in as text, never as HTML. */
export function h(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else if (typeof value === "boolean") element.toggleAttribute(name, value);
    else if (value !== undefined && value !== null) element.setAttribute(name, value);
  }
  element.append(...children.filter((child) => child !== null && child !== undefined));
  return element;
}

const ICONS = {
  play: "M7 4.5v15l12-7.5z",
  pause: "M6 5h4v14H6zM14 5h4v14h-4z",
  grains: "M8 4a4 4 0 1 0 .01 0zM17 8a3 3 0 1 0 .01 0zM13 14a3.5 3.5 0 1 0 .01 0zM6 14a2.5 2.5 0 1 0 .01 0z",
  walls: "M4 5h16v2H4zM4 17h16v2H4zM4 7h2v10H4zM18 7h2v10h-2z",
  chains: "M4 18l6-7 4 3 6-9M4 18m-2 0a2 2 0 1 0 4 0 2 2 0 1 0-4 0M10 11m-2 0a2 2 0 1 0 4 0 2 2 0 1 0-4 0M14 14m-2 0a2 2 0 1 0 4 0 2 2 0 1 0-4 0M20 5m-2 0a2 2 0 1 0 4 0 2 2 0 1 0-4 0",
  clip: "M12 3v18M4 7h5v10H4M15 7h5M15 12h5M15 17h5",
  home: "M4 11l8-7 8 7M6 10v9h12v-9",
  picture: "M4 6h4l2-2h4l2 2h4v13H4zM12 9a3.5 3.5 0 1 0 .01 0z",
  film: "M4 5h16v14H4zM8 5v14M16 5v14M4 9.5h4M4 14.5h4M16 9.5h4M16 14.5h4",
  link: "M10 14a4 4 0 0 0 6 0l3-3a4 4 0 0 0-6-6l-1 1M14 10a4 4 0 0 0-6 0l-3 3a4 4 0 0 0 6 6l1-1",
  full: "M4 9V4h5M15 4h5v5M20 15v5h-5M9 20H4v-5",
  help: "M9 9a3 3 0 1 1 4 2.8c-.7.3-1 .8-1 1.7v.5M12 17.5v.5",
};

/** An icon, drawn in the colour of the text around it. */
export function icon(name, filled = name === "play" || name === "pause") {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  svg.setAttribute("viewBox", "0 0 24 24");
  svg.setAttribute("aria-hidden", "true");
  const path = document.createElementNS("http://www.w3.org/2000/svg", "path");
  path.setAttribute("d", ICONS[name]);
  path.setAttribute("class", filled ? "filled" : "line");
  svg.append(path);
  return svg;
}

export function button(name, label, onclick, attributes = {}) {
  return h("button", { type: "button", class: "icon", "aria-label": label, title: label, onclick, ...attributes }, icon(name));
}

/** Something told for a moment. */
export function tell(text) {
  document.querySelector(".toast")?.remove();
  const toast = h("div", { class: "toast", role: "status" }, text);
  document.body.append(toast);
  setTimeout(() => toast.remove(), 2600);
}

/** The colours of the page, as its style sheet has them now. */
export function schemeColour(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}
