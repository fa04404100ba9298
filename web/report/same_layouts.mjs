// Layouts that are the same tray, such as one hole over two spans: they stand in one row.

/** The layouts, of those with the same tray, runs and standing the first only, with { number, name, values } of the others as `same`. */
export function withoutTwins(layouts) {
  const first = new Map();
  for (const layout of layouts) {
    const { number, name, values, vessels, scene, means, holes, status, standing, replicates } = layout;
    const of = vessels.length === 0 ? number : JSON.stringify([vessels, scene, means, holes, status, standing, replicates]);
    if (first.has(of)) first.get(of).same.push({ number, name, values });
    else first.set(of, { ...layout, same: [] });
  }
  return [...first.values()];
}

/** "7", or "7 = 9 = 11" of one that stands for others too. */
export function numbersOf({ number, same = [] }) {
  return [number, ...same.map((twin) => twin.number)].join(' = ');
}

/** The layout by its own name and values, and by those of each that it stands for. */
export function eachOf(layout) {
  return [layout, ...(layout.same ?? []).map(({ name, values }) => ({ ...layout, name, values }))];
}
