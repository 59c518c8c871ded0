// The page of `clues view` in a real browser: every view with real files, what clicks and sliders do, what bad files do.
import assert from 'node:assert/strict';
import { copyFileSync, cpSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { CELL, CLUES_SOURCE, close, clues, colours, drop, dropped, file, FINDING, makeFinding, makeTown, read, settled, state, withPage, write } from './support.mjs';

before(() => {
  makeTown();
  makeFinding();
  clues(0, 'view', 'town.clues.json', 'town.umbra.json', 'town.verdict.json', '-o', 'town.html');
  clues(0, 'view', FINDING, '-o', 'finding.html');
  clues(0, 'view', '-o', 'empty.html');
});
after(close);

const text = (page, selector) => page.textContent(selector);
// Where a point of the scene is on the page.
const onPage = (page, point) => page.evaluate((p) => {
  const { width, height } = cluesView.stage.size(), v = cluesView.stage.marks.position.clone().set(...cluesView.frame.local(p)).project(cluesView.camera.get(width / height)), r = document.getElementById('canvas').getBoundingClientRect();
  return [r.left + ((v.x + 1) / 2) * width, r.top + ((1 - v.y) / 2) * height];
}, point);

test('the map: labels, layers, the legend', () => withPage('town.html', async (page) => {
  assert.deepEqual((await state(page)).view, 'map');
  const side = await text(page, '#side');
  for (const words of ['4 of 5 triangles are listed as visible', 'verdict: unsound', 'visible from the cell', 'hidden', 'faces away', 'view cell', 'SE-MV wedges', 'OB segments', 'umbra']) assert(side.includes(words), words);
  const before = (await state(page)).marks;
  await page.click('#layer-se-mv');
  await settled(page);
  assert.equal((await state(page)).marks, before + 1);
  await page.click('#layer-umbra');
  await page.click('#layer-cell');
  await settled(page);
  assert.equal((await state(page)).marks, before - 1);
  const orange = async () => { await page.evaluate(() => { cluesView.shading = cluesView.hatching = false; cluesView.uniforms(); cluesView.fit(); }); const count = (await colours(page))['213,94,0'] ?? 0; await page.evaluate(() => { cluesView.shading = cluesView.hatching = true; cluesView.uniforms(); }); return count; };
  assert(await orange() > 50);
  await page.click('#label-hidden');
  await settled(page);
  assert.equal(await orange(), 0, 'what is switched off in the legend is not drawn');
  assert(new URL(page.url()).hash.includes('without=hidden'));
  await page.selectOption('#colours', 'judgement');
  await settled(page);
  assert((await text(page, '#legend')).includes('missing, though visible'));
  assert.equal((await colours(page))['255,0,212'], undefined, 'shaded');
  await page.click('#shading');
  assert((await colours(page))['255,0,212'] > 20);
}));

test('the first picture fits into the room that the panel leaves', () => withPage('town.html', async (page) => {
  const distance = () => page.evaluate(() => cluesView.camera.state.distance), first = await distance();
  await page.evaluate(() => cluesView.fit());
  assert.equal(await distance(), first);
}));

test('a click on a triangle says how much of it is visible, and the proof', () => withPage('town.html', async (page) => {
  await page.click('#layer-umbra');
  const [x, y] = await onPage(page, [10.3, 1.3, 4]);
  await page.mouse.move(x, y);
  await settled(page);
  assert.match(await text(page, '#tip'), /triangle 4 · front · visible from the cell · town.obj/);
  await page.mouse.click(x, y);
  await settled(page);
  assert.equal((await state(page)).triangle, 4);
  const side = await text(page, '#side');
  for (const words of ['Triangle 4', 'front: visible part 1', 'back: visible part 0', 'verdict: missing-visible', 'free sight line from (1, 1, 3/2)', 'facet of the umbra']) assert(side.includes(words), words);
  await page.evaluate(() => cluesView.select(0));
  await settled(page);
  assert((await text(page, '#side')).includes('back: visible part 1229/1350 (91.04 %)'));
  await page.keyboard.press('Escape');
  assert.equal((await state(page)).triangle, null);
}));

test('pixels of each colour are as the exact areas say', () => withPage('town.html', async (page) => {
  for (const layer of ['umbra', 'cell', 'ob', 'dm']) await page.click(`#layer-${layer}`);
  await page.click('#shading');
  await page.click('#hatching');
  for (const [triangle, exact] of [[0, 1229 / 1350], [1, 487 / 540]]) {
    await page.evaluate((t) => { cluesView.select(t); cluesView.setAlone(true); cluesView.straight(true); cluesView.stage.marks.clear(); }, triangle);
    await settled(page);
    const counts = await colours(page), visible = counts['86,180,233'] ?? 0, hidden = counts['213,94,0'] ?? 0, all = visible + hidden;
    assert(all > 40000, `${all} pixels`);
    // Borders of both colours are smoothed: less than a pixel for each of their length.
    const within = (8 * Math.sqrt(all)) / all;
    assert(Math.abs(visible / all - exact) < within / 4, `${visible} of ${all}: ${visible / all} and not ${exact}`);
    assert(Math.abs(hidden / all - exact) > within, 'the other colour would do as well');
  }
}));

test('the verdicts: a row flies along the sight line, and what it passes is outlined', () => withPage('town.html', async (page) => {
  await page.click('#view-verdicts');
  await settled(page);
  assert.equal((await state(page)).colours, 'judgement');
  assert.equal(await page.locator('#rows tr').count(), 5);
  await page.selectOption('#verdict', 'missing-visible');
  assert.equal(await page.locator('#rows tr').count(), 1);
  const before = await state(page);
  await page.click('#rows tr');
  await settled(page);
  const after = await state(page);
  assert.equal(after.triangle, 4);
  assert(after.marks > before.marks + 3, 'outline, sight line, ends and what is passed are drawn');
  const aside = await page.evaluate(() => {
    const [v, p] = cluesView.row.sight.map((x) => cluesView.frame.local(x)), eye = cluesView.camera.place();
    const d = p.map((x, k) => x - v[k]), e = p.map((x, k) => x - eye[k]), dot = (a, b) => a.reduce((s, x, k) => s + x * b[k], 0);
    return { angle: Math.acos(dot(d, e) / Math.sqrt(dot(d, d) * dot(e, e))), nearer: Math.sqrt(dot(e, e) / dot(d, d)), grazing: cluesView.grazing() };
  });
  assert(aside.angle < 0.3 && aside.nearer < 0.9, JSON.stringify(aside));
  assert(aside.grazing.length > 0 && !aside.grazing.includes(4));
  await page.keyboard.press(']');
  await page.selectOption('#verdict', '');
  await page.fill('#words', 'triangle 3');
  assert.equal(await page.locator('#rows tr').count(), 1);
}));

test('standing in the cell: two equal pictures of a sound list, and glaring surface of another', () => withPage('town.html', async (page) => {
  await page.click('#view-stand');
  await settled(page);
  const first = await state(page);
  assert.deepEqual(await page.evaluate(() => cluesView.frame.world(cluesView.camera.eye).map((x) => Math.round(x * 1e6) / 1e6)), [1, 1, 1.5]);
  await page.locator('#viewpoint').fill('17');
  await settled(page);
  assert.notDeepEqual((await state(page)).eye, first.eye);
  assert((await text(page, '#side')).includes('Viewpoint 17'));
  await page.click('#compare');
  await settled(page);
  assert.match(await text(page, '#comparison'), /^none of \d+ pixels differs$|all by rounding/);
  // The list of the verdict lacks triangle 4.
  const verdict = JSON.parse(read('town.verdict.json'));
  await page.evaluate(() => cluesView.setView('map'));
  await drop(page, { name: 'other.json', content: JSON.stringify(verdict) });
  await settled(page);
  const other = await page.evaluate(() => {
    const at = cluesView.workspace.cases.findIndex((c) => !c.parts.some((p) => p.kind.id === 'result'));
    cluesView.choose(at);
    cluesView.setView('stand');
    const v = cluesView.frame.local([10.3, 1.3, 4]), eye = cluesView.camera.eye;
    Object.assign(cluesView.camera.state, cluesView.camera.angles(v.map((x, k) => x - eye[k])));
    return cluesView.compare(300, 300);
  });
  assert.deepEqual(other.missing, [4]);
  assert(other.real > 0);
  const glare = async () => Object.entries(await colours(page)).filter(([c]) => { const [r, g, b] = c.split(',').map(Number); return r > 120 && g < 40 && b > 100; }).reduce((n, [, k]) => n + k, 0);
  assert(await glare() > 100);
  await page.click('#glare');
  await settled(page);
  assert.equal(await glare(), 0);
}));

test('a finding, as it was met and after shrinking', () => withPage('finding.html', async (page) => {
  assert.equal(await page.locator('#cases option').count(), 2);
  assert((await text(page, '#side')).includes('hidden/visible'));
  const before = await page.evaluate(() => cluesView.case.scene.mesh.triangles.length);
  await page.click('#view-verdicts');
  await settled(page);
  assert.equal(await page.locator('#rows tr').count(), 2);
  await page.locator('#rows tr').nth(1).click();
  await settled(page);
  assert((await text(page, '#side')).includes('as it was met: '), 'the other of both');
  assert((await state(page)).case.includes('as it was met'));
  await page.click('#rows tr');
  await settled(page);
  assert((await text(page, '#side')).includes('free sight line from'));
  await page.selectOption('#cases', '1');
  await settled(page);
  assert(await page.evaluate(() => cluesView.case.scene.mesh.triangles.length) >= before);
}));

test('a conformance report: the scenes of what is unsound', async () => {
  clues(0, 'conform', '--suite', join(CLUES_SOURCE, 'vectors'), '--topic', 'grazing', '--export', 'cases');
  const list = JSON.parse(read('cases/cases.json')).cases;
  for (const c of list) write(`cases/${c.id}.pvs`, '0\n');
  clues(1, 'conform', '--suite', join(CLUES_SOURCE, 'vectors'), '--topic', 'grazing', '--results', 'cases', '--json', 'suite.json');
  clues(0, 'view', 'suite.json', '-o', 'suite.html');
  await withPage('suite.html', async (page) => {
    await page.click('#view-verdicts');
    await settled(page);
    assert.equal(await page.locator('#rows tr').count(), list.length);
    await page.locator('#rows tr', { hasText: list[3].id }).click();
    await settled(page);
    assert((await state(page)).case.includes(list[3].id));
    assert.notEqual((await state(page)).triangle, null);
  });
});

test('a report shows what is wrong in the same view', async () => {
  mkdirSync(file('results/second'), { recursive: true });
  // Two scenes of one name, in two folders: each verdict is shown with its own.
  copyFileSync(file('town.verdict.json'), file('results/town.json'));
  write('results/second/town.obj', read('town.obj').replace('v 10 2 4', 'v 10 2 4.125'));
  clues(1, 'check', 'results/second/town.obj', '--cell', CELL, '--pvs', 'baked.txt', '--json', 'results/second/town.json');
  cpSync(file(FINDING), file('results/finding'), { recursive: true });
  clues(0, 'report', 'results');
  await withPage('results/report.html', async (page) => {
    assert.equal(await page.locator('svg').count(), 0, 'no plans');
    assert.equal(await page.locator('button[data-file]').count(), 3);
    const shown = async (name) => {
      await page.click(`button[data-file="${name}"]`);
      const frame = await (await page.waitForSelector('iframe')).contentFrame();
      await frame.waitForFunction(() => window.cluesView?.view === 'verdicts' && cluesView.row);
      await frame.waitForTimeout(200);
      return frame.evaluate(() => ({ triangle: cluesView.triangle, z: cluesView.case.scene.mesh.points.at(-1), marks: cluesView.stage.marks.children.length, side: document.getElementById('side').textContent }));
    };
    const first = await shown('town.json'), second = await shown('second/town.json'), finding = await shown('finding/finding.json');
    assert.deepEqual([first.triangle, first.z, second.triangle, second.z], [4, 4, 4, 4.125]);
    assert(first.marks > 4 && first.side.includes('free sight line from'));
    assert(finding.side.includes('after shrinking') && finding.side.includes('as it was met'));
  }, { ready: false, picture: false });
  await withPage('results/report.html', async (page) => {
    await page.click('button[data-file]');
    assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 400);
  }, { ready: false, picture: false, width: 400 });
});

test('files are dropped; a scene that is missing is asked for', () => withPage('empty.html', async (page) => {
  assert((await text(page, '#welcome')).includes('Drop files here'));
  await drop(page, dropped('town.clues.json'));
  await page.waitForSelector('#note:not([hidden])');
  assert((await text(page, '#note')).includes('is about the scene town.obj (5 triangles); drop that file too'));
  await drop(page, dropped('town.obj'));
  await page.waitForSelector('body[data-drawn]');
  await settled(page);
  assert(await page.isHidden('#note'));
  assert(await page.isHidden('#welcome'));
  assert((await text(page, '#side')).includes('4 of 5 triangles'));
  await page.setInputFiles('#chooser', [file('town.umbra.json'), file('town.verdict.json')]);
  await page.waitForFunction(() => document.getElementById('side').textContent.includes('umbra: '));
  assert((await text(page, '#side')).includes('verdict: unsound'));
  assert.equal(await page.evaluate(() => cluesView.workspace.cases.length), 1);
}, { picture: false }));

test('every format of scenes is read in the page as the program reads it', async () => {
  const mesh = 'OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0.5\n4 0 1 2 3\n3 0 2 3\n';
  write('form.off', mesh);
  write('form.obj', 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 5e-1\nf 1/ 2//1 3 4\nf -4 -2 -1\n');
  write('form.ply', 'ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\nproperty double z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0.5\n4 0 1 2 3\n3 0 2 3\n');
  const corners = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 0, 0], [1, 1, 0], [0, 1, 0.5], [0, 0, 0], [1, 1, 0], [0, 1, 0.5]];
  const stl = Buffer.alloc(84 + 150);
  stl.writeUInt32LE(3, 80);
  corners.forEach((p, i) => p.forEach((x, k) => stl.writeFloatLE(x, 84 + 50 * Math.floor(i / 3) + 12 + 12 * (i % 3) + 4 * k)));
  writeFileSync(file('form.stl'), stl);
  const names = ['form.off', 'form.obj', 'form.ply', 'form.stl'];
  clues(0, 'view', ...names, '-o', 'form.html');
  const take = (page) => page.evaluate(() => Object.fromEntries(cluesView.workspace.scenes.map(({ name, mesh }) => [name, [...mesh.triangles].map((c) => [...mesh.points.subarray(3 * c, 3 * c + 3)])])));
  const embedded = await withPage('form.html', take);
  const here = await withPage('empty.html', async (page) => { await drop(page, ...names.map(dropped)); await page.waitForSelector('body[data-drawn]'); return take(page); }, { picture: false });
  assert.deepEqual(here, embedded);
  for (const name of names) assert.deepEqual(here[name], corners, name);
});

test('bad and truncated files give a sentence, and not a blank page', () => withPage('empty.html', async (page) => {
  const attempts = ['town.clues.json', 'town.umbra.json', 'town.verdict.json', 'town.obj', 'form.off', 'form.ply', 'form.stl'].map((name) => {
    const { content } = dropped(name);
    return { name, content: content.subarray(0, Math.floor(content.length * 0.6)) };
  });
  const result = JSON.parse(read('town.clues.json'));
  const changed = (name, change) => { const copy = structuredClone(result); change(copy); attempts.push({ name, content: JSON.stringify(copy) }); };
  changed('an id too large.json', (r) => r.visible.push(5));
  changed('a side of no kind.json', (r) => { r.regions[0].side = 'upper'; });
  changed('a ring of text.json', (r) => { r.regions[0].rings = 'none'; });
  changed('a fraction of nothing.json', (r) => { r.regions[0].area_fraction = '1/0'; });
  changed('a wedge with three corners.json', (r) => r.wedges[0].points.pop());
  changed('no cell.json', (r) => { delete r.cell; });
  changed('of a later version.json', (r) => { r.format = 'clues-result/9'; });
  attempts.push({ name: 'list.json', content: '[]' }, { name: 'null.json', content: 'null' }, { name: 'empty.obj', content: '' }, { name: 'notes.txt', content: 'hello' },
    { name: 'empty.json', content: '' }, { name: 'zeros.stl', content: Buffer.alloc(100) }, { name: 'finding.json', content: readFileSync(file(`${FINDING}/finding.json`)) });
  for (const attempt of attempts) {
    if (attempt.name === 'town.obj') attempt.content = Buffer.from('v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n');
    await drop(page, attempt);
    await page.waitForFunction((name) => document.getElementById('note').textContent.startsWith(name.split('/').pop()), attempt.name);
    assert((await text(page, '#note')).length > attempt.name.length + 15, await text(page, '#note'));
    await page.click('#note button');
    assert(await page.isVisible('#welcome'), attempt.name);
  }
  await drop(page, dropped('town.obj'), { name: 'town.clues.json', content: read('town.clues.json').replace(/"sha256": "./, '"sha256": "x') });
  await page.waitForSelector('#note:not([hidden])');
  assert((await text(page, '#note')).includes('another version of town.obj'));
}, { picture: false }));

test('the program refuses what it cannot read, and writes nothing', () => {
  write('half.clues.json', read('town.clues.json').slice(0, 2000));
  assert.match(clues(2, 'view', 'half.clues.json', '-o', 'no.html'), /half\.clues\.json:/);
  write('other.clues.json', read('town.clues.json').replace('"triangles": 5', '"triangles": 6'));
  clues(2, 'view', 'other.clues.json', '-o', 'no.html');
  write('side.clues.json', read('town.clues.json').replace('"side": "back"', '"side": "top"'));
  assert.match(clues(2, 'view', 'side.clues.json', '-o', 'no.html'), /neither "front" nor "back"/);
  write('alone.clues.json', read('town.clues.json').replace('town.obj', 'gone.obj').replace(/"sha256": "..../, '"sha256": "0000'));
  assert.match(clues(2, 'view', 'alone.clues.json', '-o', 'no.html'), /is about the scene gone\.obj, which is not beside it/);
  clues(2, 'view', 'town.clues.json', '-o', 'town.clues.json');
  clues(2, 'view', '.', '-o', 'no.html');
  assert.throws(() => readFileSync(file('no.html')));
});

test('a level: its faces have names, and what does not block is drawn too', async () => {
  copyFileSync(join(CLUES_SOURCE, 'fuzz/corpus/bsp/two_rooms.bsp'), file('two_rooms.bsp'));
  clues(0, 'view', 'two_rooms.bsp', '-o', 'level.html');
  await withPage('level.html', async (page) => {
    const { flags, parts } = await page.evaluate(() => { const { flags: f, parts: p } = cluesView.case.scene.mesh; return { flags: [...f], parts: p }; });
    assert.deepEqual([flags.length, flags.filter((f) => f & 2).length, flags.filter((f) => f & 1).length], [62, 40, 26], 'as `clues level` counts them');
    const { width, height } = await page.locator('#canvas').boundingBox(), box = await page.locator('#canvas').boundingBox();
    await page.mouse.move(box.x + width / 2, box.y + height / 2);
    await settled(page);
    const words = (await text(page, '#tip')).split(' · ');
    assert.match(words[0], /^triangle \d+$/);
    assert(parts.some(([, name]) => words.includes(name)), words.join());
  });
});

test('names of files are text', async () => {
  const name = '<img src=x onerror=window.broken=1>.obj';
  write(name, read('town.obj'));
  clues(0, 'view', name, '-o', 'name.html');
  await withPage('name.html', async (page) => {
    assert((await text(page, '#side')).includes(name));
    assert.equal(await page.evaluate(() => window.broken), undefined);
  });
});

test('the keyboard, the theme, the permalink and the picture', () => withPage('town.html', async (page) => {
  const camera = (await state(page)).camera;
  await page.keyboard.press('ArrowLeft');
  await page.keyboard.press('+');
  assert.notEqual((await state(page)).camera, camera);
  await page.keyboard.press('3');
  assert.equal((await state(page)).view, 'verdicts');
  await page.keyboard.press('2');
  await page.keyboard.press(']');
  assert.deepEqual([(await state(page)).view, (await state(page)).viewpoint], ['stand', 1]);
  await page.keyboard.press('t');
  assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), 'dark');
  await page.keyboard.press('?');
  assert(await page.isVisible('#keys'));
  await page.keyboard.press('Escape');
  await page.keyboard.press('1');
  await page.evaluate(() => cluesView.select(2));
  await page.keyboard.press('o');
  await page.keyboard.press('a');
  await page.click('#layer-umbra');
  await page.waitForTimeout(300);
  const shown = await state(page), { hash } = new URL(page.url());
  assert.deepEqual(await withPage('town.html', async (again) => { await settled(again); return state(again); }, { hash }), shown);
  const [download] = await Promise.all([page.waitForEvent('download'), page.click('#picture')]);
  assert.equal(download.suggestedFilename(), 'town-map.png');
  assert(readFileSync(await download.path()).subarray(1, 4).toString() === 'PNG');
}));

test('at 400 pixels, in the dark', () => withPage('town.html', async (page) => {
  assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 400);
  for (const id of ['#view-map', '#view-stand', '#view-verdicts', '#picture', '#help']) {
    const box = await page.locator(id).boundingBox();
    assert(box.x >= 0 && box.x + box.width <= 400, id);
  }
  await page.click('#view-stand');
  await settled(page);
  assert.equal(await page.evaluate(() => cluesView.stage.pictures()[1].x), 0);
  assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), 'dark');
}, { width: 400, height: 800, media: { colorScheme: 'dark' } }));
