// The canvas of the replay: as sharp as the screen, as wide as its place, and as high as the view asks for.
import { onTheme } from './theme.mjs';

export class Stage {
  constructor(canvas, heightOf, changed) {
    this.canvas = canvas;
    this.context = canvas.getContext('2d');
    this.heightOf = heightOf;
    this.changed = changed;
    new ResizeObserver(() => this.fit()).observe(canvas.parentElement);
    /** Ends what it hears of paper. */
    this.leave = onTheme(() => { if (canvas.parentElement.clientWidth !== this.width) this.fit(); });
  }

  /** Sets the bitmap to the place on the page; what was drawn is gone. */
  fit() {
    const width = this.canvas.parentElement.clientWidth;
    if (width === 0) return;
    const height = Math.round(this.heightOf(width));
    const ratio = Math.max(1, window.devicePixelRatio || 1);
    this.ratio = ratio;  // of its pixels to those of the page
    this.width = width;
    this.height = height;
    this.canvas.width = Math.round(width * ratio);
    this.canvas.height = Math.round(height * ratio);
    this.canvas.style.aspectRatio = `${width} / ${height}`;
    this.context.setTransform(ratio, 0, 0, ratio, 0, 0);
    this.changed();
  }
}
