// The panel at the side: what the file says, the legend, layers, the table, the triangle.
import { nameOfPart } from '../files/mesh_bytes.js';
import { LABELS, LAYER_COLOURS, NUMBER } from '../view/labels.js';
import { VIEWPOINTS } from '../view/stand.js';
import { h, svg } from './dom.js';

const MOST_ROWS = 500;
let filter = '', words = '';

const section = (title, ...children) => h('section', {}, h('h2', {}, title), ...children);
const swatch = (colour, kind = '') => h('span', { class: `swatch ${kind}`, style: `--colour:${colour}` });
const check = (text, on, change, id) => h('label', { class: 'check' }, h('input', { type: 'checkbox', checked: on, id, onchange: (e) => change(e.target.checked) }), ' ', text);

function summary(app) {
  const lines = app.case.parts.flatMap((p) => p.kind.summary?.(p) ?? []);
  if (app.case.scene && lines.length === 0) lines.push(`${app.case.scene.mesh.triangles.length / 3} triangles; drop a result too, to see what the cell sees`);
  return section(app.case.scene?.name ?? 'Report', ...lines.map((line) => h('p', { class: /^verdict: unsound/.test(line) ? 'bad' : '' }, line)));
}

function usedLabels(app) {
  const used = new Set(), tags = app.stage.surface?.geometry.getAttribute('tag').array ?? [];
  for (let i = 3; i < tags.length; i += 12) used.add(tags[i] & 63);
  return [...used].sort((a, b) => a - b);
}

function legend(app) {
  const choices = app.colourings();
  const chooser = choices.length > 1 && h('label', {}, 'Colours of ', h('select', { id: 'colours', onchange: (e) => app.setColours(e.target.value) }, ...choices.map((c) => h('option', { value: c.id, selected: c.id === app.colourBy }, c.name))));
  if (app.legendOf !== app.stage.surface) { app.legendOf = app.stage.surface; app.legendLabels = usedLabels(app).filter((n) => n !== NUMBER.none || !app.has('meshAt')); }
  const used = [...new Set([...app.legendLabels, ...app.able('alsoUsed').flatMap((p) => p.kind.alsoUsed(p))])].sort((a, b) => a - b), names = new Map();
  for (const n of used) { const name = app.nameOf(LABELS[n].id); names.set(name, [...(names.get(name) ?? []), n]); }
  const rows = [...names].map(([name, of]) => h('li', {}, check('', !app.away.has(LABELS[of[0]].id), (on) => app.switchLabels(of.map((n) => LABELS[n].id), on), `label-${LABELS[of[0]].id}`), of.map((n) => swatch(LABELS[n].colour, `${LABELS[n].hatch && app.hatching ? 'hatch' : ''}${of.length > 1 ? ' narrow' : ''}`)), h('label', { htmlFor: `label-${LABELS[of[0]].id}` }, name)));
  const layers = app.layers.map((l) => h('li', {}, check('', l.on, (on) => app.switchLayer(l.id, on), `layer-${l.id}`),
    h('label', { htmlFor: `layer-${l.id}` }, swatch(l.colour === 'ink' ? 'var(--ink)' : l.colour, l.id === 'dm' ? 'line dashed' : l.id === 'ob' ? 'line' : 'body'), `${l.name}${l.count ? ` (${l.count})` : ''}`)));
  return section('Legend', chooser, h('ul', { class: 'legend', id: 'legend' }, ...rows), layers.length > 0 && h('ul', { class: 'legend' }, ...layers),
    h('p', { class: 'checks' }, check('shading', app.shading, (on) => { app.shading = on; app.uniforms(); }, 'shading'), check('hatching', app.hatching, (on) => { app.hatching = on; app.uniforms(); app.changed('state'); }, 'hatching')));
}

function said(c) {
  if (c.unequal > 0) return `${c.unequal} pixels show the same triangle, and are not equal: this graphics processor does not draw alike twice, and nothing can be said`;
  if (c.differ === 0) return `none of ${c.pixels} pixels differs`;
  if (c.real === 0) return `${c.differ} of ${c.pixels} pixels differ${c.differ > 400 ? '' : ', all by rounding at edges: exact rays through them meet what is listed'}`;
  return `${c.differ} of ${c.pixels} pixels differ; missing: triangle${c.missing.length === 1 ? '' : 's'} ${c.missing.slice(0, 12).join(', ')}${c.missing.length > 12 ? '…' : ''}`;
}

function stand(app) {
  const slider = h('input', { type: 'range', id: 'viewpoint', min: 0, max: VIEWPOINTS - 1, value: app.viewpoint, 'aria-label': 'Viewpoint', oninput: (e) => app.stand(Number(e.target.value)) });
  const c = app.comparison;
  return section('Stand in the cell',
    h('p', {}, 'Left is what the list draws, right is everything. With a sound list both are the same from every point of the cell.'),
    h('label', { class: 'wide' }, `Viewpoint ${app.viewpoint}${app.viewpoint === 0 ? ' (the middle)' : ''}`, slider),
    check('mark what is missing', app.glare, (on) => app.setGlare(on), 'glare'),
    h('p', {}, h('button', { id: 'compare', onclick: () => { app.compare(); app.changed('state'); } }, 'Count pixels that differ')),
    h('p', { id: 'comparison', class: c && c.real > 0 ? 'bad' : '' }, c ? said(c) : ''),
    h('ul', { class: 'legend' }, h('li', {}, swatch('#8ab3cf'), 'surface'), h('li', {}, swatch('#ff00d4', 'hatch'), 'seen from here, but not in the list')));
}

function table(app) {
  const rows = app.able('rows').flatMap((p) => p.kind.rows(p)), verdicts = [...new Set(rows.map((r) => r.verdict))];
  if (!verdicts.includes(filter)) filter = '';
  const body = h('tbody');
  const fill = () => {
    const wanted = rows.filter((r) => (filter === '' || r.verdict === filter) && `${r.name} ${r.note ?? ''}`.includes(words));
    body.replaceChildren(...wanted.slice(0, MOST_ROWS).map((row) => {
      const here = app.row && app.row.name === row.name;
      return h('tr', { class: `${row.bad ? 'bad ' : ''}${here ? 'here' : ''}`, tabIndex: 0, 'data-verdict': row.verdict, onclick: () => app.showRow(row), onkeydown: (e) => { if (e.key === 'Enter') app.showRow(row); } },
        h('td', {}, row.verdict), h('td', {}, row.name, row.note ? h('small', {}, ` ${row.note}`) : ''));
    }));
    if (wanted.length > MOST_ROWS) body.append(h('tr', {}, h('td', { colSpan: 2 }, `and ${wanted.length - MOST_ROWS} more; choose a verdict, or type a part of the name`)));
  };
  fill();
  return section('Verdicts',
    h('p', { class: 'checks' }, h('select', { id: 'verdict', 'aria-label': 'Which verdicts', onchange: (e) => { filter = e.target.value; fill(); } }, h('option', { value: '' }, `every verdict (${rows.length})`), ...verdicts.map((v) => h('option', { value: v, selected: v === filter }, `${v} (${rows.filter((r) => r.verdict === v).length})`))),
      h('input', { id: 'words', placeholder: 'part of the name', value: words, oninput: (e) => { words = e.target.value; fill(); } })),
    h('div', { class: 'rows' }, h('table', { id: 'rows' }, body)),
    app.row?.sight && h('ul', { class: 'legend' }, h('li', {}, swatch(LAYER_COLOURS.sight, 'line'), 'the sight line'), h('li', {}, swatch('#e69f00', 'line'), 'what it passes closest')));
}

const MOST_IDS = 200, BAR_WIDTH = 300, BAR_HEIGHT = 56, BAR_COLOURS = ['#0072b2', '#e69f00'];

// One bar a step, in which values stand on each other; a click goes there.
function timeLine(app, part, { bars, barNames }) {
  const most = Math.max(1, ...bars.map((b) => b.values.reduce((x, y) => x + y, 0))), wide = BAR_WIDTH / bars.length;
  const shapes = bars.flatMap(({ values, title }, i) => {
    let top = BAR_HEIGHT;
    const parts = values.map((v, k) => { const high = (BAR_HEIGHT * v) / most; top -= high; return svg('rect', { x: i * wide, y: top, width: Math.max(0.5, wide * 0.86), height: high, fill: BAR_COLOURS[k] }); });
    const whole = svg('rect', { x: i * wide, y: 0, width: wide, height: BAR_HEIGHT, fill: i === part.at ? 'currentColor' : 'transparent', 'fill-opacity': 0.16, 'data-step': i }, svg('title', {}, title));
    whole.addEventListener('click', () => app.setStep(i));
    return [...parts, whole];
  });
  return [svg('svg', { id: 'bars', viewBox: `0 0 ${BAR_WIDTH} ${BAR_HEIGHT}`, preserveAspectRatio: 'none', role: 'img', 'aria-label': `${barNames.join(' and ')}, step by step` }, ...shapes),
    h('p', { class: 'dim' }, ...barNames.flatMap((name, k) => [swatch(BAR_COLOURS[k], 'small'), `${name} `]))];
}

function branch(node, choose) {
  if (node.cell !== undefined) return h('li', {}, h('button', { class: 'link', 'data-cell': node.cell, onclick: () => choose(node.cell) }, swatch(node.colour, 'small'), `${node.name}: ${node.note}`));
  return h('li', {}, h('details', { open: node.children.length <= 40 }, h('summary', {}, `${node.name} (${node.children.length})`), h('ul', { class: 'tree' }, ...node.children.map((n) => branch(n, choose)))));
}

function steps(app) {
  const part = app.stepper(), count = part.kind.steps(part), made = part.kind.panel(part, app);
  const slider = count > 1 && h('input', { type: 'range', id: 'step', min: 0, max: count - 1, value: part.at, 'aria-label': 'Step', oninput: (e) => app.setStep(Number(e.target.value)) });
  return section(made.title,
    slider && h('label', { class: 'wide' }, slider), ...made.lines.map((line) => h('p', {}, line)),
    ...(made.bars && made.bars.length > 1 ? timeLine(app, part, made) : []),
    ...(made.choices ?? []).map((c) => h('p', {}, h('label', {}, `${c.name} `, h('select', { id: c.id, onchange: (e) => c.set(e.target.value) }, ...c.options.map((o) => h('option', { value: o.id, selected: o.id === c.value }, o.name)))))),
    h('p', { class: 'buttons' }, made.plays && h('button', { id: 'play', title: 'P', onpointerdown: () => app.play(), onclick: (e) => { if (e.detail === 0) app.play(); } }, app.playing ? 'Stop' : 'Play'), ...(made.buttons ?? []).map((b) => h('button', { onclick: b.does, title: b.title ?? '' }, b.name))),
    ...(made.lists ?? []).map((l) => h('details', { class: 'ids' }, h('summary', {}, `${l.name} ${l.ids.length}`), ...l.ids.slice(0, MOST_IDS).map((t) => h('button', { class: 'link', onclick: () => app.select(t) }, String(t))), l.ids.length > MOST_IDS && h('span', { class: 'dim' }, ` and ${l.ids.length - MOST_IDS} more`))),
    made.tree && h('div', { class: 'rows' }, h('ul', { class: 'tree', id: 'tree' }, branch(made.tree, made.choose))));
}

function triangle(app) {
  if (app.triangle === null) return section('Triangle', h('p', { class: 'dim' }, 'Click a triangle to see how much of it is visible, and the proof.'));
  const t = app.triangle, facts = app.facts(t);
  return section(`Triangle ${t}`, nameOfPart(app.case.scene.mesh, t) !== '' && h('p', {}, nameOfPart(app.case.scene.mesh, t)),
    ...facts.map((f) => h('p', { class: 'fact' }, f.text)), facts.length === 0 && h('p', { class: 'dim' }, 'No file here says anything about it.'),
    h('p', { class: 'buttons' },
      h('button', { id: 'alone', class: app.alone ? 'on' : '', onclick: () => app.setAlone(!app.alone), title: 'A' }, 'Alone'),
      h('button', { id: 'front', onclick: () => app.straight(), title: 'N' }, 'Front'), h('button', { id: 'back', onclick: () => app.straight(true), title: 'B' }, 'Back'),
      h('button', { onclick: () => app.select(null), title: 'Escape' }, 'Close')));
}

// In place of what is there; but a slider stays where it is, for somebody may be dragging it.
function refresh(side, parts) {
  const old = side.querySelector('input[type="range"]'), section = parts.find((p) => p.querySelector(`#${old?.id ?? 'none'}`));
  if (!old || !section) { side.replaceChildren(...parts); return; }
  const made = section.querySelector(`#${old.id}`), [kept, label] = [old.closest('section'), old.closest('label')], other = made.closest('label');
  old.max = made.max;
  old.value = made.value;
  if (other.firstChild !== made) label.firstChild.data = other.firstChild.data;
  const around = (parent, stays, nodes, place) => {
    for (const node of [...parent.childNodes]) if (node !== stays) node.remove();
    stays.before(...nodes.slice(0, place));
    stays.after(...nodes.slice(place + 1));
  };
  const nodes = [...section.childNodes];
  around(kept, label, nodes, nodes.indexOf(other));
  around(side, kept, parts, parts.indexOf(section));
}

export function drawSide(app, side) {
  const scrolled = side.querySelector('.rows')?.scrollTop ?? 0, focused = document.activeElement?.id;
  if (!app.case) { side.replaceChildren(); return; }
  const parts = [summary(app)];
  if (app.view === 'verdicts') parts.push(table(app));
  if (app.view === 'stand') parts.push(stand(app));
  if (app.stepper()?.kind.view.id === app.view) parts.push(steps(app));
  if (app.case.scene) parts.push(triangle(app));
  if (app.case.scene && app.view !== 'stand') parts.push(legend(app));
  refresh(side, parts);
  const rows = side.querySelector('.rows');
  if (rows) rows.scrollTop = scrolled;
  if (focused) document.getElementById(focused)?.focus({ preventScroll: true });
}
