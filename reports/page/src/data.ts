// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The shapes of results.json ("plumbline.results/1"), timing.json ("plumbline.timing/1") and of what the page alone
// needs. A figure that nothing was judged for is null.

export type Figure = number | null;

export const FINDINGS = [
  'crack', 't_junction', 'fold_over', 'degenerate', 'hole', 'overlap', 'outline', 'non_manifold', 'duplicate',
  'non_finite', 'bad_index', 'unused_vertex',
] as const;
export type FindingName = (typeof FINDINGS)[number];

export interface Figures {
  triangles: number;
  vertices: number;
  conformity: Record<FindingName, Figure>;  // of a mesh, plan findings are null: not asked
  visible_cracks: Figure;
  largest_gap_m: Figure;
  largest_gap_px: Figure;
  vertical_m: { max: Figure; certain_max: Figure; rms: Figure; mean: Figure };
  displacement_px: {
    max: Figure; p999: Figure; p99: Figure; rms: Figure; mean: Figure; over_threshold: Figure; uncovered_px: number;
  };
  parallax_px: { max: Figure; p999: Figure; p99: Figure; rms: Figure; mean: Figure };
  depth_rel: { max: Figure; p99: Figure };
  silhouette_px: { pixels: number; max: Figure };
  pop_px: { max: Figure; p99: Figure };
  shape: { slivers: number; min_quality: Figure };
}

export interface Finding {
  code: number;
  name: string;
  kind: string;
  severity: 'hazard' | 'fault';
  at: [Figure, Figure, Figure];
  visibility: 'unknown' | 'outside' | 'occluded' | 'visible';
  gap_m?: Figure;
  gap_px?: Figure;
  area_m2?: Figure;
  distance_m?: Figure;
}

export interface FrameStability {
  cut: boolean; under_threshold: boolean; settled: boolean; toggles: number; jitter_vertices: number; jitter_px: Figure;
  path_share: Figure; path_px: Figure; revisit_share: Figure;
}
export interface RunStability {
  cuts: number; recovery_frames: Figure; unrecovered: Figure; lag_frames: Figure; unsettled: Figure; toggles: number;
  jitter_vertices: number; jitter_px: Figure; path_share: Figure; path_px: Figure; revisits: number; revisit_share: Figure;
}

export interface FrameEconomy { excess: Figure; needed_triangles: Figure; slack: Figure; slack_in_view: Figure }
export interface RunEconomy {
  excess: Figure; excess_frames: number; slack: Figure; slack_in_view: Figure; slack_frames: number;
}
/** O7: null for runs over terrains. */
export interface RunSpace {
  self_intersection: Figure; hausdorff_m: { least: Figure; most: Figure };
  normal_deg: { max: Figure; mean: Figure; turned_share: Figure }; projected_area: Figure;
}

export interface Frame extends Figures {
  index: number;
  economy: FrameEconomy;
  stability: FrameStability;
  findings: Finding[];
}

export interface Run {
  id: string;
  subject?: 'mesh';  // absent: a terrain
  terrain: string;   // its id, or the mesh's
  trajectory: string;
  method: string;
  threshold_px: number;
  frames: Frame[];
  summary: Figures & RunSpace & {
    frames: number; worst_frame: number; stability: RunStability; economy: RunEconomy;
  };
}

/** `expected`: an entry of an expectation file; `note`: what to make of one that does not hold. */
export interface Gate {
  name: string; run: string; limit: string; value: Figure; pass: boolean; expected?: true; note?: string;
}

export interface Terrain {
  id: string; columns: number; rows: number; spacing_m: number; lowest_m: Figure; highest_m: Figure;
  diagonal_ambiguity_m: Figure;
}

export interface Mesh {
  id: string; objects: number; triangles: number; vertices: number; radius_m: number; object_radius_m: number;
}

/** How the oracles did on planted faults of one kind; `sound`: a harmless twin. */
export interface KindScore {
  oracle: string; kind: string; sound: boolean;
  faults: number; expected: number; found: number; misplaced: number; false_alarms: number;
}

export interface Selftest {
  seed: number; pass: boolean; planted: number; expected: number; found: number; misplaced: number;
  false_alarms: number; clean_meshes: number; clean_false_alarms: number; kinds: KindScore[];
}

export interface Results {
  suite: string;
  yardstick: string | null;
  pass: boolean;
  interrupted: boolean;
  viewport: [number, number];
  fov_y_deg: number;
  terrains: Terrain[];
  meshes?: Mesh[];
  runs: Run[];
  gates: Gate[];
  vacuous: string[];
  selftest?: Selftest;
}

export interface RunTiming {
  run: string; prepare_s: number; oracle_s: number;
  update_ms: { median: number; p95: number; frames: number[] };
}
export interface Timing {
  plumbline: string; machine: string; compiler: string; build_type: string; jobs: number; total_s: number;
  runs: RunTiming[];
}

export interface Picture {
  run: string; frame: number; threshold_px: number; mesh: string; error: string; reference: string;
}
export interface Facts {
  plumbline: string;
  command: string;
  headline: string;
  sentences: string[];
  catalogue: { code: number; name: string; definition: string }[];
  pictures: Picture[];
}

function embedded<T>(id: string): T {
  const holder = document.getElementById(id);
  if (!holder?.textContent) throw new Error(`the page lacks its ${id}`);
  return JSON.parse(holder.textContent) as T;
}

export const facts = embedded<Facts>('facts');
export const results = embedded<Results>('results');
export const timing = embedded<Timing>('timing');

export const timingOf = new Map(timing.runs.map((run) => [run.run, run]));

export function distinct<T>(values: Iterable<T>): T[] {
  return [...new Set(values)];
}
/** Runs over terrains; those around meshes have no plan figures and a section of their own. */
export const terrainRuns = results.runs.filter((run) => run.subject !== 'mesh');
export const meshRuns = results.runs.filter((run) => run.subject === 'mesh');
export const overTerrains = distinct(terrainRuns.map((run) => run.terrain));
export const terrains = distinct(results.runs.map((run) => run.terrain));
export const trajectories = distinct(results.runs.map((run) => run.trajectory));
export const methods = distinct(results.runs.map((run) => run.method));
export const thresholds = distinct(results.runs.map((run) => run.threshold_px)).sort((a, b) => a - b);

export function median(values: number[]): number | null {
  if (values.length === 0) return null;
  const sorted = [...values].sort((a, b) => a - b);
  return sorted[Math.ceil(sorted.length / 2) - 1] ?? null;  // nearest rank, as in timing.json
}

/** The largest of the figures that exist. */
export function worst(values: Figure[]): Figure {
  return values.reduce<Figure>((most, value) => (value !== null && (most === null || value > most) ? value : most), null);
}
