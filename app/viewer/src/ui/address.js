// What is shown, in the fragment of the address: the permalink.
import { NUMBER } from '../view/labels.js';

export function writeAddress(app) {
  if (!app.case || location.protocol === 'about:') return;  // within another page there is no address
  const words = new URLSearchParams();
  const index = app.workspace.cases.indexOf(app.case);
  if (index > 0) words.set('case', index);
  words.set('view', app.view);
  if (app.case.scene) words.set('cam', app.camera.write());
  if (app.camera.up !== 'z') words.set('up', app.camera.up);
  if (app.stepper()) words.set('at', app.stepper().kind.state(app.stepper()));
  if (app.triangle !== null) words.set('tri', app.triangle);
  if (app.alone) words.set('alone', 1);
  if (app.viewpoint > 0) words.set('vp', app.viewpoint);
  if (!app.glare) words.set('glare', 0);
  if (app.colourings()[0] && app.colourBy !== app.colourings()[0].id) words.set('colours', app.colourBy);
  if (app.away.size > 0) words.set('without', [...app.away].join());
  const switched = [...app.switched].map(([id, on]) => (on ? id : `-${id}`));
  if (switched.length > 0) words.set('layers', switched.join());
  const text = `#${words.toString().replaceAll('%2C', ',').replaceAll('%3A', ':')}`;
  if (text !== location.hash) history.replaceState(null, '', text);
}

export function readAddress(app, hash = location.hash) {
  const words = new URLSearchParams(hash.slice(1)), whole = (name) => (/^\d+$/.test(words.get(name) ?? '') ? Number(words.get(name)) : null);
  if (app.workspace.cases.length === 0 || [...words].length === 0) return;
  for (const layer of (words.get('layers') ?? '').split(',').filter((l) => l !== '')) app.switched.set(layer.replace(/^-/, ''), !layer.startsWith('-'));
  app.away = new Set((words.get('without') ?? '').split(',').filter((id) => id in NUMBER));
  if (words.get('up') === 'y') app.camera.up = 'y';
  if (words.get('glare') === '0') app.glare = false;
  app.choose(Math.min(whole('case') ?? 0, app.workspace.cases.length - 1));
  if (words.has('at') && app.stepper()) {
    app.stepper().kind.restore(app.stepper(), words.get('at'));
    app.setStep(app.stepper().at);
  }
  app.setView(words.get('view') ?? app.view);
  if (app.colourings().some((c) => c.id === words.get('colours'))) app.setColours(words.get('colours'));
  if (!app.case.scene) return;
  if (whole('tri') !== null) app.select(whole('tri'));
  if (words.get('alone') === '1') app.setAlone(true);
  if (whole('vp') !== null) app.viewpoint = Math.min(whole('vp'), 99);
  if (app.view === 'stand') app.stand(app.viewpoint);
  if (words.has('cam')) app.camera.read(words.get('cam'));
  app.stage.draw();
}
