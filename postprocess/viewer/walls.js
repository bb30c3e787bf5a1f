// SPDX-License-Identifier: GPL-3.0-or-later
import * as THREE from "three";

/** Faces that are clear where one looks straight at them and denser along their edges, as of glass. */
function glass(planes, colour) {
  return new THREE.ShaderMaterial({
    vertexShader: `#include <clipping_planes_pars_vertex>
varying vec3 place;
void main() {
  vec4 mvPosition = modelViewMatrix * vec4(position, 1.0);
  place = mvPosition.xyz;
  gl_Position = projectionMatrix * mvPosition;
  #include <clipping_planes_vertex>
}`,
    fragmentShader: `#include <clipping_planes_pars_fragment>
uniform vec3 colour;
varying vec3 place;
void main() {
  #include <clipping_planes_fragment>
  vec3 normal = normalize(cross(dFdx(place), dFdy(place)));
  float facing = abs(dot(normal, normalize(place)));
  gl_FragColor = vec4(colour, mix(0.26, 0.07, facing));
}`,
    uniforms: { colour: { value: colour } },
    clipping: true,
    clippingPlanes: planes,
    transparent: true,
    depthWrite: false,
    side: THREE.DoubleSide,
  });
}

/** The walls: translucent faces with their rims and sharp edges. They stand, move and go with the run. */
export class Walls {
  constructor() {
    this.group = new THREE.Group();
    this.walls = [];
    this.planes = [];
    this.face = glass(this.planes, new THREE.Vector3(0.5, 0.57, 0.66));
    this.edge = new THREE.LineBasicMaterial({ color: 0x29303a, transparent: true, opacity: 0.5, clippingPlanes: this.planes, depthWrite: false });
  }

  setColours(face, edge) {
    this.face.uniforms.colour.value.fromArray(face);
    this.edge.color.setRGB(...edge);
  }

  /** @param box beyond which, as a plane may be very large, walls are cut off */
  async load(recording, toStage, box) {
    for (const wall of this.walls) wall.object.traverse((one) => one.geometry?.dispose());
    this.group.clear();
    this.walls = [];
    this.planes.length = 0;
    const beyond = 0.12 * box.getSize(new THREE.Vector3()).length();
    for (const axis of ["x", "y", "z"])
      for (const sign of [1, -1]) {
        const normal = new THREE.Vector3().setComponent("xyz".indexOf(axis), sign);
        this.planes.push(new THREE.Plane(normal, beyond - sign * (sign > 0 ? box.min[axis] : box.max[axis])));
      }
    for (const data of recording.data.walls) {
      const corners = await recording.floats(data.blob);
      const placed = new Float32Array(corners.length);
      for (let i = 0; i < corners.length; ++i) placed[i] = toStage.point(corners[i], i % 3);
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute("position", new THREE.BufferAttribute(placed, 3));
      const object = new THREE.Group();
      object.add(new THREE.Mesh(geometry, this.face));
      object.add(new THREE.LineSegments(new THREE.EdgesGeometry(geometry, 20), this.edge));
      object.children.forEach((one) => (one.frustumCulled = false));
      const poses = data.poses ? await recording.floats(data.poses) : null;
      object.matrixAutoUpdate = false;
      this.group.add(object);
      this.walls.push({ data, object, poses });
    }
    this.toStage = toStage;
  }

  /** Puts every wall where it is at a time, on the way f from frame k to the next. */
  move(time, k, f) {
    for (const { data, object, poses } of this.walls) {
      const stands = data.spans.some(([from, to]) => time >= from - 1e-9 && (to === null || time < to));
      const pose = poses ? this.pose(poses, k, f) : null;
      object.visible = stands || pose !== null;
      if (pose) object.matrix.copy(pose);
    }
  }

  /** The motion from a wall's first place; nothing where it is not there. */
  pose(poses, k, f) {
    const read = (n) => (12 * n + 12 <= poses.length && poses[12 * n] === poses[12 * n] ? poses.subarray(12 * n, 12 * n + 12) : null);
    const here = read(k);
    const next = read(k + 1) ?? here;
    if (!here) return f < 0.5 ? null : next && this.matrix(next);
    const [a, b] = [this.matrix(here), this.matrix(next)];
    const parts = [a, b].map((one) => {
      const part = { place: new THREE.Vector3(), turn: new THREE.Quaternion(), size: new THREE.Vector3() };
      one.decompose(part.place, part.turn, part.size);
      return part;
    });
    return new THREE.Matrix4().compose(parts[0].place.lerp(parts[1].place, f), parts[0].turn.slerp(parts[1].turn, f), parts[0].size);
  }

  matrix(pose) {
    // x → R x + t in metres; on the stage s(x) = scale x + shift, so s → R s + (scale t + shift − R shift)
    const { length, shiftOfMetres: shift } = this.toStage;
    const rows = [0, 1, 2].map((row) => {
      const turn = [0, 1, 2].map((column) => pose[3 * row + column]);
      const rest = length * pose[9 + row] + shift[row] - turn.reduce((sum, one, column) => sum + one * shift[column], 0);
      return [...turn, rest];
    });
    return new THREE.Matrix4().set(...rows[0], ...rows[1], ...rows[2], 0, 0, 0, 1);
  }
}
