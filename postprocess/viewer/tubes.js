// SPDX-License-Identifier: GPL-3.0-or-later
import * as THREE from "three";

const vertexShader = /* glsl */ `
precision highp float;
in vec3 position; // on a tube of radius 1 along z, from 0 to 1
in vec4 from, to; // ends, radius, value
uniform mat4 modelViewMatrix, projectionMatrix;
out vec3 normal, place;
flat out float value;
void main() {
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
      uniforms: { ramp: { value: this.texture }, clip: { value: new THREE.Vector4() } },
    });
    this.mesh = new THREE.Mesh(new THREE.InstancedBufferGeometry(), this.material);
    this.mesh.frustumCulled = false;
    this.mesh.visible = false;
    this.capacity = 0;
    this.makeRoom(16);
  }

  makeRoom(count) {
    if (count <= this.capacity) return;
    this.capacity = Math.ceil(1.2 * count);
    const shape = new THREE.CylinderGeometry(1, 1, 1, 10, 1, true).rotateX(Math.PI / 2).translate(0, 0, 0.5);
    const geometry = new THREE.InstancedBufferGeometry();
    geometry.setAttribute("position", shape.getAttribute("position"));
    geometry.setIndex(shape.getIndex());
    for (const name of ["from", "to"]) geometry.setAttribute(name, new THREE.InstancedBufferAttribute(new Float32Array(4 * this.capacity), 4));
    this.mesh.geometry.dispose();
    this.mesh.geometry = geometry;
  }

  /** Draws these: each from a point to a point, with a radius and a value from 0 to 1. */
  draw(tubes) {
    this.makeRoom(tubes.length);
    const { from, to } = this.mesh.geometry.attributes;
    tubes.forEach(({ a, b, radius, value }, n) => {
      from.array.set([...a, radius], 4 * n);
      to.array.set([...b, value], 4 * n);
    });
    this.mesh.geometry.instanceCount = tubes.length;
    this.mesh.visible = tubes.length > 0;
    from.needsUpdate = to.needsUpdate = true;
  }
}
