// A run in the plane again, in the page itself: the same scene, the same random seed, and so the same counts.
import { hasSimulator, startSimulator } from '../core/simulator.mjs';
import { element, section } from './dom.mjs';
import { clock } from './format.mjs';

function countsOf(data) {
  return data.holes.map(({ counted_all }) => counted_all);
}

/** What a finished run in the page says beside what the file holds. */
export function verdict(counted, ofFile) {
  const differing = counted.findIndex((count, k) => count !== ofFile[k]);
  const all = counted.reduce((sum, count) => sum + count, 0);
  if (counted.length !== ofFile.length) return 'The page simulated another number of holes than the file has.';
  if (differing >= 0) return `Hole ${differing + 1} let out ${counted[differing]} seeds here and ${ofFile[differing]} in the file.`;
  return `The same ${all} seeds left by the same holes as in the file.`;
}

export function rerunSection(data) {
  if (data.space !== 'plane' || data.status === 'interrupted') return null;
  if (!hasSimulator()) {
    return section('rerun', 'Run it again here',
      element('p', {}, 'This page was written without the simulator, which would make the run again in it. The packages have it, and so has a source tree in which scripts/web has run.'));
  }
  const said = element('p', { 'aria-live': 'polite' });
  const course = element('progress', { max: 1, value: 0, 'aria-label': 'How far the run in the page is', hidden: true });
  const button = element('button', { type: 'button', class: 'quiet' });
  let simulator = null;

  function rest(text) {
    simulator?.close();
    simulator = null;
    course.hidden = true;
    button.textContent = 'Run it again';
    said.textContent = text;
  }

  async function run() {
    button.textContent = 'Stop';
    course.hidden = false;
    course.value = 0;
    simulator = await startSimulator();
    await simulator.open(JSON.stringify(data.scene), data.random_seed);
    simulator.play({
      pace: null,
      onFrame({ time_s, counted }) {
        course.value = time_s / data.end_time_s;
        said.textContent = `${clock(time_s)}: ${counted.join(', ')} seeds at the holes.`;
      },
      onEnd: ({ holes }) => rest(verdict(holes.map(({ counted_all }) => counted_all), countsOf(data))),
      onFail: ({ message }) => rest(`It cannot be run here: ${message}.`),
    });
  }

  button.addEventListener('click', () => {
    if (simulator) rest('Stopped.');
    else run().catch(({ message }) => rest(`It cannot be run here: ${message}.`));
  });
  rest('');
  return section('rerun', 'Run it again here',
    element('p', {}, 'The simulator is in this page. It makes the same run of the same scene, seed by seed.'), element('p', { class: 'transport' }, button, course), said);
}
