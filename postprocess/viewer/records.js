// SPDX-License-Identifier: GPL-3.0-or-later
import * as THREE from "three";

const WIDTH = 512; // of the texture

/** GLSL to read record n of a texture of records. */
export const fetchRecord = /* glsl */ `
vec4 record(highp sampler2D records, int n) {
  return texelFetch(records, ivec2(n % ${WIDTH}, n / ${WIDTH}), 0);
}`;

/** Four numbers for each of many things, which a shader reads by their index. */
export class Records {
  constructor(capacity) {
    const height = Math.max(1, Math.ceil(capacity / WIDTH));
    this.array = new Float32Array(4 * WIDTH * height);
    this.texture = new THREE.DataTexture(this.array, WIDTH, height, THREE.RGBAFormat, THREE.FloatType);
  }

  changed() {
    this.texture.needsUpdate = true;
  }

  dispose() {
    this.texture.dispose();
  }
}

/**
 * Triangles of many equal things, without a number for a vertex: a shader finds by gl_VertexID which vertex of which
 * thing it is. One call draws all: drawn as instances, 10 000 of them took more than twice as long without a graphics card.
 * @param triangles of one thing, as numbers of its vertices
 */
export function repeated(triangles, vertices, capacity) {
  const index = new Uint32Array(triangles.length * capacity);
  for (let n = 0; n < capacity; ++n) for (let k = 0; k < triangles.length; ++k) index[n * triangles.length + k] = n * vertices + triangles[k];
  const geometry = new THREE.BufferGeometry();
  geometry.setIndex(new THREE.BufferAttribute(index, 1));
  return geometry;
}
