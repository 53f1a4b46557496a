// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// An encoder of quantized-mesh-1.0 tiles as short as the format allows: no npm or Debian package has one. What it
// writes is read back by HERE's decoder (quantized_tiles.mjs) before plumbline sees it.
const kSteps = 32767;
const kSemiMajor = 6378137, kSemiMinor = 6356752.3142451793;

/// Earth-centred, Earth-fixed, of degrees and metres above WGS84.
function ecef([lon, lat, height]) {
  const [l, p] = [lon, lat].map((degrees) => degrees * Math.PI / 180);
  const e2 = 1 - (kSemiMinor / kSemiMajor) ** 2;
  const n = kSemiMajor / Math.sqrt(1 - e2 * Math.sin(p) ** 2);
  return [(n + height) * Math.cos(p) * Math.cos(l), (n + height) * Math.cos(p) * Math.sin(l),
          (n * (1 - e2) + height) * Math.sin(p)];
}

const length = (a) => Math.hypot(...a);
const minus = (a, b) => a.map((x, k) => x - b[k]);

/// The point beyond which the whole tile is below the horizon, in units of the ellipsoid's semi-axes.
function horizonOcclusion(points, centre) {
  const scaled = (p) => [p[0] / kSemiMajor, p[1] / kSemiMajor, p[2] / kSemiMinor];
  const towards = scaled(centre).map((x, _, all) => x / length(all));
  let most = 0;
  for (const point of points.map(scaled)) {
    const size = Math.max(1, length(point)), direction = point.map((x) => x / length(point));
    const cosAlpha = direction.reduce((sum, x, k) => sum + x * towards[k], 0);
    const sinAlpha = Math.sqrt(Math.max(0, 1 - cosAlpha ** 2));
    const cosBeta = 1 / size, sinBeta = Math.sqrt(size ** 2 - 1) * cosBeta;
    most = Math.max(most, 1 / (cosAlpha * cosBeta - sinAlpha * sinBeta));
  }
  return towards.map((x) => x * most);
}

const zigZag = (difference) => ((difference << 1) ^ (difference >> 31)) & 0xffff;

/// `u`, `v` in lattice steps from the south-west, `heights` in metres, triangles counter-clockwise from above;
/// `place(u, v)` gives longitude and latitude. Returns the file's bytes and what a decoder has to find in them.
export function encodeQuantizedMesh(u, v, heights, triangles, place) {
  const order = new Map();
  for (const vertex of triangles) if (!order.has(vertex)) order.set(vertex, order.size);
  const vertices = [...order.keys()], count = vertices.length;
  const used = vertices.map((k) => heights[k]);
  const low = Math.fround(used.reduce((a, b) => Math.min(a, b))), high = Math.fround(used.reduce((a, b) => Math.max(a, b)));
  const step = high > low ? (high - low) / kSteps : 1;
  const lattice = {
    u: vertices.map((k) => u[k]),
    v: vertices.map((k) => v[k]),
    height: used.map((h) => Math.min(Math.max(Math.round((h - low) / step), 0), kSteps)),
  };
  const points = vertices.map((k) => ecef([...place(u[k], v[k]), heights[k]]));
  const centre = ecef([...place(kSteps / 2, kSteps / 2), (low + high) / 2]);
  const middle = [0, 1, 2].map((axis) => {
    const all = points.map((p) => p[axis]);
    return (all.reduce((a, b) => Math.min(a, b)) + all.reduce((a, b) => Math.max(a, b))) / 2;
  });
  // Heights are rounded to their lattice, so the ball is half a step wider than the points ask for.
  const radius = points.reduce((most, p) => Math.max(most, length(minus(p, middle))), 0) + step;

  const edge = (on) => vertices.map((_, k) => k).filter(on);
  const edges = [edge((k) => lattice.u[k] === 0), edge((k) => lattice.v[k] === 0),
                 edge((k) => lattice.u[k] === kSteps), edge((k) => lattice.v[k] === kSteps)];
  let next = 0;
  const indices = Array.from(triangles, (vertex) => order.get(vertex));
  const codes = indices.map((index) => index === next ? (++next, 0) : next - index);

  const wide = count > 65536, size = wide ? 4 : 2;
  const start = 92 + 6 * count, aligned = Math.ceil(start / size) * size;
  const bytes = Buffer.alloc(aligned + 4 + size * codes.length +
                             edges.reduce((sum, list) => sum + 4 + size * list.length, 0));
  let at = 0;
  for (const x of centre) at = bytes.writeDoubleLE(x, at);
  for (const x of [low, high]) at = bytes.writeFloatLE(x, at);
  for (const x of [...middle, radius, ...horizonOcclusion(points, centre)]) at = bytes.writeDoubleLE(x, at);
  at = bytes.writeUInt32LE(count, at);
  for (const values of [lattice.u, lattice.v, lattice.height]) {
    let before = 0;
    for (const value of values) {
      at = bytes.writeUInt16LE(zigZag(value - before), at);
      before = value;
    }
  }
  const write = (x) => at = wide ? bytes.writeUInt32LE(x, at) : bytes.writeUInt16LE(x, at);
  at = bytes.writeUInt32LE(codes.length / 3, aligned);
  codes.forEach(write);
  for (const list of edges) {
    at = bytes.writeUInt32LE(list.length, at);
    list.forEach(write);
  }
  return { bytes, lattice, indices, edges };
}
