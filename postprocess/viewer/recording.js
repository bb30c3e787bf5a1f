// SPDX-License-Identifier: GPL-3.0-or-later
import { floats, unpackContacts, unpackGroup, unpackSpheres } from "./unpack.js";

/**
 * The frames of a run. Grains have slots: their places in the table of all that are in any frame.
 *
 * A frame has, for each of the grains of its group, `there` and `places`, whole multiples of the quantum; a group has
 * the slots of its grains, and for each slot which of its grains that is (−1: none).
 */
export class Recording {
  /** @param blob gives the bytes of a blob by its key, as a promise; groups that another recording has are taken over */
  static async open(data, blob, earlier) {
    const recording = new Recording();
    recording.data = data;
    recording.blob = blob;
    recording.times = data.frames.times;
    recording.quantum = data.frames.quantum;
    recording.origin = data.frames.origin;
    recording.spheres = data.frames.spheres;
    const table = unpackSpheres(await blob(data.frames.spheres.blob), data.frames.spheres);
    Object.assign(recording, { ids: table.ids, radii: table.radii, materials: table.materials });
    recording.groups = new Map();
    recording.known = earlier?.known ?? new Map();
    recording.contactFrames = earlier?.contactFrames ?? new Map();
    recording.cache = new Map();
    recording.firstSeen = [];
    recording.origins = [];
    recording.originRange = recording.heightRange;
    recording.meanRadius = table.radii.length ? table.radii.reduce((sum, r) => sum + r, 0) / table.radii.length : 0.01;
    return recording;
  }

  get length() {
    return this.times.length;
  }

  get up() {
    const g = this.data.gravity.map((one) => one ?? 0);
    const size = Math.hypot(...g);
    return size > 0 ? g.map((one) => -one / size) : [0, 0, 1];
  }

  get heightRange() {
    const [low, high] = this.data.frames.box;
    const ends = [0, 0];
    this.up.forEach((u, k) => {
      ends[0] += u * (u > 0 ? low[k] : high[k]);
      ends[1] += u * (u > 0 ? high[k] : low[k]);
    });
    return ends;
  }

  height(places, at) {
    const up = this.up;
    let sum = 0;
    for (let axis = 0; axis < 3; ++axis) sum += up[axis] * (this.origin[axis] + this.quantum * places[3 * at + axis]);
    return sum;
  }

  /** Makes the group with frame k ready, if it is not. */
  async load(k) {
    const shape = this.data.frames.groups.find((group) => k >= group.first && k < group.first + group.count);
    if (!shape || this.groups.has(shape.first)) return;
    let raw = this.known.get(shape.blob);
    if (!raw) {
      raw = unpackGroup(await this.blob(shape.blob), shape);
      this.known.set(shape.blob, raw);
    }
    const slots = new Int32Array(raw.ids.length);
    const local = new Int32Array(this.ids.length).fill(-1);
    for (let i = 0, slot = 0; i < slots.length; ++i) {
      while (this.ids[slot] !== raw.ids[i]) ++slot;
      slots[i] = slot;
      local[slot] = i;
    }
    this.groups.set(shape.first, { first: shape.first, count: shape.count, slots, local, raw });
  }

  /** Loads everything, from the frame k outwards; calls `each` after every group. */
  async loadAll(k, each) {
    const order = [...this.data.frames.groups].sort((a, b) => Math.abs(a.first - k) - Math.abs(b.first - k));
    for (const group of order) {
      await this.load(group.first);
      each?.();
      await new Promise((next) => setTimeout(next));
    }
    this.followFromTheStart();
    each?.();
  }

  /** When each grain was first there, and how high. */
  followFromTheStart() {
    this.firstSeen = new Float64Array(this.ids.length).fill(NaN);
    this.origins = new Float64Array(this.ids.length).fill(NaN);
    let low = Infinity;
    let high = -Infinity;
    for (let k = 0; k < this.length; ++k) {
      const frame = this.frame(k);
      for (let i = 0; i < frame.slots.length; ++i) {
        const slot = frame.slots[i];
        if (!frame.there[i] || this.firstSeen[slot] === this.firstSeen[slot]) continue;
        this.firstSeen[slot] = this.times[k];
        const height = (this.origins[slot] = this.height(frame.places, i));
        low = Math.min(low, height);
        high = Math.max(high, height);
      }
    }
    if (high > low) this.originRange = [low, high];
    this.cache.clear();
  }

  /** The frame k; nothing while it is not loaded. */
  frame(k) {
    for (const group of this.groups.values())
      if (k >= group.first && k < group.first + group.count) {
        const at = k - group.first;
        return { group, slots: group.slots, local: group.local, there: group.raw.there[at], places: group.raw.places[at] };
      }
    return null;
  }

  /** The frame at or before a time, and how far that is on the way to the next, from 0 to 1. */
  at(time) {
    const { times } = this;
    let k = 0;
    let end = times.length - 1;
    while (end - k > 1) {
      const middle = (k + end) >> 1;
      if (times[middle] <= time) k = middle;
      else end = middle;
    }
    if (times.length < 2) return { k: 0, f: 0 };
    return { k, f: Math.min(1, Math.max(0, (time - times[k]) / (times[k + 1] - times[k]))) };
  }

  perGrain(k, value) {
    const frame = this.frame(k);
    const values = new Float32Array(frame.slots.length);
    for (let i = 0; i < values.length; ++i) values[i] = value(frame.slots[i], i, frame);
    return values;
  }

  /** A way in quanta along an axis; across a border of a periodic world the short way. */
  wrapped(step, axis) {
    const period = this.data.periods[axis] / this.quantum;
    return period > 0 ? step - period * Math.round(step / period) : step;
  }

  /** Mean speed between the frames before and after k [m/s]; NaN where a grain is in this frame only. */
  speeds(k) {
    const now = this.frame(k);
    const beside = [k - 1, k + 1].map((n) => (n >= 0 && n < this.length ? this.frame(n) : null));
    return this.perGrain(k, (slot, i) => {
      let sum = 0;
      let found = 0;
      beside.forEach((other, side) => {
        const j = other ? other.local[slot] : -1;
        if (j < 0 || !other.there[j]) return;
        let square = 0;
        for (let axis = 0; axis < 3; ++axis) square += this.wrapped(other.places[3 * j + axis] - now.places[3 * i + axis], axis) ** 2;
        sum += (Math.sqrt(square) * this.quantum) / Math.abs(this.times[k + 2 * side - 1] - this.times[k]);
        ++found;
      });
      return found ? sum / found : NaN;
    });
  }

  /** The frame of contacts at frame k: its own, or where the run wrote few of them one that is not far off. */
  contactsAt(k) {
    const listed = this.data.contacts;
    if (!listed.length) return null;
    const nearest = listed.reduce((best, one) => (Math.abs(one.frame - k) < Math.abs(best.frame - k) ? one : best));
    return Math.abs(nearest.frame - k) <= 2 ? nearest : null;
  }

  async loadContacts() {
    for (const one of this.data.contacts)
      if (!this.contactFrames.has(one.blob)) this.contactFrames.set(one.blob, unpackContacts(await this.blob(one.blob), one));
    this.cache.clear();
  }

  coordination(k) {
    const listed = this.contactsAt(k);
    const known = listed?.touching ? this.contactFrames.get(listed.blob) : null;
    return this.perGrain(k, (slot) => (known ? (known.touching[this.ids[slot]] ?? 0) + 0.5 : NaN));
  }

  /** Values of a colouring in frame k, kept for the next time. */
  values(colouring, k) {
    const key = `${colouring.key}:${k}`;
    let values = this.cache.get(key);
    if (!values) {
      values = colouring.value(k);
      if (this.cache.size > 12) this.cache.delete(this.cache.keys().next().value);
      this.cache.set(key, values);
    }
    return values;
  }

  /** Whether there is a grain in frame k that a colouring has no value for, as of one that just came in. */
  isUnknown(colouring, k) {
    const { there } = this.frame(k);
    return this.values(colouring, k).some((value, i) => there[i] && Number.isNaN(value));
  }

  /** The slot of a grain by its id; −1: it is in no frame. */
  slotOf(id) {
    let low = 0;
    let high = this.ids.length - 1;
    while (low <= high) {
      const middle = (low + high) >> 1;
      if (this.ids[middle] === id) return middle;
      if (this.ids[middle] < id) low = middle + 1;
      else high = middle - 1;
    }
    return -1;
  }

  /** Where a grain is at a time [m], the mean of two frames; nothing where it is not there. */
  place(slot, k, f) {
    const here = this.placeIn(slot, k);
    const next = k + 1 < this.length ? this.placeIn(slot, k + 1) : null;
    if (here && next && !this.jumps(here, next)) return here.map((one, axis) => one + f * (next[axis] - one));
    return f < 0.5 ? here : next;
  }

  placeIn(slot, k) {
    const frame = this.frame(k);
    const i = frame ? frame.local[slot] : -1;
    if (i < 0 || !frame.there[i]) return null;
    return [0, 1, 2].map((axis) => this.origin[axis] + this.quantum * frame.places[3 * i + axis]);
  }

  jumps(here, there) {
    return this.data.periods.some((period, axis) => period > 0 && Math.abs(here[axis] - there[axis]) > period / 2);
  }

  /** Bytes of a blob as numbers. */
  async floats(key) {
    return floats(await this.blob(key));
  }
}
