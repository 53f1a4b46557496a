// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The page from top to bottom. It shows what results.json and timing.json hold and decides nothing.
import { accuracySection } from './accuracy';
import { section } from './controls';
import { facts, meshRuns, methods, results, terrainRuns, timing, trajectories } from './data';
import { definitionsSection, findingsSection, gatesSection, matrixSection, terrainsSection } from './tables';
import { objectsSection } from './objects';
import { el, plural, short } from './text';
import { economySection } from './economy';
import { stabilitySection } from './stability';
import { timelineSection } from './timeline';
import { trustSection } from './trust';

function fact(name: string, ...value: (Node | string)[]): HTMLElement {
  return el('div', {}, el('dt', {}, name), el('dd', {}, ...value));
}

function header(): HTMLElement {
  const frames = results.runs.reduce((sum, run) => sum + run.frames.length, 0);
  return el('header', {},
    el('p', { class: 'brand' }, el('b', {}, 'plumbline'), ` ${facts.plumbline} · suite `, el('b', {}, results.suite)),
    el('div', { class: `verdict ${results.pass ? 'pass' : 'fail'}` },
      el('p', { class: 'stamp' }, results.pass ? '✓ pass' : '✕ fail'),
      el('div', {}, el('h1', {}, facts.headline),
        facts.sentences.length === 0 ? null
          : el('ul', {}, ...facts.sentences.map((sentence) => el('li', {}, sentence))))),
    el('dl', { class: 'facts' },
      fact('Judged', `${plural(frames, 'frame')} of ${plural(results.runs.length, 'run')}: ${plural(methods.length, 'method')}, ` +
        `${results.terrains.length > 0 || !results.meshes ? `${plural(results.terrains.length, 'terrain')}, ` : ''}` +
        `${results.meshes ? `${plural(results.meshes.length, 'mesh', 'meshes')}, ` : ''}${plural(trajectories.length, 'trajectory', 'trajectories')}`),
      fact('Picture', `${results.viewport[0]} × ${results.viewport[1]} px, ${short(results.fov_y_deg)}° high`),
      fact('Times from', [timing.machine, timing.compiler, timing.build_type, plural(timing.jobs, 'thread'),
        `${short(timing.total_s)} s in all`].filter((part) => part !== '').join(', ')),
      fact('Repeat', el('code', {}, facts.command))));
}

const enlarged = el('dialog', { 'aria-label': 'Picture at full size' });
enlarged.addEventListener('click', () => enlarged.close());

/** A picture that opens at full size; Escape or a click closes it. */
function enlargeable(source: string, caption: string): HTMLElement {
  const button = el('button', { type: 'button', class: 'picture', title: 'Enlarge' },
    el('img', { src: source, alt: caption, loading: 'lazy' }));
  button.addEventListener('click', () => {
    enlarged.replaceChildren(el('img', { src: source, alt: caption }));
    enlarged.showModal();
  });
  return button;
}

function picturesSection(): HTMLElement | null {
  if (facts.pictures.length === 0) return null;
  const panel = (source: string, caption: string) =>
    el('figure', {}, enlargeable(source, caption), el('figcaption', {}, caption));
  return section('pictures', 'Pictures',
    el('p', { class: 'lead' }, 'The frame with the widest visible crack or, where there is none, with the largest p99 displacement. The middle picture shows each ' +
      'pixel’s displacement from 0 to 2 τ (viridis), red beyond; the bar’s long mark is τ; grey pixels were not judged. Of a mesh: the frame with the ' +
      'largest silhouette distance, and each pixel’s parallax; red where only one of the two surfaces is seen.'),
    ...facts.pictures.map((picture) => el('article', { class: 'triptych' },
      el('h3', {}, picture.run, el('span', {}, ` frame ${picture.frame}, τ = ${short(picture.threshold_px)} px`)),
      el('div', {}, panel(picture.mesh, 'The method’s mesh'), panel(picture.error, 'Displacement, px'),
        panel(picture.reference, 'The full surface')))));
}

const sections = [
  matrixSection(), ...(terrainRuns.length === 0 ? [] : [accuracySection(), economySection()]),
  ...(meshRuns.length === 0 ? [] : [objectsSection()]),
  ...(results.runs.length === 0 ? [] : [stabilitySection(), timelineSection()]), picturesSection(),
  gatesSection(), findingsSection(), terrainsSection(), trustSection(), definitionsSection(),
].filter((part): part is HTMLElement => part !== null);

const contents = el('nav', { 'aria-label': 'Contents' },
  ...sections.map((part) => el('a', { href: `#${part.id}` }, part.querySelector('h2')!.textContent ?? '')));

document.getElementById('page')!.replaceChildren(header(), contents, el('main', {}, ...sections), enlarged,
  el('footer', {}, 'This page is one file and needs no network. Charts: Apache ECharts (Apache-2.0). Figures: results.json ' +
    'and timing.json beside it.'));
