// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The Jacksboro fault's heights as other programs want them, and meshes as PLY.
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { dirname, relative } from 'node:path';
import { inflateRawSync } from 'node:zlib';

/// Heights in metres, row 0 northmost: what scenarios/assets/jacksboro.vrt reads from the same file.
export class Heights {
  constructor(columns, rows, values) {
    this.columns = columns;
    this.rows = rows;
    this.values = values;
  }
  at(column, row) {
    return this.values[row * this.columns + column];
  }
  window(column, row, columns, rows) {
    const values = new Float32Array(columns * rows);
    for (let r = 0; r < rows; ++r) {
      for (let c = 0; c < columns; ++c) values[r * columns + c] = this.at(column + c, row + r);
    }
    return new Heights(columns, rows, values);
  }
  /// Bilinear; between samples, and outside held to the rim.
  between(x, y) {
    const c = Math.min(Math.max(x, 0), this.columns - 1), r = Math.min(Math.max(y, 0), this.rows - 1);
    const c0 = Math.min(Math.floor(c), this.columns - 2), r0 = Math.min(Math.floor(r), this.rows - 2);
    const fx = c - c0, fy = r - r0;
    return (1 - fy) * ((1 - fx) * this.at(c0, r0) + fx * this.at(c0 + 1, r0)) +
           fy * ((1 - fx) * this.at(c0, r0 + 1) + fx * this.at(c0 + 1, r0 + 1));
  }
}

function unzip(file, member) {
  const zip = readFileSync(file);
  let end = zip.length - 22;
  while (end >= 0 && zip.readUInt32LE(end) !== 0x06054b50) --end;
  if (end < 0) throw new Error(`${file}: no zip file`);
  let entry = zip.readUInt32LE(end + 16);
  for (let left = zip.readUInt16LE(end + 10); left > 0; --left) {
    const name = zip.readUInt16LE(entry + 28);
    if (zip.toString('latin1', entry + 46, entry + 46 + name) === member) {
      const local = zip.readUInt32LE(entry + 42);
      const start = local + 30 + zip.readUInt16LE(local + 26) + zip.readUInt16LE(local + 28);
      const packed = zip.subarray(start, start + zip.readUInt32LE(entry + 20));
      return zip.readUInt16LE(entry + 10) === 0 ? packed : inflateRawSync(packed);
    }
    entry += 46 + name + zip.readUInt16LE(entry + 30) + zip.readUInt16LE(entry + 32);
  }
  throw new Error(`${file}: no ${member} in it`);
}

export function readJacksboro(file) {
  const npy = unzip(file, 'elevation.npy');
  const start = 10 + npy.readUInt16LE(8);
  const header = npy.toString('latin1', 10, start);
  const shape = /'shape': \((\d+), (\d+)\)/.exec(header);
  if (!header.includes("'descr': '<i2'") || header.includes("'fortran_order': True") || !shape) {
    throw new Error(`${file}: not the array of 16-bit heights that was expected: ${header}`);
  }
  const [rows, columns] = [Number(shape[1]), Number(shape[2])];
  const values = Float32Array.from({ length: rows * columns }, (_, k) => npy.readInt16LE(start + 2 * k));
  return new Heights(columns, rows, values);
}

/// A mesh: `xyz` three numbers a vertex, `triangles` three indices each. Written as PLY, little endian, double.
export function writePly(path, xyz, triangles) {
  const vertices = xyz.length / 3, count = triangles.length / 3;
  const header = Buffer.from(
    `ply\nformat binary_little_endian 1.0\nelement vertex ${vertices}\n` +
    'property double x\nproperty double y\nproperty double z\n' +
    `element face ${count}\nproperty list uchar int vertex_indices\nend_header\n`);
  const body = Buffer.alloc(24 * vertices + 13 * count);
  let at = 0;
  for (let k = 0; k < xyz.length; ++k) at = body.writeDoubleLE(xyz[k], at);
  for (let t = 0; t < triangles.length; t += 3) {
    at = body.writeUInt8(3, at);
    for (let k = 0; k < 3; ++k) at = body.writeInt32LE(triangles[t + k], at);
  }
  mkdirSync(dirname(path), { recursive: true });
  writeFileSync(path, Buffer.concat([header, body]));
}

/// The spacing of the heights in metres, near enough, and exact in floats: for programs that think in metres.
export const kEastM = 74.5, kNorthM = 92.5;

/// The north-west window of a DEM as a DEM: nothing is resampled. As georeferenced as the whole is; or in metres
/// from its south-west sample.
export function writeWindowVrt(path, of, source, columns, rows, metres = false) {
  const step = 1 / 1200;
  const georeference = metres
    ? `<GeoTransform>${-kEastM / 2}, ${kEastM}, 0, ${(rows - 0.5) * kNorthM}, 0, ${-kNorthM}</GeoTransform>`
    : `<SRS>EPSG:4326</SRS>
  <GeoTransform>-84.41375, ${step}, 0, 36.73291666666667, 0, ${-step}</GeoTransform>`;
  mkdirSync(dirname(path), { recursive: true });
  writeFileSync(path, `<VRTDataset rasterXSize="${columns}" rasterYSize="${rows}">
  ${georeference}
  <VRTRasterBand dataType="Int16" band="1">
    <UnitType>m</UnitType>
    <SimpleSource>
      <SourceFilename relativeToVRT="1">${relative(dirname(path), source)}</SourceFilename>
      <SourceBand>1</SourceBand>
      <SourceProperties RasterXSize="${of.columns}" RasterYSize="${of.rows}" DataType="Int16"/>
      <SrcRect xOff="0" yOff="0" xSize="${columns}" ySize="${rows}"/>
      <DstRect xOff="0" yOff="0" xSize="${columns}" ySize="${rows}"/>
    </SimpleSource>
  </VRTRasterBand>
</VRTDataset>
`);
}

/// The grid itself, two triangles a cell, split from north-west to south-east or the other way: `place(c, r)`
/// gives a vertex. Counter-clockwise where x runs east and y north.
export function gridMesh(columns, rows, place) {
  const xyz = new Float64Array(3 * columns * rows), triangles = new Uint32Array(6 * (columns - 1) * (rows - 1));
  for (let r = 0; r < rows; ++r) {
    for (let c = 0; c < columns; ++c) xyz.set(place(c, r), 3 * (r * columns + c));
  }
  let at = 0;
  for (let r = 0; r + 1 < rows; ++r) {
    for (let c = 0; c + 1 < columns; ++c) {
      const nw = r * columns + c, ne = nw + 1, sw = nw + columns, se = sw + 1;
      triangles.set([nw, sw, ne, ne, sw, se], at);
      at += 6;
    }
  }
  return { xyz, triangles };
}
