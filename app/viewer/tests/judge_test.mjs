// Rendering as a judge: from viewpoints in the cell the picture of the list is the picture of everything, pixel by pixel. A pixel that differs is cast anew in doubles
// (src/view/stand.js), for graphics processors round corners to parts of a pixel. With one visible triangle taken out of the list it must be noticed.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { close, clues, CLUES_SOURCE, drop, file, LONG, read, withPage } from './support.mjs';

const SCENES = LONG ? 20 : 3, VIEWPOINTS = LONG ? 100 : 3, SIZE = 160;

let cases = [];
before(() => {
  clues(0, 'view', '-o', 'judge.html');
  clues(0, 'conform', '--suite', join(CLUES_SOURCE, 'vectors'), '--export', 'scenes');
  // Those with most triangles among the solid cells of the suite, of at least three that are seen.
  cases = JSON.parse(read('scenes/cases.json')).cases.sort((a, b) => b.triangles - a.triangles || (a.id < b.id ? -1 : 1));
});
after(close);

// All six directions from so many viewpoints.
const look = (page, viewpoints, start) => page.evaluate(([count, first, size]) => {
  const sum = { pictures: 0, pixels: 0, surface: 0, differ: 0, real: 0, missing: [], seen: [] };
  cluesView.setView('stand');
  cluesView.camera.perspective.fov = 90;
  for (let i = 0; i < count; ++i) {
    cluesView.stand((first + i) % 100);
    for (const [yaw, pitch] of [[0, 0], [1.5708, 0], [3.1416, 0], [-1.5708, 0], [0, 1.5], [0, -1.5]]) {
      Object.assign(cluesView.camera.state, { yaw, pitch });
      const c = cluesView.compare(size, size, Infinity);
      ++sum.pictures;
      for (const key of ['pixels', 'surface', 'differ', 'real']) sum[key] += c[key];
      sum.missing.push(...c.missing);
      sum.seen.push(...c.seen);
    }
  }
  sum.missing = [...new Set(sum.missing)];
  sum.seen = [...new Set(sum.seen)];
  return sum;
}, [viewpoints, start, SIZE]);

test(`${SCENES} scenes, ${VIEWPOINTS} viewpoints each`, { timeout: 3600000 }, async () => {
  const total = { scenes: 0, pictures: 0, pixels: 0, surface: 0, differ: 0, real: 0 };
  let noticed = 0;
  for (const c of cases) {
    if (total.scenes >= SCENES) break;
    const scene = `scenes/${c.scene}`, name = `${c.id}.clues.json`;
    clues(0, 'map', scene, '--cell', join('scenes', c.cell), '--mode', c.mode, '-o', name);
    const result = JSON.parse(read(name));
    const flat = [0, 1, 2].some((k) => new Set(result.cell.vertices.map((p) => p[k])).size < 2);
    if (flat || c.mode !== 'sheet' || result.visible.length < 3) continue;
    const open = (list, run) => withPage('judge.html', async (page) => {
      await drop(page, { name: c.scene, content: readFileSync(file(scene)) }, { name, content: JSON.stringify({ ...result, visible: list }) });
      await page.waitForSelector('body[data-drawn]');
      return run(page);
    }, { picture: false });
    const sound = await open(result.visible, (page) => look(page, VIEWPOINTS, 0));
    if (sound.surface === 0) continue;
    assert.equal(sound.real, 0, `${c.id}: a list that is sound lacks triangles ${sound.missing}`);
    ++total.scenes;
    if (LONG || sound.differ > 0) console.log(`${c.id}: ${c.triangles} triangles, ${sound.differ} of ${sound.surface} pixels of surface differ, ${sound.real} missing`);
    for (const key of ['pictures', 'pixels', 'surface', 'differ', 'real']) total[key] += sound[key];
    // The triangle that takes the most to notice is not known; any that is seen must do.
    const gone = sound.seen.filter((t) => result.visible.includes(t))[0];
    const other = await open(result.visible.filter((t) => t !== gone), (page) => look(page, VIEWPOINTS, 0));
    assert(other.differ > sound.differ, `${c.id}: nobody misses triangle ${gone}`);
    if (other.missing.includes(gone)) ++noticed;
  }
  console.log(JSON.stringify({ ...total, noticed }));
  assert.equal(total.scenes, SCENES);
  assert(noticed > 0);
});
