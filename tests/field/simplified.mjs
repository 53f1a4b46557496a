// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// node simplified.mjs OUT HEIGHTS.npz SIMPLIFY: grid meshes of the Jacksboro fault brought down by meshoptimizer's
// simplifier: npm's current one here, Debian's by the program SIMPLIFY (meshoptimizer_debian.cpp).
import { MeshoptSimplifier } from 'meshoptimizer';
import { execFileSync } from 'node:child_process';
import { mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { gridMesh, kEastM, kNorthM, readJacksboro, writePly } from './terrain.mjs';

const [out, npz, debian] = process.argv.slice(2);
if (!debian) throw new Error('usage: node simplified.mjs OUT HEIGHTS.npz SIMPLIFY');

const whole = readJacksboro(npz);
const kStep = 128, kColumns = 3, kRows = 2, kShare = 0.1;
// Metres from the south-west sample, y north: floats hold them exactly, as the library wants floats.
const place = (heights, column, row) => (c, r) =>
  [(column + c) * kEastM, (kRows * kStep - row - r) * kNorthM, heights.at(c, r)];

await MeshoptSimplifier.ready;

/// Indices that stay, and the library's own word for the error, metres.
function bringDown(grid, share, lock, version) {
  const positions = Float32Array.from(grid.xyz), indices = Uint32Array.from(grid.triangles);
  const target = Math.floor(indices.length / 3 * share) * 3;
  if (version === 'npm') {
    const [kept, error] = MeshoptSimplifier.simplify(indices, positions, 3, target, 1, lock ? ['LockBorder'] : []);
    return { kept, error_m: error * MeshoptSimplifier.getScale(positions, 3) };
  }
  const input = join(out, 'to_simplify.bin'), output = join(out, 'simplified.bin');
  const head = Uint32Array.of(positions.length / 3, indices.length, target, lock ? 1 : 0);
  writeFileSync(input, Buffer.concat([head, positions, indices].map((part) => Buffer.from(part.buffer))));
  const error_m = Number(execFileSync(debian, [input, output], { encoding: 'utf8' }));
  const bytes = readFileSync(output);
  const kept = new Uint32Array(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length));
  rmSync(input);
  rmSync(output);
  return { kept, error_m };
}

/// Without the vertices that nothing uses any more.
function used(xyz, kept) {
  const name = new Map(), points = [];
  const triangles = Array.from(kept, (v) => {
    if (!name.has(v)) {
      name.set(v, name.size);
      points.push(xyz[3 * v], xyz[3 * v + 1], xyz[3 * v + 2]);
    }
    return name.get(v);
  });
  return { xyz: points, triangles };
}

mkdirSync(out, { recursive: true });
const all = whole.window(0, 0, kColumns * kStep + 1, kRows * kStep + 1);
const full = gridMesh(all.columns, all.rows, place(all, 0, 0));
writePly(join(out, 'full.ply'), full.xyz, full.triangles);

const declared = {};
for (const version of ['npm', 'debian']) {
  for (const lock of [true, false]) {
    const name = `${version}_${lock ? 'locked' : 'free'}`;
    const one = bringDown(full, kShare, lock, version);
    const mesh = used(full.xyz, one.kept);
    writePly(join(out, `${name}.ply`), mesh.xyz, mesh.triangles);
    declared[name] = one.error_m;
    for (let r = 0; r < kRows; ++r) {
      for (let c = 0; c < kColumns; ++c) {
        const heights = whole.window(c * kStep, r * kStep, kStep + 1, kStep + 1);
        const grid = gridMesh(kStep + 1, kStep + 1, place(heights, c * kStep, r * kStep));
        const tile = used(grid.xyz, bringDown(grid, kShare, lock, version).kept);
        writePly(join(out, `${name}_tiles`, `${c}_${r}.ply`), tile.xyz, tile.triangles);
      }
    }
  }
}
// What the library says of its own error; script/field-notes hands it to --declared.
for (const [name, error_m] of Object.entries(declared)) writeFileSync(join(out, `${name}.error`), `${error_m}\n`);
