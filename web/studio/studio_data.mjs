// What the program wrote into the page.
import { tooLongAsWritten } from './limits.mjs';

// Only what can play is offered: the program says what it refuses and how many steps the rest takes.
function judged(seeder) {
  const problem = seeder.live ? tooLongAsWritten(seeder) : '';
  return problem ? { ...seeder, live: false, why_not: problem } : seeder;
}

/** `text`: its JSON. Throws a SyntaxError for what is not JSON, an Error for what is not of the studio or has no seeder to show. */
export function readStudioData(text) {
  const data = JSON.parse(text);
  if (data.kind !== 'studio') throw new Error(`its data are of the kind "${data.kind}", which this page does not know`);
  const seeders = (data.seeders ?? []).map(judged);
  const live = seeders.filter((seeder) => seeder.live);
  if (live.length === 0) throw new Error('none of its seeders can be simulated here');
  const asked = seeders.find((seeder) => seeder.name === data.opened);
  return { program: data.program ?? {}, seeders, linked: [], crops: data.crops ?? [], sent: data.sent ?? '', asked: asked ?? null, opened: asked?.live ? asked : live[0] };
}
