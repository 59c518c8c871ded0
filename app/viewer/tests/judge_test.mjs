// Rendering as a judge: from viewpoints in the cell the picture of the list is the picture of everything, pixel by pixel. A pixel that differs is cast anew in doubles
// (src/view/stand.js), for graphics processors round corners to parts of a pixel. With one visible triangle taken out of the list it must be noticed.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { close, clues, CLUES_SOURCE, drop, file, LONG, read, withPage, write } from './support.mjs';

// Half of the scenes are of the suite, half are made here.
const SCENES = LONG ? 20 : 4, VIEWPOINTS = LONG ? 100 : 2, SIZE = 160;

let cases = [];
before(() => {
  clues(0, 'view', '-o', 'judge.html');
  clues(0, 'conform', '--suite', join(CLUES_SOURCE, 'vectors'), '--export', 'scenes');
  const suite = JSON.parse(read('scenes/cases.json')).cases.filter((c) => c.mode === 'sheet').sort((a, b) => b.triangles - a.triangles || (a.id < b.id ? -1 : 1))
    .map((c) => ({ id: c.id, scene: `scenes/${c.scene}`, words: ['--cell', join('scenes', c.cell)] }));
  const made = [...Array(SCENES / 2).keys()].map((i) => makeBlocks(i + 1));
  cases = [...made, ...suite];
});
after(close);

// Boxes and leaning boards on a ground, around a cell; the same for the same seed. Every other one by the fast kernel, and larger.
function makeBlocks(seed) {
  let state = seed;
  const random = () => { state = (state * 48271) % 2147483647; return state / 2147483647; };
  const lines = [], fast = seed % 2 === 0;
  const quads = (corners, faces) => { const base = lines.filter((l) => l[0] === 'v').length; lines.push(...corners.map((p) => `v ${p.join(' ')}`), ...faces.map((f) => `f ${f.map((c) => base + c + 1).join(' ')}`)); };
  quads([[-20, -20, 0], [20, -20, 0], [20, 20, 0], [-20, 20, 0]], [[0, 1, 2, 3]]);
  for (let i = 0; i < (fast ? 24 : 7); ++i) {
    const angle = random() * 6.2832, far = 4 + 14 * random(), [x, y] = [far * Math.cos(angle), far * Math.sin(angle)], [w, d, h] = [0.5 + 2 * random(), 0.5 + 2 * random(), 1 + 6 * random()];
    const corner = (i2) => [x + (i2 & 1 ? w : 0), y + (i2 & 2 ? d : 0), i2 & 4 ? h : 0];
    if (i % 3 < 2) quads([0, 1, 2, 3, 4, 5, 6, 7].map(corner), [[0, 1, 5, 4], [1, 3, 7, 5], [3, 2, 6, 7], [2, 0, 4, 6], [4, 5, 7, 6]]);
    else quads([[x, y, 0.2], [x + w, y + d, 0.3], [x + w + random(), y + d - random(), h], [x + random(), y, h]], [[0, 1, 2], [0, 2, 3]]);
  }
  write(`blocks-${seed}.obj`, lines.join('\n'));
  return { id: `blocks-${seed}`, scene: `blocks-${seed}.obj`, words: ['--cell', 'box:-1,-0.5,1,1,0.5,2', '--kernel', fast ? 'fast' : 'exact'] };
}

// From so many viewpoints: all six directions from few of them, two each from many. `until`: something is missed.
const look = (page, viewpoints, until = false) => page.evaluate(([count, size, stop]) => {
  const sum = { pictures: 0, pixels: 0, surface: 0, differ: 0, real: 0, missing: [], seen: [] }, seen = new Map();
  cluesView.setView('stand');
  cluesView.camera.perspective.fov = 90;
  const directions = [[0, 0], [1.5708, 0], [3.1416, 0], [-1.5708, 0], [0, 1.5], [0, -1.5]];
  for (let i = 0; i < count && !(stop && sum.real > 0); ++i) {
    cluesView.stand(i);
    for (const [yaw, pitch] of count > 10 ? [directions[i % 6], directions[(i + 3) % 6]] : directions) {
      Object.assign(cluesView.camera.state, { yaw, pitch });
      const c = cluesView.compare(size, size, Infinity);
      ++sum.pictures;
      for (const key of ['pixels', 'surface', 'differ', 'real']) sum[key] += c[key];
      sum.missing.push(...c.missing);
      for (const [t, n] of c.seen) seen.set(t, Math.max(seen.get(t) ?? 0, n));
    }
  }
  sum.missing = [...new Set(sum.missing)];
  sum.seen = [...seen];
  return sum;
}, [viewpoints, SIZE, until]);

test(`${SCENES} scenes, ${VIEWPOINTS} viewpoints each`, { timeout: 7200000 }, () => withPage('judge.html', async (page) => {
  const total = { scenes: 0, pictures: 0, pixels: 0, surface: 0, differ: 0, real: 0 };
  let noticed = 0;
  for (const c of cases) {
    if (total.scenes >= SCENES) break;
    const { scene } = c, name = `${c.id}.clues.json`;
    clues(0, 'map', scene, ...c.words, '-o', name);
    const result = JSON.parse(read(name));
    const flat = [0, 1, 2].some((k) => new Set(result.cell.vertices.map((p) => p[k])).size < 2);
    if (flat || result.visible.length < 3) continue;
    await drop(page, { name: result.scene.file, content: readFileSync(file(scene)) }, { name, content: read(name) });
    await page.waitForFunction((wanted) => {
      const at = cluesView.workspace.cases.findIndex((one) => one.scene.name === wanted && one.parts.length > 0);
      if (at >= 0) cluesView.choose(at);
      return at >= 0;
    }, result.scene.file);
    const sound = await look(page, VIEWPOINTS);
    if (sound.surface === 0) continue;
    if (LONG || sound.differ > 0) console.log(`${c.id}: ${result.scene.triangles} triangles, ${result.visible.length} listed, ${sound.differ} of ${sound.surface} pixels of surface differ, ${sound.real} missing`);
    assert.equal(sound.real, 0, `${c.id}: a list that is sound lacks triangles ${sound.missing}`);
    ++total.scenes;
    for (const key of ['pictures', 'pixels', 'surface', 'differ', 'real']) total[key] += sound[key];
    // The smallest of those that cover a hundred pixels of some picture, for fewer can be a sliver along an edge; or else the largest.
    const seen = sound.seen.filter(([t]) => result.visible.includes(t)).sort((a, b) => a[1] - b[1] || a[0] - b[0]);
    const [gone] = seen.find(([, n]) => n >= 100) ?? seen.at(-1);
    await page.evaluate((t) => { cluesView.list().data.listed.delete(t); cluesView.paint(); }, gone);
    const other = await look(page, VIEWPOINTS, true);
    assert(other.real > 0 && other.missing.includes(gone), `${c.id}: nobody misses triangle ${gone}`);
    ++noticed;
  }
  console.log(JSON.stringify({ ...total, noticed }));
  assert.equal(total.scenes, SCENES);
}, { picture: false }));
