// SPDX-License-Identifier: GPL-3.0-or-later
import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { rampBytes } from "./colours.js";
import { Spheres } from "./spheres.js";
import { Tubes } from "./tubes.js";
import { Walls } from "./walls.js";

THREE.ColorManagement.enabled = false; // colours are those of the screen, from the ramp to the pixel

const SIZE = 10; // of what is seen, on the stage
const TANGENT = 0.23; // of half the angle of view
export const FIRST_VIEW = { azimuth: -73, elevation: 13 }; // degrees, as in run_page/still.py
const LOWEST = 0.4; // pixels drawn for a pixel of the page, while things move on a slow machine
const ROUNDING = 12; // of the canvas's corners [px]; drawn here, as a style sheet's cost a fifth of a picture without a graphics card
const SLOW = 45; // ms that a picture may take

const onto = {
  vertexShader: `out vec2 at; void main() { at = uv; gl_Position = vec4(position.xy, 0.0, 1.0); }`,
  // Darkens what lies behind its neighbours: an outline at every jump in depth, and shade in the crevices.
  fragmentShader: `
uniform sampler2D colour, depth;
uniform vec2 pixel;
uniform float near, far, grain, reach;
uniform bool fine;
uniform vec2 size; // of the canvas in pixels of the page
uniform float rounding; // of its corners, in the same
uniform vec3 page; // what is seen outside them
in vec2 at;
out vec4 shown;
float away(vec2 where) {
  return near * far / (far - texture(depth, where).r * (far - near));
}
float behind(float here, vec2 step) {
  return clamp((here - away(at + step)) / grain, 0.0, 1.0);
}
void main() {
  vec3 seen = texture(colour, at).rgb;
  if (texture(depth, at).r < 1.0) {
    float here = away(at);
    float jump = behind(here, vec2(pixel.x, 0.0)) + behind(here, vec2(-pixel.x, 0.0)) + behind(here, vec2(0.0, pixel.y)) + behind(here, vec2(0.0, -pixel.y));
    float shade = 0.16 * jump;
    if (fine) {
      vec2 far_step = reach * pixel / here;
      float wide = 0.0;
      for (int k = 0; k < 8; ++k) {
        float turn = 0.7854 * float(k) + 0.39;
        wide += behind(here, far_step * vec2(cos(turn), sin(turn)) * (k % 2 == 0 ? 1.0 : 0.55));
      }
      shade += 0.075 * wide;
    } else {
      shade += 0.12 * jump;
    }
    seen *= exp(-shade);
  }
  vec2 beyond = max(abs(at - 0.5) * size - 0.5 * size + rounding, 0.0);
  shown = vec4(mix(seen, page, rounding > 0.0 ? clamp(length(beyond) - rounding + 0.5, 0.0, 1.0) : 0.0), 1.0);
}`,
};

/** The box around what a run shows [m]: grains, and walls that are not much larger. */
export function boxOf(data) {
  const boxFrom = ([low, high]) => new THREE.Box3(new THREE.Vector3(...low), new THREE.Vector3(...high));
  const box = boxFrom(data.frames.box);
  const size = box.getSize(new THREE.Vector3()).length();
  for (const wall of data.walls) {
    const ofWall = boxFrom(wall.box);
    if (ofWall.getSize(new THREE.Vector3()).length() <= 2 * size) box.union(ofWall);
  }
  return box;
}

/** Where the grains are drawn: a canvas, a camera that the user turns, and what stands there. */
export class Stage {
  /** @param changed is called when the view has been changed by the user */
  constructor(canvas, changed) {
    this.canvas = canvas;
    this.changed = changed;
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: false, powerPreference: "high-performance" });
    this.renderer.outputColorSpace = THREE.LinearSRGBColorSpace;
    this.renderer.localClippingEnabled = true;
    this.scene = new THREE.Scene();
    this.camera = new THREE.PerspectiveCamera((2 * Math.atan(TANGENT) * 180) / Math.PI, 1, 0.1, 100);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = false;
    this.controls.zoomToCursor = true;
    this.controls.addEventListener("change", () => {
      this.stir();
      this.changed?.();
    });
    this.spheres = new Spheres();
    this.walls = new Walls();
    this.chains = new Tubes(rampBytes("sand"));
    this.path = new Tubes(rampBytes("viridis"));
    this.scene.add(this.spheres.mesh, this.chains.mesh, this.path.mesh, this.walls.group);
    this.target = new THREE.WebGLRenderTarget(1, 1, { depthTexture: new THREE.DepthTexture(1, 1, THREE.UnsignedIntType) });
    this.paper = new THREE.Mesh(new THREE.PlaneGeometry(2, 2), new THREE.ShaderMaterial({
      ...onto,
      glslVersion: THREE.GLSL3,
      depthTest: false,
      uniforms: {
        colour: { value: this.target.texture }, depth: { value: this.target.depthTexture }, pixel: { value: new THREE.Vector2() },
        near: { value: 0 }, far: { value: 0 }, grain: { value: 1 }, reach: { value: 1 }, fine: { value: true },
        size: { value: new THREE.Vector2() }, rounding: { value: ROUNDING }, page: { value: new THREE.Vector3() },
      },
    }));
    this.paper.frustumCulled = false;
    this.clip = { axis: "off", at: 0.5, flip: false };
    this.ratio = Math.min(2, window.devicePixelRatio || 1);
    this.box = new THREE.Box3(new THREE.Vector3(-5, -5, -5), new THREE.Vector3(5, 5, 5));
    this.lastStir = 0;
    this.frameTimes = [];
    this.fixedRatio = null; // pixels drawn for a pixel of the page, while a film is recorded
    this.drawn = 0; // pictures so far
  }

  /** Takes a recording. @param box [m] that becomes the middle of the stage */
  async show(recording, box = boxOf(recording.data)) {
    const length = SIZE / Math.max(box.getSize(new THREE.Vector3()).length(), 1e-30);
    const middle = box.getCenter(new THREE.Vector3()).toArray();
    const shiftOfMetres = middle.map((one) => -length * one);
    this.toStage = {
      length,
      scale: length * recording.quantum,
      shift: recording.origin.map((one, axis) => length * (one - middle[axis])),
      shiftOfMetres,
      point: (metres, axis) => length * metres + shiftOfMetres[axis],
    };
    this.metres = (point) => point.toArray().map((one, axis) => (one - shiftOfMetres[axis]) / length);
    this.box.min.fromArray(box.min.toArray().map((one, axis) => this.toStage.point(one, axis)));
    this.box.max.fromArray(box.max.toArray().map((one, axis) => this.toStage.point(one, axis)));
    this.recording = recording;
    this.meanRadius = recording.meanRadius * length;
    await this.walls.load(recording, this.toStage, this.box);
    this.stir();
  }

  setScheme({ back, page, face, edge }) {
    this.paper.material.uniforms.page.value.fromArray(page);
    this.renderer.setClearColor(new THREE.Color().setRGB(...back), 1);
    this.walls.setColours(face, edge);
    this.stir();
  }

  /** Looks from a direction, in degrees, with everything in the picture. */
  lookFrom({ azimuth, elevation }) {
    const [a, e] = [azimuth, elevation].map(THREE.MathUtils.degToRad);
    const towards = new THREE.Vector3(Math.cos(e) * Math.cos(a), Math.cos(e) * Math.sin(a), Math.sin(e));
    const up = Math.abs(elevation) > 89.9 ? new THREE.Vector3(0, 1, 0) : new THREE.Vector3(0, 0, 1);
    const right = new THREE.Vector3().crossVectors(up, towards).normalize();
    const above = new THREE.Vector3().crossVectors(towards, right);
    const middle = this.box.getCenter(new THREE.Vector3());
    let distance = 0;
    for (let corner = 0; corner < 8; ++corner) {
      const point = new THREE.Vector3(...["x", "y", "z"].map((axis, k) => this.box[corner & (1 << k) ? "max" : "min"][axis])).sub(middle);
      const across = Math.max(Math.abs(point.dot(right)) / this.camera.aspect, Math.abs(point.dot(above))) / TANGENT;
      distance = Math.max(distance, across + point.dot(towards));
    }
    this.controls.target.copy(middle);
    this.camera.position.copy(middle).addScaledVector(towards, 1.08 * distance);
    this.controls.update();
    this.isHome = true;
  }

  /** The view as numbers: azimuth and elevation [degrees], distance [m], the point looked at [m]. */
  get view() {
    const off = this.camera.position.clone().sub(this.controls.target);
    const distance = off.length();
    return [THREE.MathUtils.radToDeg(Math.atan2(off.y, off.x)), THREE.MathUtils.radToDeg(Math.asin(off.z / distance)),
      distance / this.toStage.length, ...this.metres(this.controls.target)];
  }

  set view([azimuth, elevation, distance, ...target]) {
    const [a, e] = [azimuth, elevation].map(THREE.MathUtils.degToRad);
    this.controls.target.fromArray(target.map((one, axis) => this.toStage.point(one, axis)));
    this.camera.position.set(Math.cos(e) * Math.cos(a), Math.cos(e) * Math.sin(a), Math.sin(e)).multiplyScalar(distance * this.toStage.length).add(this.controls.target);
    this.controls.update();
    this.isHome = false;
  }

  turn(right, up) {
    const off = this.camera.position.clone().sub(this.controls.target);
    const round = new THREE.Spherical().setFromVector3(new THREE.Vector3(off.x, off.z, -off.y));
    round.theta += right;
    round.phi = Math.min(Math.PI - 0.01, Math.max(0.01, round.phi - up));
    const turned = new THREE.Vector3().setFromSpherical(round);
    this.camera.position.copy(this.controls.target).add(new THREE.Vector3(turned.x, -turned.z, turned.y));
    this.controls.update();
  }

  zoom(factor) {
    this.camera.position.sub(this.controls.target).multiplyScalar(factor).add(this.controls.target);
    this.controls.update();
  }

  /** The plane above which all is cut away, on the stage; nothing where nothing is. */
  get plane() {
    const axis = "xyz".indexOf(this.clip.axis);
    if (axis < 0) return null;
    const [low, high] = [this.box.min, this.box.max].map((corner) => corner.getComponent(axis));
    const sign = this.clip.flip ? -1 : 1;
    const at = low + this.clip.at * (high - low);
    return new THREE.Plane(new THREE.Vector3().setComponent(axis, sign), -sign * at);
  }

  /** A pixel of the page as a ray from the eye. */
  ray(x, y) {
    const frame = this.canvas.getBoundingClientRect();
    const at = new THREE.Vector2((2 * (x - frame.left)) / frame.width - 1, 1 - (2 * (y - frame.top)) / frame.height);
    const caster = new THREE.Raycaster();
    caster.setFromCamera(at, this.camera);
    return caster.ray;
  }

  pick(x, y) {
    return this.spheres.pick(this.ray(x, y), this.plane);
  }

  /** Something is to be drawn anew. */
  stir() {
    this.dirty = true;
    this.isFine = false;
    this.lastStir = performance.now();
  }

  /** Called for every picture of the screen; draws if there is something new, and once more, finely, when all is at rest. */
  tick(now, moving) {
    this.fit();
    const sinceLast = now - (this.lastTick ?? now);
    this.lastTick = now;
    if (this.fixedRatio) {
      if (this.dirty || moving) this.draw(this.fixedRatio, true, 0);
    } else if (this.dirty || moving) {
      this.learn(sinceLast);
      this.draw(this.ratio, this.ratio >= 1);
      this.isFine = false;
    } else if (!this.isFine && now - this.lastStir > 220) {
      this.draw(Math.max(this.ratio, Math.min(2, 2 * (window.devicePixelRatio || 1))), true);
      this.isFine = true;
    }
    this.wasMoving = this.dirty || moving;
    this.dirty = false;
  }

  /** Finds how many pixels this machine can draw while things move. */
  learn(milliseconds) {
    if (!this.wasMoving || milliseconds > 1000) return;
    this.frameTimes.push(milliseconds);
    if (this.frameTimes.length < 5) return;
    const mean = this.frameTimes.reduce((sum, one) => sum + one) / this.frameTimes.length;
    this.frameTimes.length = 0;
    const most = Math.min(2, window.devicePixelRatio || 1);
    if (mean > SLOW) this.ratio = Math.max(LOWEST, this.ratio * Math.max(0.7, Math.sqrt((0.8 * SLOW) / mean)));
    else if (mean < 0.55 * SLOW) this.ratio = Math.min(most, this.ratio * 1.12);
  }

  /** Gives the camera the shape of the canvas. */
  fit() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (!width || !height || (width === this.width && height === this.height)) return;
    Object.assign(this, { width, height });
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    if (this.isHome) this.lookFrom(this.home);
    this.stir();
  }

  home = FIRST_VIEW;

  /** @param rounding of the corners [px] */
  draw(ratio, fine, rounding = ROUNDING) {
    if (!this.width) return;
    const width = Math.max(2, Math.round(ratio * this.width));
    const height = Math.max(2, Math.round(ratio * this.height));
    if (this.target.width !== width || this.target.height !== height) {
      this.renderer.setPixelRatio(1);
      this.renderer.setSize(width, height, false);
      this.target.setSize(width, height);
    }
    const middle = this.box.getCenter(new THREE.Vector3());
    const distance = this.camera.position.distanceTo(middle);
    this.camera.near = Math.max(0.02, distance - 1.2 * SIZE);
    this.camera.far = distance + 1.2 * SIZE;
    this.camera.updateProjectionMatrix();
    this.camera.updateMatrixWorld();
    const clip = this.spheres.material.uniforms.clip.value;
    const { plane } = this;
    if (plane) {
      plane.applyMatrix4(this.camera.matrixWorldInverse);
      clip.set(plane.normal.x, plane.normal.y, plane.normal.z, plane.constant);
    } else {
      clip.set(0, 0, 0, 0);
    }
    this.chains.material.uniforms.clip.value.copy(clip);
    this.renderer.setRenderTarget(this.target);
    this.renderer.render(this.scene, this.camera);
    this.renderer.setRenderTarget(null);
    const { uniforms } = this.paper.material;
    uniforms.pixel.value.set(1.1 / width, 1.1 / height);
    uniforms.near.value = this.camera.near;
    uniforms.far.value = this.camera.far;
    uniforms.grain.value = 2.5 * this.meanRadius;
    uniforms.reach.value = (1.5 * this.meanRadius * height) / (2 * TANGENT);
    uniforms.fine.value = fine;
    uniforms.size.value.set(this.width, this.height);
    uniforms.rounding.value = rounding;
    this.renderer.render(this.paper, this.camera);
    ++this.drawn;
  }

  dispose() {
    this.controls.dispose();
    this.renderer.dispose();
  }
}
