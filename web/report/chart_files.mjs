// A chart as a file: its numbers as CSV, its picture as SVG or PNG.
import { element } from './dom.mjs';
import { saveBlob, saveText } from './save.mjs';

const looks = ['fill', 'stroke', 'stroke-width', 'stroke-dasharray', 'stroke-linejoin', 'opacity', 'font-family', 'font-size', 'font-weight', 'text-anchor', 'visibility'];
const sharpness = 2;  // pixels of a PNG a px

function cell(value) {
  const text = value === null || value === undefined ? '' : String(value);
  return /[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}

/** { columns: texts, rows: numbers or texts } as CSV, with every digit. */
export function csvOf({ columns, rows }) {
  return [columns, ...rows].map((row) => `${row.map(cell).join(',')}\n`).join('');
}

/** The picture by itself: what the style sheet says of each part is written to it. */
export function svgOf(svg) {
  const copy = svg.cloneNode(true);
  const parts = [...svg.querySelectorAll('*')];
  [...copy.querySelectorAll('*')].forEach((part, k) => {
    const style = getComputedStyle(parts[k]);
    part.setAttribute('style', looks.map((name) => `${name}:${style.getPropertyValue(name)}`).join(';'));
  });
  for (const reading of copy.querySelectorAll('.reading')) reading.remove();
  const { width, height } = svg.getBoundingClientRect();
  copy.setAttribute('xmlns', 'http://www.w3.org/2000/svg');
  copy.setAttribute('viewBox', `0 0 ${width} ${height}`);
  copy.setAttribute('style', `background:${getComputedStyle(document.documentElement).getPropertyValue('--card')}`);
  return new XMLSerializer().serializeToString(copy);
}

async function pngOf(svg) {
  const picture = new Image();
  picture.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(svgOf(svg))}`;
  await picture.decode();
  const { width, height } = svg.getBoundingClientRect();
  const canvas = element('canvas', { width: Math.round(width * sharpness), height: Math.round(height * sharpness) });
  const context = canvas.getContext('2d');
  context.fillStyle = getComputedStyle(document.documentElement).getPropertyValue('--card');
  context.fillRect(0, 0, canvas.width, canvas.height);
  context.drawImage(picture, 0, 0, canvas.width, canvas.height);
  return new Promise((made) => { canvas.toBlob(made, 'image/png'); });
}

/** Buttons that save a chart. `name`: of its files; `svg()` and `table()` give what is shown now. */
export function saveButtons(name, svg, table) {
  const button = (text, act) => element('button', { type: 'button', class: 'quiet', 'aria-label': `Save the chart ${name} as ${text}`, onclick: act }, text);
  return element('div', { class: 'chart-files' }, element('span', { 'aria-hidden': 'true' }, 'Save'),
    button('CSV', () => saveText(csvOf(table()), `${name}.csv`, 'text/csv')), button('SVG', () => saveText(svgOf(svg()), `${name}.svg`, 'image/svg+xml')),
    button('PNG', async () => saveBlob(await pngOf(svg()), `${name}.png`)));
}
