// The canvas: draws when something has changed, one picture or two beside each other, and tells what is under a pixel. Of a large surface a part is drawn while the camera
// moves, as much as there is time for, and everything when it rests; two pictures beside each other are always drawn as a whole.
import * as THREE from 'three';
import { Glare } from './glare.js';
import { Progress } from './progress.js';
import { AT_ONCE, Draw, hitOf, Only } from './surface.js';

THREE.ColorManagement.enabled = false;

const NOTHING = new THREE.Color(1, 1, 1);

export class Stage {
  constructor(canvas, onDrawn, smooth) {
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: smooth, preserveDrawingBuffer: true });
    this.renderer.outputColorSpace = THREE.LinearSRGBColorSpace;
    this.renderer.autoClear = false;
    this.canvas = canvas;
    this.onDrawn = onDrawn;
    this.scene = new THREE.Scene();
    this.surface = null;  // what is coloured; `whole` has the triangles uncut
    this.whole = null;
    this.marks = new THREE.Group();
    this.scene.add(this.marks);
    this.background = new THREE.Color('#ffffff');
    this.halves = null;  // of two pictures { only, glare }: which triangles, and whether what is lacking is marked
    this.glare = new Glare();
    this.camera = null;
    this.asked = false;
    this.progress = new Progress(this);
    new ResizeObserver(() => {
      const { width, height } = this.size(), now = this.renderer.getSize(new THREE.Vector2());
      if (now.x !== width || now.y !== height) this.draw();
    }).observe(canvas.parentElement);
  }
  show(surface, whole) {
    for (const old of new Set([this.surface, this.whole])) {
      if (!old) continue;
      old.geometry.dispose();
      old.material.dispose();
      old.removeFromParent();
    }
    this.surface = surface;
    this.whole = whole;
    for (const mesh of new Set([surface, whole])) if (mesh) { mesh.frustumCulled = false; this.scene.add(mesh); }
  }
  size() {
    const parent = this.canvas.parentElement;
    return { width: Math.max(1, parent.clientWidth), height: Math.max(1, parent.clientHeight) };
  }
  // The rectangles of the pictures, from the upper left corner.
  pictures() {
    const { width, height } = this.size();
    if (!this.halves) return [{ x: 0, y: 0, width, height }];
    if (width >= height * 0.9) {
      const half = Math.floor(width / 2);
      return [{ x: 0, y: 0, width: half, height }, { x: half, y: 0, width: width - half, height }];
    }
    const half = Math.floor(height / 2);
    return [{ x: 0, y: 0, width, height: half }, { x: 0, y: half, width, height: height - half }];
  }
  isLarge() { return !this.halves && this.surface !== null && this.surface.geometry.getAttribute('position').count > 3 * AT_ONCE; }
  // Only the camera has moved.
  move() {
    if (this.isLarge()) this.progress.restart();
    else this.draw();
  }
  draw() {
    this.progress.stop();
    if (this.asked) return;
    this.asked = true;
    requestAnimationFrame(() => { this.asked = false; this.drawNow(); });
  }
  fitCanvas() {
    const { width, height } = this.size(), ratio = Math.min(2, window.devicePixelRatio || 1);
    if (this.renderer.getPixelRatio() !== ratio) this.renderer.setPixelRatio(ratio);
    const now = this.renderer.getSize(new THREE.Vector2());
    if (now.x !== width || now.y !== height) this.renderer.setSize(width, height, false);
    this.renderer.setRenderTarget(null);
    return { height, ratio };
  }
  // All of it.
  drawNow() {
    this.progress.stop();
    const { height, ratio } = this.fitCanvas();
    this.pictures().forEach((r, i) => {
      const lower = height - r.y - r.height, half = this.halves?.[i];
      const numbers = half?.glare ? this.numbersTarget(this.whole, { width: Math.round(r.width * ratio), height: Math.round(r.height * ratio), aspect: r.width / r.height }) : null;
      this.into(r, lower);
      this.renderer.setClearColor(this.background, 1);
      this.renderer.clear();
      if (!this.camera) return;
      this.only(half ? this.whole : this.surface);
      if (half) this.whole.material.uniforms.only.value = half.only;
      this.prepareMarks(r, true);
      this.renderer.render(this.scene, this.camera.get(r.width / r.height));
      if (numbers) {
        this.glare.draw(this.renderer, numbers, [r.x * ratio, lower * ratio], this.whole.material.uniforms);
        numbers.dispose();
      }
    });
    if (this.halves) this.whole.material.uniforms.only.value = Only.all;
    this.onDrawn();
  }
  // Some triangles of the surface in their order, over what is there already unless they are the first. Translucent bodies are painted once, over everything.
  drawSome(from, count, bodies) {
    this.fitCanvas();
    const [r] = this.pictures();
    this.into(r, 0);
    this.renderer.setClearColor(this.background, 1);
    if (from === 0) this.renderer.clear();
    this.only(this.surface);
    this.prepareMarks(r, bodies);
    this.surface.geometry.setDrawRange(3 * from, 3 * count);
    this.renderer.render(this.scene, this.camera.get(r.width / r.height));
    this.surface.geometry.setDrawRange(0, Infinity);
    this.prepareMarks(r, true);
  }
  into(r, lower) {
    this.renderer.setScissorTest(true);
    this.renderer.setViewport(r.x, lower, r.width, r.height);
    this.renderer.setScissor(r.x, lower, r.width, r.height);
  }
  prepareMarks(r, bodies) {
    this.marks.traverse((part) => {
      part.material?.resolution?.set(r.width, r.height);
      if (part.userData.below) part.visible = this.camera.state.distance < part.userData.below;
      if (part.material?.transparent) part.material.visible = bodies;
    });
  }
  // Until what was asked for is drawn; else a browser only queues it.
  wait() {
    const gl = this.renderer.getContext();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
  }
  only(mesh) {
    for (const other of [this.surface, this.whole]) if (other) other.visible = other === mesh;
  }
  // Triangle numbers and tags in place of colours, of `width` times `height` pixels or one of them; `colours`: what standing in the cell draws. With `target` and
  // `some` (first triangle, how many) these triangles are added to it.
  numbersTarget(mesh, { width, height, aspect = width / height, listed = false, pixel = null, colours = false, target = null, some = [0, Infinity] }) {
    const into = target ?? new THREE.WebGLRenderTarget(pixel ? 1 : width, pixel ? 1 : height, { minFilter: THREE.NearestFilter, magFilter: THREE.NearestFilter });
    const uniforms = mesh.material.uniforms, old = { mode: uniforms.mode.value, only: uniforms.only.value };
    uniforms.mode.value = colours ? Draw.stand : Draw.numbers;
    uniforms.only.value = listed ? Only.listed : Only.all;
    const marks = this.marks.visible;
    this.marks.visible = false;
    this.only(mesh);
    const camera = this.camera.get(aspect);
    if (pixel) camera.setViewOffset(width, height, pixel.x, pixel.y, 1, 1);
    this.renderer.setScissorTest(false);
    this.renderer.setRenderTarget(into);
    this.renderer.setClearColor(NOTHING, 1);
    if (!target) this.renderer.clear();
    mesh.geometry.setDrawRange(3 * some[0], 3 * some[1]);
    this.renderer.render(this.scene, camera);
    mesh.geometry.setDrawRange(0, Infinity);
    if (pixel) camera.clearViewOffset();
    this.renderer.setRenderTarget(null);
    uniforms.mode.value = old.mode;
    uniforms.only.value = old.only;
    this.marks.visible = marks;
    return into;
  }
  // The same as bytes, from below.
  numbers(mesh, wanted) {
    return this.bytesOf(this.numbersTarget(mesh, wanted));
  }
  bytesOf(target) {
    const bytes = new Uint8Array(4 * target.width * target.height);
    this.renderer.readRenderTargetPixels(target, 0, 0, target.width, target.height, bytes);
    target.dispose();
    return bytes;
  }
  // What is under the pointer. Of a large surface this is known a little after the picture is there, and until then nothing is.
  hover(x, y) { return this.isLarge() ? this.progress.under(Math.floor(x), Math.floor(y)) : this.pick(x, y); }
  // What is at a place of the canvas, in pixels of the page.
  pick(x, y) {
    if (!this.surface || !this.camera) return null;
    const r = this.pictures().find((p) => x >= p.x && x < p.x + p.width && y >= p.y && y < p.y + p.height);
    if (!r) return null;
    const mesh = this.halves ? this.whole : this.surface;
    const pixel = { x: Math.floor(x - r.x), y: Math.floor(y - r.y) };
    return hitOf(this.numbers(mesh, { width: r.width, height: r.height, pixel }));
  }
}
