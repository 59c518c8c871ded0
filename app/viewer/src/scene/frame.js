// Where a scene is drawn: doubles of any size are moved to a ball of radius 1 around the origin before they become floats.
export class Frame {
  constructor(mesh, cell) {
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    const take = (p, at) => {
      for (let k = 0; k < 3; ++k) {
        if (p[at + k] < low[k]) low[k] = p[at + k];
        if (p[at + k] > high[k]) high[k] = p[at + k];
      }
    };
    for (const corner of mesh.triangles) take(mesh.points, 3 * corner);
    for (const p of cell) take(p, 0);
    this.centre = low.map((x, k) => x / 2 + high[k] / 2);
    const half = low.map((x, k) => high[k] / 2 - x / 2), most = Math.max(...half);
    this.radius = most > 0 ? most * Math.hypot(...half.map((x) => x / most)) : 1;
    if (!Number.isFinite(this.radius)) this.radius = most;
  }
  local(p) { return [0, 1, 2].map((k) => (p[k] - this.centre[k]) / this.radius); }
  world(p) { return [0, 1, 2].map((k) => p[k] * this.radius + this.centre[k]); }
  // All points of a mesh, three floats each.
  locals(points) {
    const out = new Float32Array(points.length), [x, y, z] = this.centre, r = this.radius;
    for (let i = 0; i < points.length; i += 3) {
      out[i] = (points[i] - x) / r;
      out[i + 1] = (points[i + 1] - y) / r;
      out[i + 2] = (points[i + 2] - z) / r;
    }
    return out;
  }
}
