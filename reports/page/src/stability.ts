// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Where each method is unstable: every figure over all flights, and one figure flight by flight.
import { controls, orAll, section, select } from './controls';
import { methods, results, terrains, trajectories, worst } from './data';
import type { Figure, Run, RunStability } from './data';
import { table } from './tables';
import { el, short } from './text';

interface Measure {
  head: string;
  unit: string;
  of: (stability: RunStability) => Figure;
  sum?: boolean;  // counts add up over runs; all else is the worst run
}

const MEASURES: Measure[] = [
  { head: 'differs on coming back', unit: 'share of vertices', of: (s) => s.revisit_share },
  { head: 'differs from a fresh start', unit: 'share of vertices', of: (s) => s.path_share },
  { head: 'differs from a fresh start, displacement', unit: 'px', of: (s) => s.path_px },
  { head: 'after a cut, until under τ', unit: 'frames', of: (s) => s.recovery_frames },
  { head: 'cuts never under τ again', unit: 'count', of: (s) => s.unrecovered, sum: true },
  { head: 'after a cut, until as good as fresh', unit: 'frames', of: (s) => s.lag_frames },
  { head: 'cuts never as good as fresh', unit: 'count', of: (s) => s.unsettled, sum: true },
  { head: 'vertices that toggle', unit: 'count', of: (s) => s.toggles, sum: true },
  { head: 'change under 0.01 px', unit: 'vertices', of: (s) => s.jitter_vertices },
  { head: 'pop under 0.01 px', unit: 'px', of: (s) => s.jitter_px },
];

function over(runs: Run[], measure: Measure): Figure {
  const values = runs.map((run) => measure.of(run.summary.stability));
  if (!measure.sum) return worst(values);
  const known = values.filter((value): value is number => value !== null);
  return known.length === 0 ? null : known.reduce((sum, value) => sum + value, 0);
}

/** A number whose ground deepens with its share of the largest one beside it; a zero is marked as good. */
function heat(value: Figure, most: Figure): Node | string {
  if (value === null) return '–';
  if (value === 0) return el('span', { class: 'good', title: 'none' }, '✓');
  const depth = most === null || most === 0 ? 0 : Math.sqrt(value / most);
  const cell = el('span', { class: 'heat' }, short(value));
  cell.style.setProperty('--depth', `${Math.round(10 + 50 * depth)}%`);
  return cell;
}

export function stabilitySection(): HTMLElement {
  const flights = el('div', {});
  const draw = () => {
    const measure = MEASURES[Number(which.value())]!;
    const here = results.runs.filter((run) => terrain.value() === '' || run.terrain === terrain.value());
    const cells = methods.map((method) => trajectories.map((trajectory) =>
      over(here.filter((run) => run.method === method && run.trajectory === trajectory), measure)));
    const most = worst(cells.flat());
    flights.replaceChildren(table(
      [{ head: `Method (${measure.unit})` }, ...trajectories.map((trajectory) => ({ head: trajectory, number: true }))],
      methods.map((method, row) => [method, ...cells[row]!.map((value) => heat(value, most))]),
      `Stability by flight: ${measure.head}`));
  };
  const which = select('Figure', MEASURES.map(({ head, unit }, place) => ({ value: String(place), label: `${head} (${unit})` })),
    '0', draw);
  const terrain = select('Terrain', orAll(terrains, 'all together'), terrains.length < 2 ? terrains[0] ?? '' : '', draw);

  const all = methods.map((method) => MEASURES.map((measure) =>
    over(results.runs.filter((run) => run.method === method), measure)));
  const overview = table(
    [{ head: 'Method' }, ...MEASURES.map(({ head, unit }) => ({ head: `${head} (${unit})`, number: true }))],
    methods.map((method, row) => [method,
      ...all[row]!.map((value, place) => heat(value, worst(all.map((others) => others[place]!))))]),
    'Stability by method');
  draw();
  return section('stability', 'Stability',
    el('p', { class: 'lead' }, 'Over all terrains, flights and thresholds: counts added up, the worst run for all else. A fresh ' +
      'start is the same method, reset, at the same camera. Deeper red is worse beside the others; ✓ is none, – was not asked ' +
      '(no cut, no camera twice).'),
    overview,
    el('h3', {}, 'Where: flight by flight'), controls(which, terrain), flights);
}
