// A page: reads what the program wrote into it and lays it out.
import { accuracyPage } from './accuracy_page.mjs';
import { calibrationPage } from './calibration_page.mjs';
import { decisionPage } from './decision_page.mjs';
import { element } from './dom.mjs';
import { firstScreen } from './first_screen.mjs';
import { frontPage } from './front_page.mjs';
import { readPageData } from './page_data.mjs';
import { paperStyle } from './paper.mjs';
import { runPage } from './run_page.mjs';
import { sweepPage } from './sweep_page.mjs';
import { startTheme } from './theme.mjs';

const pages = { run: runPage, sweep: sweepPage, decision: decisionPage, front: frontPage, accuracy: accuracyPage, calibration: calibrationPage };

function foot({ name = 'vibrosow', version = '' }, whole) {
  return element('p', {}, `Written by ${name} ${version}. ${whole} is in this file: it opens without a network.`);
}

async function show() {
  startTheme();
  const data = readPageData(document.getElementById('report-data').textContent);
  const page = pages[data.kind](data);
  document.documentElement.toggleAttribute('data-beside', Boolean(page.beside));
  document.title = `${page.title} – Vibrosow`;
  document.head.append(paperStyle(page, data.program));
  document.getElementById('head').replaceChildren(...firstScreen(page));
  document.getElementById('foot').replaceChildren(foot(data.program, page.whole));
  document.getElementById('page').replaceChildren(...(await page.sections()));
  document.documentElement.dataset.ready = 'true';
}

show().catch((error) => {
  document.getElementById('page').replaceChildren(element('p', { class: 'doubt' }, `This page cannot show what is in it: ${error.message}.`));
  throw error;
});
