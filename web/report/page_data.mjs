// What the program wrote into the page. Missing parts become empty ones, so that the rest is shown all the same.

const empty = {
  kind: 'run', program: {}, title: '', space: 'plane', headline: '', remarks: [], status: 'finished', end_time_s: 0,
  window_s: null, lots: [], vessels: [], holes: [], rate_unit: 'seeds/s', hole_table: { columns: [], rows: [] }, evenness: null,
  events: { time_s: [], hole: [], lot: [] }, effects: [], guard: '', settings: [], drill: null, scene: {},
};

/** `text`: the JSON of one run. Throws a SyntaxError for what is not JSON. */
export function readPageData(text) {
  const given = JSON.parse(text);
  const data = { ...empty };
  for (const [key, value] of Object.entries(given)) {
    if (value !== null) data[key] = value;
  }
  data.window_s = data.window_s ?? [0, data.end_time_s];
  return data;
}

/** Bytes of base64, without line breaks; none of an empty text. */
export function bytesOfBase64(text) {
  const packed = atob(text.trim());
  const bytes = new Uint8Array(packed.length);
  for (let k = 0; k < packed.length; ++k) bytes[k] = packed.charCodeAt(k);
  return bytes;
}
