// The page of a run: reads what the program wrote into it and lays it out.
import { effectsSection, guardSection, settingsSection } from './account.mjs';
import { element } from './dom.mjs';
import { evennessSection, rowsSection } from './evenness.mjs';
import { sentence } from './format.mjs';
import { outflowSection } from './outflow.mjs';
import { bytesOfBase64, readPageData } from './page_data.mjs';
import { Player } from './player.mjs';
import { openRecording } from './recording.mjs';
import { replaySection } from './replay.mjs';
import { onTheme, startTheme, theme, toggleTheme } from './theme.mjs';

const endings = { stopped_by_guard: 'Stopped by the guard', interrupted: 'Interrupted' };

function themeSwitch() {
  const button = element('button', { type: 'button', class: 'quiet', onclick: toggleTheme });
  const name = () => { button.textContent = theme() === 'dark' ? 'Light' : 'Dark'; };
  onTheme(name);
  name();
  return button;
}

function head(data) {
  const space = data.space === 'plane' ? 'in the plane' : 'in space';
  const remarks = [...(endings[data.status] ? [`${endings[data.status]} at ${data.end_time_s} s.`] : []), ...data.remarks];
  return [
    element('div', { class: 'topline' }, element('p', { class: 'kicker' }, `Run ${space}`), themeSwitch()),
    element('h1', {}, data.title || 'A run'),
    element('p', { class: 'headline' }, sentence(data.headline)),
    data.drill?.sentence ? element('p', { class: 'headline' }, sentence(data.drill.sentence)) : null,
    remarks.length ? element('ul', { class: 'remarks', 'aria-label': 'What to know about this result' }, remarks.map((remark) => element('li', {}, sentence(remark)))) : null,
  ].filter(Boolean);
}

function foot(data) {
  const { name = 'vibrosow', version = '' } = data.program;
  return element('p', {}, `Written by ${name} ${version}. The whole run is in this file: it opens without a network.`);
}

async function recordingOf(text) {
  try {
    return { recording: await openRecording(bytesOfBase64(text)), problem: null };
  } catch (error) {
    return { recording: null, problem: error.message };
  }
}

async function show() {
  startTheme();
  const data = readPageData(document.getElementById('report-data').textContent);
  document.title = `${data.title || 'A run'} – Vibrosow`;
  document.getElementById('head').replaceChildren(...head(data));
  document.getElementById('foot').replaceChildren(foot(data));
  const { recording, problem } = await recordingOf(document.getElementById('recording').textContent);
  const player = recording ? new Player(recording.times) : null;
  player?.showTime(data.window_s[0]);
  document.getElementById('page').replaceChildren(...[
    replaySection(data, recording, player, problem), outflowSection(data, player), evennessSection(data), rowsSection(data),
    effectsSection(data), guardSection(data), settingsSection(data),
  ].filter(Boolean));
  document.documentElement.dataset.ready = 'true';
}

show().catch((error) => {
  document.getElementById('page').replaceChildren(element('p', { class: 'doubt' }, `This page cannot show its run: ${error.message}.`));
  throw error;
});
