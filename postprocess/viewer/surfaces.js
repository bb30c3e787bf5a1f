// SPDX-License-Identifier: GPL-3.0-or-later
// What is found in the grains of one frame: the profile of a heap or slope, the packing over height.

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

/** The slope of the line through points, and its value at a place; not a number where there are too few. */
function fitted(places, values, within) {
  const chosen = places.map((x, n) => [x, values[n]]).filter(([x]) => within(x));
  if (chosen.length < 3) return { slope: NaN, at: () => null };
  const [mx, my] = [mean(chosen.map(([x]) => x)), mean(chosen.map(([, y]) => y))];
  const slope = chosen.reduce((sum, [x, y]) => sum + (x - mx) * (y - my), 0) / chosen.reduce((sum, [x]) => sum + (x - mx) ** 2, 0);
  return { slope, at: (x) => my + slope * (x - mx) };
}

/** Mean heights of rings half a diameter wide, and the line through the flank, as the sensor `repose` finds them
 * (core/sensors/repose.hpp): the surface is where a grain that is let down meets the heap. */
export function heapProfile(recording, k, sensor) {
  const { up, meanRadius } = recording;
  const diameter = 2 * meanRadius;
  const base = sensor.base ?? [0, 0, 0];
  const e1 = acrossTo(up);
  const e2 = cross(up, e1);
  const fast = 0.3 * Math.sqrt(Math.hypot(...recording.data.gravity) * diameter);
  const speeds = recording.speeds(k);
  const grains = [];
  forGrains(recording, k, (place, slot, i) => {
    if (!(speeds[i] <= fast) && recording.length > 1) return; // nor what just came in, whose speed is not known
    const x = place.map((one, axis) => one - base[axis]);
    const radius = recording.radii[slot];
    if (dot(x, up) + radius > 0) grains.push({ across: dot(x, e1), along: dot(x, e2), height: dot(x, up), radius });
  });
  if (!grains.length) return { places: [], heights: [], line: [], angle: NaN };
  const foot = footOf(grains);
  const half = foot + diameter;
  const cell = Math.max(diameter / 3, (2 * half) / 1024);
  const count = Math.ceil((2 * half) / cell);
  const surface = new Float64Array(count * count);
  const placeOf = (n) => (n + 0.5) * cell - half;
  const cellOf = (x) => Math.min(count - 1, Math.max(0, Math.floor((x + half) / cell)));
  for (const { across, along, height, radius } of grains) {
    const reach = radius + meanRadius;
    for (let i = cellOf(across - reach); i <= cellOf(across + reach); ++i)
      for (let j = cellOf(along - reach); j <= cellOf(along + reach); ++j) {
        const square = reach ** 2 - (placeOf(i) - across) ** 2 - (placeOf(j) - along) ** 2;
        if (square > 0) surface[i * count + j] = Math.max(surface[i * count + j], height - meanRadius + Math.sqrt(square));
      }
  }
  const ringWidth = diameter / 2;
  const rings = [];
  const cells = [];
  for (let i = 0; i < count; ++i)
    for (let j = 0; j < count; ++j) {
      const out = Math.hypot(placeOf(i), placeOf(j));
      const ring = (rings[Math.floor(out / ringWidth)] ??= { sum: 0, cells: 0 });
      ring.sum += surface[i * count + j];
      ++ring.cells;
      if (surface[i * count + j] > 0) cells.push([out, surface[i * count + j]]);
    }
  const places = Array.from(rings, (_, ring) => (ring + 0.5) * ringWidth);
  const heights = Array.from(rings, (ring) => (ring ? ring.sum / ring.cells : 0));
  const apex = Math.max(...heights);
  let inner = sensor.outer_radius ? sensor.inner_radius ?? 0 : 0;
  let outer = sensor.outer_radius || Infinity;
  if (!sensor.outer_radius)
    places.forEach((x, ring) => {
      if (heights[ring] > 0.8 * apex) inner = x;
      if (heights[ring] < Math.max(0.2 * apex, 1.5 * diameter)) outer = Math.min(outer, x);
    });
  outer = Math.min(outer, foot);
  const within = (x) => x >= inner && x <= outer;
  const { slope, at } = fitted(cells.map(([out]) => out), cells.map(([, height]) => height), within);
  return { places, heights, line: places.map((x) => (within(x) ? at(x) : null)), angle: (-Math.atan(slope) * 180) / Math.PI };
}

/** The distance from the axis within which 99 % of the mass lies. */
function footOf(grains) {
  const mass = grains.map(({ across, along, radius }) => [Math.hypot(across, along), radius ** 3]).sort((a, b) => a[0] - b[0]);
  let left = 0.99 * mass.reduce((sum, [, one]) => sum + one, 0);
  for (const [out, one] of mass) if ((left -= one) <= 0) return out;
  return mass.at(-1)[0];
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
  const { slope, at } = fitted(places, heights, () => true);
  return { places, heights, line: places.map(at), angle: (-Math.atan(slope) * 180) / Math.PI };
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
