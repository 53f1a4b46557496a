// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// One figure along one trajectory, a curve per method.
import { axis, base, chart, css, look, tooltip } from './chart';
import type { Option } from './chart';
import { asChoices, checkbox, controls, section, select } from './controls';
import { methods, results, terrainRuns, terrains, thresholds, timingOf, trajectories } from './data';
import type { Figure, Frame, Run } from './data';
import { el, short, tick } from './text';

interface Quantity {
  label: string;
  unit: string;
  of: (frame: Frame, run: Run, place: number) => Figure;
  bounded?: boolean;  // the threshold bounds it
}

const QUANTITIES: Quantity[] = [
  { label: 'displacement, p99', unit: 'px', of: (frame) => frame.displacement_px.p99, bounded: true },
  { label: 'displacement, max', unit: 'px', of: (frame) => frame.displacement_px.max, bounded: true },
  { label: 'pixels above τ', unit: 'share', of: (frame) => frame.displacement_px.over_threshold },
  { label: 'pop, max', unit: 'px', of: (frame) => frame.pop_px.max, bounded: true },
  { label: 'pop, p99', unit: 'px', of: (frame) => frame.pop_px.p99, bounded: true },
  { label: 'parallax, p99', unit: 'px', of: (frame) => frame.parallax_px.p99 },
  { label: 'parallax, max', unit: 'px', of: (frame) => frame.parallax_px.max },
  { label: 'differs from a fresh start', unit: 'share', of: (frame) => frame.stability.path_share },
  { label: 'vertices that toggle', unit: 'count', of: (frame) => frame.stability.toggles },
  { label: 'change under 0.01 px', unit: 'count', of: (frame) => frame.stability.jitter_vertices },
  { label: 'silhouette, max', unit: 'px', of: (frame) => frame.silhouette_px.max, bounded: true },
  { label: 'silhouette, pixels', unit: 'px', of: (frame) => frame.silhouette_px.pixels },
  { label: 'triangles', unit: 'count', of: (frame) => frame.triangles },
  { label: 'update time', unit: 'ms', of: (_, run, place) => timingOf.get(run.id)?.update_ms.frames[place] ?? null },
  { label: 'cracks', unit: 'count', of: (frame) => frame.conformity.crack },
  { label: 'visible cracks', unit: 'count', of: (frame) => frame.visible_cracks },
  { label: 'T-junctions', unit: 'count', of: (frame) => frame.conformity.t_junction },
  { label: 'largest gap of a visible crack', unit: 'px', of: (frame) => frame.largest_gap_px },
  { label: 'vertical error, max', unit: 'm', of: (frame) => frame.vertical_m.max },
  { label: 'vertical error, certain', unit: 'm', of: (frame) => frame.vertical_m.certain_max },
  { label: 'vertical error, RMS', unit: 'm', of: (frame) => frame.vertical_m.rms },
  { label: 'relative depth, p99', unit: 'ratio', of: (frame) => frame.depth_rel.p99 },
  { label: 'silhouette pixels', unit: 'px', of: (frame) => frame.silhouette_px.pixels },
  { label: 'slivers', unit: 'count', of: (frame) => frame.shape.slivers },
];

function option(runs: Run[], quantity: Quantity, threshold: number, log: boolean, width: number): Option {
  const shown = methods.filter((method) => runs.some((run) => run.method === method));
  const frames = runs.flatMap((run) => run.frames.map((frame) => frame.index));
  const first = runs[0];
  const amount = (value: Figure) => (quantity.unit === 'count' ? short(value) : `${short(value)} ${quantity.unit}`);
  const named = (method: string) => {
    const own = runs.find((run) => run.method === method)?.threshold_px;
    return own === undefined || own === threshold ? method : `${method} at τ ${own} px`;
  };
  return {
    ...base(width, shown),
    tooltip: {
      ...(base(width, shown)['tooltip'] as object),
      trigger: 'axis',
      formatter: (items: { seriesName: string; value: [number, Figure, Figure] }[]) =>
        tooltip(`frame ${items[0]?.value[0] ?? ''}`,
          items.map((item) => [named(item.seriesName), amount(item.value[2])])),
    },
    xAxis: axis('frame', 'x', 'value', {
      min: Math.min(...frames), max: Math.max(...frames), minInterval: 1, splitLine: { show: false },
    }),
    yAxis: axis(`${quantity.label} (${quantity.unit})`, 'y', log ? 'log' : 'value', log ? {} : { min: 0 }),
    series: shown.map((method) => {
      const run = runs.find((one) => one.method === method)!;
      const { colour, symbol, dash } = look(method);
      const few = run.frames.length <= 60;
      return {
        name: method, type: 'line', symbol, symbolSize: few ? 6 : 4, showSymbol: few, connectNulls: false,
        lineStyle: { color: colour, width: 2, type: dash }, itemStyle: { color: colour },
        // On a logarithmic axis a zero leaves a gap; the tooltip still tells it.
        data: run.frames.map((frame, place) => {
          const value = quantity.of(frame, run, place);
          return [frame.index, log && value !== null && value <= 0 ? null : value, value];
        }),
        markLine: quantity.bounded && run === first ? {
          symbol: 'none', silent: true, animation: false,
          lineStyle: { color: css('--bad'), type: [4, 4], width: 1.5 },
          label: { formatter: `τ = ${tick(threshold)} px`, color: css('--bad'), position: 'insideEndTop', fontSize: 12 },
          data: [{ yAxis: threshold }],
        } : undefined,
      };
    }),
  };
}

export function timelineSection(): HTMLElement {
  const redraw = () => drawing.redraw();
  const terrain = select('Terrain', asChoices(terrains), terrains[0] ?? '', redraw);
  const trajectory = select('Trajectory', asChoices(trajectories), trajectories[0] ?? '', redraw);
  const middle = thresholds[Math.floor((thresholds.length - 1) / 2)] ?? 1;
  const threshold = select('Threshold τ', thresholds.map((value) => ({ value: String(value), label: `${value} px` })),
    String(middle), redraw);
  // A mesh has no displacement.
  const initial = terrainRuns.length > 0 ? 0 : QUANTITIES.findIndex(({ label }) => label === 'silhouette, max');
  const quantity = select('Figure', QUANTITIES.map(({ label }, place) => ({ value: String(place), label })),
    String(initial), redraw);
  const log = checkbox('logarithmic', false, redraw);
  const chosen = () => {
    const here = results.runs.filter((run) => run.terrain === terrain.value() && run.trajectory === trajectory.value());
    const tau = Number(threshold.value());
    // A method that was not given this threshold, such as the full grid, is shown at its nearest one.
    return methods.flatMap((method) => {
      const own = here.filter((run) => run.method === method);
      if (own.length === 0) return [];
      return [own.reduce((best, run) =>
        (Math.abs(run.threshold_px - tau) < Math.abs(best.threshold_px - tau) ? run : best))];
    });
  };
  const drawing = chart('Chart: a figure along the trajectory, a curve per method', (width) =>
    option(chosen(), QUANTITIES[Number(quantity.value())]!, Number(threshold.value()), log.checked(), width));
  return section('timeline', 'Along a trajectory',
    controls(terrain, trajectory, threshold, quantity, log), el('figure', {}, drawing.element));
}
