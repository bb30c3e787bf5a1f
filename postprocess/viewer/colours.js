// SPDX-License-Identifier: GPL-3.0-or-later
// What the colour of a grain tells, and in which colours.

/** Ramps for magnitudes, as knots: all grow evenly darker or lighter, so that they are read without colour too. */
const RAMPS = {
  sand: ["#f0cfa1", "#f7ab5c", "#e57b57", "#d14754", "#93366a", "#59247a"],
  viridis: ["#440154", "#414487", "#2a788e", "#22a884", "#7ad151", "#fde725"],
  cividis: ["#00204d", "#31446b", "#666970", "#958f78", "#cab969", "#ffea46"],
};
/** Okabe and Ito's, told apart by the colour-blind; the first is sand. */
export const CATEGORIES = ["#f0cfa1", "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00", "#7a7a7a"];
export const UNKNOWN = "#a9adb3";

export const RAMP_NAMES = Object.keys(RAMPS);

export function rgb(hex) {
  return [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16));
}

/** 256 colours of a ramp, as bytes; with `bands` above 0 in so many steps. */
export function rampBytes(name, bands = 0) {
  const knots = RAMPS[name].map(rgb);
  const bytes = new Uint8Array(4 * 256);
  for (let i = 0; i < 256; ++i) {
    const share = bands ? Math.floor((i / 256) * bands) / Math.max(1, bands - 1) : i / 255;
    const place = share * (knots.length - 1);
    const k = Math.min(knots.length - 2, Math.floor(place));
    for (let c = 0; c < 3; ++c) bytes[4 * i + c] = knots[k][c] + (place - k) * (knots[k + 1][c] - knots[k][c]);
    bytes[4 * i + 3] = 255;
  }
  return bytes;
}

/** The colours of so many materials or the like, repeated where there are more. */
export function categoryBytes(count) {
  const bytes = new Uint8Array(4 * 256);
  for (let i = 0; i < 256; ++i) {
    const which = Math.min(count - 1, Math.floor((i / 256) * count));
    bytes.set([...rgb(CATEGORIES[which % CATEGORIES.length]), 255], 4 * i);
  }
  return bytes;
}

/** The next of 1, 2, 5, 10, … */
export function roundUp(value) {
  if (!(value > 0)) return 1;
  const power = 10 ** Math.floor(Math.log10(value));
  return [1, 2, 5, 10].map((step) => step * power).find((one) => one >= 0.999 * value);
}

/** A number as short as it may be. */
export function short(value) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-3 || size >= 1e6)) return value.toExponential(2).replace("e+", "e");
  return String(Number(value.toPrecision(4)));
}

/**
 * The ways to colour the grains of a recording. Each has a name, the range of its values, a unit, and `value(k)`: a
 * number for each grain of frame k, below 0 where it is not known.
 */
export function colourings(recording) {
  const { data } = recording;
  const materials = Math.max(data.materials.length, 1);
  const [bottom, top] = recording.heightRange;
  const d = 2e3 * recording.spheres.high;
  const list = [
    { key: "speed", name: "Speed", unit: "m/s", range: [0, roundUp(data.frames.fastest / 2)], open: true, value: (k) => recording.speeds(k) },
    { key: "height", name: "Height", unit: "m", range: [bottom, top], value: (k) => recording.perGrain(k, (slot, at, f) => recording.height(f.places, at)) },
    { key: "radius", name: "Radius", unit: "mm", range: [1e3 * recording.spheres.low, d / 2], value: (k) => recording.perGrain(k, (slot) => 1e3 * recording.radii[slot]) },
    { key: "material", name: "Material", categories: data.materials, range: [0, materials], value: (k) => recording.perGrain(k, (slot) => recording.materials[slot] + 0.5) },
    { key: "id", name: "Id", unit: "", bands: 10, range: [0, Math.max(1, recording.ids.at(-1) ?? 1)], value: (k) => recording.perGrain(k, (slot) => recording.ids[slot]) },
    { key: "origin", name: "Height at first", unit: "m", bands: 8, range: recording.originRange, value: (k) => recording.perGrain(k, (slot) => recording.origins[slot] ?? NaN) },
    { key: "age", name: "Time inside", unit: "s", range: [0, Math.max(1e-9, recording.times.at(-1) - recording.times[0])], value: (k) => recording.perGrain(k, (slot) => recording.times[k] - (recording.firstSeen[slot] ?? NaN)) },
  ];
  if (data.contacts.some((one) => one.touching))
    list.push({ key: "coordination", name: "Contacts", unit: "", bands: 9, range: [0, 9], value: (k) => recording.coordination(k) });
  list.push({ key: "none", name: "One colour", range: [0, 1], plain: true, value: (k) => recording.perGrain(k, () => 0) });
  return list;
}
