// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Bundles the page and writes it as a C++ source: node build.mjs OUTPUT.cpp
// The template's style and script are put in here (check.html has the style alone); its data, when a report is written (report_html.cpp).
import { readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { build } from 'esbuild';

const here = dirname(fileURLToPath(import.meta.url));
const output = process.argv[2];
if (!output) throw new Error('usage: node build.mjs OUTPUT.cpp');

// docs/images/findings, by code: "302" of 302_crack.svg.
const pictures = Object.fromEntries(readdirSync(join(here, 'findings')).sort().map(
  (name) => [name.slice(0, 3), readFileSync(join(here, 'findings', name), 'utf8')]));

const bundled = await build({
  entryPoints: [join(here, 'src/main.ts'), join(here, 'src/style.css'), join(here, 'src/check.css')],
  outdir: 'out',
  bundle: true,
  minify: true,
  write: false,
  format: 'iife',
  target: 'es2021',
  charset: 'utf8',
  legalComments: 'eof',
  define: { FINDING_PICTURES: JSON.stringify(pictures) },
});
const text = (name) => bundled.outputFiles.find((file) => file.path.endsWith(name)).text;

const page = readFileSync(join(here, 'src/page.html'), 'utf8')
  .replace('/*style*/', () => text('style.css'))
  .replace('/*script*/', () => text('main.js'));

const mark = 'plumbline_page';
const raw = (string) => {
  if (string.includes(`)${mark}"`)) throw new Error('the page holds the end mark of its own C++ string');
  return `R"${mark}(${string})${mark}"`;
};
writeFileSync(output, `// Written by reports/page/build.mjs from reports/page/src; do not edit.
#include "reports/page_template.h"

namespace plumbline::reports {
const std::string_view kPageTemplate = ${raw(page)};
const std::string_view kCheckStyle = ${raw(text('check.css'))};
constexpr FindingPicture kPictures[] = {
${Object.entries(pictures).map(([code, svg]) => `    {${Number(code)}, ${raw(svg)}}`).join(',\n')}};
const std::span<const FindingPicture> kFindingPictures{kPictures};
}  // namespace plumbline::reports
`);
