// What the tests of the page share: the browser, pages that must not complain, and files made by the program itself.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { createHash } from 'node:crypto';
import { copyFileSync, existsSync, mkdirSync, readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';

// CLUES: the program; CLUES_SOURCE: the repository; CLUES_MODULES: where playwright-core is; CLUES_CHROMIUM; CLUES_SCRATCH: a folder.
export const { CLUES, CLUES_SOURCE, CLUES_MODULES, CLUES_CHROMIUM, CLUES_SCRATCH } = process.env;
for (const [name, value] of Object.entries({ CLUES, CLUES_SOURCE, CLUES_MODULES, CLUES_CHROMIUM, CLUES_SCRATCH })) assert(value, `${name} is not set`);
export const LONG = process.env.CLUES_LONG === '1';
const { chromium } = createRequire(join(CLUES_MODULES, 'tests.js'))('playwright-core');

mkdirSync(CLUES_SCRATCH, { recursive: true });
export const file = (name) => join(CLUES_SCRATCH, name);
export const read = (name) => readFileSync(file(name), 'utf8');
export const write = (name, content) => { writeFileSync(file(name), content); return file(name); };
export const sha256 = (bytes) => createHash('sha256').update(bytes).digest('hex');

// Runs the program in the scratch folder; `code` is what it must end with.
export function clues(code, ...words) {
  try {
    const out = execFileSync(CLUES, words, { cwd: CLUES_SCRATCH, encoding: 'utf8', stdio: ['ignore', 'pipe', 'pipe'] });
    assert.equal(0, code, `clues ${words.join(' ')} ended with 0`);
    return out;
  } catch (problem) {
    if (problem.status === undefined || problem.status === null) throw problem;
    assert.equal(problem.status, code, `clues ${words.join(' ')}: ${problem.stderr}`);
    return problem.stdout + problem.stderr;
  }
}

// A wall (0, 1), a screen before it (2), a small triangle behind the screen (3), and one off to the side (4).
export const TOWN = `v -19 -19 6\nv 21 -19 6\nv 21 21 6\nv -19 21 6\nv -5 -3 4\nv 7 -3 4\nv 1 9 4\nv 0.5 0.5 4.25\nv 1.5 0.5 4.25
v 1 1.5 4.25\nv 10 1 4\nv 11 1 4\nv 10 2 4\nf 1 2 3\nf 1 3 4\nf 5 6 7\nf 8 9 10\nf 11 13 12\n`;
export const CELL = 'box:0,0,1,2,2,2';

export function makeTown() {
  if (existsSync(file('town.verdict.json'))) return;
  write('town.obj', TOWN);
  write('baked.txt', '0\n1\n2\n3\n');
  clues(0, 'map', 'town.obj', '--cell', CELL, '--map', '-o', 'town.clues.json', '--umbra', 'town.umbra.json');
  clues(1, 'check', 'town.obj', '--cell', CELL, '--pvs', 'baked.txt', '--json', 'town.verdict.json');
}

export function makeFinding() {
  if (existsSync(file('found'))) return;
  copyFileSync(join(CLUES_SOURCE, 'tests/docs/stand-ins/bake'), file('bake'));
  clues(1, 'fuzz', '--subject', './bake {scene} {cell} -o {pvs}', '--generator', 'axis_boxes', '--oracle', 'sight-lines', '--cases', '1', '--out', 'found');
}
export const FINDING = 'found/sight-lines-hidden-visible-axis_boxes';

// The limit of time is that of the whole test: this is how long a browser on a busy machine may take for anything.
const PATIENCE = 600000;
let running = null;
export async function browser() {
  running ??= await chromium.launch({
    executablePath: CLUES_CHROMIUM,
    timeout: PATIENCE,
    args: ['--no-sandbox', '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync',
      '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'],
  });
  return running;
}
export async function close() { await running?.close(); running = null; }

// Opens a page, runs the test with it (and the processor time until it was there), and fails on anything that the page complains of or fetches.
export async function withPage(name, test, { width = 1280, height = 800, hash = '', ready = true, picture = true, media = {} } = {}) {
  const context = await (await browser()).newContext({ viewport: { width, height }, acceptDownloads: true, reducedMotion: 'reduce', colorScheme: 'light', ...media });
  context.setDefaultTimeout(PATIENCE);
  const page = await context.newPage(), complaints = [];
  page.on('console', (message) => { if (['error', 'warning'].includes(message.type()) && !/GPU stall due to ReadPixels/.test(message.text())) complaints.push(message.text()); });
  page.on('pageerror', (problem) => complaints.push(problem.stack));
  page.on('request', (request) => { if (!/^(file|blob|data):/.test(request.url())) complaints.push(`fetched ${request.url()}`); });
  const before = processorTime();
  await page.goto(`file://${file(name)}${hash}`);
  if (ready) await page.waitForSelector('body[data-ready]');
  if (picture) await page.waitForSelector('body[data-drawn]');
  const worked = processorTime() - before;
  try {
    const out = await test(page, worked);
    assert.deepEqual(complaints, []);
    return out;
  } finally {
    await context.close();
  }
}

// Milliseconds of processor time that the browser has had so far, in all its processes.
export function processorTime() {
  const parents = new Map(), times = new Map();
  for (const pid of readdirSync('/proc').filter((name) => /^\d+$/.test(name))) {
    let fields;
    try { fields = readFileSync(`/proc/${pid}/stat`, 'utf8').replace(/^.*\) /, '').split(' '); } catch { continue; }  // it has ended
    parents.set(Number(pid), Number(fields[1]));
    times.set(Number(pid), 10 * (Number(fields[11]) + Number(fields[12])));
  }
  const ours = (pid) => { for (let p = parents.get(pid); p; p = parents.get(p)) if (p === process.pid) return true; return false; };
  return [...times].reduce((sum, [pid, ms]) => sum + (ours(pid) ? ms : 0), 0);
}

// Drops files into the page, as a person would: { path, text or bytes }.
export async function drop(page, ...files) {
  const data = await page.evaluateHandle((list) => {
    const transfer = new DataTransfer();
    for (const { name, base64 } of list) transfer.items.add(new File([Uint8Array.from(atob(base64), (c) => c.charCodeAt(0))], name));
    return transfer;
  }, files.map((f) => ({ name: f.name, base64: Buffer.from(f.content).toString('base64') })));
  await page.dispatchEvent('body', 'drop', { dataTransfer: data });
  await data.dispose();
}
export const dropped = (name) => ({ name: name.split('/').pop(), content: readFileSync(file(name)) });

export const settled = (page) => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done, 200)))));
export const state = (page) => page.evaluate(() => ({ view: cluesView.view, triangle: cluesView.triangle, viewpoint: cluesView.viewpoint, colours: cluesView.colourBy,
  alone: cluesView.alone, camera: cluesView.camera.write(), flat: cluesView.camera.state.flat, marks: cluesView.stage.marks.children.length, case: cluesView.case?.title, eye: cluesView.camera.eye }));

// How many pixels of the canvas have each colour, as "r,g,b": count.
export const colours = (page) => page.evaluate(() => {
  cluesView.stage.drawNow();
  const gl = cluesView.stage.renderer.getContext(), [w, h] = [gl.drawingBufferWidth, gl.drawingBufferHeight], bytes = new Uint8Array(4 * w * h), out = {};
  gl.readPixels(0, 0, w, h, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
  for (let i = 0; i < bytes.length; i += 4) { const key = `${bytes[i]},${bytes[i + 1]},${bytes[i + 2]}`; out[key] = (out[key] ?? 0) + 1; }
  return out;
});
