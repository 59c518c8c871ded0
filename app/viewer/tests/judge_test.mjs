// Rendering as a judge: from viewpoints in the cell the picture of the list is the picture of everything, pixel by pixel and without a tolerance. What is listed is drawn alike in
// both, to the last bit of number and colour; where a triangle that is not listed won a pixel, exact rays decide (src/view/stand.js says why that happens). With one visible
// triangle taken out of the list it must be noticed.
//
// CLUES_LEVELS: a folder with levels (*.bsp) for the long form; without it, and in the short form, two small ones of the corpus are taken.
import assert from 'node:assert/strict';
import { copyFileSync, readdirSync, readFileSync, rmSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { close, clues, CLUES_SOURCE, drop, file, LONG, read, withPage, write } from './support.mjs';

// Half of the scenes are of the suite, half are made here.
const SCENES = LONG ? 20 : 4, VIEWPOINTS = LONG ? 100 : 2, SIZE = 160, LEVELS = 2, CELLS = LONG ? 3 : 1;

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
  const sum = { pictures: 0, pixels: 0, surface: 0, differ: 0, unequal: 0, real: 0, coloured: 0, missing: [], seen: [] }, seen = new Map();
  cluesView.setView('stand');
  cluesView.camera.perspective.fov = 90;
  // Triangles that fill a block of 3 by 3 pixels of the picture: not slivers, which are drawn where no ray through the middle of a pixel meets them.
  const blocks = () => {
    const bytes = new Uint32Array(cluesView.stage.numbers(cluesView.stage.whole, { width: size, height: size }).buffer), found = new Set();
    for (let i = size; i + size + 3 <= bytes.length; ++i)
      if (i % size <= size - 3 && [-size, 0, size].every((row) => [0, 1, 2].every((k) => bytes[i + row + k] === bytes[i]))) found.add(bytes[i] & 0xffffff);
    return found;
  };
  // Colours of both pictures, where everything shows what is listed, or nothing.
  const colours = () => {
    const draw = (words) => new Uint32Array(cluesView.stage.numbers(cluesView.stage.whole, { width: size, height: size, ...words }).buffer);
    const numbers = draw({}), all = draw({ colours: true }), list = draw({ colours: true, listed: true });
    numbers.forEach((bytes, i) => {
      if (bytes >>> 24 !== 255 && ((bytes >>> 24) & 64) === 0) return;
      ++sum.coloured;
      if (all[i] !== list[i]) ++sum.unequal;
    });
  };
  const directions = [[0, 0], [1.5708, 0], [3.1416, 0], [-1.5708, 0], [0, 1.5], [0, -1.5]];
  for (let i = 0; i < count && !(stop && sum.real > 0); ++i) {
    cluesView.stand(i);
    for (const [yaw, pitch] of count > 10 ? [directions[i % 6], directions[(i + 3) % 6]] : directions) {
      Object.assign(cluesView.camera.state, { yaw, pitch });
      const c = cluesView.compare(size, size, Infinity);
      ++sum.pictures;
      for (const key of ['pixels', 'surface', 'differ', 'unequal', 'real']) sum[key] += c[key];
      if (i < 10 && !stop) colours();
      sum.missing.push(...c.missing);
      const filled = stop ? new Set() : blocks();
      for (const [t, n] of c.seen) if (filled.has(t)) seen.set(t, Math.max(seen.get(t) ?? 0, n));
    }
  }
  sum.missing = [...new Set(sum.missing)];
  sum.seen = [...seen];
  return sum;
}, [viewpoints, SIZE, until]);

const KEYS = ['pictures', 'pixels', 'surface', 'differ', 'unequal', 'real', 'coloured'];

// What the page shows now: its list is judged, and then without one triangle. `isListed` and `putOut` (of the list, or back) speak of triangles; `tries`:
// how many may be in vain. Returns sums, or null where nothing is large enough to be seen.
async function judge(page, name, isListed, putOut, tries = 1) {
  const sound = await look(page, VIEWPOINTS);
  if (sound.surface === 0) return null;
  if (LONG || sound.differ > 0) console.log(`${name}: ${sound.differ} of ${sound.surface} pixels of surface are drawn differently, ${sound.real} differ`);
  assert.equal(sound.unequal, 0, `${name}: what is listed is drawn in two ways`);
  assert(sound.coloured > 0);
  assert.equal(sound.real, 0, `${name}: a list that is sound lacks triangles ${sound.missing}`);
  const seen = sound.seen.filter(([t]) => isListed(t)).sort((a, b) => a[1] - b[1] || a[0] - b[0]);
  if (seen.length === 0) return null;
  // Levels have surfaces in one place, and then nobody misses one of them: another one is tried.
  for (const [gone] of seen.slice(0, tries)) {
    await putOut(gone, true);
    const other = await look(page, VIEWPOINTS, true);
    await putOut(gone, false);
    if (other.real > 0 && other.missing.includes(gone)) return sound;
    console.log(`${name}: nobody misses triangle ${gone}`);
  }
  return assert.fail(`${name}: nobody misses what is taken out`);
}

test(`${SCENES} scenes, ${VIEWPOINTS} viewpoints each`, { timeout: 7200000 }, () => withPage('judge.html', async (page) => {
  const total = { scenes: 0, ...Object.fromEntries(KEYS.map((key) => [key, 0])) };
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
    const sound = await judge(page, `${c.id}, ${result.scene.triangles} triangles, ${result.visible.length} listed`, (t) => result.visible.includes(t),
      (t, out) => page.evaluate(([gone, how]) => { cluesView.list().data.listed[how](gone); cluesView.paint(); }, [t, out ? 'delete' : 'add']));
    if (!sound) continue;
    ++total.scenes;
    for (const key of KEYS) total[key] += sound[key];
  }
  console.log(JSON.stringify(total));
  assert.equal(total.scenes, SCENES);
}, { picture: false }));

test(`${LEVELS} levels, the leaves of each, ${VIEWPOINTS} viewpoints in each of ${CELLS}`, { timeout: 7200000 }, async () => {
  const own = join(CLUES_SOURCE, 'fuzz/corpus/bsp'), folder = LONG && process.env.CLUES_LEVELS ? process.env.CLUES_LEVELS : own;
  const levels = folder === own ? ['two_rooms.bsp', 'slanted.bsp'] : readdirSync(folder).filter((name) => name.endsWith('.bsp')).sort().slice(0, LEVELS);
  assert.equal(levels.length, LEVELS);
  for (const level of levels) {
    copyFileSync(join(folder, level), file(level));
    if (folder === own) rmSync(file(`${level}.bake`), { force: true });
    clues(0, 'bake', level, '--cells', 'leaves', '-o', `${level}.bake`);
    clues(0, 'view', `${level}.bake`, '-o', `${level}.html`);
    await withPage(`${level}.html`, async (page) => {
      const total = { cells: 0, ...Object.fromEntries(KEYS.map((key) => [key, 0])) }, count = await page.evaluate(() => cluesView.stepper().data.cells.length);
      for (let i = 0; i < count && total.cells < CELLS; ++i) {
        const listed = await page.evaluate((cell) => {
          const part = cluesView.stepper();
          part.data.path = [cell];
          cluesView.setStep(0);
          return [...Array(part.scene.triangles).keys()].filter((t) => part.kind.listed(part, t));
        }, i);
        if (listed.length < 3) continue;
        const sound = await judge(page, `${level}, cell ${i}, ${listed.length} listed`, (t) => listed.includes(t),
          (t) => page.evaluate((gone) => { const part = cluesView.stepper(); part.data.cells[part.data.path[0]].bits[gone >> 3] ^= 1 << (gone & 7); cluesView.paint(); }, t), 5);
        if (!sound) continue;
        ++total.cells;
        for (const key of KEYS) total[key] += sound[key];
      }
      console.log(`${level}: ${JSON.stringify(total)}`);
      assert(total.cells > 0, 'no cell of the level sees anything');
    });
  }
});
