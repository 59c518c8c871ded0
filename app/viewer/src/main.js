// The page: reads what the program put into it, or what is dropped, and connects the parts.
import { App } from './app.js';
import { AT_ONCE } from './view/surface.js';
import { nameOfPart } from './files/mesh_bytes.js';
import { control } from './view/controls.js';
import { readAddress, writeAddress } from './ui/address.js';
import { keyboard, keysTable } from './ui/keys.js';
import { drawSide } from './ui/side.js';
import { h } from './ui/dom.js';

const $ = (id) => document.getElementById(id);

function note(sentences) {
  $('note').hidden = sentences.length === 0;
  $('note').replaceChildren(...sentences.map((s) => h('span', {}, s)), h('button', { onclick: () => note([]), 'aria-label': 'Close' }, '×'));
}

// Where the processor draws, smooth edges are most of the cost of a large scene.
function affordsSmoothEdges(data) {
  const triangles = (data?.files ?? []).reduce((sum, { mesh }) => sum + (mesh ? mesh.triangles.length / 16 : 0), 0);  // 12 bytes each, in base64
  if (triangles <= AT_ONCE) return true;
  const trial = document.createElement('canvas').getContext('webgl2', { antialias: false, depth: false }), info = trial?.getExtension('WEBGL_debug_renderer_info');
  const name = info ? trial.getParameter(info.UNMASKED_RENDERER_WEBGL) : '';
  trial?.getExtension('WEBGL_lose_context')?.loseContext();
  return !/swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
}

function make(data) {
  let panel = 0, address = 0;
  const app = new App($('canvas'), (what) => {
    if (what === 'drawn') {
      if (app.case && !document.body.dataset.drawn) {
        app.stage.wait();
        document.body.dataset.drawn = String(Math.round(performance.now()));
      }
      return;
    }
    if (what === 'room') {  // what is beside the scene takes its room before the scene is fitted into the rest
      $('side').hidden = false;
      return;
    }
    if (what !== 'camera') { cancelAnimationFrame(panel); panel = requestAnimationFrame(() => drawPanels(app)); }
    clearTimeout(address);
    address = setTimeout(() => writeAddress(app), 150);
  }, affordsSmoothEdges(data));
  return app;
}

function drawPanels(app) {
  const { cases } = app.workspace;
  document.title = app.case ? `${app.case.title} - clues view` : 'clues view';
  $('welcome').hidden = app.case !== null;
  $('side').hidden = app.case === null;
  $('cases').hidden = cases.length < 2;
  $('cases').replaceChildren(...cases.map((c, i) => h('option', { value: i, selected: c === app.case }, c.title)));
  $('views').replaceChildren(...app.views().map((v) => h('button', { id: `view-${v.id}`, role: 'tab', 'aria-selected': String(v.id === app.view), onclick: () => app.setView(v.id) }, v.name)));
  $('halves').hidden = app.view !== 'stand' || !app.case;
  $('left-title').textContent = 'the list';
  $('right-title').textContent = 'everything';
  $('halves').className = app.stage.pictures().length > 1 && app.stage.pictures()[1].y > 0 ? 'stacked' : '';
  drawSide(app, $('side'));
}

function tip(app, x, y) {
  const hit = x < 0 ? null : app.stage.hover(x, y);
  $('tip').hidden = !hit;
  $('canvas').style.cursor = hit ? 'pointer' : '';
  if (!hit) return;
  const face = app.case.scene.mesh.faces?.[hit.triangle];
  const words = [`triangle ${hit.triangle}`];
  if (face !== undefined && face !== hit.triangle) words.push(`face ${face}`);
  if (app.regions() && app.colourBy === 'map' && app.view !== 'stand') words.push(hit.back ? 'back' : 'front');
  const part = nameOfPart(app.case.scene.mesh, hit.triangle);
  if (part !== '') words.push(part);
  words.push(app.view === 'stand' ? (hit.listed ? 'in the list' : 'not in the list') : hit.label === 'none' ? '' : app.nameOf(hit.label), app.case.scene.name);
  $('tip').textContent = words.filter((w) => w !== '').join(' · ');
  const { width } = app.stage.size();
  $('tip').style.cssText = `top:${y + 14}px;${x < width / 2 ? `left:${x + 12}px` : `right:${width - x + 12}px`}`;
}

function save(app) {
  app.stage.drawNow();
  $('canvas').toBlob((blob) => {
    const link = h('a', { href: URL.createObjectURL(blob), download: `${(app.case?.scene?.name ?? 'clues').replace(/\.[^.]*$/, '')}-${app.view}.png` });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10000);
  });
}

// Files and folders of a drop, with paths.
async function filesOf(transfer) {
  const out = [], entries = [...transfer.items].map((item) => item.webkitGetAsEntry?.()).filter((e) => e);
  const walk = async (entry, folder) => {
    if (entry.isFile) out.push({ path: folder + entry.name, file: await new Promise((done, failed) => entry.file(done, failed)) });
    else if (entry.isDirectory) {
      const reader = entry.createReader();
      for (let some = [null]; some.length > 0;) {
        some = await new Promise((done, failed) => reader.readEntries(done, failed));
        for (const e of some) await walk(e, `${folder}${entry.name}/`);
      }
    }
  };
  if (entries.length === 0) return [...transfer.files].map((file) => ({ path: file.name, file }));
  for (const entry of entries) await walk(entry, '');
  return out;
}

async function openFiles(app, files) {
  const read = await Promise.all(files.map(async ({ path, file }) => ({ path, bytes: new Uint8Array(await file.arrayBuffer()) })));
  note(await app.open(read));
}

async function start() {
  const embedded = $('clues-data');
  let app, data;
  try {
    data = embedded && JSON.parse(embedded.textContent);
  } catch {
    note(['This page is not complete: its data end too early. Write it again with clues view.']);
    $('welcome').hidden = true;
    return;
  }
  try {
    app = make(data);
  } catch (problem) {
    note([`This browser cannot draw the page: ${problem.message}. WebGL 2 is needed.`]);
    $('welcome').hidden = true;
    return;
  }
  window.cluesView = app;
  app.setTheme(matchMedia('(prefers-color-scheme: dark)').matches);
  control($('canvas'), app.camera, {
    changed: () => { app.stage.move(); app.changed('camera'); },
    hover: (() => { let asked = 0; return (x, y) => { cancelAnimationFrame(asked); asked = requestAnimationFrame(() => tip(app, x, y)); }; })(),
    click: (x, y) => { if (app.case?.scene) app.select(app.stage.pick(x, y)?.triangle ?? null); },
    busy: () => app.stopFlight(),
  });
  const help = () => { $('keys').replaceChildren(...keysTable(() => $('keys').close())); $('keys').showModal(); };
  keyboard(app, { save: () => save(app), help });
  $('help').onclick = help;
  $('picture').onclick = () => save(app);
  $('theme').onclick = () => app.setTheme(!app.dark);
  $('open').onclick = $('open-first').onclick = () => $('chooser').click();
  $('chooser').onchange = () => openFiles(app, [...$('chooser').files].map((file) => ({ path: file.name, file })));
  $('cases').onchange = () => { app.choose(Number($('cases').value)); app.changed('files'); };
  document.addEventListener('dragover', (event) => { event.preventDefault(); document.body.classList.add('over'); });
  document.addEventListener('dragleave', () => document.body.classList.remove('over'));
  document.addEventListener('drop', async (event) => {
    event.preventDefault();
    document.body.classList.remove('over');
    await openFiles(app, await filesOf(event.dataTransfer));
  });
  window.addEventListener('hashchange', () => readAddress(app));
  if (data) {
    const { hash } = location;
    embedded.textContent = '';
    note(await app.open(data.files));
    readAddress(app, hash);
  }
  drawPanels(app);
  document.body.dataset.ready = 'yes';
}

start();
