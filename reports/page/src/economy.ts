// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// How many triangles a scene needs, and how many each method spends: excess over the yardstick at the same measured
// error, and the share of vertices that could go.
import { controls, orAll, section, select } from './controls';
import { distinct, overTerrains, results, terrainRuns } from './data';
import type { Figure, Run } from './data';
import { table } from './tables';
import { el, short } from './text';

interface Sums { frames: number; drawn: number; needed: number }

/** Triangles of the frames for which the yardstick says how many are needed. */
function sums(runs: Run[]): Sums {
  const all = { frames: 0, drawn: 0, needed: 0 };
  for (const run of runs) {
    for (const frame of run.frames) {
      if (frame.economy.needed_triangles === null) continue;
      all.frames += 1;
      all.drawn += frame.triangles;
      all.needed += frame.economy.needed_triangles;
    }
  }
  return all;
}

function mean(runs: Run[], of: (run: Run) => Figure): Figure {
  const known = runs.map(of).filter((value): value is number => value !== null);
  return known.length === 0 ? null : known.reduce((sum, value) => sum + value, 0) / known.length;
}

const percent = (share: Figure): string => (share === null ? '–' : `${short(100 * share)} %`);

export function economySection(): HTMLElement {
  const shown = el('div', {});
  const draw = () => {
    const here = terrainRuns.filter((run) => terrain.value() === '' || run.terrain === terrain.value());
    const rows = distinct(here.map((run) => `${run.method}\n${run.threshold_px}`)).map((key) => {
      const [method, threshold] = key.split('\n');
      const runs = here.filter((run) => run.method === method && run.threshold_px === Number(threshold));
      const { frames, drawn, needed } = sums(runs);
      const all = runs.reduce((count, run) => count + run.summary.frames, 0);
      return [method!, threshold!,
        method === results.yardstick ? 'yardstick' : frames === 0 ? '–' : short(drawn / needed),
        frames === 0 ? '–' : short(drawn / frames), frames === 0 ? '–' : short(needed / frames), `${frames} of ${all}`,
        percent(mean(runs, (run) => run.summary.economy.slack)),
        percent(mean(runs, (run) => run.summary.economy.slack_in_view))];
    });
    shown.replaceChildren(table(
      [{ head: 'Method' }, { head: 'τ (px)', number: true }, { head: 'excess', number: true },
        { head: 'triangles drawn, mean', number: true }, { head: 'needed, mean', number: true },
        { head: 'frames that could be compared', number: true }, { head: 'slack, of all vertices', number: true },
        { head: 'of those in the picture', number: true }],
      rows, 'Economy by method and threshold'));
  };
  const terrain = select('Terrain', orAll(overTerrains, 'all together'), overTerrains.length < 2 ? overTerrains[0] ?? '' : '',
    draw);
  draw();
  return section('economy', 'Economy',
    el('p', { class: 'lead' }, results.yardstick === null
      ? 'No method of this suite is its yardstick, so nothing is said about how many triangles a scene needs. '
      : `Needed is what ${results.yardstick} draws at the same camera and the same measured p99 displacement; excess is ` +
        'drawn over needed: 1 is the goal. Frames whose error lies outside of the yardstick’s are not compared. ',
      'Slack: the share of vertices each of which could be taken out, alone, without any pixel going over τ; measured in some ' +
      'frames of each flight, here the mean over the flights.'),
    controls(terrain), shown);
}
