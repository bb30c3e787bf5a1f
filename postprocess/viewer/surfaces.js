// SPDX-License-Identifier: GPL-3.0-or-later
// What is found in the grains of one frame: the profile of a heap or slope, the packing over height.

const SECTORS = 16;
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

function acrossTo(up) {
  const other = Math.abs(up[2]) < 0.9 ? [0, 0, 1] : [1, 0, 0];
  const e1 = cross(up, other);
  const size = Math.hypot(...e1);
  return e1.map((one) => one / size);
}

/** Calls each(place, slot, i) for the grains that are there in frame k. */
function forGrains(recording, k, each) {
  const frame = recording.frame(k);
  if (!frame) return;
  const { origin, quantum } = recording;
  for (let i = 0; i < frame.slots.length; ++i)
    if (frame.there[i]) each([0, 1, 2].map((axis) => origin[axis] + quantum * frame.places[3 * i + axis]), frame.slots[i], i);
}

function mean(values) {
  return values.reduce((sum, one) => sum + one, 0) / values.length;
}

/** The line through points, as values at their places; null where there is none. */
function fitted(places, values, within) {
  const chosen = places.map((x, n) => [x, values[n]]).filter(([x, y]) => y !== null && within(x));
  if (chosen.length < 3) return { slope: NaN, line: places.map(() => null) };
  const [mx, my] = [mean(chosen.map(([x]) => x)), mean(chosen.map(([, y]) => y))];
  const slope = chosen.reduce((sum, [x, y]) => sum + (x - mx) * (y - my), 0) / chosen.reduce((sum, [x]) => sum + (x - mx) ** 2, 0);
  return { slope, line: places.map((x) => (within(x) ? my + slope * (x - mx) : null)) };
}

/** Heights of the surface of a heap over the distance from its axis, as the sensor `repose` finds them, with its line. */
export function heapProfile(recording, k, sensor) {
  const { up, meanRadius } = recording;
  const width = 2 * meanRadius;
  const base = sensor.base ?? [0, 0, 0];
  const e1 = acrossTo(up);
  const e2 = cross(up, e1);
  const gravity = Math.hypot(...recording.data.gravity);
  const fast = 0.3 * Math.sqrt(gravity * width);
  const speeds = recording.speeds(k);
  const tops = [];
  forGrains(recording, k, (place, slot, i) => {
    if (!(speeds[i] <= fast) && recording.length > 1) return; // nor what just came in, whose speed is not known
    const x = place.map((one, axis) => one - base[axis]);
    const height = dot(x, up) + recording.radii[slot];
    const [across, along] = [dot(x, e1), dot(x, e2)];
    const ring = Math.floor(Math.hypot(across, along) / width);
    if (height <= 0 || ring > 10000) return;
    const sector = Math.min(SECTORS - 1, Math.floor((Math.atan2(along, across) / (2 * Math.PI) + 0.5) * SECTORS));
    tops[ring] ??= new Array(SECTORS).fill(-Infinity);
    tops[ring][sector] = Math.max(tops[ring][sector], height);
  });
  const places = Array.from(tops, (_, ring) => (ring + 0.5) * width);
  const heights = Array.from(tops, (sectors) => {
    const found = (sectors ?? []).filter(Number.isFinite);
    return found.length ? mean(found) : null;
  });
  const apex = Math.max(0, ...heights.filter((one) => one !== null));
  let inner = 0;
  let outer = Infinity;
  places.forEach((x, ring) => {
    if (heights[ring] === null) return;
    if (heights[ring] > 0.8 * apex) inner = x;
    if (heights[ring] < 0.2 * apex) outer = Math.min(outer, x);
  });
  const { slope, line } = fitted(places, heights, (x) => x >= inner && x <= outer);
  return { places, heights, line, angle: (-Math.atan(slope) * 180) / Math.PI };
}

/** Heights of a surface along a direction, as the sensor `slope` finds them, with its line. */
export function slopeProfile(recording, k, sensor) {
  const { up, meanRadius } = recording;
  const width = 2 * meanRadius;
  const along = sensor.along;
  const across = cross(up, along);
  const cells = new Map();
  const half = sensor.length / 2;
  forGrains(recording, k, (place, slot) => {
    const x = place.map((one, axis) => one - sensor.point[axis]);
    const s = dot(x, along);
    if (Math.abs(s) > half) return;
    const cell = Math.floor((s + half) / width);
    const row = cells.get(cell) ?? new Map();
    cells.set(cell, row);
    const lane = Math.floor(dot(x, across) / width);
    row.set(lane, Math.max(row.get(lane) ?? -Infinity, dot(x, up) + recording.radii[slot]));
  });
  const numbers = [...cells.keys()].sort((a, b) => a - b);
  const places = numbers.map((cell) => (cell + 0.5) * width - half);
  const heights = numbers.map((cell) => mean([...cells.get(cell).values()]));
  const { slope, line } = fitted(places, heights, () => true);
  return { places, heights, line, angle: (-Math.atan(slope) * 180) / Math.PI };
}

/** Area of the convex outline of points in a plane, and its length. */
function outline(points) {
  points.sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  const half = (list) => {
    const chain = [];
    for (const p of list) {
      while (chain.length > 1) {
        const [a, b] = chain.slice(-2);
        if ((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]) > 0) break;
        chain.pop();
      }
      chain.push(p);
    }
    return chain.slice(0, -1);
  };
  const hull = [...half(points), ...half([...points].reverse())];
  let area = 0;
  let length = 0;
  hull.forEach((a, n) => {
    const b = hull[(n + 1) % hull.length];
    area += (a[0] * b[1] - a[1] * b[0]) / 2;
    length += Math.hypot(b[0] - a[0], b[1] - a[1]);
  });
  return { area, length };
}

/** The share of space that grains take at each height, within the convex outline of those that are there. */
export function packingOverHeight(recording, k) {
  const { up, meanRadius } = recording;
  const e1 = acrossTo(up);
  const e2 = cross(up, e1);
  const thick = 3 * meanRadius;
  const slabs = new Map();
  forGrains(recording, k, (place, slot) => {
    const height = dot(place, up);
    const r = recording.radii[slot];
    for (let n = Math.floor((height - r) / thick); n <= Math.floor((height + r) / thick); ++n) {
      const slab = slabs.get(n) ?? { volume: 0, points: [], radii: 0 };
      slabs.set(n, slab);
      const [low, high] = [Math.max(n * thick, height - r) - height, Math.min((n + 1) * thick, height + r) - height];
      slab.volume += Math.PI * (r * r * (high - low) - (high ** 3 - low ** 3) / 3);
      const middle = Math.min(high, Math.max(low, 0));
      slab.points.push([dot(place, e1), dot(place, e2)]);
      slab.radii += Math.sqrt(Math.max(0, r * r - middle * middle));
    }
  });
  const numbers = [...slabs.keys()].sort((a, b) => a - b);
  const shares = numbers.map((n) => {
    const { volume, points, radii } = slabs.get(n);
    if (points.length < 20) return null;
    const r = radii / points.length;
    const { area, length } = outline(points);
    return volume / (thick * (area + length * r + Math.PI * r * r));
  });
  return { heights: numbers.map((n) => (n + 0.5) * thick), shares };
}
