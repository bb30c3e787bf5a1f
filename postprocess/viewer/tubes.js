// SPDX-License-Identifier: GPL-3.0-or-later
import * as THREE from "three";
import { fetchRecord, Records, repeated } from "./records.js";

const SIDES = 8;

const vertexShader = /* glsl */ `
precision highp float;
precision highp int;
uniform highp sampler2D froms, tos; // one end and the radius, the other end and the value
uniform mat4 modelViewMatrix, projectionMatrix;
out vec3 normal, place;
flat out float value;
${fetchRecord}
void main() {
  int tube = gl_VertexID / ${2 * SIDES};
  int vertex = gl_VertexID % ${2 * SIDES};
  vec4 from = record(froms, tube), to = record(tos, tube);
  float turn = float(vertex / 2) * ${((2 * Math.PI) / SIDES).toFixed(6)};
  vec3 position = vec3(cos(turn), sin(turn), float(vertex % 2));
  vec3 along = to.xyz - from.xyz;
  vec3 axis = normalize(along + vec3(0.0, 0.0, 1e-12));
  vec3 side = normalize(cross(axis, abs(axis.z) < 0.9 ? vec3(0.0, 0.0, 1.0) : vec3(1.0, 0.0, 0.0)));
  vec3 out_of = position.x * side + position.y * cross(axis, side);
  vec4 seen = modelViewMatrix * vec4(from.xyz + position.z * along + from.w * out_of, 1.0);
  normal = (modelViewMatrix * vec4(out_of, 0.0)).xyz;
  place = seen.xyz;
  value = to.w;
  gl_Position = projectionMatrix * seen;
}`;

const fragmentShader = /* glsl */ `
precision highp float;
in vec3 normal, place;
flat in float value;
uniform sampler2D ramp;
uniform vec4 clip;
out vec4 colour;
void main() {
  if (dot(clip.xyz, place) + clip.w > 0.0) discard;
  vec3 base = texture(ramp, vec2(clamp(value, 0.002, 0.998), 0.5)).rgb;
  float key = max(dot(normalize(normal), vec3(-0.45, 0.65, 0.61)), 0.0);
  colour = vec4(base * (0.6 + 0.5 * key), 1.0);
}`;

/** Straight tubes from point to point: force chains, the way of a grain. */
export class Tubes {
  constructor(rampBytes) {
    this.texture = new THREE.DataTexture(rampBytes, 256, 1);
    this.texture.needsUpdate = true;
    this.material = new THREE.RawShaderMaterial({
      glslVersion: THREE.GLSL3,
      vertexShader,
      fragmentShader,
      uniforms: { ramp: { value: this.texture }, clip: { value: new THREE.Vector4() }, froms: { value: null }, tos: { value: null } },
      side: THREE.DoubleSide,
    });
    this.mesh = new THREE.Mesh(new THREE.BufferGeometry(), this.material);
    this.mesh.frustumCulled = false;
    this.mesh.visible = false;
    this.capacity = 0;
    this.makeRoom(16);
  }

  makeRoom(count) {
    if (count <= this.capacity) return;
    this.capacity = Math.ceil(1.2 * count);
    const sides = Array.from({ length: SIDES }, (_, k) => [2 * k, 2 * ((k + 1) % SIDES)]);
    this.mesh.geometry.dispose();
    this.mesh.geometry = repeated(sides.flatMap(([a, b]) => [a, b, b + 1, a, b + 1, a + 1]), 2 * SIDES, this.capacity);
    for (const name of ["froms", "tos"]) {
      this[name]?.dispose();
      this[name] = new Records(this.capacity);
      this.material.uniforms[name].value = this[name].texture;
    }
  }

  /** Draws these: each from a point to a point, with a radius and a value from 0 to 1. */
  draw(tubes) {
    this.makeRoom(tubes.length);
    tubes.forEach(({ a, b, radius, value }, n) => {
      this.froms.array.set([...a, radius], 4 * n);
      this.tos.array.set([...b, value], 4 * n);
    });
    this.mesh.geometry.setDrawRange(0, 6 * SIDES * tubes.length);
    this.mesh.visible = tubes.length > 0;
    this.froms.changed();
    this.tos.changed();
  }
}
