// Views that are gone through step by step: bakes, transitions, walks and hierarchies, made by the program; and what is not whole of them.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { copyFileSync, readFileSync, rmSync } from 'node:fs';
import { after, before, test } from 'node:test';
import { close, clues, colours, drop, dropped, file, makeTown, read, settled, withPage, write } from './support.mjs';

const CELLS = 'grid:4x2x1:box:0,0,0,12,2,1';
const MADE = ['town.bake', 'town.delta.json', 'town.walk.jsonl', 'ball.maps'];

before(() => {
  makeTown();
  write('boards.obj', boards());
  write('room.obj', room());
  write('ball.off', ball(12));
  for (const old of ['town.bake', 'plain']) rmSync(file(old), { force: true, recursive: true });
  clues(0, 'bake', 'boards.obj', '--cells', CELLS, '--group', '4', '-o', 'town.bake');
  clues(0, 'delta', 'town.obj', '--from', 'box:0,0,1,1,2,2', '--to', 'box:1,0,1,2,2,2', '--fragments', '-o', 'town.delta.json');
  clues(0, 'motion', 'room.obj', '--path', 'walk:-1,0,0:1,0,0', '--frames', '8', '--samples', '300', '--walk-out', 'town.walk.jsonl', '--json', 'walk.json');
  clues(0, 'maps', 'ball.off', '--base', '20', '-o', 'ball.maps');
  for (const name of MADE) clues(0, 'view', name, '-o', `${name}.html`);
  clues(0, 'view', '-o', 'empty.html');
});
after(close);

// Four boards beside the cells, and behind each a small triangle that it hides from the cells nearby.
function boards() {
  const points = [], faces = [];
  for (const x of [1.5, 4.5, 7.5, 10.5]) {
    const a = points.length + 1;
    points.push([x - 1, 4, -5], [x + 1, 4, -5], [x + 1, 4, 5], [x - 1, 4, 5], [x - 0.1, 4.5, 0.4], [x + 0.1, 4.5, 0.4], [x, 4.5, 0.6]);
    faces.push([a, a + 1, a + 2], [a, a + 2, a + 3], [a + 4, a + 5, a + 6]);
  }
  return `${points.map((p) => `v ${p.join(' ')}`).join('\n')}\n${faces.map((f) => `f ${f.join(' ')}`).join('\n')}\n`;
}
// A box from inside, with a board in it.
function room() {
  const corner = (i) => `v ${i & 1 ? 4 : -4} ${i & 2 ? 4 : -4} ${i & 4 ? 4 : -4}`;
  return `${[0, 1, 2, 3, 4, 5, 6, 7].map(corner).join('\n')}\nv 1 2 -1\nv 2 2 -1\nv 2 2 1\nv 1 2 1\n${['1 2 4 3', '5 7 8 6', '1 5 6 2', '3 4 8 7', '1 3 7 5', '2 6 8 4', '9 10 11 12'].map((f) => `f ${f}`).join('\n')}\n`;
}
// A bumpy ball.
function ball(n) {
  const points = [], faces = [], m = 2 * n;
  for (let i = 1; i < n; ++i) {
    for (let j = 0; j < m; ++j) {
      const a = (Math.PI * i) / n, b = (Math.PI * j) / n, r = 1 + 0.15 * Math.sin(3 * b) * Math.sin(a) ** 2;
      points.push([r * Math.sin(a) * Math.cos(b), r * Math.sin(a) * Math.sin(b), r * Math.cos(a)]);
    }
  }
  points.push([0, 0, 1], [0, 0, -1]);
  for (let i = 0; i + 2 < n; ++i) for (let j = 0; j < m; ++j) { const [a, b] = [i * m + j, i * m + ((j + 1) % m)]; faces.push([a, a + m, b + m], [a, b + m, b]); }
  for (let j = 0; j < m; ++j) faces.push([points.length - 2, j, (j + 1) % m], [points.length - 1, (n - 2) * m + ((j + 1) % m), (n - 2) * m + j]);
  return `OFF\n${points.length} ${faces.length} 0\n${points.map((p) => p.join(' ')).join('\n')}\n${faces.map((f) => `3 ${f.join(' ')}`).join('\n')}\n`;
}

const text = (page, selector) => page.textContent(selector);
const slide = async (page, to) => { await page.locator('#step').fill(String(to)); await settled(page); };
const flat = async (page) => { if (await page.isChecked('#shading')) await page.click('#shading'); if (await page.isChecked('#hatching')) await page.click('#hatching'); };
const part = (page, what) => page.evaluate(`(() => { const part = cluesView.stepper(); return ${what}; })()`);

test('a bake: the path through cells, + and -, bytes, the tree', () => withPage('town.bake.html', async (page) => {
  await page.click('#view-bake');
  await settled(page);
  const side = await text(page, '#side');
  for (const words of ['8 cells', 'bytes of +', 'group 1', 'listed in this cell', 'not listed', 'cells, coloured by the length']) assert(side.includes(words), words);
  const count = await part(page, 'part.kind.steps(part)');
  assert.equal(count, 5, 'from one corner of 4 by 2 cells to the other in four steps');
  // What the page says of each step is what the plain lists of the program say.
  clues(0, 'bake', 'boards.obj', '--cells', CELLS, '--group', '4', '-o', 'town.bake', '--export', 'plain');
  const lists = await part(page, 'part.data.cells.map((c) => [...Array(12).keys()].filter((t) => (c.bits[t >> 3] >> (t & 7)) & 1))');
  lists.forEach((list, i) => assert.deepEqual(list, read(`plain/pvs/${i}.txt`).split('\n').filter((l) => /^\d/.test(l)).map(Number), `cell ${i}`));
  const path = await part(page, 'part.data.path');
  let plusses = 0, minuses = 0;
  for (let at = 1; at < count; ++at) {
    await slide(page, at);
    const [a, b] = [lists[path[at - 1]], lists[path[at]]], plus = b.filter((t) => !a.includes(t)).length, minus = a.filter((t) => !b.includes(t)).length;
    assert((await text(page, '#side')).includes(`${b.length} listed; + ${plus}, − ${minus}`));
    assert.equal(await page.locator(`#bars rect[data-step="${at}"] title`).textContent(), `step ${at}, cell ${await part(page, `part.data.cells[${path[at]}].name`)}: + ${4 * plus} bytes, − ${4 * minus} bytes`);
    plusses += plus;
    minuses += minus;
  }
  assert(plusses > 0 && minuses > 0, 'the path changes lists both ways');
  assert.equal(await page.locator('#bars rect[data-step]').count(), count);
  await page.locator('#bars rect[data-step="1"]').click();
  assert.equal(await part(page, 'part.at'), 1);
  await page.locator('#tree button[data-cell="4"]').click();
  await settled(page);
  assert.equal(await part(page, 'part.data.path.at(-1)'), 4);
  await page.selectOption('#go', '7');
  await settled(page);
  assert.equal(await part(page, 'part.data.path[part.at]'), 7);
  await page.keyboard.press('[');
  const { hash } = new URL(await (async () => { await page.waitForTimeout(300); return page.url(); })()), shown = await part(page, '[part.at, part.data.path]');
  assert.deepEqual(await withPage('town.bake.html', async (again) => { await settled(again); return part(again, '[part.at, part.data.path]'); }, { hash }), shown);
  // One stands in the cell of the path.
  await page.click('#view-stand');
  await settled(page);
  const inside = await page.evaluate(() => { const c = cluesView.stepper(), cell = c.data.cells[c.data.path[c.at]], eye = cluesView.frame.world(cluesView.camera.eye); return eye.every((x, k) => x >= cell.low[k] - 1e-6 && x <= cell.high[k] + 1e-6); });
  assert(inside);
}));

test('a bake is dropped as it is, and shown as in a page that the program writes', async () => {
  const told = (page) => part(page, 'JSON.stringify([part.scene, part.data.note, part.data.nodes, part.data.path, part.data.cells.map((c) => [c.name, c.node, c.fallbacks, c.points, c.count, [...c.bits]])])');
  const written = await withPage('town.bake.html', told);
  await withPage('empty.html', async (page) => {
    await drop(page, dropped('town.bake'));
    await page.waitForFunction(() => document.getElementById('note').textContent === 'town.bake: is about the scene boards.obj (12 triangles); drop that file too×');
    await page.click('#note button');
    await drop(page, dropped('boards.obj'));
    await page.waitForSelector('body[data-drawn]');
    assert(await page.isHidden('#note'));
    assert.equal(await told(page), written);
    await page.click('#view-bake');
    await slide(page, 1);
    assert((await text(page, '#side')).includes('step 1 of 4'));
    await page.click('#view-stand');
    await page.click('#compare');
    await settled(page);
    assert.match(await text(page, '#comparison'), /^none of \d+ pixels differs$|all by rounding/);
  }, { picture: false });
  // Both at once, and the store first.
  await withPage('empty.html', async (page) => {
    await drop(page, dropped('town.bake'), dropped('boards.obj'));
    await page.waitForSelector('body[data-drawn]');
    assert.equal(await told(page), written);
  }, { picture: false });
});

test('stores that are damaged, unfinished or of others are a sentence', () => withPage('empty.html', async (page) => {
  const whole = readFileSync(file('town.bake')), attempts = [];
  const changed = (words, from, to) => {
    const bytes = Buffer.from(whole), at = bytes.indexOf(from);
    assert(at >= 0 && bytes.indexOf(from, at + 1) < 0, `${from} is there once`);
    bytes.set(Buffer.from(to), at);
    attempts.push([words, bytes]);
  };
  changed('is no bake of clues (clues-bake/1)', 'clues-bake/1', 'other-bake/1');
  changed('is not finished: 8 of 8 cells', 'finishedyes', 'finishedno ');
  changed('no number of triangles', 'triangles12', 'triangles-2');
  changed('cell 0 has no list of 99 triangles', 'triangles12', 'triangles99');
  const lists = Buffer.from(whole);
  for (let at = lists.indexOf(Buffer.from([0x28, 0xb5, 0x2f, 0xfd])); at >= 0; at = lists.indexOf(Buffer.from([0x28, 0xb5, 0x2f, 0xfd]), at + 1)) lists[at + 7] ^= 6;
  attempts.push(['triangles; the store was damaged', lists]);
  attempts.push(['is a damaged store', whole.subarray(0, 60)], ['ends in the middle', whole.subarray(0, whole.length - 1)]);
  for (const [words, content] of attempts) {
    await drop(page, { name: 'odd.bake', content });
    await page.waitForFunction((w) => document.getElementById('note').textContent.startsWith('odd.bake: ') && document.getElementById('note').textContent.includes(w), words);
    await page.click('#note button');
    assert(await page.isVisible('#welcome'), words);
  }
  // At random: something is said, or something is shown, whatever the bytes are.
  const silent = await page.evaluate(async (base64) => {
    const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0)), { constructor: Workspace } = cluesView.workspace, out = [];
    let seed = 7;
    const random = (n) => { seed = (seed * 48271) % 2147483647; return seed % n; };
    for (let i = 0; i < 3000; ++i) {
      const some = i % 3 === 0 ? bytes.slice(0, random(bytes.length)) : bytes.slice(), workspace = new Workspace();
      for (let k = random(4); k >= 0 && some.length > 0; --k) some[random(some.length)] = random(256);
      const flaws = await workspace.add([{ path: 'odd.bake', bytes: some }]).catch((problem) => { out.push(problem.stack); return ['thrown']; });
      if (flaws.length === 0) out.push(`nothing is said of ${i}`);
    }
    return out;
  }, whole.toString('base64'));
  assert.deepEqual(silent, []);
}, { picture: false }));

test('sliders can be dragged, though the panel beside them changes', () => withPage('ball.maps.html', async (page) => {
  const r = await page.locator('#step').boundingBox(), y = r.y + r.height / 2, steps = [];
  await page.mouse.move(r.x + 8, y);
  await page.mouse.down();
  for (const to of [0.3, 0.6, 0.98]) {
    await page.mouse.move(r.x + r.width * to, y, { steps: 4 });
    await settled(page);
    steps.push(await part(page, 'part.at'));
  }
  await page.mouse.up();
  assert(steps[0] > 0 && steps[1] > steps[0] && steps[2] === await part(page, 'part.kind.steps(part) - 1'), steps.join());
}));

test('a transition: regions by who sees them, as large as the table says', () => withPage('town.delta.json.html', async (page) => {
  await page.click('#view-delta');
  await settled(page);
  const side = await text(page, '#side');
  for (const words of ['seen from both cells', 'newly visible', 'newly hidden', 'area newly visible about 11.778', 'packets: + 0, − 0']) assert(side.includes(words), words);
  await flat(page);
  for (const layer of ['cell', 'cell-to']) await page.click(`#layer-${layer}`);
  const delta = JSON.parse(read('town.delta.json')), { vertices, triangles } = delta.fragments;
  const area = (seen, triangle) => triangles.filter((f) => f.seen === seen && f.triangle === triangle && f.side === 'back').reduce((sum, { corners }) => {
    const [a, b, c] = corners.map((i) => vertices[i]);
    return sum + Math.abs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2;
  }, 0);
  await page.evaluate(() => { cluesView.select(0); cluesView.setAlone(true); cluesView.straight(true); cluesView.stage.marks.clear(); });
  await settled(page);
  const shown = await colours(page), counts = { both: '86,180,233', from: '213,94,0', to: '240,228,66', neither: '138,138,144' };
  const pixels = Object.fromEntries(Object.entries(counts).map(([seen, c]) => [seen, shown[c] ?? 0])), all = Object.values(pixels).reduce((a, b) => a + b), whole = Object.keys(counts).reduce((sum, seen) => sum + area(seen, 0), 0);
  assert(all > 40000, JSON.stringify(pixels));
  for (const seen of Object.keys(counts)) assert(Math.abs(pixels[seen] / all - area(seen, 0) / whole) < 8 / Math.sqrt(all), `${seen}: ${pixels[seen] / all}, not ${area(seen, 0) / whole}`);
  await page.evaluate(() => cluesView.select(null));
  await slide(page, 1);
  assert((await text(page, '#side')).includes('In the second cell'));
  assert.deepEqual(await page.evaluate(() => cluesView.case.cell.length), 8);
}));

test('a walk: frames, what is examined, made and removed, bounds', () => withPage('town.walk.jsonl.html', async (page) => {
  assert((await text(page, '#side')).includes('9 frames'));
  await slide(page, 5);
  const side = await text(page, '#side');
  assert.match(side, /Frame 5 of 8/);
  assert.match(side, /\d+ examined, \d+ removed, \d+ made/);
  for (const words of ['bound: ', 'triangles removed in this frame', 'the way of the viewpoint']) assert(side.includes(words), words);
  // The same frame, whether one comes from before it or from behind.
  const there = await part(page, '[...part.data.triangles]');
  await slide(page, 8);
  await slide(page, 5);
  assert.deepEqual(await part(page, '[...part.data.triangles]'), there);
  const frames = read('town.walk.jsonl').trim().split('\n').slice(1).map((line) => JSON.parse(line)), mesh = new Map();
  for (const f of frames.slice(0, 6)) for (const [i, ...corners] of f.triangles ?? []) mesh.set(i, corners);
  assert.equal(await part(page, 'part.data.count'), [...mesh.values()].filter((c) => c.length === 3).length);
  assert(await page.evaluate(() => cluesView.able('steps')[0].data.bounds.frames.slice(1).some((f) => f.some((b) => b >= 64))), 'nothing was ever examined');
  await page.selectOption('#walk-colours', 'changes');
  await settled(page);
  assert((await text(page, '#legend')).includes('as in the frame before'));
  await page.click('#play');
  await page.waitForFunction(() => cluesView.stepper().at === 8 && !cluesView.playing);
  await page.keyboard.press('p');
  await page.keyboard.press('p');
  assert.equal(await page.evaluate(() => cluesView.playing), 0);
  await page.getByText('From the viewpoint').click();
  await settled(page);
  assert.deepEqual(await page.evaluate(() => cluesView.frame.world(cluesView.camera.eye).map((x) => Math.round(100 * x) / 100)), (await part(page, 'part.data.frames[part.at].viewpoint')).map((x) => Math.round(100 * x) / 100));
}));

test('bounds in the page are those of the walk', async () => {
  write('still.txt', '-1 0 0\n-1 0 0\n');
  clues(0, 'motion', 'room.obj', '--path', 'still.txt', '--samples', '200', '--walk-out', 'still.jsonl', '--bounds-out', 'still.bounds.json');
  clues(0, 'view', 'still.jsonl', '-o', 'still.html');
  // Without a way a step is 1. Null: nothing can fail.
  const wanted = JSON.parse(read('still.bounds.json')).bounds.map((b) => (b === null ? 7 : [0.25, 1, 4, 16, 64, 256, 1024].findIndex((limit) => b < limit))).map((b) => (b < 0 ? 7 : b));
  await withPage('still.html', async (page) => {
    assert.deepEqual(await part(page, '[...part.data.bounds.frames[0]]'), wanted);
    assert.deepEqual(await part(page, '[...part.data.bounds.frames[1]]'), wanted);
    assert.equal(await part(page, '[...part.data.triangles].filter((c, i) => i % 3 === 0 && c !== 0xffffffff).length'), wanted.length);
  });
});

test('a hierarchy: levels, patches and the checkerboard at each, distances, the overlay when near', () => withPage('ball.maps.html', async (page) => {
  const levels = JSON.parse((clues(0, 'maps', 'verify', 'ball.maps', '--json', 'verdict.json'), read('verdict.json'))).levels.map((l) => l.triangles);
  await flat(page);
  for (let at = 0; at < levels.length; ++at) {
    if (at !== 0 && at !== 3 && at !== levels.length - 1) continue;
    await slide(page, at);
    assert.equal(await page.evaluate(() => cluesView.case.scene.mesh.triangles.length / 3), levels[at], `level ${at}`);
  }
  await slide(page, 0);
  for (const id of ['edges', 'overlay']) await page.click(`#layer-${id}`);
  const patches = ['230,159,0', '86,180,233', '0,158,115', '240,228,66', '0,114,178', '213,94,0', '204,121,167', '153,153,153'];
  const plain = await colours(page), bright = (c) => patches.reduce((sum, p) => sum + (c[p] ?? 0), 0), surface = bright(plain);
  assert(surface > 20000 && patches.filter((p) => plain[p] > 200).length >= 4);
  await page.selectOption('#maps-colours', 'checkerboard');
  await settled(page);
  const share = bright(await colours(page)) / surface;
  assert(share > 0.35 && share < 0.75, `36 of 64 small triangles are bright: ${share}`);
  // The levels between, by the steps: pieces that fill each triangle of the level and of the base domain once, with the images of vertices that the file has.
  for (let at = 1; at + 1 < levels.length; ++at) {
    const found = await page.evaluate((level) => {
      const { data } = cluesView.stepper(), cut = data.maps.at(level), sums = { triangles: cut.size, here: 0, base: 0, images: 0, vertices: 0 }, filled = data.base.map(() => 0), seen = new Set();
      const area = (c, k, off) => {
        const [a, b, d] = [0, k - 1, k].map((i) => c.slice(6 * i + off, 6 * i + off + 3));
        return a[0] * (b[1] * d[2] - b[2] * d[1]) - a[1] * (b[0] * d[2] - b[2] * d[0]) + a[2] * (b[0] * d[1] - b[1] * d[0]);
      };
      for (const [name, pieces] of cut) {
        const vertices = name.split(',').map(Number);
        let whole = 0;
        for (const { base, corners } of pieces) {
          for (let k = 2; 6 * k < corners.length; ++k) { whole += area(corners, k, 0); filled[base] += area(corners, k, 3); }
          for (let i = 0; i < corners.length; i += 6) {
            const k = [0, 1, 2].find((j) => corners[i + j] > 1 - 1e-9);
            if (k === undefined) continue;
            seen.add(vertices[k]);
            data.base[base].forEach((v, j) => { const weight = data.points[vertices[k]].image.find((x) => x.corner === v)?.weight ?? 0; sums.images = Math.max(sums.images, Math.abs(weight - corners[i + 3 + j])); });
          }
        }
        sums.here = Math.max(sums.here, Math.abs(Math.abs(whole) - 1));
      }
      sums.base = Math.max(...filled.map((x) => Math.abs(x - 1)));
      sums.vertices = new Set(data.levels[level]).size - seen.size;
      return sums;
    }, at);
    assert.equal(found.triangles, levels[at]);
    assert.equal(found.vertices, 0);
    assert(found.here < 1e-9 && found.base < 1e-9 && found.images < 1e-9, `level ${at}: ${JSON.stringify(found)}`);
    if (at % 4 !== 1) continue;
    await page.selectOption('#maps-colours', 'patches');
    await slide(page, at);
    await page.evaluate(() => { for (const id of ['edges', 'next', 'overlay']) cluesView.switchLayer(id, false); });
    const here = bright(await colours(page));
    assert(here > 20000, `patches at level ${at}: ${here}`);
    await page.selectOption('#maps-colours', 'checkerboard');
    await settled(page);
    const dark = bright(await colours(page)) / here;
    assert(dark > 0.35 && dark < 0.75, `level ${at}: ${dark}`);
  }
  await page.evaluate(() => cluesView.select(0));
  await settled(page);
  assert.match(await text(page, '#side'), /in \d+ pieces, on base triangle/);
  await slide(page, 0);
  await page.selectOption('#maps-colours', 'error');
  await settled(page);
  assert.match(await text(page, '#legend'), /0 % to /);
  await page.click('#layer-overlay');
  await page.evaluate(() => { cluesView.camera.state.distance = 3; cluesView.stage.drawNow(); });
  const seen = () => page.evaluate(() => cluesView.stage.marks.children.some((m) => m.userData.below && m.visible));
  assert.equal(await seen(), false);
  await page.evaluate(() => { cluesView.camera.state.distance = 1; cluesView.stage.drawNow(); });
  assert.equal(await seen(), true);
}));

test('walks, hierarchies and transitions are dropped; what is not whole is a sentence', () => withPage('empty.html', async (page) => {
  const attempts = MADE.map((name) => ({ name, content: readFileSync(file(name)).subarray(0, Math.floor(readFileSync(file(name)).length * 0.6)) }));
  const walk = read('town.walk.jsonl').split('\n'), maps = read('ball.maps').split('\n');
  attempts.push({ name: 'no frames.jsonl', content: walk[0] }, { name: 'no number.jsonl', content: [walk[0], walk[1].replace('"triangles": [[0, ', '"triangles": [[0.5, ')].join('\n') },
    { name: 'later.maps', content: read('ball.maps').replace('clues-maps 1', 'clues-maps 9') }, { name: 'beyond.maps', content: maps.map((l, i) => (maps[i - 1]?.startsWith('base ') ? '0 1 99999' : l)).join('\n') },
    { name: 'odd.maps', content: maps.map((l) => (l.startsWith('base ') ? 'base x' : l)).join('\n') });
  for (const attempt of attempts) {
    await drop(page, attempt);
    await page.waitForFunction((name) => document.getElementById('note').textContent.startsWith(name), attempt.name);
    await page.click('#note button');
    assert(await page.isVisible('#welcome'), attempt.name);
  }
  await drop(page, dropped('town.delta.json'), dropped('town.obj'), dropped('town.walk.jsonl'), dropped('ball.maps'));
  await page.waitForSelector('body[data-drawn]');
  await settled(page);
  assert(await page.isHidden('#note'));
  assert.equal(await page.evaluate(() => cluesView.workspace.cases.length), 3);
}, { picture: false }));

test('the program refuses what is not whole of them, and writes nothing; names do not matter', () => {
  for (const name of MADE) {
    const bytes = readFileSync(file(name)), half = name.replace('town', 'half').replace('ball', 'half');
    write(half, bytes.subarray(0, Math.floor(bytes.length * 0.6)));
    assert.match(clues(2, 'view', half, '-o', 'no.html'), new RegExp(half.replaceAll('.', '\\.')));
  }
  rmSync(file('pipe'), { force: true });
  execFileSync('mkfifo', [file('pipe')]);
  assert.match(clues(2, 'view', 'pipe', '-o', 'no.html'), /pipe/);
  assert.throws(() => readFileSync(file('no.html')));
  // What a file is called does not matter.
  for (const [i, name] of MADE.entries()) {
    copyFileSync(file(name), file(`called.${i}`));
    clues(0, 'view', `called.${i}`, '-o', 'called.html');
  }
});
