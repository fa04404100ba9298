// A made-up repository of documents for the site: tutorials, how-to pages and explanations, and no reference yet.
import { mkdirSync, writeFileSync } from 'node:fs';
import path from 'node:path';

const code = '```';
const files = {
  'README.md': '# Vibrosow\n\n**Says what a tray sows.** And how sure that is.\n\n## When not to use it\n\nFor damp seed.\n\n## Where to read on\n\n[All](docs)\n',
  'docs/README.md': '# Documents\n\n- [third](tutorials/b.md)\n- [first](tutorials/z.md)\n- [second](tutorials/a.md#steps)\n- [theory](explanation/theory.md)\n',
  'docs/tutorials/z.md': '# Fill a tray\n\nYou fill a tray with wheat. Then you look at it.\n\n## Steps\n\nOne.\n',
  'docs/tutorials/a.md': '# Shake a tray\n\nYou shake it.\n\n## Steps\n\nTwo.\n',
  'docs/tutorials/b.md': '# Draw a `tray`\n\nYou draw it.\n',
  'docs/tutorials/not-in-the-index.md': '# Weigh a tray\n\nYou weigh it.\n',
  'docs/how-to/unclog.md': `# Unclog a hole

Open [the theory](../explanation/theory.md#the-law-of-beverloo-and-mu_r-twice-1), or [this](#what-it-prints).

## Run it

${code}console
$ vibrosow check tray.toml
step 1 us; 2 $ of it
$ vibrosow run tray.toml \\
    --html
done
${code}

An indented block:

    vibrosow plan --crop pea    # costs $5 and $6
    echo "$HOME"

## What it prints

A very long line of output, which must scroll by itself on a phone:

${code}
hole,rate_kg_per_s,rate_low,rate_high,unevenness_percent,unevenness_low,unevenness_high,seeds_counted_in_the_window
${code}

### Arching <b>grains</b>

Grains that arch over the hole stop its outflow; a stronger shaking, a wider opening or another slope breaks the arches again, and the parabolometric
unevenness falls.

## What it prints

Twice the same heading.

| | before | after |
|---|--:|--:|
| rate | 1 | 2 |
`,
  'docs/explanation/theory.md': `# Theory

Costs \\$5, or $5 and $6, or \`$a$\` in code: no formulas. The rate is $W \\propto \\rho\\sqrt{g}\\,(D - kd)^{5/2}$, with $k \\approx 1.4$ [^1].

## The law of Beverloo and \`mu_r\`, twice

${code}math
W = C \\rho_b \\sqrt{g}\\,(D - k d)^{5/2}, \\qquad \\frac{1}{m^*} = \\frac{1}{m_i} + \\frac{1}{m_j} + \\sum_{n=1}^{N} \\frac{\\partial F}{\\partial x_n} + \\int_0^T \\omega(t)\\,dt
${code}

| of | formula |
|---|---|
| damping | $\\zeta < 1$ |

## The law of Beverloo and \`mu_r\`, twice

### With $e$ and [a link](../how-to/unclog.md)

End.
`,
};

/** Writes the repository into `folder`. */
export function writeDocuments(folder) {
  for (const [name, text] of Object.entries(files)) {
    mkdirSync(path.join(folder, path.dirname(name)), { recursive: true });
    writeFileSync(path.join(folder, name), text);
  }
  mkdirSync(path.join(folder, 'docs/reference'));
  mkdirSync(path.join(folder, 'reports/pages'), { recursive: true });
  const pixel = Buffer.from('R0lGODlhAQABAIAAAP///wAAACwAAAAAAQABAAACAkQBADs=', 'base64');
  for (const name of ['studio-playing.jpg', 'run-desktop.jpg']) writeFileSync(path.join(folder, 'reports/pages', name), pixel);
}
