// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// node heights_to_meshes.mjs OUT DEM.vrt HEIGHTS.npz: meshes of the Jacksboro fault by delatin, martini and
// loaders.gl, whole and as 3 x 2 tiles that share their border samples and know nothing of each other.
import Martini from '@mapbox/martini';
import Delatin from 'delatin';
import { mkdirSync } from 'node:fs';
import { join } from 'node:path';
import { Heights, kEastM, kNorthM, readJacksboro, writePly, writeWindowVrt } from './terrain.mjs';
// Not among the package's exports, which decode a picture first; this is what they hand it to.
import { makeTerrainMeshFromImage } from './node_modules/@loaders.gl/terrain/dist/lib/parse-terrain.js';

const [out, dem, npz] = process.argv.slice(2);
if (!npz) throw new Error('usage: node heights_to_meshes.mjs OUT DEM.vrt HEIGHTS.npz');

const whole = readJacksboro(npz);
const kStep = 128, kColumns = 3, kRows = 2, kBounds = [5, 20];

mkdirSync(out, { recursive: true });
writeWindowVrt(join(out, 'square.vrt'), whole, dem, 257, 257);
for (const [name, metres] of [['tiles.vrt', false], ['tiles_metres.vrt', true]]) {
  writeWindowVrt(join(out, name), whole, dem, kColumns * kStep + 1, kRows * kStep + 1, metres);
}

/// Vertices as both libraries give them: column and row, row 0 northmost, so y runs south.
const raised = (coords, heights, column = 0, row = 0) => {
  const xyz = new Float64Array(coords.length / 2 * 3);
  for (let v = 0; 2 * v < coords.length; ++v) {
    const [x, y] = [coords[2 * v], coords[2 * v + 1]];
    xyz.set([x + column, y + row, heights.at(x, y)], 3 * v);
  }
  return xyz;
};

function delatin(heights, bound) {
  const tin = new Delatin(heights.values, heights.columns, heights.rows);
  tin.run(bound);
  return { coords: tin.coords, triangles: tin.triangles };
}

function martini(heights, bound) {
  const { vertices, triangles } = new Martini(heights.columns).createTile(heights.values).getMesh(bound);
  return { coords: vertices, triangles };
}

const tiles = [];
for (let r = 0; r < kRows; ++r) {
  for (let c = 0; c < kColumns; ++c) tiles.push({ column: c * kStep, row: r * kStep, name: `${c}_${r}.ply` });
}

for (const [name, mesher] of [['delatin', delatin], ['martini', martini]]) {
  const all = name === 'martini' ? whole.window(0, 0, 257, 257) : whole;
  for (const bound of kBounds) {
    const one = mesher(all, bound);
    writePly(join(out, name, `whole_${bound}m.ply`), raised(one.coords, all), one.triangles);
    for (const tile of tiles) {
      const heights = whole.window(tile.column, tile.row, kStep + 1, kStep + 1);
      const mesh = mesher(heights, bound);
      writePly(join(out, name, `tiles_${bound}m`, tile.name), raised(mesh.coords, heights, tile.column, tile.row),
               mesh.triangles);
    }
  }
}

// The mistakes that people make with arrays: axes exchanged on the way in, rows counted from the wrong end.
{
  const square = whole.window(0, 0, 257, 257), n = square.columns;
  const columnMajor = new Heights(n, n, Float32Array.from(square.values, (_, k) => square.at(Math.floor(k / n), k % n)));
  const turned = martini(columnMajor, 5);
  writePly(join(out, 'martini', 'transposed_5m.ply'), raised(turned.coords, columnMajor), turned.triangles);
  const right = martini(square, 5);
  const xyz = raised(right.coords, square);
  for (let k = 1; k < xyz.length; k += 3) xyz[k] = n - 1 - xyz[k];
  writePly(join(out, 'martini', 'rows_flipped_5m.ply'), xyz, right.triangles);
}

// As deck.gl's TerrainLayer asks: a picture of 128 x 128 pixels a tile (Terrarium's code); its skirt is twice the bound.
const kTerrarium = { rScaler: 256, gScaler: 1, bScaler: 1 / 256, offset: -32768 };
function picture(tile) {
  const data = new Uint8Array(4 * kStep * kStep);
  for (let k = 0; k < kStep * kStep; ++k) {
    const code = whole.at(tile.column + k % kStep, tile.row + Math.floor(k / kStep)) + 32768;
    data.set([Math.floor(code / 256), code % 256, 0, 255], 4 * k);
  }
  return { data, width: kStep, height: kStep };
}
for (const tesselator of ['martini', 'delatin']) {
  for (const skirtHeight of [0, 2 * 5, 50]) {
    for (const tile of tiles) {
      // Metres from the south-west sample of all tiles; y runs north, as on maps.
      const south = kRows * kStep - tile.row - kStep;
      const bounds = [tile.column * kEastM, south * kNorthM, (tile.column + kStep) * kEastM, (south + kStep) * kNorthM];
      const mesh = makeTerrainMeshFromImage(
        picture(tile), { meshMaxError: 5, bounds, elevationDecoder: kTerrarium, tesselator, skirtHeight });
      writePly(join(out, 'loaders_gl', `${tesselator}_skirt_${skirtHeight}m`, tile.name),
               mesh.attributes.POSITION.value, mesh.indices.value);
    }
  }
}
