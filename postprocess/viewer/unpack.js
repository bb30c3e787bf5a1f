// SPDX-License-Identifier: GPL-3.0-or-later
// Undoes what run_page/packing.py does.

/** A blob of the page by its key, inflated. */
export function embeddedBlob(key) {
  const text = document.getElementById(`blob-${key}`).textContent;
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = binary.charCodeAt(i);
  return inflate(bytes);
}

export async function inflate(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

export function floats(bytes) {
  return new Float32Array(bytes.buffer, bytes.byteOffset, bytes.byteLength >> 2);
}

/** Reads numbers one after the other from bytes. */
class Reader {
  constructor(bytes) {
    this.bytes = bytes;
    this.at = 0;
  }

  take(count) {
    this.at += count;
    return this.bytes.subarray(this.at - count, this.at);
  }

  /** Unsigned numbers from planes, low bytes first. */
  planes(count, width) {
    const numbers = new Uint32Array(count);
    for (let byte = 0; byte < width; ++byte) {
      const plane = this.take(count);
      for (let i = 0; i < count; ++i) numbers[i] |= plane[i] << (8 * byte);
    }
    return numbers;
  }

  increasing(count) {
    const numbers = this.planes(count, 4);
    for (let i = 0, last = 0; i < count; ++i) last = numbers[i] = last + unzigzag(numbers[i]);
    return numbers;
  }
}

const unzigzag = (n) => (n >>> 1) ^ -(n & 1);

/** What a grain keeps for life: ids, radii [m], materials. */
export function unpackSpheres(bytes, { count, low, high }) {
  const reader = new Reader(bytes);
  const ids = reader.increasing(count);
  const radii = Float32Array.from(reader.planes(count, 2), (level) => low + ((high - low) * level) / 65535);
  return { ids, radii, materials: reader.take(count) };
}

/** Frames in a row: the ids of their slots, and for each frame which of them are there, and where, in quanta. */
export function unpackGroup(bytes, { count, slots, width }) {
  const reader = new Reader(bytes);
  const ids = reader.increasing(slots);
  const there = [];
  for (let k = 0; k < count; ++k) {
    const bits = reader.take((slots + 7) >> 3);
    const now = new Uint8Array(slots);
    for (let i = 0; i < slots; ++i) now[i] = ((bits[i >> 3] >> (i & 7)) & 1) ^ (k ? there[k - 1][i] : 0);
    there.push(now);
  }
  const places = [];
  for (let k = 0; k < count; ++k) {
    const now = k ? places[k - 1].slice() : new Int32Array(3 * slots);
    for (let axis = 0; axis < 3; ++axis) {
      const steps = reader.planes(slots, width);
      for (let i = 0; i < slots; ++i) now[3 * i + axis] += unzigzag(steps[i]);
    }
    places.push(now);
  }
  return { ids, there, places };
}

/** The strongest contacts of a frame, and the number of contacts of each grain by its id (empty: not known). */
export function unpackContacts(bytes, { count, widths, arm, top, touching }) {
  const reader = new Reader(bytes);
  const a = Int32Array.from(reader.planes(count, widths[0]), unzigzag);
  for (let i = 1; i < count; ++i) a[i] += a[i - 1];
  const b = Int32Array.from(reader.planes(count, widths[1]), (n, i) => unzigzag(n) + a[i]);
  const steps = [0, 1, 2].map(() => new Int8Array(reader.take(count)));
  const arms = new Float32Array(3 * count);
  for (let i = 0; i < count; ++i) for (let axis = 0; axis < 3; ++axis) arms[3 * i + axis] = (steps[axis][i] * arm) / 127;
  const force = Float32Array.from(reader.take(count), (level) => (level * top) / 255);
  return { a, b, arms, force, touching: reader.take(touching) };
}
