// The keyboard.
import { VIEWPOINTS } from '../view/stand.js';
import { h } from './dom.js';

const KEYS = [
  ['arrows', 'turn; with Shift: move', null],
  ['+ −', 'nearer, farther', null],
  ['1 2 3…', 'the views, in the order of their buttons', null],
  ['[ ]', 'previous and next viewpoint, row of the table, cell, frame or level', null],
  ['P', 'play the frames, or stop', (app) => app.play()],
  ['F', 'fit all of the scene', (app) => app.fit()],
  ['O', 'with or without perspective', (app) => app.setFlat(!app.camera.state.flat)],
  ['U', 'up is z or y', (app) => app.setUp(app.camera.up === 'z' ? 'y' : 'z')],
  ['A', 'the chosen triangle alone', (app) => app.setAlone(!app.alone)],
  ['N B', 'its front, its back', null],
  ['C', 'count pixels that differ (in the cell)', (app) => { if (app.view === 'stand') { app.compare(); app.changed('state'); } }],
  ['S', 'save the picture', null],
  ['T', 'light or dark', (app) => app.setTheme(!app.dark)],
  ['Esc', 'nothing chosen', null],
];

export function keyboard(app, { save, help }) {
  document.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || ['INPUT', 'SELECT', 'TEXTAREA'].includes(event.target.tagName) && event.key !== 'Escape') return;
    if (event.key === '?') { help(); return; }
    if (!app.case?.scene) return;
    const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
    if (step) {
      event.preventDefault();
      app.stopFlight();
      if (event.shiftKey) app.camera.slide(-0.08 * step[0], -0.08 * step[1]);
      else app.camera.turn(...step.map((x) => x * (app.camera.eye ? 0.06 : -0.1)));
      app.stage.move();
      app.changed('camera');
    } else if (event.key === '+' || event.key === '=' || event.key === '-') {
      app.camera.zoom(event.key === '-' ? 1.15 : 1 / 1.15);
      app.stage.move();
      app.changed('camera');
    } else if (event.key >= '1' && event.key <= '9') {
      app.setView(app.views()[event.key - 1]?.id);
    } else if (event.key === '[' || event.key === ']') {
      const by = event.key === ']' ? 1 : -1;
      if (app.stepper()?.kind.view.id === app.view) app.setStep(app.stepper().at + by);
      if (app.view === 'stand') app.stand((app.viewpoint + by + VIEWPOINTS) % VIEWPOINTS);
      if (app.view === 'verdicts') {
        const rows = app.able('rows').flatMap((p) => p.kind.rows(p)), at = rows.findIndex((r) => r.name === app.row?.name);
        app.showRow(rows[Math.max(0, Math.min(rows.length - 1, at + by))]);
      }
    } else if (event.key === 'Escape') {
      app.select(null);
    } else {
      const key = event.key.toUpperCase();
      if (key === 'S') save();
      else if (key === 'N' || key === 'B') app.straight(key === 'B');
      else KEYS.find(([name, , does]) => name === key && does)?.[2](app);
    }
  });
}

export function keysTable(close) {
  return [h('h2', {}, 'Keys'), h('table', {}, ...KEYS.map(([key, what]) => h('tr', {}, h('th', {}, key), h('td', {}, what)))),
    h('p', {}, 'Drag to turn, wheel or two fingers to come nearer, Shift or the right button to move. The address of the page holds what is shown.'), h('button', { onclick: close }, 'Close')];
}
