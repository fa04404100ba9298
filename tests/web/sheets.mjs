// What is printed of a page, sheet by sheet: the words of its PDF and where they stand.
import { execFileSync } from 'node:child_process';

const point = 1 / 72;     // inches
const mm = 1 / 25.4;
const margins = { top: (20 * mm) / point, foot: (18 * mm) / point, side: (14 * mm) / point };  // of web/report/paper.mjs

const names = { amp: '&', lt: '<', gt: '>', quot: '"', apos: '\'' };

function textOf(xml) {
  return xml.replace(/&(?:#(\d+)|(\w+));/g, (_, code, name) => (code ? String.fromCodePoint(Number(code)) : names[name]));
}

function numbersOf(attributes) {
  return Object.fromEntries([...attributes.matchAll(/(\w+)="([\d.-]+)"/g)].map(([, name, value]) => [name, Number(value)]));
}

function wordsOf(xml) {
  return [...xml.matchAll(/<word ([^>]*)>([^<]*)<\/word>/g)].map(([, attributes, text]) => ({ ...numbersOf(attributes), text: textOf(text) }));
}

function joined(words) {
  return [...words].sort((a, b) => a.xMin - b.xMin).map(({ text }) => text).join(' ');
}

function sheetOf(attributes, xml) {
  const { width, height } = numbersOf(attributes);
  const words = wordsOf(xml);
  const isHead = ({ yMax }) => yMax < margins.top, isFoot = ({ yMin }) => yMin > height - margins.foot;
  const lines = [...xml.matchAll(/<line [^>]*>(.*?)<\/line>/gs)].map(([, line]) => wordsOf(line));
  return {
    head: joined(words.filter(isHead)), foot: joined(words.filter(isFoot)), words: words.filter((word) => !isHead(word) && !isFoot(word)),
    lines: lines.filter(([first]) => !isHead(first) && !isFoot(first)).map((line) => ({ low: line[0].yMax, text: joined(line) })),
    left: margins.side, right: width - margins.side, height,
  };
}

/** Prints to A4: { pdf, sheets: [{ head, foot, words, lines, left, right, height }] }, lengths in points; needs pdftotext. */
export async function sheetsOf(page) {
  const pdf = await page.pdf({ format: 'A4', preferCSSPageSize: true });
  const xml = execFileSync('pdftotext', ['-bbox-layout', '-', '-'], { input: pdf, encoding: 'utf8', maxBuffer: 1e8 });
  const sheets = [...xml.matchAll(/<page ([^>]*)>(.*?)<\/page>/gs)].map(([, attributes, text]) => sheetOf(attributes, text));
  return { pdf, sheets };
}
