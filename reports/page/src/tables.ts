// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
import { controls, orAll, section, select } from './controls';
import { distinct, facts, FINDINGS, methods, results, worst } from './data';
import type { Figure, Finding, FindingName, Frame, Run } from './data';
import { el, plural, short } from './text';

type Cell = Node | string;
interface Column { head: Cell; number?: boolean }

export function table(columns: Column[], rows: Cell[][], label: string): HTMLElement {
  const kind = (place: number) => (columns[place]?.number ? { class: 'n' } : {}) as Record<string, string>;
  const box = el('table', { 'aria-label': label },
    el('thead', {}, el('tr', {}, ...columns.map((column, place) => el('th', { scope: 'col', ...kind(place) }, column.head)))),
    el('tbody', {}, ...rows.map((cells) => el('tr', {}, ...cells.map((cell, place) =>
      place === 0 ? el('th', { scope: 'row' }, cell) : el('td', kind(place), cell))))));
  return el('div', { class: 'scroll', tabindex: '0', role: 'region', 'aria-label': label }, box);
}

/** The first rows of a long table, and a button for the others. */
function longTable(columns: Column[], rows: Cell[][], label: string, first: number): HTMLElement {
  if (rows.length <= first) return table(columns, rows, label);
  const holder = el('div', {}, table(columns, rows.slice(0, first), label));
  const more = el('button', { type: 'button' }, `Show all ${short(rows.length)}`);
  more.addEventListener('click', () => holder.replaceChildren(table(columns, rows, label)));
  holder.append(more);
  return holder;
}

export function findingLink(name: string, text = name): HTMLElement {
  return el('a', { href: `#finding-${name}` }, text);
}

const HAZARDS: ReadonlySet<string> = new Set(['unused_vertex']);

/** Sign and number, so that colour is not the only bearer: ✓ none, ▲ a hazard, ✕ a fault. */
function countCell(name: FindingName, count: Figure): HTMLElement {
  if (count === null) return el('span', { title: `${name}: not asked of a mesh` }, '–');
  if (count === 0) return el('span', { class: 'good', title: `no ${name}` }, '✓');
  const hazard = HAZARDS.has(name);
  return el('a', { class: `count ${hazard ? 'warn' : 'bad'}`, href: `#finding-${name}`, title: `${count} ${name}` },
    `${hazard ? '▲' : '✕'} ${short(count)}`);
}

/** A column's head along the column, so that many narrow columns fit. */
function upright(text: Cell): HTMLElement {
  return el('span', { class: 'upright' }, text);
}

export function matrixSection(): HTMLElement {
  const methodOf = new Map(results.runs.map((run) => [run.id, run.method]));
  const rows = methods.map((method) => {
    const runs = results.runs.filter((run) => run.method === method);
    const gates = results.gates.filter((gate) => methodOf.get(gate.run) === method);
    const failed = gates.filter((gate) => !gate.pass).length;
    const counts = FINDINGS.map((name) => runs.every((run) => run.summary.conformity[name] === null) ? null
      : runs.reduce((sum, run) => sum + (run.summary.conformity[name] ?? 0), 0));
    const frames = runs.reduce((sum, run) => sum + run.summary.frames, 0);
    const sound = frames > 0 && counts.every((count) => !count);
    const plan = runs.some((run) => run.subject !== 'mesh');
    const visible = runs.reduce((sum, run) => sum + (run.summary.visible_cracks ?? 0), 0);
    return [
      method,
      el('span', { class: sound ? 'tag good' : 'tag bad' }, sound ? '✓ sound' : '✕ not sound'),
      short(frames),
      ...FINDINGS.map((name, place) => countCell(name, counts[place] ?? null)),
      plan ? short(visible) : '–',
      visible === 0 ? '–' : short(worst(runs.map((run) => run.summary.largest_gap_px))),
      gates.length === 0 ? '–' : el('span', { class: failed ? 'bad' : 'good' },
        failed ? `✕ ${failed} of ${gates.length} fail` : `✓ ${gates.length} hold`),
    ];
  });
  return section('matrix', 'Findings by method',
    el('p', { class: 'lead' }, 'Sound means no finding in any frame of any run, decided exactly. Counts are complete; ' +
      'a T-junction with a gap counts under both names. Every column is explained under ',
      el('a', { href: '#definitions' }, 'Definitions'), '.'),
    table([
      { head: 'Method' }, { head: 'Verdict' }, { head: 'Frames', number: true },
      ...FINDINGS.map((name) => ({ head: upright(findingLink(name, name.replace('_', ' '))), number: true })),
      { head: upright('visible cracks'), number: true }, { head: upright('largest gap (px)'), number: true },
      { head: 'Gates' },
    ], rows, 'Findings by method'));
}

export function gatesSection(): HTMLElement | null {
  if (results.gates.length === 0) return null;
  const failed = results.gates.filter((gate) => !gate.pass);
  const ordered = [...failed, ...results.gates.filter((gate) => gate.pass)];
  return section('gates', 'Gates',
    el('p', { class: 'lead' }, failed.length === 0 ? `All ${plural(results.gates.length, 'gate')} hold.`
      : `${short(failed.length)} of ${plural(results.gates.length, 'gate')} failed; these come first.`),
    longTable([{ head: 'Gate' }, { head: 'Verdict' }, { head: 'Run' }, { head: 'Limit' }, { head: 'Value', number: true }],
      ordered.map((gate) => [
        gate.note ?? gate.name,
        el('span', { class: gate.pass ? 'tag good' : 'tag bad' },
          gate.expected ? (gate.pass ? '≈ as expected' : '✕ not as expected') : gate.pass ? '✓ holds' : '✕ fails'),
        el('code', {}, gate.run), gate.limit, short(gate.value),
      ]), 'Gates', 12));
}

interface Located { run: Run; frame: Frame; finding: Finding }

/** Visible before hidden, then the larger gap in pixels, in metres, the larger area. */
function byBadness(a: Located, b: Located): number {
  const keys = ({ finding }: Located) => [
    finding.visibility === 'visible' ? 1 : 0, Math.abs(finding.gap_px ?? 0), Math.abs(finding.gap_m ?? 0),
    finding.area_m2 ?? 0,
  ];
  const [left, right] = [keys(a), keys(b)];
  for (let k = 0; k < left.length; ++k) if (left[k] !== right[k]) return right[k]! - left[k]!;
  return 0;
}

export function findingsSection(): HTMLElement {
  const all: Located[] = results.runs.flatMap((run) => run.frames.flatMap((frame) =>
    frame.findings.map((finding) => ({ run, frame, finding })))).sort(byBadness);
  const id = 'findings', title = 'Worst findings';
  if (all.length === 0) return section(id, title, el('p', { class: 'lead' }, results.runs.length === 0 ? 'No frame was judged.' : 'No finding in any frame.'));
  const holder = el('div', {});
  const draw = () => {
    const rows = all.filter(({ run, finding }) => (method.value() === '' || run.method === method.value()) &&
      (name.value() === '' || finding.name === name.value()));
    holder.replaceChildren(longTable([
      { head: 'Finding' }, { head: 'Kind' }, { head: 'Run' }, { head: 'Frame', number: true },
      { head: 'x, y, z (m)', number: true }, { head: 'Gap (px)', number: true }, { head: 'Gap (m)', number: true },
      { head: 'Area (m²)', number: true }, { head: 'In the picture' },
    ], rows.slice(0, 200).map(({ run, frame, finding }) => [
      findingLink(finding.name, `${finding.code} ${finding.name}`),
      `${finding.kind.replace(/_/g, ' ')}${finding.severity === 'hazard' ? ' ▲ hazard' : ''}`,
      el('code', {}, run.id), String(frame.index),
      finding.at.map((value) => (value === null ? '–' : value.toFixed(1))).join(', '),
      short(finding.gap_px ?? null), short(finding.gap_m ?? null), short(finding.area_m2 ?? null),
      finding.visibility === 'visible' ? el('b', {}, '● visible') : finding.visibility,
    ]), 'Worst findings', 12));
  };
  const method = select('Method', orAll(distinct(all.map(({ run }) => run.method)), 'all'), '', draw);
  const name = select('Finding', orAll(distinct(all.map(({ finding }) => finding.name)), 'all'), '', draw);
  draw();
  return section(id, title,
    el('p', { class: 'lead' }, 'Each frame lists its worst few; visible ones come first, then by size.'),
    controls(method, name), holder);
}

export function terrainsSection(): HTMLElement | null {
  if (results.terrains.length === 0) return null;
  return section('terrains', 'Terrains',
    el('p', { class: 'lead' }, 'The ambiguity is the largest gap between the two ways to split a cell: an error below it ' +
      'may be the samples’, not the method’s.'),
    table([
      { head: 'Terrain' }, { head: 'Samples', number: true }, { head: 'Spacing (m)', number: true },
      { head: 'Lowest (m)', number: true }, { head: 'Highest (m)', number: true }, { head: 'Ambiguity (m)', number: true },
    ], results.terrains.map((terrain) => [
      terrain.id, `${terrain.columns} × ${terrain.rows}`, short(terrain.spacing_m), short(terrain.lowest_m),
      short(terrain.highest_m), short(terrain.diagonal_ambiguity_m),
    ]), 'Terrains'));
}

/** The manual's pictures (SVG) by code; put in when the page is bundled. */
declare const FINDING_PICTURES: Record<string, string>;

function findingPicture(code: number): HTMLElement | null {
  const svg = FINDING_PICTURES[String(code)];
  if (svg === undefined) return null;
  const holder = el('div', { class: 'example' });
  holder.innerHTML = svg;
  return holder;
}

export function definitionsSection(): HTMLElement {
  return section('definitions', 'Definitions', el('dl', { class: 'definitions' },
    ...facts.catalogue.flatMap(({ code, name, definition }) => [
      el('dt', { id: `finding-${name}` }, el('span', { class: 'code' }, String(code)), ` ${name}`),
      el('dd', {}, definition, findingPicture(code)),
    ])));
}

