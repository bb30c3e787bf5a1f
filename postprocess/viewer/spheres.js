// SPDX-License-Identifier: GPL-3.0-or-later
import * as THREE from "three";
import { rgb, UNKNOWN } from "./colours.js";
import { fetchRecord, Records, repeated } from "./records.js";

/** How a grain comes from one frame to the next. */
const HERE = 1; // it is in the first only
const THERE = 2; // in the second only
const MOVES = 3;
const JUMPS = 4; // across a periodic border

const vertexShader = /* glsl */ `
precision highp float;
precision highp int;
uniform highp sampler2D heres, theres; // centre, value
uniform highp sampler2D bodies; // radius, how it comes from here to there
uniform mat4 modelViewMatrix, projectionMatrix;
uniform float mixing, shrink;
uniform int picked;
out vec3 way;
flat out vec3 centre;
flat out float radius, value;
flat out int marked;
${fetchRecord}
void main() {
  int grain = gl_VertexID / 4;
  int corner = gl_VertexID % 4;
  vec4 here = record(heres, grain), there = record(theres, grain), body = record(bodies, grain);
  vec2 position = vec2(corner == 1 || corner == 2 ? 1.0 : -1.0, corner > 1 ? 1.0 : -1.0);
  float f = mixing;
  int kind = int(body.y + 0.5);
  bool hidden = kind == 0 || (kind == ${HERE} && f >= 0.5) || (kind == ${THERE} && f < 0.5);
  if (kind == ${JUMPS}) f = step(0.5, f);
  centre = (modelViewMatrix * vec4(mix(here.xyz, there.xyz, f), 1.0)).xyz;
  value = (here.w < 0.0 || there.w < 0.0) ? (f < 0.5 ? here.w : there.w) : mix(here.w, there.w, f);
  radius = body.x * shrink;
  marked = grain == picked ? 1 : 0;
  if (marked == 1) radius = body.x;
  // A square across the line of sight that just covers what is seen of the sphere.
  float distance = length(centre);
  vec3 ahead = centre / distance;
  vec3 right = normalize(cross(ahead, vec3(0.0, 1.0, 0.0)));
  float size = radius * distance / sqrt(max(distance * distance - radius * radius, 1e-12));
  way = centre + size * (position.x * right + position.y * cross(right, ahead));
  gl_Position = hidden ? vec4(2.0, 2.0, 2.0, 1.0) : projectionMatrix * vec4(way, 1.0);
}`;

const fragmentShader = /* glsl */ `
precision highp float;
in vec3 way;
flat in vec3 centre;
flat in float radius, value;
flat in int marked;
uniform mat4 projectionMatrix;
uniform sampler2D ramp;
uniform vec3 unknown, accent;
uniform vec4 clip; // in the eye's frame: what is above it is cut away; all zero: nothing
uniform float fade;
out vec4 colour;
void main() {
  vec3 ray = normalize(way);
  float middle = dot(ray, centre);
  vec3 off = centre - middle * ray;
  float inside = radius * radius - dot(off, off);
  if (inside <= 0.0) discard;
  float half_chord = sqrt(inside);
  float t = middle - half_chord;
  vec3 hit = t * ray;
  vec3 normal = (hit - centre) / radius;
  bool cut = false;
  if (dot(clip.xyz, hit) + clip.w > 0.0) {
    float slope = dot(clip.xyz, ray);
    if (slope >= 0.0) discard;
    t = -clip.w / slope;
    if (t > middle + half_chord) discard;
    hit = t * ray;
    normal = clip.xyz;
    cut = true;
  }
  vec3 base = value < 0.0 ? unknown : texture(ramp, vec2(clamp(value, 0.002, 0.998), 0.5)).rgb;
  base = mix(base, unknown * 0.6 + 0.4, fade);
  if (marked == 1) base = accent;
  float key = max(dot(normal, vec3(-0.45, 0.65, 0.61)), 0.0);
  float shine = pow(max(dot(reflect(ray, normal), vec3(-0.45, 0.65, 0.61)), 0.0), 24.0);
  vec3 lit = base * (0.66 + 0.12 * normal.y + 0.40 * key) + 0.08 * shine;
  if (cut) lit = mix(base, vec3(1.0), 0.12) * (length(hit - centre) > 0.93 * radius ? 0.72 : 0.97);
  colour = vec4(lit, 1.0);
  vec4 place = projectionMatrix * vec4(hit, 1.0);
  gl_FragDepth = 0.5 * place.z / place.w + 0.5;
}`;

/** The grains, each a square in which its sphere is found pixel by pixel, mixed from two frames. */
export class Spheres {
  constructor() {
    this.texture = new THREE.DataTexture(new Uint8Array(4 * 256), 256, 1);
    this.material = new THREE.RawShaderMaterial({
      glslVersion: THREE.GLSL3,
      vertexShader,
      fragmentShader,
      uniforms: {
        mixing: { value: 0 },
        shrink: { value: 1 },
        fade: { value: 0 },
        picked: { value: -1 },
        ramp: { value: this.texture },
        unknown: { value: new THREE.Vector3(...rgb(UNKNOWN).map((c) => c / 255)) },
        accent: { value: new THREE.Vector3(0, 0.7, 1) },
        clip: { value: new THREE.Vector4() },
        heres: { value: null },
        theres: { value: null },
        bodies: { value: null },
      },
    });
    this.mesh = new THREE.Mesh(new THREE.BufferGeometry(), this.material);
    this.mesh.frustumCulled = false;
    this.count = 0;
    this.capacity = -1;
    this.slots = new Int32Array(0);
  }

  setRamp(bytes) {
    this.texture.image.data.set(bytes);
    this.texture.needsUpdate = true;
  }

  makeRoom(count) {
    if (count <= this.capacity) return;
    this.capacity = Math.ceil(1.2 * count) + 16;
    this.mesh.geometry.dispose();
    this.mesh.geometry = repeated([0, 1, 2, 0, 2, 3], 4, this.capacity);
    for (const name of ["heres", "theres", "bodies"]) {
      this[name]?.dispose();
      this[name] = new Records(this.capacity);
      this.material.uniforms[name].value = this[name].texture;
    }
    this.slots = new Int32Array(this.capacity);
  }

  /**
   * Takes the grains of frame k and the one after it.
   * @param toStage brings a place in quanta to the stage: scale and shift of each axis
   * @param colouring with its range
   */
  setPair(recording, k, colouring, toStage) {
    const first = recording.frame(k);
    const second = k + 1 < recording.length ? recording.frame(k + 1) : first;
    if (!first || !second) return false;
    const values = [recording.values(colouring, k), second === first ? null : recording.values(colouring, k + 1)];
    values[1] ??= values[0];
    const same = first.group === second.group;
    let count = first.slots.length;
    if (!same) for (const slot of second.slots) if (first.local[slot] < 0) ++count;
    this.makeRoom(count);
    const [here, there, body] = [this.heres.array, this.theres.array, this.bodies.array];
    const before = k > 0 ? recording.frame(k - 1) : null;
    const [low, high] = colouring.range;
    const share = (value) => (value === value ? Math.max(0, (value - low) / (high - low || 1)) : -1);
    const { scale, shift } = toStage;
    let n = 0;
    const add = (slot, i, j) => {
      const inFirst = i >= 0 && first.there[i] === 1;
      const inSecond = j >= 0 && second.there[j] === 1;
      if (!inFirst && !inSecond) return;
      let kind = inFirst && inSecond ? MOVES : inFirst ? HERE : THERE;
      const b = inFirst && !inSecond && before ? before.local[slot] : -1;
      const wasBefore = b >= 0 && before.there[b] === 1;
      for (let axis = 0; axis < 3; ++axis) {
        const p = inFirst ? first.places[3 * i + axis] : second.places[3 * j + axis];
        // A grain that leaves goes on as it went, until it is gone.
        const q = inSecond ? second.places[3 * j + axis] : p + (wasBefore ? recording.wrapped(p - before.places[3 * b + axis], axis) : 0);
        here[4 * n + axis] = p * scale + shift[axis];
        there[4 * n + axis] = q * scale + shift[axis];
        if (kind === MOVES && recording.wrapped(q - p, axis) !== q - p) kind = JUMPS;
      }
      here[4 * n + 3] = inFirst ? share(values[0][i]) : share(values[1][j]);
      there[4 * n + 3] = inSecond ? share(values[1][j]) : here[4 * n + 3];
      body[4 * n] = recording.radii[slot] * toStage.length;
      body[4 * n + 1] = kind;
      this.slots[n++] = slot;
    };
    for (let i = 0; i < first.slots.length; ++i) add(first.slots[i], i, same ? i : second.local[first.slots[i]]);
    if (!same) for (let j = 0; j < second.slots.length; ++j) if (first.local[second.slots[j]] < 0) add(second.slots[j], -1, j);
    this.count = n;
    this.mesh.geometry.setDrawRange(0, 6 * n);
    for (const records of [this.heres, this.theres, this.bodies]) records.changed();
    return true;
  }

  set mixing(f) {
    this.material.uniforms.mixing.value = f;
  }

  get mixing() {
    return this.material.uniforms.mixing.value;
  }

  /** Marks the grain with this slot, or none. */
  mark(slot) {
    let picked = -1;
    for (let n = 0; n < this.count && slot >= 0; ++n) if (this.slots[n] === slot) picked = n;
    this.material.uniforms.picked.value = picked;
  }

  /** The slot of the first grain that a ray meets, on the side of the plane that is left; −1: none. */
  pick(ray, plane) {
    if (!this.count) return -1;
    const [here, there, body] = [this.heres.array, this.theres.array, this.bodies.array];
    const { origin: o, direction: u } = ray;
    let nearest = Infinity;
    let found = -1;
    for (let n = 0; n < this.count; ++n) {
      const kind = body[4 * n + 1];
      let f = this.mixing;
      if ((kind === HERE && f >= 0.5) || (kind === THERE && f < 0.5)) continue;
      if (kind === JUMPS) f = f < 0.5 ? 0 : 1;
      const c = [0, 1, 2].map((axis) => here[4 * n + axis] + f * (there[4 * n + axis] - here[4 * n + axis]));
      const x = c[0] - o.x, y = c[1] - o.y, z = c[2] - o.z;
      const along = x * u.x + y * u.y + z * u.z;
      const inside = body[4 * n] ** 2 - (x * x + y * y + z * z - along * along);
      if (inside <= 0) continue;
      let t = along - Math.sqrt(inside);
      if (plane && plane.distanceToPoint(o.clone().addScaledVector(u, t)) > 0) {
        const slope = plane.normal.dot(u);
        if (slope >= 0) continue;
        t = -plane.distanceToPoint(o) / slope;
        if (t > along + Math.sqrt(inside)) continue;
      }
      if (t > 0 && t < nearest) {
        nearest = t;
        found = this.slots[n];
      }
    }
    return found;
  }
}
