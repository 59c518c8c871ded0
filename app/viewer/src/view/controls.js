// Mouse, fingers and wheel.
export function control(canvas, camera, { changed, hover, click, busy }) {
  const fingers = new Map();
  let moved = 0, spread = 0;
  const at = (event) => { const r = canvas.getBoundingClientRect(); return [event.clientX - r.left, event.clientY - r.top]; };
  canvas.addEventListener('pointerdown', (event) => {
    busy();
    canvas.setPointerCapture(event.pointerId);
    fingers.set(event.pointerId, at(event));
    moved = 0;
    spread = 0;
  });
  canvas.addEventListener('pointermove', (event) => {
    const before = fingers.get(event.pointerId), now = at(event);
    if (!before) { hover(...now); return; }
    const [dx, dy] = [now[0] - before[0], now[1] - before[1]], height = canvas.clientHeight || 1;
    moved += Math.abs(dx) + Math.abs(dy);
    fingers.set(event.pointerId, now);
    if (moved < 3) return;
    if (fingers.size === 2) {
      const [a, b] = [...fingers.values()], far = Math.hypot(a[0] - b[0], a[1] - b[1]);
      if (spread > 0 && far > 0) camera.zoom(spread / far);
      spread = far;
      camera.slide(dx / height / 2, dy / height / 2);
    } else if (event.shiftKey || event.buttons & 6) {
      camera.slide(dx / height, dy / height);
    } else {
      const speed = camera.eye ? -(camera.perspective.fov * Math.PI) / 180 / height : 5 / height;
      camera.turn(dx * speed, dy * speed);
    }
    changed();
  });
  const end = (event) => {
    const known = fingers.delete(event.pointerId);
    if (known && event.type === 'pointerup' && moved < 3 && event.button === 0) click(...at(event));
  };
  canvas.addEventListener('pointerup', end);
  canvas.addEventListener('pointercancel', end);
  canvas.addEventListener('pointerleave', () => hover(-1, -1));
  canvas.addEventListener('contextmenu', (event) => event.preventDefault());
  canvas.addEventListener('wheel', (event) => {
    event.preventDefault();
    busy();
    camera.zoom(Math.exp(Math.max(-200, Math.min(200, event.deltaY)) * 0.0015));
    changed();
  }, { passive: false });
}
