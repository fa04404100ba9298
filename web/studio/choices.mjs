// Which seeder, which crop, how accurate.
import { choice, element } from '../report/dom.mjs';
import { accuraciesOf, asWritten } from './layout.mjs';

const accuracyTexts = { draft: 'Draft', design: 'Design', reference: 'Reference', [asWritten]: 'As written' };
const accuracyWords = {
  draft: 'Draft: softer seeds, the quickest; for trying things out.',
  design: 'Design: stiffer seeds, about half as fast; for deciding between layouts.',
  reference: 'Reference: the stiffest seeds and the finest steps, many times slower.',
  [asWritten]: 'As written: stiffness and steps that the seeder’s file says.',
};

function list(title, groups, chosen, choose) {
  const options = [];
  const option = ({ value, text }) => {
    options.push(value);
    return element('option', { value: options.length - 1, selected: value === chosen }, text);
  };
  const select = element('select', { 'aria-label': title, onchange: () => choose(options[Number(select.value)]) },
    groups.map(({ name, disabled, entries }) => (name ? element('optgroup', { label: name, disabled }, entries.map(option)) : entries.map(option))));
  return element('label', { class: 'list-choice' }, element('span', {}, title), select);
}

const titleOf = (seeder) => seeder.title || seeder.name;
const entriesOf = (seeders) => seeders.map((seeder) => ({ value: seeder, text: titleOf(seeder) }));

function seederList(data, layout, choose) {
  const resting = data.seeders.filter((seeder) => !seeder.live);
  const inSpace = resting.filter((seeder) => seeder.space !== 'plane'), others = resting.filter((seeder) => seeder.space === 'plane');
  const groups = [
    { entries: entriesOf(data.seeders.filter((seeder) => seeder.live)) }, { name: 'Of the link', entries: entriesOf(data.linked) },
    { name: 'In 3D: shown as recorded runs', disabled: true, entries: entriesOf(inSpace) }, { name: 'Not simulated here', disabled: true, entries: entriesOf(others) },
  ];
  return list('Seeder', groups.filter(({ entries }) => entries.length), layout.seeder, choose);
}

function cropList(data, layout, choose) {
  const own = layout.seeder.crop ? [] : [{ value: '', text: 'its own seeds' }];
  const entries = [...own, ...data.crops.map((crop) => ({ value: crop.name, text: crop.title || crop.name }))];
  return list('Crop', [{ entries }], layout.crop, choose);
}

/** The row of choices of a layout, and the words that explain the accuracy chosen. `choose`: { seeder, crop, accuracy }, each called with what is chosen. */
export function choicesOf(data, layout, choose) {
  const accuracies = accuraciesOf(layout.seeder).map((value) => ({ value, text: accuracyTexts[value] ?? String(value) }));
  return [
    element('div', { class: 'choices' }, seederList(data, layout, choose.seeder), cropList(data, layout, choose.crop),
      choice('Accuracy', accuracies, layout.accuracy, choose.accuracy)),
    element('p', { class: 'hint' }, accuracyWords[layout.accuracy] ?? ''),
  ];
}

/** Why seeders of the list cannot be chosen; null where all can. */
export function restingSeeders(data) {
  const resting = data.seeders.filter((seeder) => !seeder.live);
  if (resting.length === 0) return null;
  return element('details', { class: 'card resting' }, element('summary', {}, 'Seeders that are not simulated here'),
    element('dl', { class: 'effects' }, resting.map((seeder) => [element('dt', {}, titleOf(seeder)), element('dd', {}, seeder.why_not ?? '')])));
}
