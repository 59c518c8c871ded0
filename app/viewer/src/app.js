// The state of the page, and what changes it. The panels (ui/) and the tests speak to this.
import * as THREE from 'three';
import { counts } from './files/mesh_bytes.js';
import { Workspace } from './files/workspace.js';
import { Frame } from './scene/frame.js';
import { along, cross, length, middle, minus, toTriangle } from './scene/vectors.js';
import { Camera } from './view/camera.js';
import { LABELS, LAYER_COLOURS, NUMBER } from './view/labels.js';
import { dots, hull, lines, loop, release } from './view/marks.js';
import { regionSurface } from './view/regions.js';
import { Stage } from './view/stage.js';
import { compare, nearest, viewpoint } from './view/stand.js';
import { Draw, Only, surfaceMaterial, wholeSurface } from './view/surface.js';

const MOST_GRAZING = 4;

export class App {
  constructor(canvas, changed, smooth = true) {
    this.workspace = new Workspace();
    this.camera = new Camera();
    this.changed = changed;
    this.stage = new Stage(canvas, () => this.changed('drawn'), smooth);
    this.case = null;
    this.view = 'map';
    this.colourBy = 'map';
    this.layers = [];
    this.switched = new Map();  // layers that the user switched
    this.away = new Set();  // labels whose surface is not drawn
    this.triangle = null;
    this.alone = false;
    this.shading = true;
    this.hatching = true;
    this.viewpoint = 0;
    this.glare = true;
    this.comparison = null;
    this.dark = false;
    this.flight = 0;
    this.playing = 0;  // the timer that goes through the steps
  }

  async open(files) {
    const before = this.case, flaws = await this.workspace.add(files);
    const again = before && this.workspace.cases.findIndex((c) => c.scene === before.scene && c.parts[0] === before.parts[0]);
    const cases = this.workspace.cases;
    const best = cases.findIndex((c) => c.parts.length > 0);
    if (cases.length > 0) this.choose(again > 0 ? again : Math.max(0, best), before !== null && again === 0);
    this.changed('files');
    return flaws;
  }

  choose(index, keepCamera = false) {
    const c = this.workspace.cases[index];
    this.case = c;
    this.triangle = null;
    this.alone = false;
    this.viewpoint = 0;
    this.comparison = null;
    this.stop();
    this.frame = c.scene ? new Frame(c.scene.mesh, this.able('steps').reduce((all, p) => all.concat(p.kind.extent?.(p) ?? []), c.cell)) : null;
    this.colourBy = this.regions() || !this.has('label') ? 'map' : this.colourings()[0]?.id ?? 'map';
    const open = this.views().map((v) => v.id);
    if (!open.includes(this.view)) this.view = open[0];
    if (!c.scene) {
      this.stage.show(null, null);
      this.stage.camera = null;
    } else {
      this.whole = null;
      this.stage.camera = this.camera;
      this.followStep();
      this.paint();
      this.changed('room');
      if (!keepCamera) this.fit();
    }
    this.mark();
    this.setView(this.view);
  }

  // What the parts of the case can do.
  able(what) { return this.case ? this.case.parts.filter((p) => p.kind[what]) : []; }
  has(what) { return this.able(what).length > 0; }
  regions() { return this.able('regions').map((p) => p.kind.regions(p)).find((r) => r) ?? null; }
  colourings() {
    const out = this.able('label').map((p) => ({ id: p.kind.id, name: p.kind.name ?? p.kind.id, part: p }));
    if (this.regions()) out.unshift({ id: 'map', name: 'the map', part: null });
    return out;
  }
  // What a label is called here: labels that stand for a measure, by the part.
  nameOf(label) {
    for (const part of this.able('names')) { const name = part.kind.names(part)[label]; if (name) return name; }
    return LABELS[NUMBER[label]].name;
  }
  list() { return this.able('listed')[0] ?? null; }
  // What does not count is in no list, and no list lacks it.
  listed = (t) => { const part = this.list(); return part && counts(this.case.scene.mesh, t) ? part.kind.listed(part, t) : true; };
  stepper() { return this.able('steps').find((p) => p.kind.view.id === this.view) ?? this.able('steps')[0] ?? null; }
  views() {
    const out = [];
    if (this.case?.scene && !this.has('meshAt')) out.push({ id: 'map', name: 'Map' });
    for (const part of this.able('view')) out.push(part.kind.view);
    if (this.case?.scene && this.list() && this.case.cell.length > 0) out.push({ id: 'stand', name: 'Stand in the cell' });
    if (this.has('rows')) out.push({ id: 'verdicts', name: 'Verdicts' });
    return out;
  }

  paint() {
    const { mesh } = this.case.scene;
    const old = this.whole;
    this.whole = new THREE.Mesh(wholeSurface(mesh, this.frame, this.labelOf(), this.listed), surfaceMaterial(THREE.DoubleSide));
    let coloured = this.whole;
    const regions = this.regions(), own = this.able('surface').find((p) => p.kind.id === this.colourBy);
    const surface = own?.kind.surface(own, this.frame, this.listed);
    if (surface) coloured = new THREE.Mesh(surface, surfaceMaterial(own.kind.meshAt ? THREE.DoubleSide : THREE.FrontSide, surface.hasAttribute('chart')));
    else if (regions && this.colourBy === 'map') coloured = new THREE.Mesh(regionSurface(mesh, this.frame, regions, this.case.cell, this.listed), surfaceMaterial(THREE.FrontSide));
    if (old && old !== this.stage.whole) old.geometry.dispose();
    this.stage.show(coloured, this.whole);
    this.uniforms();
  }
  labelOf() {
    const chosen = this.colourings().find((c) => c.id === this.colourBy)?.part ?? this.able('label')[0];
    return chosen ? (t) => NUMBER[chosen.kind.label(chosen, t)] : () => NUMBER.none;
  }
  uniforms() {
    for (const mesh of new Set([this.stage.surface, this.stage.whole])) {
      if (!mesh) continue;
      const u = mesh.material.uniforms, ratio = Math.min(2, window.devicePixelRatio || 1);
      u.shading.value = this.shading ? 1 : 0;
      u.hatching.value = this.hatching ? 1 : 0;
      u.patternSize.value = 9 * ratio;
      u.alone.value = this.alone && this.triangle !== null ? this.triangle : -1;
      u.hidden.value = LABELS.map((label) => (this.view !== 'stand' && this.away.has(label.id) ? 1 : 0));
      u.mode.value = this.view === 'stand' ? Draw.stand : Draw.colours;
      u.solid.value = mesh === this.stage.whole && this.case.parts.some((p) => p.mode === 'solid') ? 1 : 0;
    }
    this.stage.draw();
  }

  corners(t) {
    const { points, triangles } = this.case.scene.mesh;
    return [0, 1, 2].map((k) => [...points.subarray(3 * triangles[3 * t + k], 3 * triangles[3 * t + k] + 3)]);
  }
  facts(t) { return this.able('facts').flatMap((p) => p.kind.facts(p, t, this.corners(t))); }

  // Where one is among cells, frames or levels.
  setStep(at) {
    const part = this.stepper();
    if (!part) return;
    part.at = Math.max(0, Math.min(part.kind.steps(part) - 1, at));
    if (this.colourBy !== part.kind.id && this.colourings().some((c) => c.id === part.kind.id)) this.colourBy = part.kind.id;
    this.followStep();
    if (part.kind.meshAt) { this.triangle = null; this.alone = false; }
    this.paint();
    if (this.view === 'stand') this.stand(this.viewpoint);
    this.mark();
    this.changed('state');
  }
  followStep() {
    const { scene } = this.case;
    for (const part of this.able('steps')) {
      if (part.kind.meshAt) scene.mesh = part.kind.meshAt(part);
      if (part.kind.cellAt) this.case.cell = part.kind.cellAt(part);
    }
    const eye = this.stepper()?.kind.eyeAt?.(this.stepper());
    if (this.view !== 'stand') {
      this.camera.eye = eye ? this.frame.local(eye) : null;
      this.camera.near = 1e-4;
    }
    this.locals = this.frame.locals(scene.mesh.points);
  }
  play() {
    const part = this.stepper();
    if (this.playing || !part) { this.stop(); return; }
    if (part.at + 1 >= part.kind.steps(part)) part.at = -1;
    this.playing = setInterval(() => {
      this.setStep(part.at + 1);
      if (part.at + 1 >= part.kind.steps(part)) this.stop();
    }, 250);
    this.changed('state');
  }
  stop() {
    clearInterval(this.playing);
    this.playing = 0;
    this.changed('state');
  }

  // Everything that is drawn besides the surface.
  mark() {
    for (const old of [...this.stage.marks.children]) release(old);
    this.layers = [];
    if (!this.case?.scene) return;
    const ink = this.dark ? '#f2f2f2' : '#101014', { frame } = this;
    if (this.case.cell.length > 0)
      this.layers.push({ id: 'cell', name: 'view cell', colour: LAYER_COLOURS.cell, on: true, make: () => hull(frame, this.case.cell, LAYER_COLOURS.cell) });
    for (const part of this.able('layers')) this.layers.push(...part.kind.layers(part, frame));
    for (const layer of this.layers) {
      layer.on = this.switched.get(layer.id) ?? layer.on;
      if (layer.on && this.view !== 'stand') this.stage.marks.add(layer.make(ink));
    }
    if (this.triangle !== null) {
      const corners = this.corners(this.triangle);
      this.stage.marks.add(lines(frame, loop(corners), ink, 3.5, { over: true }), lines(frame, loop(corners), this.dark ? '#101014' : '#ffffff', 1.2, { over: true }));
      for (const fact of this.facts(this.triangle)) {
        for (const l of fact.lines ?? []) this.stage.marks.add(lines(frame, l.pairs, l.colour, l.width, { over: true }));
        if (fact.ends) this.stage.marks.add(dots(frame, fact.ends, ink, 7));
      }
      if (this.view === 'verdicts')
        for (const t of this.grazing()) this.stage.marks.add(lines(frame, loop(this.corners(t)), '#e69f00', 2.2, { over: true }));
    }
    this.stage.draw();
  }
  switchLabels(ids, on) {
    for (const id of ids) this.away[on ? 'delete' : 'add'](id);
    this.uniforms();
    this.changed('state');
  }
  switchLayer(id, on) {
    this.switched.set(id, on);
    this.mark();
    this.changed('state');
  }

  select(t) {
    this.triangle = t !== null && t < this.case.scene.mesh.triangles.length / 3 ? t : null;
    if (this.triangle === null) this.alone = false;
    this.row = null;
    this.mark();
    this.uniforms();
    this.changed('state');
  }
  setAlone(on) {
    this.alone = on && this.triangle !== null;
    this.uniforms();
    this.changed('state');
  }

  // The triangles that the sight line of the chosen row passes closest, other than the one it ends on.
  grazing() {
    const sight = this.row?.sight;
    if (!sight) return [];
    const [v, p] = sight.map((x) => this.frame.local(x)), { triangles } = this.case.scene.mesh, best = [];
    for (let t = 0; t < triangles.length / 3; ++t) {
      if (t === this.triangle) continue;
      const found = toTriangle(v, p, [0, 1, 2].map((k) => this.locals.subarray(3 * triangles[3 * t + k], 3 * triangles[3 * t + k] + 3)));
      if (found.at > 0.001 && found.at < 0.999) best.push({ t, distance: found.distance });
      if (best.length > 64) { best.sort((a, b) => a.distance - b.distance); best.length = MOST_GRAZING; }
    }
    return best.sort((a, b) => a.distance - b.distance).slice(0, MOST_GRAZING).map((g) => g.t);
  }

  // From the cell along the sight line to the triangle.
  showRow(row) {
    if (row.goto && !this.case.parts.some((p) => p.data === row.goto)) {
      this.choose(this.workspace.cases.findIndex((c) => c.parts.some((p) => p.data === row.goto)));
      this.setView('verdicts');
      this.changed('files');
      row = this.able('rows').flatMap((p) => p.kind.rows(p)).find((r) => r.name === row.name) ?? row;
    }
    if (row.triangle === null || row.triangle === undefined || !this.case.scene) return;
    this.triangle = row.triangle;
    this.row = row;
    this.mark();
    this.uniforms();
    const corners = this.corners(row.triangle).map((p) => this.frame.local(p)), centre = middle(corners);
    const size = Math.max(...corners.map((p) => length(minus(p, centre)))) || 0.1;
    if (!row.sight) {
      this.flyTo({ ...this.camera.state, target: centre, distance: Math.max(4 * size, 0.05) });
    } else {
      const [v, p] = row.sight.map((x) => this.frame.local(x)), far = length(minus(p, v)), look = this.camera.angles(minus(p, v));
      const start = { ...look, target: p, distance: far, flat: false };
      // A little aside in the end, so that the line is not seen as a point.
      const end = { ...start, yaw: look.yaw + 0.16, pitch: Math.min(1.5, look.pitch + 0.1), distance: Math.max(Math.min(far * 0.75, Math.max(5 * size, far * 0.25)), 1e-4) };
      this.flyTo(start, () => this.flyTo(end));
    }
    this.changed('state');
  }

  // For a page that holds this one: a row of a file, or its first.
  showRowOf(file, name) {
    const at = this.workspace.cases.findIndex((c) => c.parts.some((p) => p.file === file));
    if (at < 0) return;
    this.choose(at);
    this.setView('verdicts');
    this.changed('files');
    const rows = this.able('rows').filter((p) => p.file === file).flatMap((p) => p.kind.rows(p));
    this.showRow(rows.find((r) => r.name === name) ?? rows[0]);
  }

  // Moves the camera; at once for who wants no motion.
  flyTo(goal, then = () => {}) {
    const from = { ...this.camera.state, target: [...this.camera.state.target] }, flight = ++this.flight, begin = performance.now();
    const time = matchMedia('(prefers-reduced-motion: reduce)').matches ? 0 : 700;
    let turn = goal.yaw - from.yaw;
    turn -= 2 * Math.PI * Math.round(turn / (2 * Math.PI));
    const step = () => {
      if (flight !== this.flight) return;
      const t = time === 0 ? 1 : Math.min(1, (performance.now() - begin) / time), s = t * t * (3 - 2 * t);
      this.camera.state = {
        target: along(from.target, goal.target, s), distance: from.distance * (goal.distance / from.distance) ** s,
        yaw: from.yaw + turn * s, pitch: from.pitch + (goal.pitch - from.pitch) * s, flat: goal.flat,
      };
      this.stage.move();
      if (t < 1) requestAnimationFrame(step);
      else { this.changed('camera'); then(); }
    };
    step();
  }
  stopFlight() { ++this.flight; }

  // From the cell to the middle of what is listed, or of everything.
  fromCell() {
    const cell = this.frame.local(middle(this.case.cell)), count = this.case.scene.mesh.triangles.length / 3, some = [];
    for (let t = 0; t < count && some.length < 2000; ++t) if (this.listed(t)) some.push(middle(this.corners(t).map((p) => this.frame.local(p))));
    const v = minus(some.length > 0 ? middle(some) : [0, 0, 0], cell);
    return length(v) > 1e-6 ? v : [0.55, 0.83, 0];
  }
  // All of the scene, from the cell's side.
  fit() {
    this.stopFlight();
    const look = this.camera.angles(this.case.cell.length > 0 ? this.fromCell() : [0.55, 0.83, 0]);
    // From above; unless the cell looks up or down at it, then more as the cell does.
    const pitch = Math.abs(look.pitch) > 0.7 ? Math.sign(look.pitch) * 0.95 : 0.6;
    const { width, height } = this.stage.size();
    this.camera.state = { target: [0, 0, 0], distance: 1, yaw: look.yaw + 0.35, pitch, flat: false };
    this.camera.state.distance = this.camera.distanceFor([this.whole.geometry.getAttribute('position').array, this.case.cell.flatMap((p) => this.frame.local(p)), this.able('extent').flatMap((p) => p.kind.extent(p).flatMap((x) => this.frame.local(x)))], width / height);
    this.stage.draw();
    this.changed('camera');
  }
  // The chosen triangle from straight before it, without perspective.
  straight(back = false) {
    if (this.triangle === null) return;
    const corners = this.corners(this.triangle).map((p) => this.frame.local(p)), centre = middle(corners);
    const n = cross(minus(corners[1], corners[0]), minus(corners[2], corners[0]));
    const size = Math.max(...corners.map((p) => length(minus(p, centre)))) || 0.1;
    this.flyTo({ ...this.camera.angles(back ? n : n.map((x) => -x)), target: centre, distance: size * 2.9, flat: true });
  }
  setUp(up) {
    this.camera.up = up;
    if (this.case?.scene) this.fit();
    this.setView(this.view);
  }
  setFlat(flat) {
    this.camera.state.flat = flat;
    this.stage.draw();
    this.changed('camera');
  }

  setView(id) {
    if (!this.views().some((v) => v.id === id)) return;
    const before = this.view;
    this.view = id;
    this.comparison = null;
    // The table of verdicts comes with their colours, the map with its own.
    const ofView = this.able('view').find((p) => p.kind.view.id === id)?.kind.id, own = new Set(this.able('view').map((p) => p.kind.id));
    const fitting = this.colourings().find((c) => (ofView ? c.id === ofView : !own.has(c.id) && (id === 'verdicts') === (c.id !== 'map' && c.id !== 'result')));
    if (before !== id && id !== 'stand' && fitting && this.case.scene && this.colourBy !== fitting.id) {
      this.colourBy = fitting.id;
      this.paint();
    }
    if (id === 'stand') {
      this.stage.halves = [{ only: Only.listed, glare: this.glare }, { only: Only.all, glare: false }];
      this.stand(this.viewpoint, true);
    } else {
      this.stage.halves = null;
      this.camera.eye = null;
      if (this.case.scene) this.followStep();
    }
    this.mark();
    this.uniforms();
    this.changed('state');
  }
  // At a viewpoint of the cell; `face`: turned to where most of the scene is.
  stand(index, face = false) {
    this.viewpoint = index;
    const eye = this.frame.local(viewpoint(this.case.cell, index));
    if (face) {
      Object.assign(this.camera.state, this.camera.angles(this.fromCell()));
      this.camera.perspective.fov = 75;
    }
    this.camera.eye = eye;
    this.camera.near = nearest(this.locals, this.case.scene.mesh.triangles, eye);
    this.comparison = null;
    this.stage.draw();
    this.changed('state');
  }
  setGlare(on) {
    this.glare = on;
    if (this.stage.halves) this.stage.halves[0].glare = on;
    this.stage.draw();
    this.changed('state');
  }
  compare(width = 0, height = 0, most = undefined) {
    const r = this.stage.pictures()[0];
    this.comparison = compare(this.stage, {
      width: width || Math.round(r.width), height: height || Math.round(r.height), mesh: this.case.scene.mesh, listed: this.listed, most,
      solid: this.case.parts.some((p) => p.mode === 'solid'), eye: viewpoint(this.case.cell, this.viewpoint),
    });
    this.stage.draw();
    return this.comparison;
  }
  setColours(id) {
    this.colourBy = id;
    this.paint();
    this.mark();
    this.changed('state');
  }
  setTheme(dark) {
    this.dark = dark;
    document.documentElement.dataset.theme = dark ? 'dark' : 'light';
    this.stage.background.set(dark ? '#17181c' : '#f4f5f7');
    this.mark();
    this.stage.draw();
    this.changed('state');
  }
}
