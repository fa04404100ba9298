// The page of a run, part by part.
import { computedSection } from './account.mjs';
import { unevennessSection, rowsSection } from './unevenness.mjs';
import { number } from './format.mjs';
import { outflowSection } from './outflow.mjs';
import { mapsSection } from './maps.mjs';
import { bytesOfBase64 } from './page_data.mjs';
import { Player } from './player.mjs';
import { openRecording } from './recording.mjs';
import { replaySection } from './replay.mjs';
import { rerunSection } from './rerun.mjs';

const endings = { stopped_by_guard: 'stopped by the guard', interrupted: 'interrupted' };

async function recordingOf(text) {
  try {
    const recording = await openRecording(bytesOfBase64(text));
    const maps = await Promise.all(['tray', 'hopper'].map(async (vessel) => ({ vessel, map: (await recording?.map(vessel)) ?? null })));
    return { recording, maps: maps.filter(({ map }) => map), problem: null };
  } catch (error) {
    return { recording: null, maps: [], problem: error.message };
  }
}

async function sections(data) {
  const { recording, maps, problem } = await recordingOf(document.getElementById('recording').textContent);
  const player = recording ? new Player(recording.times) : null;
  player?.showTime(data.window_s[0]);
  return [
    replaySection(data, recording, player, problem), outflowSection(data, player), mapsSection(data, maps), unevennessSection(data), rowsSection(data),
    rerunSection(data), computedSection(data),
  ].filter(Boolean);
}

/** What main.mjs lays out of a run. */
export function runPage(data) {
  return {
    kicker: `Run ${data.space === 'plane' ? 'in 2D' : 'in 3D'}`,
    title: data.title || 'A run',
    headlines: [data.headline, data.expected, data.drill?.sentence],
    remarks: [...(endings[data.status] ? [{ serious: true, text: `${endings[data.status]} at ${number(data.end_time_s)} s` }] : []), ...data.remarks],
    tray: { name: 'The tray', vessels: data.vessels, scene: data.scene, space: data.space },
    whole: 'The whole run',
    sections: () => sections(data),
  };
}
