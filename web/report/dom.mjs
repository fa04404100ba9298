// Elements made without markup: whatever a file says can only become text.

const svgNamespace = 'http://www.w3.org/2000/svg';

function fill(node, attributes, children) {
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith('on')) node.addEventListener(name.slice(2), value);
    else if (value === true) node.setAttribute(name, '');
    else if (value !== false && value !== null && value !== undefined) node.setAttribute(name, String(value));
  }
  node.append(...children.flat(Infinity).filter((child) => child !== null && child !== undefined));
  return node;
}

/** `attributes` whose names begin with "on" are listeners; children are elements or texts, null is left out. */
export function element(tag, attributes = {}, ...children) {
  return fill(document.createElement(tag), attributes, children);
}

/** The same of SVG. */
export function shape(tag, attributes = {}, ...children) {
  return fill(document.createElementNS(svgNamespace, tag), attributes, children);
}

/** A picture on a button, 24 units wide; `paths` are SVG path data. */
export function icon(...paths) {
  return shape('svg', { viewBox: '0 0 24 24', 'aria-hidden': 'true', focusable: 'false' }, paths.map((d) => shape('path', { d })));
}

let choices = 0;

/** One choice of few, side by side: radio buttons under a name. `options`: [{ value, text, name (said aloud) }]. */
export function choice(title, options, chosen, change) {
  const group = `choice-${++choices}`;
  const buttons = options.map(({ value, text, name }, k) => element('label', {},
    element('input', { type: 'radio', name: group, value: k, checked: value === chosen, 'aria-label': name ?? null, onchange: () => change(value) }),
    element('span', {}, text)));
  return element('fieldset', { class: 'choice' }, element('legend', {}, title), element('div', { class: 'choice-row' }, buttons));
}

/** Buttons side by side under a name. `acts`: [text, what a press does, name (said aloud)]. */
export function presses(title, acts) {
  return element('div', { class: 'choice', role: 'group', 'aria-label': title }, element('span', { class: 'choice-title' }, title),
    element('div', { class: 'choice-row' }, acts.map(([text, act, name]) => element('button', { type: 'button', 'aria-label': name ?? null, title: name ?? null, onclick: act }, text))));
}

/** One choice of many, in a list that opens. `options`: [{ value, text }]. */
export function listChoice(title, options, chosen, change) {
  const list = element('select', { 'aria-label': title, onchange: () => change(options[list.selectedIndex].value) },
    options.map(({ value, text }) => element('option', { selected: value === chosen }, text)));
  return element('label', { class: 'list-choice' }, element('span', {}, title), list);
}

/** What is folded under a summary until the reader opens it; on paper it is open. */
export function folded(summary, ...children) {
  const frame = element('details', { class: 'card folded' }, element('summary', {}, summary), ...children);
  let wasOpen = false;
  addEventListener('beforeprint', () => {
    wasOpen = frame.open;
    frame.open = true;
  });
  addEventListener('afterprint', () => { frame.open = wasOpen; });
  return frame;
}

/** A section of the page with its heading. */
export function section(id, title, ...children) {
  return element('section', { id, 'aria-labelledby': `${id}-title` }, element('h2', { id: `${id}-title` }, title), ...children);
}

/** A table that scrolls by itself where it is too wide; `columns`: [{ name, unit }], `rows`: texts. */
export function table(caption, columns, rows) {
  const isNumber = (text) => Number.isFinite(Number(text.replaceAll('\u202f', '')));  // between thousands
  const numeric = columns.map((_, k) => k > 0 && rows.every((row) => !row[k] || isNumber(row[k])));
  const align = (k) => (numeric[k] ? 'number' : null);
  const head = columns.map(({ name, unit }, k) => element('th', { scope: 'col', class: align(k) }, name,
    unit ? element('span', { class: 'unit' }, ` ${unit}`) : null));
  const body = rows.map((row) => element('tr', {}, row.map((cell, k) => (k === 0
    ? element('th', { scope: 'row', class: align(k) }, cell ?? '')
    : element('td', { class: align(k) }, cell ?? '')))));
  return element('div', { class: 'table-frame', tabindex: '0', role: 'region', 'aria-label': caption },
    element('table', {}, element('caption', { class: 'unseen' }, caption), element('thead', {}, element('tr', {}, head)), element('tbody', {}, body)));
}
