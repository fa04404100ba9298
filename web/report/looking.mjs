// Hands on a camera: a pointer turns, two of them or one with Shift move and zoom, the wheel zooms once the picture is chosen, and so do keys.

const turnOfPixel = 0.008;  // rad
const turnOfKey = 0.1;
const panOfKey = 30;        // px
const zoomOfKey = 1.25;
const zoomOfWheel = 0.0015;
const still = 4;            // px that a press may move and chooses a seed all the same

const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
const zooms = { '+': zoomOfKey, '=': zoomOfKey, '-': 1 / zoomOfKey };

const middleOf = ([a, b = a]) => [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
const apart = ([a, b]) => (b ? Math.hypot(a[0] - b[0], a[1] - b[1]) : 1);

/** `changed` is called after each turn, move or zoom; `reset` for the key 0; `choose(x, y)` for a press, px, or of the middle for the key Enter. */
export function lookAround(canvas, camera, { changed, reset, choose }) {
  const held = new Map();  // places of pointers that are down
  let pressed = null;      // where, until it moves

  const keys = ({ key, shiftKey }) => {
    const [x, y] = arrows[key] ?? [];
    if (x !== undefined && shiftKey) camera.pan(-panOfKey * x, panOfKey * y);
    else if (x !== undefined) camera.orbit(turnOfKey * x, turnOfKey * y);
    else if (zooms[key]) camera.zoomBy(zooms[key]);
    else if (key === '0') reset();
    else if (key === 'Enter') choose(camera.width / 2, camera.height / 2);
    else return false;
    return true;
  };

  const drag = (before, now, event) => {
    const [from, to] = [middleOf(before), middleOf(now)];
    const by = [to[0] - from[0], to[1] - from[1]];
    if (now.length > 1) camera.zoomBy(apart(now) / apart(before), ...to);
    if (now.length > 1 || event.shiftKey || event.buttons > 1) camera.pan(...by);
    else camera.orbit(turnOfPixel * by[0], turnOfPixel * by[1]);
  };

  const placeOf = ({ clientX, clientY }) => {
    const { left, top } = canvas.getBoundingClientRect();
    return [clientX - left, clientY - top];
  };

  canvas.addEventListener('pointerdown', (event) => {
    held.set(event.pointerId, placeOf(event));
    pressed = held.size === 1 ? placeOf(event) : null;
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener('pointermove', (event) => {
    if (!held.has(event.pointerId)) return;
    if (pressed && apart([pressed, placeOf(event)]) > still) pressed = null;
    const before = [...held.values()].slice(0, 2);
    held.set(event.pointerId, placeOf(event));
    drag(before, [...held.values()].slice(0, 2), event);
    changed();
  });
  canvas.addEventListener('pointerup', () => {
    if (pressed) choose(...pressed);
    pressed = null;
  });
  for (const end of ['pointerup', 'pointercancel', 'lostpointercapture']) canvas.addEventListener(end, ({ pointerId }) => held.delete(pointerId));
  canvas.addEventListener('contextmenu', (event) => event.preventDefault());
  canvas.addEventListener('wheel', (event) => {
    if (document.activeElement !== canvas && !event.ctrlKey) return;  // the page scrolls
    event.preventDefault();
    camera.zoomBy(Math.exp(-zoomOfWheel * event.deltaY * (event.deltaMode === 1 ? 16 : 1)), ...placeOf(event));
    changed();
  }, { passive: false });
  canvas.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey || !keys(event)) return;
    event.preventDefault();
    event.stopPropagation();
    changed();
  });
}
