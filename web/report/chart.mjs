// A uPlot chart that follows the page: its width, light or dark, and paper.
import uPlot from 'uplot';
import { element } from './dom.mjs';
import { onTheme, theme, themeColour } from './theme.mjs';

const paperWidth = 660;  // px, of a chart on paper

function axis(label, more) {
  const font = `12px ${themeColour('font')}`;
  return {
    label, font, labelFont: font, labelSize: 20, size: 32, stroke: themeColour('muted'),
    grid: { stroke: themeColour('line'), width: 1 }, ticks: { stroke: themeColour('line'), width: 1, size: 5 }, ...more,
  };
}

export class Chart {
  /** `options(axis, theme)` gives uPlot's options but width and height; `data` as uPlot's. `afterDraw` may be set. */
  constructor(name, options, data, height = 300) {
    Object.assign(this, { options, data, height });
    this.frame = element('div', { class: 'chart', role: 'img', 'aria-label': name });
    new ResizeObserver(() => this.resize()).observe(this.frame);
    onTheme(() => this.draw());
    addEventListener('beforeprint', () => this.plot?.setSize({ width: paperWidth, height: this.height }));
    addEventListener('afterprint', () => this.resize());
  }

  draw() {
    if (!this.frame.clientWidth) return;
    this.plot?.destroy();
    const options = this.options(axis, theme());
    const hooks = { ...options.hooks, draw: [...(options.hooks?.draw ?? []), (plot) => this.afterDraw?.(plot)] };
    this.plot = new uPlot({ width: this.frame.clientWidth, height: this.height, legend: { show: false }, ...options, hooks }, this.data, this.frame);
  }

  resize() {
    const width = this.frame.clientWidth;
    if (!width) return;
    if (!this.plot) this.draw();
    else if (this.plot.width !== width) this.plot.setSize({ width, height: this.height });
  }
}

/** Bars with the intervals of their values, and a line at `mean` when that is a number. `bars`: [{ label, value, low, high }]. */
export function intervalBars(name, bars, labelOfValue, labelOfBar, mean) {
  const top = Math.max(...bars.map((bar) => Math.max(bar.value ?? 0, bar.high ?? 0)), 0);
  const whiskers = (plot) => {
    const { ctx, bbox } = plot;
    ctx.save();
    ctx.strokeStyle = themeColour('ink');
    ctx.lineWidth = 1.5 * devicePixelRatio;
    ctx.beginPath();
    bars.forEach((bar, k) => {
      if (typeof bar.low !== 'number' || typeof bar.high !== 'number') return;
      const x = plot.valToPos(k, 'x', true), cap = Math.min(7 * devicePixelRatio, bbox.width / bars.length / 5);
      const [low, high] = [plot.valToPos(Math.max(0, bar.low), 'y', true), plot.valToPos(bar.high, 'y', true)];
      for (const y of [low, high]) { ctx.moveTo(x - cap, y); ctx.lineTo(x + cap, y); }
      ctx.moveTo(x, low);
      ctx.lineTo(x, high);
    });
    ctx.stroke();
    if (Number.isFinite(mean)) {
      const y = plot.valToPos(mean, 'y', true);
      ctx.setLineDash([5 * devicePixelRatio, 4 * devicePixelRatio]);
      ctx.strokeStyle = themeColour('muted');
      ctx.beginPath();
      ctx.moveTo(bbox.left, y);
      ctx.lineTo(bbox.left + bbox.width, y);
      ctx.stroke();
    }
    ctx.restore();
  };
  return new Chart(name, (axis) => ({
    scales: { x: { time: false, range: [-0.6, bars.length - 0.4] }, y: { range: [0, top > 0 ? top * 1.08 : 1] } },
    cursor: { show: false },
    axes: [
      axis(labelOfBar, { splits: () => bars.map((_, k) => k), values: () => bars.map((bar) => bar.label), grid: { show: false }, ticks: { show: false } }),
      axis(labelOfValue, { size: 58 }),
    ],
    series: [{}, { fill: themeColour('bar'), stroke: themeColour('bar'), width: 0, points: { show: false }, paths: uPlot.paths.bars({ size: [0.62, 72] }) }],
    hooks: { draw: [whiskers] },
  }), [bars.map((_, k) => k), bars.map((bar) => bar.value)], 260);
}
