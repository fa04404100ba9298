// Numbers written under the holes, in as many lines as they need to stay apart.

const lineHeight = 17;
const gap = 8;

/** Draws [{ x, y, text }], each as near under its place as it can be. Returns the lines that were needed. */
export function drawHoleLabels(context, labels, colours, font) {
  context.font = font;
  context.textAlign = 'center';
  context.textBaseline = 'top';
  const ends = [];
  for (const label of [...labels].sort((a, b) => a.x - b.x)) {
    const half = context.measureText(label.text).width / 2 + gap / 2;
    let line = 0;
    while (ends[line] !== undefined && ends[line] > label.x - half) ++line;
    ends[line] = label.x + half;
    const y = label.y + 10 + line * lineHeight;
    context.fillStyle = colours.halo;
    context.beginPath();
    context.roundRect(label.x - half, y - 2, 2 * half, lineHeight, 5);
    context.fill();
    context.fillStyle = colours.ink;
    context.fillText(label.text, label.x, y);
  }
  return ends.length;
}
