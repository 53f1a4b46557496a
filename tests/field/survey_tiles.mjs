// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// node survey_tiles.mjs OUT HEIGHTS.npz
//   drone/*.ply  two neighbouring tiles of 0.1 m spacing in UTM coordinates, in doubles: for programs that convert
//   big.ply      2 097 152 triangles, to time plumbline itself
import { join } from 'node:path';
import { gridMesh, readJacksboro, writePly } from './terrain.mjs';

const [out, npz] = process.argv.slice(2);
if (!npz) throw new Error('usage: node survey_tiles.mjs OUT HEIGHTS.npz');
const whole = readJacksboro(npz);

const kSpacing = 0.1, kEasting = 735204.37, kNorthing = 4051893.61, kCells = 64;
for (const tile of [0, 1]) {
  // The shape of the fault in small: heights shrink as the plan does.
  const mesh = gridMesh(kCells + 1, kCells + 1, (c, r) => [
    kEasting + (tile * kCells + c) * kSpacing, kNorthing - r * kSpacing,
    whole.at(tile * kCells + c, r) * kSpacing / 80]);
  writePly(join(out, 'drone', `${tile}_0.ply`), mesh.xyz, mesh.triangles);
}

const kSide = 1025, kWindow = 340;
const big = gridMesh(kSide, kSide, (c, r) => [
  c * 30, (kSide - 1 - r) * 30, whole.between(c * kWindow / (kSide - 1), r * kWindow / (kSide - 1))]);
writePly(join(out, 'big.ply'), big.xyz, big.triangles);
