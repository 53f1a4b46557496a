// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// node quantized_tiles.mjs OUT HEIGHTS.npz: folders of quantized-mesh tiles over the Jacksboro fault.
//   separate  level 11, 3 x 2 tiles, each meshed by martini at 20 m and knowing nothing of the others
//   grid      the same tiles as plain grids of 65 x 65 vertices
//   levels    the same grids, but one tile is replaced by its four children of level 12
import decoder from '@here/quantized-mesh-decoder';
import Martini from '@mapbox/martini';
import assert from 'node:assert/strict';
import { mkdirSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { encodeQuantizedMesh } from './quantized_mesh.mjs';
import { Heights, gridMesh, readJacksboro } from './terrain.mjs';

const [out, npz] = process.argv.slice(2);
if (!npz) throw new Error('usage: node quantized_tiles.mjs OUT HEIGHTS.npz');
const whole = readJacksboro(npz);
const kSteps = 32767, kLevel = 11, kBound = 20;
const kWest = -84.41375 + 0.5 / 1200, kNorth = 36.73291666666667 - 0.5 / 1200;  // centre of the first sample

/// Heights of a tile, rows from the north. Two tiles read a shared border at the very same places.
function tileHeights(level, x, y, cells) {
  const size = 180 / 2 ** level;
  const values = new Float32Array((cells + 1) ** 2);
  for (let r = 0; r <= cells; ++r) {
    const latitude = -90 + size * ((y * cells + cells - r) / cells);
    for (let c = 0; c <= cells; ++c) {
      const longitude = -180 + size * ((x * cells + c) / cells);
      values[r * (cells + 1) + c] = whole.between((longitude - kWest) * 1200, (kNorth - latitude) * 1200);
    }
  }
  return new Heights(cells + 1, cells + 1, values);
}

const asGrid = (heights) => {
  const { triangles } = gridMesh(heights.columns, heights.rows, () => [0, 0, 0]);
  const coords = Array.from({ length: heights.columns * heights.rows }, (_, k) => [k % heights.columns, Math.floor(k / heights.columns)]);
  return { coords: coords.flat(), triangles };
};
const byMartini = (heights) => {
  const { vertices, triangles } = new Martini(heights.columns).createTile(heights.values).getMesh(kBound);
  return { coords: vertices, triangles };
};

/// As HERE's decoder reads it, it has to be what was meant.
function readBack({ bytes, lattice, indices, edges }) {
  const tile = decoder.default(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length));
  assert.deepEqual(Array.from(tile.vertexData), [...lattice.u, ...lattice.v, ...lattice.height]);
  assert.deepEqual(Array.from(tile.triangleIndices), indices);
  assert.deepEqual([tile.westIndices, tile.southIndices, tile.eastIndices, tile.northIndices].map((list) => Array.from(list)), edges);
}

function writeTile(folder, level, x, y, cells, mesher) {
  const heights = tileHeights(level, x, y, cells);
  const { coords, triangles } = mesher(heights);
  const count = coords.length / 2, u = [], v = [], z = [];
  for (let k = 0; k < count; ++k) {
    const [c, r] = [coords[2 * k], coords[2 * k + 1]];
    u.push(Math.round(kSteps * c / cells));
    v.push(Math.round(kSteps * (cells - r) / cells));
    z.push(heights.at(c, r));
  }
  // The library's triangles run whichever way; the format wants counter-clockwise with v to the north.
  const [a, b, c] = triangles;
  const turned = (u[b] - u[a]) * (v[c] - v[a]) - (u[c] - u[a]) * (v[b] - v[a]) < 0;
  const facing = Array.from(triangles);
  for (let t = 0; turned && t < facing.length; t += 3) [facing[t + 1], facing[t + 2]] = [facing[t + 2], facing[t + 1]];
  const size = 180 / 2 ** level;
  const place = (pu, pv) => [-180 + size * (x + pu / kSteps), -90 + size * (y + pv / kSteps)];
  const tile = encodeQuantizedMesh(u, v, z, facing, place);
  readBack(tile);
  const path = join(folder, String(level), String(x), `${y}.terrain`);
  mkdirSync(dirname(path), { recursive: true });
  writeFileSync(path, tile.bytes);
}

function writeLayer(folder, tiles) {
  const levels = Math.max(...tiles.map((tile) => tile.level));
  const available = Array.from({ length: levels + 1 }, (_, level) => tiles.filter((tile) => tile.level === level)
    .map(({ x, y }) => ({ startX: x, startY: y, endX: x, endY: y })));
  writeFileSync(join(folder, 'layer.json'), JSON.stringify({
    tilejson: '2.1.0', name: 'jacksboro', format: 'quantized-mesh-1.0', version: '1.0.0', scheme: 'tms',
    projection: 'EPSG:4326', tiles: ['{z}/{x}/{y}.terrain'], available }, null, 1));
}

const coarse = [];
for (const y of [1439, 1440]) for (const x of [1088, 1089, 1090]) coarse.push({ level: kLevel, x, y });
const split = { level: kLevel, x: 1089, y: 1440 };
const isSplit = ({ x, y }) => x === split.x && y === split.y;
const children = [0, 1, 2, 3].map((k) => ({ level: kLevel + 1, x: 2 * split.x + k % 2, y: 2 * split.y + (k >> 1) }));

const sets = {
  separate: { tiles: coarse, cells: 128, mesher: byMartini },
  grid: { tiles: coarse, cells: 64, mesher: asGrid },
  levels: { tiles: [...coarse.filter((tile) => !isSplit(tile)), ...children], cells: 64, mesher: asGrid },
};
for (const [name, { tiles, cells, mesher }] of Object.entries(sets)) {
  for (const { level, x, y } of tiles) writeTile(join(out, name), level, x, y, cells, mesher);
  writeLayer(join(out, name), tiles);
}
