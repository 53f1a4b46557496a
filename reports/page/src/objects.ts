// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Objects: what a mesh without a plan is judged by. Every frame is a point: triangles against the error that shows.
import { axis, base, chart, look, tooltip } from './chart';
import type { Option } from './chart';
import { asChoices, controls, orAll, section, select } from './controls';
import { distinct, median, meshRuns, methods, results, timingOf, worst } from './data';
import type { Figure, Frame, Run } from './data';
import { table } from './tables';
import { el, short } from './text';

interface Measure { label: string; unit: string; of: (frame: Frame) => Figure }

const MEASURES: Measure[] = [
  { label: 'silhouette, largest distance', unit: 'px', of: (frame) => frame.silhouette_px.max },
  { label: 'silhouette, pixels that differ', unit: 'px', of: (frame) => frame.silhouette_px.pixels },
  { label: 'parallax, p99', unit: 'px', of: (frame) => frame.parallax_px.p99 },
  { label: 'depth, p99', unit: 'share', of: (frame) => frame.depth_rel.p99 },
];

function scatter(runs: Run[], measure: Measure, width: number): Option {
  const shown = methods.filter((method) => runs.some((run) => run.method === method));
  return {
    ...base(width, shown),
    tooltip: {
      ...(base(width, shown)['tooltip'] as object),
      trigger: 'item',
      formatter: ({ data }: { data: { run: Run; frame: Frame } }) =>
        tooltip(`${data.run.id}, frame ${data.frame.index}`, [
          ['triangles', short(data.frame.triangles)],
          ...MEASURES.map(({ label, unit, of }): [string, string] => [label, `${short(of(data.frame))} ${unit}`]),
        ]),
    },
    xAxis: axis('triangles of a frame', 'x', 'value', { min: 0 }),
    yAxis: axis(`${measure.label} (${measure.unit})`, 'y', 'value', { min: 0 }),
    series: shown.map((method) => {
      const { colour, symbol } = look(method);
      return {
        name: method, type: 'line', lineStyle: { width: 0 }, symbol, symbolSize: 9, showAllSymbol: true,
        itemStyle: { color: colour, opacity: 0.75 },
        data: runs.filter((run) => run.method === method).flatMap((run) => run.frames
          .filter((frame) => measure.of(frame) !== null)
          .map((frame) => ({ value: [frame.triangles, measure.of(frame)], run, frame }))),
      };
    }),
  };
}

export function objectsSection(): HTMLElement {
  const meshes = distinct(meshRuns.map((run) => run.terrain));
  const flights = distinct(meshRuns.map((run) => run.trajectory));
  const redraw = () => plot.redraw();
  const mesh = select('Mesh', asChoices(meshes), meshes[0] ?? '', redraw);
  const flight = select('Trajectory', orAll(flights, 'all together'), '', redraw);
  const which = select('Error', MEASURES.map(({ label, unit }, place) => ({ value: String(place), label: `${label} (${unit})` })),
    '0', redraw);
  const plot = chart('Chart: triangles of each frame against the error that shows',
    (width) => scatter(meshRuns.filter((run) => run.terrain === mesh.value() &&
      (flight.value() === '' || run.trajectory === flight.value())), MEASURES[Number(which.value())]!, width));

  const groups = new Map<string, Run[]>();
  for (const run of meshRuns) {
    const key = JSON.stringify([run.terrain, run.method, run.threshold_px]);
    groups.set(key, [...(groups.get(key) ?? []), run]);
  }
  const full = new Map((results.meshes ?? []).map((facts) => [facts.id, facts]));
  const rows = [...groups.values()].map((runs) => {
    const first = runs[0]!;
    const frames = runs.flatMap((run) => run.frames);
    const mean = frames.reduce((sum, frame) => sum + frame.triangles, 0) / Math.max(1, frames.length);
    return [
      first.terrain, first.method, short(first.threshold_px), short(full.get(first.terrain)?.objects ?? null),
      short(full.get(first.terrain)?.triangles ?? null), short(Math.round(mean)),
      short(frames.reduce((least, frame) => Math.min(least, frame.triangles), Infinity)),
      ...MEASURES.map((measure) => short(worst(frames.map(measure.of)))),
      short(worst(runs.map((run) => run.summary.hausdorff_m.most))),
      short(worst(runs.map((run) => run.summary.normal_deg.mean))),
      short(worst(runs.map((run) => run.summary.self_intersection))),
      short(worst(runs.map((run) => run.summary.projected_area))),
      short(median(runs.flatMap((run) => timingOf.get(run.id)?.update_ms.frames ?? []))),
    ];
  });
  return section('objects', 'Objects',
    el('p', { class: 'lead' }, 'General meshes have no plan to cover and no height over a point: silhouettes, depths along ' +
      'the same ray and parallax are judged against the full scene. The table has the worst frame; in the chart each frame is a point. Distances ' +
      'in space, normals and self-intersections are measured in some frames; the full mesh’s own self-intersections count too.'),
    table([
      { head: 'Mesh' }, { head: 'Method' }, { head: 'τ (px)', number: true }, { head: 'Objects', number: true },
      { head: 'Triangles, full', number: true }, { head: 'mean', number: true }, { head: 'least', number: true },
      ...MEASURES.map(({ label, unit }) => ({ head: `${label} (${unit})`, number: true })),
      { head: 'Hausdorff, at most (m)', number: true }, { head: 'normals, mean (°)', number: true },
      { head: 'self-intersections', number: true }, { head: 'projected area (share)', number: true },
      { head: 'update, median (ms)', number: true },
    ], rows, 'Objects'),
    controls(mesh, flight, which), el('figure', {}, plot.element));
}
