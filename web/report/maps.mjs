// Maps of where seeds are dense and how they flow, in the mean over the measured time: in the tray, and in the hopper, each in its own frame.
import { layerScale, speedScale } from './colours.mjs';
import { element, section } from './dom.mjs';
import { niceAbove, number } from './format.mjs';
import { wallsSeenFrom } from './geometry.mjs';
import { legendParts } from './legend.mjs';
import { emptyShare, mapSentence, packingSentence, speeds, velocitySentence } from './map_sentences.mjs';
import { Stage } from './stage.mjs';
import { inks, onTheme, theme } from './theme.mjs';

const margin = 12;       // px
const arrowEvery = 26;   // px, at least
const steps = 20;        // of a colour scale
const narrowest = 320;   // px, of a small vessel's map
const faint = 0.12;      // cells that seeds fill to less fade away

// A vessel's part that a map shows, mm: all its length, and its height as far as seeds were, and a little more.
function partOf(map, vessel) {
  const ys = (vessel?.lines ?? []).flatMap(({ points_mm: points }) => points.map(([, y]) => y));
  const cell = map.cell * 1000;
  return { right: Math.max(vessel?.length_mm ?? 0, map.columns * cell), low: Math.min(0, ...ys), high: (map.rows + 1) * cell };
}

// The other vessels of which something stands in that part.
function besideTray(map, [tray, ...others]) {
  const { high } = partOf(map, tray);
  return others.filter((vessel) => wallsSeenFrom(tray, vessel).some((wall) => wall.some(([, y]) => y < high)));
}

class MapView {
  // `vessels`: the map's own, and those that are drawn with it.
  constructor(map, vessels, { values, top, scale, arrows }) {
    const [own] = vessels;
    Object.assign(this, { map, values, top, scale, arrows, part: partOf(map, own), walls: vessels.flatMap((vessel) => wallsSeenFrom(own, vessel)) });
  }

  height(width) {
    const { right, low, high } = this.part;
    return ((width - 2 * margin) / right) * (high - low) + 2 * margin;
  }

  draw({ context, width, height }) {
    const { right, high } = this.part;
    context.clearRect(0, 0, width, height);
    this.pixels = (width - 2 * margin) / right;
    this.at = (x, y) => [margin + this.pixels * x, margin + this.pixels * (high - y)];
    this.drawCells(context);
    if (this.arrows) this.drawArrows(context);
    this.drawWalls(context);
  }

  drawCells(context) {
    const { map, values, top } = this;
    const colours = this.scale(steps, theme());
    const side = map.cell * 1000 * this.pixels;
    values.forEach((value, k) => {
      if (!(value > 0)) return;
      const [x, y] = this.at((k % map.columns) * map.cell * 1000, (Math.floor(k / map.columns) + 1) * map.cell * 1000);
      context.fillStyle = colours[Math.min(steps - 1, Math.floor((value / top) * steps))];
      context.globalAlpha = Math.min(1, map.packing[k] / faint);
      context.fillRect(x, y, side, side);
    });
    context.globalAlpha = 1;
  }

  // The mean velocity of some cells together: an arrow, as long as it is fast.
  drawArrows(context) {
    const { map } = this;
    const cells = Math.max(1, Math.ceil(arrowEvery / (map.cell * 1000 * this.pixels)));
    for (let row = 0; row < map.rows; row += cells) {
      for (let column = 0; column < map.columns; column += cells) this.drawArrow(context, row, column, cells);
    }
  }

  drawArrow(context, firstRow, firstColumn, cells) {
    const { map } = this;
    let [weight, vx, vy, x, y] = [0, 0, 0, 0, 0];
    for (let row = firstRow; row < Math.min(map.rows, firstRow + cells); ++row) {
      for (let column = firstColumn; column < Math.min(map.columns, firstColumn + cells); ++column) {
        const k = row * map.columns + column;
        if (map.packing[k] < emptyShare) continue;
        const share = map.packing[k];
        weight += share;
        vx += share * map.vx[k], vy += share * map.vy[k];
        x += share * (column + 0.5), y += share * (row + 0.5);
      }
    }
    const speed = Math.hypot(vx, vy) / weight;
    if (!(speed > 0.02 * this.top)) return;
    const length = arrowEvery * (0.35 + 0.5 * Math.min(1, speed / this.top));
    const [cos, sin] = [vx / weight / speed, -vy / weight / speed];
    const [cx, cy] = this.at((x / weight) * map.cell * 1000, (y / weight) * map.cell * 1000);
    const place = (along, aside) => [cx + cos * along - sin * aside, cy + sin * along + cos * aside];
    const ends = [[place(-length / 2, 0), place(length / 2, 0)], [place(length / 2 - 4.5, -3.2), place(length / 2, 0), place(length / 2 - 4.5, 3.2)]];
    const ink = inks();
    for (const [colour, thick] of [[ink.halo, 3.4], [ink.ink, 1.4]]) {
      context.strokeStyle = colour;
      context.lineWidth = thick;
      context.lineCap = context.lineJoin = 'round';
      context.beginPath();
      for (const line of ends) line.forEach(([px, py], k) => (k ? context.lineTo(px, py) : context.moveTo(px, py)));
      context.stroke();
    }
  }

  drawWalls(context) {
    context.strokeStyle = inks().wall;
    context.lineWidth = 2;
    context.lineCap = context.lineJoin = 'round';
    for (const wall of this.walls) {
      context.beginPath();
      for (const [x, y] of wall) context.lineTo(...this.at(x, y));
      context.stroke();
    }
  }
}

// `share`: how wide it is drawn, of the page's width.
function mapFigure(id, title, sentence, view, legend, share) {
  const canvas = element('canvas', { role: 'img', 'aria-label': `${title}. ${sentence}` });
  const key = element('p', { class: 'legend' }), place = element('div', { class: 'stage' }, canvas);
  if (share < 1) place.style.maxWidth = `max(${narrowest}px, ${100 * share}%)`;
  const figure = element('figure', { class: 'card map', id }, element('h3', {}, title), place, key, element('figcaption', {}, sentence));
  const stage = new Stage(canvas, (width) => view.height(width), () => view.draw(stage));
  const paint = () => {
    key.replaceChildren(...legendParts(legend, view.scale(steps, theme())));
    if (stage.width) view.draw(stage);
  };
  onTheme(paint);
  paint();
  return figure;
}

// Packing and velocity of one vessel, under a sentence that says what they are of.
function mapPair(data, { vessel: name, map }, isInHopper) {
  const [tray] = data.vessels;
  const own = data.vessels.find((vessel) => vessel.name === name) ?? tray, isTray = own === tray;
  const drawn = isTray ? data.vessels : [own], id = isTray ? 'map' : `${name}-map`, of = isTray ? '' : ` in the ${name}`;
  const speed = speeds(map);
  const dense = Math.max(0.1, Math.ceil(Math.max(...map.packing) * 10 - 1e-6) / 10), fast = niceAbove(Math.max(0, ...speed.filter((value) => !Number.isNaN(value))));
  const share = Math.min(1, own.length_mm / tray.length_mm);
  const fills = data.space !== 'plane' ? 'part of a cell’s volume that seeds fill' : 'part of a cell’s area that seeds cover';
  return [element('p', { class: 'lead' }, mapSentence(map, data.space, own, { beside: isTray ? besideTray(map, data.vessels) : [], isInHopper })),
    element('div', { class: 'maps' },
      mapFigure(`${id}-packing`, `Packing${of}`, packingSentence(map, own), new MapView(map, drawn, { values: map.packing, top: dense, scale: layerScale }),
        { kind: 'scale', low: '0', high: number(dense), note: fills }, share),
      mapFigure(`${id}-velocity`, `Velocity${of}`, velocitySentence(map, own), new MapView(map, drawn, { values: speed, top: fast, scale: speedScale, arrows: true }),
        { kind: 'scale', low: '0', high: `${number(fast)} m/s`, note: `mean velocity against the ${own.name}; arrows point where it goes` }, share))];
}

/** The section of a recording's `maps`: [{ vessel, map }]; null of a run that kept none. */
export function mapsSection(data, maps) {
  if (maps.length === 0) return null;
  const isInHopper = maps.some(({ vessel }) => vessel === 'hopper');
  return section('maps', 'Where the bed is dense, and how it flows', maps.flatMap((one) => mapPair(data, one, isInHopper)));
}
