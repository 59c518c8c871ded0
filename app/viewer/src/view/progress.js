// Drawing a large surface in parts. While the camera moves, each picture has the first triangles of the order (spread.js), as many as were drawn in time before; when it rests,
// picture by picture the others are added, until it is what drawing everything at once gives, and then what is under each pixel is found out in the same way.
import { hitOf } from './surface.js';

const MOVING = 33, RESTING = 120;  // ms that a picture may take
const REST = 150;  // ms without a move are rest
const LEAST = 8000;  // triangles

export class Progress {
  constructor(stage) {
    this.stage = stage;
    this.share = 100000;  // triangles in MOVING ms: what was measured, and before that a guess
    this.state = 'done';  // or 'moving', 'resting', 'numbers'
    this.asked = 0;
    this.moved = 0;  // when the camera did
    this.drawn = 0;
    this.target = null;
    this.known = null;  // of the whole picture: triangle numbers and tags
    this.last = null;  // { triangles, ms } of the last picture while the camera moved
  }
  total() { return this.stage.surface.geometry.getAttribute('position').count / 3; }
  restart() {
    this.stop();
    this.state = 'moving';
    this.moved = performance.now();
    this.ask();
  }
  // Something else is drawn; or has changed, so that nothing is known.
  stop() {
    cancelAnimationFrame(this.asked);
    this.target?.dispose();
    this.target = null;
    this.known = null;
    this.state = 'done';
  }
  ask() { this.asked = requestAnimationFrame(() => this.step()); }
  step() {
    const { stage } = this, total = this.total(), begin = performance.now();
    if (this.state === 'moving') {
      const triangles = Math.min(total, this.share);
      stage.drawSome(0, triangles, true);
      stage.wait();
      const ms = Math.max(1, performance.now() - begin);
      this.last = { triangles, ms };
      // Slowly up and quickly down: what a picture costs besides its triangles is not known.
      this.share = Math.round(Math.max(LEAST, Math.min(total, triangles * Math.max(0.25, Math.min(1.5, MOVING / ms)))));
      this.state = 'resting';
      this.drawn = 0;
    } else if (this.state === 'resting' && begin - this.moved > REST) {
      const count = Math.min(total - this.drawn, Math.max(LEAST, Math.round((this.share * RESTING) / MOVING))), last = this.drawn + count === total;
      stage.drawSome(this.drawn, count, last);
      stage.wait();
      this.drawn += count;
      if (last) {
        stage.onDrawn();
        this.beginNumbers();
      }
    } else if (this.state === 'numbers') {
      const count = Math.min(total - this.drawn, Math.max(LEAST, Math.round((this.share * RESTING) / MOVING))), { width, height } = stage.size();
      this.target = stage.numbersTarget(stage.surface, { width, height, target: this.target, some: [this.drawn, count] });
      stage.wait();
      this.drawn += count;
      if (this.drawn === total) {
        this.known = { width, height, bytes: stage.bytesOf(this.target) };
        this.target = null;
        this.state = 'done';
      }
    }
    if (this.state !== 'done') this.ask();
  }
  beginNumbers() {
    this.state = 'numbers';
    this.drawn = 0;
  }
  // What is at a pixel of the canvas; nothing while that is being found out.
  under(x, y) {
    if (!this.known && this.state === 'done') { this.beginNumbers(); this.ask(); }
    if (!this.known || x < 0 || y < 0 || x >= this.known.width || y >= this.known.height) return null;
    return hitOf(this.known.bytes, 4 * ((this.known.height - 1 - y) * this.known.width + x));
  }
}
