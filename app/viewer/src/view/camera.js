// Where one looks from. Around a target, or (standing) about a fixed eye; either way a few numbers, which are the permalink.
import * as THREE from 'three';

const LIMIT = Math.PI / 2 - 1e-3;

export class Camera {
  constructor() {
    this.perspective = new THREE.PerspectiveCamera(45, 1, 0.001, 100);
    this.flat = new THREE.OrthographicCamera(-1, 1, 1, -1, -20, 20);
    this.up = 'z';
    this.state = { target: [0, 0, 0], distance: 3, yaw: 0.7, pitch: 0.5, flat: false };
    this.eye = null;  // standing there, if not null
    this.near = 1e-4;
  }
  // The direction in which one looks.
  direction({ yaw, pitch } = this.state) {
    const [a, b, c] = [Math.cos(pitch) * Math.cos(yaw), Math.cos(pitch) * Math.sin(yaw), -Math.sin(pitch)];
    return this.up === 'z' ? [a, b, c] : [a, c, -b];
  }
  // Turned so that one looks along the vector.
  angles(v) {
    const [x, y, z] = this.up === 'z' ? v : [v[0], -v[2], v[1]], size = Math.hypot(x, y, z) || 1;
    const pitch = Math.max(-LIMIT, Math.min(LIMIT, -Math.asin(z / size)));
    return { yaw: Math.hypot(x, y) > 1e-9 * size ? Math.atan2(y, x) : this.state.yaw, pitch };
  }
  place() {
    if (this.eye) return this.eye;
    const d = this.direction();
    return this.state.target.map((x, k) => x - d[k] * this.state.distance);
  }
  // How far from the target one has to be to see all of these places (lists of coordinates), with a little room around them.
  distanceFor(lists, aspect) {
    const camera = this.get(aspect), high = Math.tan((22.5 * Math.PI) / 180) * 0.92, [r, a, d] = [new THREE.Vector3(), new THREE.Vector3(), this.direction()];
    camera.matrixWorld.extractBasis(r, a, new THREE.Vector3());
    let far = 1e-3;
    for (const places of lists) {
      for (let i = 0; i < places.length; i += 3) {
        const [x, y, z] = [places[i], places[i + 1], places[i + 2]], along = x * d[0] + y * d[1] + z * d[2];
        far = Math.max(far, Math.abs(x * r.x + y * r.y + z * r.z) / (high * aspect) - along, Math.abs(x * a.x + y * a.y + z * a.z) / high - along);
      }
    }
    return far;
  }
  turn(dx, dy) {
    this.state.yaw -= dx;
    this.state.pitch = Math.max(-LIMIT, Math.min(LIMIT, this.state.pitch + dy));
  }
  zoom(factor) {
    if (this.eye) this.perspective.fov = Math.max(5, Math.min(120, this.perspective.fov * factor));
    else this.state.distance = Math.max(1e-5, Math.min(50, this.state.distance * factor));
  }
  // Moves the target along the picture; 1 is its height.
  slide(dx, dy) {
    if (this.eye) return;
    const camera = this.get(1), right = new THREE.Vector3(), above = new THREE.Vector3();
    camera.matrixWorld.extractBasis(right, above, new THREE.Vector3());
    const size = 2 * this.state.distance * Math.tan((22.5 * Math.PI) / 180);
    this.state.target = this.state.target.map((x, k) => x + size * (-dx * right.getComponent(k) + dy * above.getComponent(k)));
  }
  get(aspect) {
    const camera = this.state.flat && !this.eye ? this.flat : this.perspective;
    const eye = this.place(), d = this.direction();
    camera.up.set(0, this.up === 'y' ? 1 : 0, this.up === 'z' ? 1 : 0);
    camera.position.set(...eye);
    camera.lookAt(...eye.map((x, k) => x + d[k]));
    if (camera === this.flat) {
      const half = this.state.distance * Math.tan((22.5 * Math.PI) / 180);
      Object.assign(camera, { left: -half * aspect, right: half * aspect, top: half, bottom: -half });
    } else {
      const far = Math.hypot(...eye) + 8;
      camera.aspect = aspect;
      if (!this.eye) camera.fov = 45;
      camera.near = this.eye ? this.near : Math.max(this.state.distance * 0.002, Math.hypot(...eye) - 3, 1e-5);
      camera.far = Math.max(far, camera.near * 10);
    }
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld();
    return camera;
  }
  write() {
    const s = this.state, number = (x) => String(Number(x.toPrecision(7)));
    return [...s.target, s.distance, s.yaw, s.pitch].map(number).join() + (s.flat ? ',flat' : '');
  }
  read(text) {
    const words = text.split(','), numbers = words.slice(0, 6).map(Number);
    if (numbers.length < 6 || !numbers.every(Number.isFinite) || !(numbers[3] > 0)) return false;
    this.state = { target: numbers.slice(0, 3), distance: numbers[3], yaw: numbers[4], pitch: numbers[5], flat: words[6] === 'flat' };
    return true;
  }
}
