// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Speed against accuracy, and triangles against error: a curve per method over its thresholds.
import { axis, base, chart, css, look, NARROW, tooltip } from './chart';
import type { Option } from './chart';
import { controls, orAll, section, select } from './controls';
import { median, methods, overTerrains as terrains, terrainRuns, timingOf, trajectories, worst } from './data';
import type { Figure, Run } from './data';
import { el, short, tick } from './text';

interface Point {
  method: string;
  threshold: number;
  runs: number;
  update: Figure;     // ms a frame, median over all frames
  triangles: Figure;  // mean
  p99: Figure;        // px, median frame
  p99Worst: Figure;   // px, worst frame
  parallax: Figure;   // px, p99, median frame
  max: Figure;        // px, worst run
  findings: number;
}

function points(runs: Run[]): Point[] {
  const groups = new Map<string, Run[]>();
  for (const run of runs) {
    const key = JSON.stringify([run.method, run.threshold_px]);
    groups.set(key, [...(groups.get(key) ?? []), run]);
  }
  return [...groups.values()].map((group) => {
    const frames = group.reduce((sum, run) => sum + run.summary.frames, 0);
    return {
      method: group[0]!.method,
      threshold: group[0]!.threshold_px,
      runs: group.length,
      update: median(group.flatMap((run) => timingOf.get(run.id)?.update_ms.frames ?? [])),
      triangles: frames === 0 ? null
        : group.reduce((sum, run) => sum + run.summary.triangles * run.summary.frames, 0) / frames,
      // The middle frame: one frame close to the ground, where a cell spans many pixels, must not stand for a flight.
      p99: median(group.flatMap((run) => run.frames.map((frame) => frame.displacement_px.p99))
        .filter((value): value is number => value !== null)),
      parallax: median(group.flatMap((run) => run.frames.map((frame) => frame.parallax_px.p99))
        .filter((value): value is number => value !== null)),
      p99Worst: worst(group.map((run) => run.summary.displacement_px.p99)),
      max: worst(group.map((run) => run.summary.displacement_px.max)),
      findings: group.reduce((sum, run) =>
        sum + Object.values(run.summary.conformity).reduce<number>((all, count) => all + (count ?? 0), 0), 0),
    };
  }).sort((a, b) => a.threshold - b.threshold);
}

// A logarithmic axis has no zero. Its lowest decade stands for everything from there down to zero, and says so.
const LEAST_FLOOR_PX = 1e-4;
function floorOf(values: Figure[], least: number): number {
  const shown = values.filter((value): value is number => value !== null && value > least);
  if (shown.length === 0) return least;
  return Math.max(least, 10 ** Math.floor(Math.log10(Math.min(...shown) / 2)));
}
function ceilingOf(values: Figure[], floor: number): number {
  const most = Math.max(floor * 10, ...values.filter((value): value is number => value !== null));
  return 10 ** Math.ceil(Math.log10(most) - 1e-9);
}

type Error = 'p99' | 'parallax';
const ERRORS: Record<Error, string> = { p99: 'displacement', parallax: 'parallax' };

function errorChart(runs: Run[], width: number, x: 'update' | 'triangles', y: Error): Option {
  const all = points(runs).filter((point) => point[x] !== null && point[y] !== null);
  const floor = floorOf(all.map((point) => point[y]), LEAST_FLOOR_PX);
  const pinned = all.some((point) => point[y]! < floor);
  const xFloor = 10 ** Math.floor(Math.log10(Math.max(1e-5, Math.min(...all.map((point) => point[x]!)))) + 1e-9);
  const shown = methods.filter((method) => all.some((point) => point.method === method));
  return {
    ...base(width, shown),
    tooltip: {
      ...(base(width, shown)['tooltip'] as object),
      trigger: 'item',
      formatter: ({ data }: { data: { point: Point } }) => {
        const point = data.point;
        return tooltip(`${point.method}, τ = ${short(point.threshold)} px`, [
          ['update, median', `${short(point.update)} ms`],
          ['triangles, mean', short(point.triangles)],
          ['displacement, p99, median frame', `${short(point.p99)} px`],
          ['displacement, p99, worst frame', `${short(point.p99Worst)} px`],
          ['parallax, p99, median frame', `${short(point.parallax)} px`],
          ['displacement, max', `${short(point.max)} px`],
          ['findings', short(point.findings)],
          ['runs', short(point.runs)],
        ]);
      },
    },
    xAxis: axis(x === 'update' ? 'update time per frame, median (ms)' : 'triangles per frame, mean', 'x', 'log', {
      min: xFloor, max: ceilingOf(all.map((point) => point[x]), xFloor),
    }),
    yAxis: axis(`p99 ${ERRORS[y]}, median frame (px)`, 'y', 'log', {
      min: floor, max: ceilingOf(all.map((point) => point[y]), floor),
      axisLabel: {
        color: css('--muted'), fontSize: 12,
        formatter: (value: number) => (pinned && value <= floor * 1.0001 ? `≤ ${tick(value)}` : tick(value)),
      },
    }),
    series: shown.map((method) => {
      const { colour, symbol, dash } = look(method);
      return {
        name: method, type: 'line', symbol, symbolSize: 11, clip: false,
        lineStyle: { color: colour, width: 2, type: dash },
        itemStyle: { color: colour },
        emphasis: { scale: 1.4 },
        // Labels of neighbouring curves stand on different sides.
        label: {
          show: width >= NARROW, position: methods.indexOf(method) % 2 ? 'right' : 'left', distance: 6, color: css('--muted'), fontSize: 11,
          formatter: ({ data }: { data: { point: Point } }) =>
            data.point[y] === 0 ? 'zero error' : `τ ${short(data.point.threshold)}`,
        },
        labelLayout: { hideOverlap: true },
        data: all.filter((point) => point.method === method).map((point) => ({
          value: [Math.max(xFloor, point[x]!), Math.max(floor, point[y]!)],
          point,
          // Hollow: the 99th percentile is above the threshold that the method was given.
          label: point[y]! < floor ? { position: 'top' } : undefined,
          itemStyle: y === 'p99' && point.p99! > point.threshold
            ? { color: css('--card'), borderColor: colour, borderWidth: 2.5 }
            : { color: colour },
        })),
      };
    }),
  };
}

export function accuracySection(): HTMLElement {
  const redraw = () => charts.forEach((one) => one.redraw());
  const terrain = select('Terrain', orAll(terrains, 'all together'), terrains.length < 2 ? terrains[0] ?? '' : '', redraw);
  const trajectory = select('Trajectory', orAll(trajectories, 'all together'),
    trajectories.length < 2 ? trajectories[0] ?? '' : '', redraw);
  const error = select('Error', (Object.keys(ERRORS) as Error[]).map((value) => ({ value, label: ERRORS[value] })), 'p99', redraw);
  const chosen = () => terrainRuns.filter((run) =>
    (terrain.value() === '' || run.terrain === terrain.value()) &&
    (trajectory.value() === '' || run.trajectory === trajectory.value()));
  const speed = chart('Chart: update time against displacement, a curve per method',
    (width) => errorChart(chosen(), width, 'update', error.value() as Error));
  const size = chart('Chart: triangles against displacement, a curve per method',
    (width) => errorChart(chosen(), width, 'triangles', error.value() as Error));
  const charts = [speed, size];
  return section('accuracy', 'Speed against accuracy',
    el('p', { class: 'lead' }, 'Down and to the left is better. A curve joins one method’s thresholds τ; a hollow marker ' +
      'means that in the middle frame the 99th percentile of the displacement lies above τ. Zero error stands on the axis’ floor.'),
    controls(terrain, trajectory, error),
    el('div', { class: 'pair' },
      el('figure', {}, el('figcaption', {}, 'Update time against error'), speed.element),
      el('figure', {}, el('figcaption', {}, 'Triangles against error'), size.element)));
}
