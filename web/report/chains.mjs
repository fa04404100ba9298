// Force chains: a line a contact from centre to centre, to a wall as far as the place of contact; wider and less
// transparent the larger its normal force.

const steps = [0.25, 0.5, 1, 2, 4, 8];  // of the mean force: where a next kind of line begins
const ofMean = 0.35;                    // width of the line of the mean force, of a seed's mean radius
const thinnest = 0.7;                   // px

function mean(values) {
  return values.length ? values.reduce((sum, value) => sum + value, 0) / values.length : 0;
}

/** Lines of a frame's contacts, mm in the lab: { ends: [x, y, z, x, y, z] of each, kind of each, count, mean and largest in N }. */
export function chainsOf(contacts, frame, recording) {
  const mm = recording.units.map((unit) => unit * 1000);
  const inSpace = recording.fields[2] === 'z';
  const at = (k) => [frame.values[0][k] * mm[0], frame.values[1][k] * mm[1], inSpace ? frame.values[2][k] * mm[2] : 0];
  const all = [...contacts.force, ...contacts.touch].filter((force) => force > 0);
  const chains = { ends: [], kind: [], count: all.length, mean: mean(all), largest: contacts.largest };
  const add = (from, to, force) => {
    const kind = steps.findLastIndex((step) => force >= step * chains.mean);
    if (kind < 0 || !(force > 0)) return;
    chains.ends.push([...from, ...to]);
    chains.kind.push(kind);
  };
  contacts.force.forEach((force, k) => add(at(contacts.grain[k]), at(contacts.partner[k]), force));
  contacts.touch.forEach((force, k) => {
    const from = at(contacts.touched[k]);
    const radius = recording.radii[frame.ids[contacts.touched[k]]] * 1000;
    add(from, from.map((value, axis) => value + radius * (contacts.place[axis]?.[k] ?? 0)), force);
  });
  return chains;
}

/** How lines of each kind look: { width (of a seed's mean radius), opacity }; null of contacts below `least` mean forces. */
export function chainLooks(least = 0) {
  return steps.map((step, kind) => (step < least ? null : { width: ofMean * Math.sqrt(step), opacity: 0.3 + (0.7 * (kind + 1)) / steps.length }));
}

/** Draws them; `project(x, y, z)` gives places on the screen, `radius` is a seed's there; contacts below `least` mean forces are left out. */
export function drawChains(context, chains, { colour, radius, project, least = 0 }) {
  const paths = steps.map(() => new Path2D());
  chains.ends.forEach(([x, y, z, toX, toY, toZ], k) => {
    const path = paths[chains.kind[k]];
    const [from, to] = [project(x, y, z), project(toX, toY, toZ)];
    path.moveTo(from[0], from[1]);
    path.lineTo(to[0], to[1]);
  });
  context.save();
  context.strokeStyle = colour;
  context.lineCap = 'round';
  chainLooks(least).forEach((look, kind) => {
    if (!look) return;
    context.globalAlpha = look.opacity;
    context.lineWidth = Math.max(thinnest, look.width * radius);
    context.stroke(paths[kind]);
  });
  context.restore();
}

/** The mean radius of the seeds that were recorded, mm. */
export function meanRadius(recording) {
  return 1000 * mean([...recording.radii].filter((radius) => radius > 0));
}
