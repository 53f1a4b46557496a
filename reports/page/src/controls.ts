// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
import { el } from './text';

export interface Choice { value: string; label: string }

export interface Select { element: HTMLElement; value: () => string }

/** A labelled native select; one that offers a single choice is plain text. */
export function select(label: string, choices: Choice[], initial: string, changed: () => void): Select {
  if (choices.length < 2) {
    const only = choices[0] ?? { value: '', label: '–' };
    return {
      element: el('span', { class: 'control' }, el('span', {}, label), el('b', {}, only.label)),
      value: () => only.value,
    };
  }
  const box = el('select', {}, ...choices.map(({ value, label: text }) => el('option', { value }, text)));
  box.value = initial;
  box.addEventListener('change', changed);
  return { element: el('label', { class: 'control' }, el('span', {}, label), box), value: () => box.value };
}

export function checkbox(label: string, initial: boolean, changed: () => void) {
  const box = el('input', { type: 'checkbox' });
  box.checked = initial;
  box.addEventListener('change', changed);
  return { element: el('label', { class: 'control check' }, box, el('span', {}, label)), checked: () => box.checked };
}

export function asChoices(values: string[]): Choice[] {
  return values.map((value) => ({ value, label: value }));
}
/** With a first choice that takes them all together, if there are several. */
export function orAll(values: string[], all: string): Choice[] {
  return values.length < 2 ? asChoices(values) : [{ value: '', label: all }, ...asChoices(values)];
}

export function controls(...parts: { element: HTMLElement }[]): HTMLElement {
  return el('div', { class: 'controls' }, ...parts.map((part) => part.element));
}

export function section(id: string, title: string, ...children: (Node | string | null)[]): HTMLElement {
  return el('section', { id, 'aria-labelledby': `${id}-title` }, el('h2', { id: `${id}-title` }, title), ...children);
}
