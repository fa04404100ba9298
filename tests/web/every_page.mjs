// Every kind of page, of made-up data.
import { readFileSync } from 'node:fs';
import * as in_ from './browser.mjs';
import { madeUpAccuracy, madeUpCalibration } from './made_up_answers.mjs';
import { fillTemplate, madeUpRun } from './made_up_run.mjs';
import { fillStudio, madeUpStudio, studioTemplate } from './made_up_studio.mjs';
import { madeUpDecision, madeUpFront } from './made_up_studies.mjs';
import { madeUpSweep } from './made_up_sweep.mjs';

const seeds = 500;  // of a run

const reports = {
  run: madeUpRun('plane', { seeds }), 'run-in-space': madeUpRun('three_dimensional', { seeds }), sweep: madeUpSweep('plane'), decision: madeUpDecision('plane'), front: madeUpFront('plane'),
  accuracy: madeUpAccuracy(), calibration: madeUpCalibration(true),
};

/** Names to the text of each page: the reports, and the studio with the made-up simulator. */
export async function everyPage() {
  const template = readFileSync(in_.template, 'utf8');
  const filled = Object.entries(reports).map(([name, made]) => [name, fillTemplate(template, made)]);
  return new Map([...filled, ['studio', fillStudio(await studioTemplate(), madeUpStudio())]]);
}
