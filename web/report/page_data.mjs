// What the program wrote into the page. Missing parts become empty ones, so that the rest is shown all the same.

import { withoutTwins } from './same_layouts.mjs';

const empty = { program: {}, title: '', space: 'plane', headline: '', expected: '', remarks: [], vessels: [], scene: {} };

const emptyOf = {
  run: {
    kind: 'run', status: 'finished', end_time_s: 0, window_s: null, lots: [], holes: [], rate_unit: 'seeds/s',
    hole_table: { columns: [], rows: [] }, unevenness: null, events: { time_s: [], hole: [], lot: [] }, effects: [], guard: '', settings: [],
    drill: null,
  },
  sweep: { keys: [], figures: [], layouts: [] },
  decision: { asked: [], cost: [], keys: [], figures: [], layouts: [] },
  accuracy: { headlines: [], against: 'the finest setting', within_percent: 1, levels: [], errors: [] },
  calibration: { quantity: '', of_curves: false, parameters: [], pairs: [], series: [], account: [] },
  front: { asked: [], cost: [], keys: [], figures: [], layouts: [] },
};

const emptyLayout = { name: '', values: [], status: 'ok', note: '', expected: '', replicates: 0, means: {}, misfit_percent: null, holes: [], vessels: [], scene: {}, command: '', replay: null, at_edge: [] };

function filled(given, ...defaults) {
  return Object.assign({}, ...defaults, Object.fromEntries(Object.entries(given).filter(([, value]) => value !== null)));
}

/** `text`: the JSON of one page. Throws a SyntaxError for what is not JSON, an Error for another kind. */
export function readPageData(text) {
  const given = JSON.parse(text);
  const kind = given.kind ?? 'run';
  if (!Object.hasOwn(emptyOf, kind)) throw new Error(`its data are of the kind "${kind}", which this page does not know`);
  const data = filled(given, empty, emptyOf[kind]);
  if (kind === 'run') data.window_s = data.window_s ?? [0, data.end_time_s];
  if (data.layouts) data.layouts = withoutTwins(data.layouts.map((layout) => filled(layout, emptyLayout, { compared: (layout.status ?? 'ok') === 'ok' })));
  return data;
}

/** Bytes of base64, without line breaks; none of an empty text. */
export function bytesOfBase64(text) {
  const packed = atob(text.trim());
  const bytes = new Uint8Array(packed.length);
  for (let k = 0; k < packed.length; ++k) bytes[k] = packed.charCodeAt(k);
  return bytes;
}
