// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
import { LineChart } from 'echarts/charts';
import { AriaComponent, GridComponent, LegendComponent, MarkLineComponent, TooltipComponent } from 'echarts/components';
import * as echarts from 'echarts/core';
import { SVGRenderer } from 'echarts/renderers';
import { methods } from './data';
import { el, escapeMarkup, tick } from './text';

echarts.use([LineChart, AriaComponent, GridComponent, LegendComponent, MarkLineComponent, TooltipComponent, SVGRenderer]);

export type Option = echarts.EChartsCoreOption;

/** A method looks the same in every chart: its colour, marker and dash go by its place in the suite. */
const SYMBOLS = ['circle', 'triangle', 'diamond', 'rect', 'roundRect', 'pin', 'arrow'];
const DASHES: (string | number[])[] = ['solid', [7, 4], [2, 3], [10, 3, 2, 3]];
export function look(method: string) {
  const place = Math.max(0, methods.indexOf(method));
  return {
    colour: css(`--series-${place % 8}`),
    symbol: SYMBOLS[place % SYMBOLS.length]!,
    dash: DASHES[place % DASHES.length]!,
  };
}

export function css(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

const dark = matchMedia('(prefers-color-scheme: dark)');
const redraws: (() => void)[] = [];
dark.addEventListener('change', () => redraws.forEach((redraw) => redraw()));

/** A chart that follows its width and the page's colours. `option` is asked anew at every redraw. */
export function chart(label: string, option: (width: number) => Option) {
  const holder = el('div', { class: 'chart', role: 'img', 'aria-label': label });
  let instance: echarts.ECharts | undefined;
  const redraw = () => instance?.setOption(option(holder.clientWidth), { notMerge: true });
  new ResizeObserver(() => {
    if (holder.clientWidth === 0) return;
    if (instance) instance.resize();
    else instance = echarts.init(holder, undefined, { renderer: 'svg' });
    redraw();
  }).observe(holder);
  redraws.push(redraw);
  return { element: holder, redraw };
}

/** Below this width a chart leaves out what would crowd it. */
export const NARROW = 440;

const LEGEND_ROW = 24, LEGEND_MARK = 34, LEGEND_GAP = 20, LETTER = 8;
/** The rows that a legend needs, as it fills them from the left. Letters are counted wide rather than narrow. */
function legendRows(legend: string[], width: number): number {
  let rows = 1, used = 0;
  for (const name of legend) {
    const needs = LEGEND_MARK + 5 + name.length * LETTER + LEGEND_GAP;
    if (used > 0 && used + needs > width) {
      rows += 1;
      used = 0;
    }
    used += needs;
  }
  return rows;
}

/** What all charts share: type, grid, legend, tooltip. */
export function base(width: number, legend: string[]): Option {
  const narrow = width < NARROW;
  return {
    animation: false,
    textStyle: { fontFamily: css('--font'), color: css('--ink') },
    grid: { left: narrow ? 52 : 64, right: narrow ? 12 : 24, top: 16 + LEGEND_ROW * legendRows(legend, width), bottom: 52 },
    legend: {
      data: legend, top: 0, left: 0, width: '100%', itemWidth: LEGEND_MARK, itemGap: LEGEND_GAP,
      textStyle: { color: css('--ink'), fontSize: 13 },
    },
    tooltip: {
      confine: true, backgroundColor: css('--card'), borderColor: css('--rule'),
      textStyle: { color: css('--ink'), fontSize: 13, fontFamily: css('--font') },
    },
  };
}

export function axis(name: string, place: 'x' | 'y', type: 'log' | 'value', more: object = {}): object {
  return {
    type, name, nameLocation: 'middle', nameGap: place === 'x' ? 32 : 46,
    nameTextStyle: { color: css('--muted'), fontSize: 13 },
    axisLabel: { color: css('--muted'), fontSize: 12, hideOverlap: true, formatter: (value: number) => tick(value) },
    axisLine: { show: true, lineStyle: { color: css('--rule-strong') } },
    axisTick: { show: true, lineStyle: { color: css('--rule-strong') } },
    splitLine: { show: true, lineStyle: { color: css('--rule') } },
    minorSplitLine: { show: false },
    ...more,
  };
}

/** Rows of a tooltip: a title, then name and value. */
export function tooltip(title: string, rows: [string, string][]): string {
  const lines = rows.map(([name, value]) =>
    `<tr><td>${escapeMarkup(name)}</td><td>${escapeMarkup(value)}</td></tr>`).join('');
  return `<b>${escapeMarkup(title)}</b><table class="tip">${lines}</table>`;
}
