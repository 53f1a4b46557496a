// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// node notes.mjs FIELD: the verdicts of script/field-notes as one table, and the command of each.
import { readFileSync } from 'node:fs';
import { join } from 'node:path';

const field = process.argv[2];
if (!field) throw new Error('usage: node notes.mjs FIELD');
const rows = (name) => readFileSync(join(field, name), 'utf8').trimEnd().split('\n').map((line) => line.split('\t'));
const seconds = new Map(rows('seconds.tsv'));

/// Four digits, as a person reads them; the verdict's JSON has all.
const short = (x) => x === null || x === undefined ? '' : String(Number(Number(x).toPrecision(4)));

const kFaults = ['crack', 't_junction', 'fold_over', 'overlap', 'hole', 'outline', 'degenerate', 'non_manifold', 'duplicate',
                 'bad_index', 'non_finite', 'unused_vertex'];
const lines = [], commands = [];
for (const [name, command] of rows('commands.tsv')) {
  const verdict = JSON.parse(readFileSync(join(field, 'verdicts', `${name}.json`), 'utf8'));
  const faults = kFaults.filter((code) => verdict.conformity[code] > 0).map((code) => `${verdict.conformity[code]} ${code}`);
  if (verdict.tile_faults > 0) faults.push(`${verdict.tile_faults} tile_fault`);
  const seams = verdict.seams.length === 0 ? '' : Object.entries(verdict.seam_states).map(([state, count]) => `${count} ${state}`).join(', ');
  const gap = verdict.seams.reduce((most, seam) => Math.max(most, Math.abs(seam.largest_gap_m)), 0);
  const vertical = verdict.vertical_m, declared = verdict.terrain?.declared;
  lines.push([
    name, verdict.verdict, verdict.meshes.reduce((sum, mesh) => sum + mesh.triangles, 0), faults.join(', '), seams,
    verdict.seams.length ? short(gap) : '', short(verdict.sufficient_skirt_m), short(declared?.bound_m),
    short(vertical?.samples_max), short(vertical?.certain_max), short(vertical?.max),
    verdict.meshes.reduce((sum, mesh) => sum + (mesh.shape?.slivers ?? 0), 0), verdict.terrain?.better_match ?? '',
    short(seconds.get(name)),
  ]);
  commands.push(`- ${name}: \`${command}\``);
}
const head = ['mesh', 'verdict', 'triangles', 'findings', 'seams', 'largest gap, m', 'skirt that suffices, m', 'declared, m',
              'error at samples, m', 'error for certain, m', 'error, m', 'slivers', 'better match', 'check took, s'];
const line = (cells) => `| ${cells.join(' | ')} |`;
console.log([line(head), line(head.map(() => '---')), ...lines.map(line), '', ...commands].join('\n'));
