// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The oracles' own test: what was planted, and what they made of it.
import { section } from './controls';
import { distinct, results } from './data';
import type { KindScore } from './data';
import { table } from './tables';
import { el, plural, short } from './text';

const HEADS = ['planted', 'findings expected', 'found', 'misplaced', 'false alarms'];

function sum(kinds: KindScore[]): number[] {
  const of = (value: (kind: KindScore) => number) => kinds.reduce((all, kind) => all + value(kind), 0);
  return [of((kind) => kind.faults), of((kind) => kind.expected), of((kind) => kind.found), of((kind) => kind.misplaced),
    of((kind) => kind.false_alarms)];
}

/** Red where something was missed, misplaced or made up. */
function cells(kinds: KindScore[]): (Node | string)[] {
  const [planted, expected, found, misplaced, alarms] = sum(kinds) as [number, number, number, number, number];
  const bad = (value: number, wrong: boolean) => (wrong ? el('span', { class: 'count bad' }, `✕ ${short(value)}`) : short(value));
  return [bad(planted, planted === 0), short(expected), bad(found, found !== expected), bad(misplaced, misplaced > 0),
    bad(alarms, alarms > 0)];
}

export function trustSection(): HTMLElement | null {
  const score = results.selftest;
  if (!score) return null;
  const oracles = distinct(score.kinds.map((kind) => kind.oracle));
  const columns = (first: string) => [{ head: first }, ...HEADS.map((head) => ({ head, number: true }))];
  return section('trust', 'Can the oracles be believed?',
    el('p', { class: 'lead' }, score.pass
      ? `Before this report was written, ${plural(score.planted, 'fault')} were planted in sound meshes and scenes: the oracles found each ` +
        `one, at its place, and nothing else; nor anything on ${plural(score.clean_meshes, 'clean mesh', 'clean meshes')}. `
      : 'The oracles of this build failed their own test. Believe no other figure of this report. ',
      el('code', {}, 'plumbline selftest'), ' plants ten thousand.'),
    table(columns('Oracle'), oracles.map((oracle) => [oracle, ...cells(score.kinds.filter((kind) => kind.oracle === oracle))]),
      'Planted faults by oracle'),
    el('details', {}, el('summary', {}, `Each of the ${short(score.kinds.length)} kinds`),
      table(columns('Fault'), score.kinds.map((kind) => [kind.sound ? `${kind.kind} (harmless)` : kind.kind, ...cells([kind])]),
        'Planted faults by kind')));
}
