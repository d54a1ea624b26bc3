/** Eigenvalues over the forward speed: real parts solid, imaginary parts dashed, stable range shaded, speed draggable. */

import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import type { Complex } from "./complex";
import type { CriticalSpeeds } from "./critical";
import { COLOURS, colourOf } from "./style";
import { readable } from "./units";

export interface Curves {
  speeds: Float64Array;
  names: string[];
  /** [mode][speed] */
  eigenvalues: Complex[][];
  critical: CriticalSpeeds;
}

export interface Overlay {
  label: string;
  curves: Curves;
}

const LIMIT = 10;
const PINNED_DASHES = [[2, 3], [7, 3], [9, 3, 2, 3]];

export class Chart {
  private plot: uPlot | null = null;
  private curves: Curves | null = null;
  private speed = 0;

  constructor(
    private readonly host: HTMLElement,
    private readonly onSpeed: (speed: number) => void,
  ) {
    new ResizeObserver(() => this.plot?.setSize(this.size())).observe(host);
    host.addEventListener("pointerdown", (event) => this.drag(event));
  }

  private size(): { width: number; height: number } {
    return { width: Math.max(this.host.clientWidth, 200), height: Math.max(this.host.clientHeight, 200) };
  }

  /** Speed under the pointer while it is held down. */
  private drag(down: PointerEvent): void {
    const move = (event: PointerEvent) => {
      if (this.plot === null) return;
      const left = event.clientX - this.plot.over.getBoundingClientRect().left;
      const top = (this.curves as Curves).speeds.at(-1) as number;
      this.onSpeed(Math.min(Math.max(this.plot.posToVal(left, "x"), 0), top));
    };
    const up = () => {
      removeEventListener("pointermove", move);
      removeEventListener("pointerup", up);
    };
    addEventListener("pointermove", move);
    addEventListener("pointerup", up);
    move(down);
  }

  show(curves: Curves, overlays: Overlay[], speed: number): void {
    const shape = JSON.stringify([curves.names, overlays.map((overlay) => overlay.label), COLOURS.scheme]);
    this.curves = curves;
    this.speed = speed;
    const data = this.columns(curves, overlays);
    if (this.plot !== null && this.plot.root.dataset.shape === shape) {
      this.plot.setData(data); // with its scales: a plot made a moment ago may not have any yet
      return;
    }
    this.plot?.destroy();
    this.plot = new uPlot(this.options(curves, overlays), data, this.host);
    this.plot.root.dataset.shape = shape;
  }

  moveSpeed(speed: number): void {
    this.speed = speed;
    this.plot?.redraw(false);
  }

  /** The drawing as PNG. */
  png(): Promise<Blob | null> {
    return new Promise((resolve) => (this.plot ? this.plot.ctx.canvas.toBlob(resolve) : resolve(null)));
  }

  private columns(curves: Curves, overlays: Overlay[]): uPlot.AlignedData {
    const columns: (number | null)[][] = [];
    for (const set of [curves, ...overlays.map((overlay) => overlay.curves)]) {
      for (const roots of set.eigenvalues) {
        columns.push(roots.map((root) => root.re));
        columns.push(roots.map((root) => (root.im > 0 ? root.im : null)));
      }
    }
    return [Array.from(curves.speeds), ...columns] as uPlot.AlignedData;
  }

  private options(curves: Curves, overlays: Overlay[]): uPlot.Options {
    const series: uPlot.Series[] = [{ label: "v" }];
    [curves, ...overlays.map((overlay) => overlay.curves)].forEach((set, which) => {
      for (const name of set.names) {
        const [stroke, width] = [colourOf(name), which === 0 ? 2 : 1];
        const dash = which === 0 ? undefined : PINNED_DASHES[(which - 1) % 3];
        series.push({ label: `Re ${name}`, stroke, width, dash, points: { show: false }, pxAlign: 0 });
        series.push({ label: `Im ${name}`, stroke, width, dash: dash ?? [6, 4], points: { show: false }, pxAlign: 0 });
      }
    });
    const axis = { stroke: COLOURS.text, grid: { stroke: COLOURS.grid, width: 1 }, ticks: { stroke: COLOURS.grid } };
    return {
      ...this.size(),
      series,
      legend: { show: false },
      cursor: { show: false },
      scales: { x: { time: false }, y: { range: [-LIMIT, LIMIT] } },
      axes: [
        { ...axis, label: "forward speed v (m/s)", labelSize: 22, size: 34 },
        { ...axis, label: "Re λ solid, Im λ dashed (1/s)", labelSize: 22, size: 44 },
      ],
      padding: [26, 12, 0, 0],
      hooks: { drawClear: [(plot) => this.shade(plot)], draw: [(plot) => this.mark(plot)] },
    };
  }

  /** Names of the modes in a row at the bottom, in their colours. */
  private nameCurves(plot: uPlot): void {
    const { ctx, bbox } = plot;
    ctx.textAlign = "left"; // the axes leave theirs
    ctx.textBaseline = "alphabetic";
    let left = bbox.left + 8 * devicePixelRatio;
    for (const name of new Set((this.curves as Curves).names)) {
      ctx.fillStyle = colourOf(name);
      ctx.fillText(name, left, bbox.top + bbox.height - 5 * devicePixelRatio);
      left += ctx.measureText(name).width + 14 * devicePixelRatio;
    }
  }

  private shade(plot: uPlot): void {
    const { ctx, bbox } = plot;
    ctx.save();
    ctx.fillStyle = COLOURS.stable;
    for (const [low, high] of (this.curves as Curves).critical.stableRanges) {
      const left = Math.max(plot.valToPos(low, "x", true), bbox.left);
      const right = Math.min(high === Infinity ? bbox.left + bbox.width : plot.valToPos(high, "x", true), bbox.left + bbox.width);
      if (right > left) ctx.fillRect(left, bbox.top, right - left, bbox.height);
    }
    ctx.restore();
  }

  /** Critical speeds with their names above the axes, the zero line, and the speed that is shown. */
  private mark(plot: uPlot): void {
    const { ctx, bbox } = plot;
    const ratio = devicePixelRatio;
    const critical = (this.curves as Curves).critical;
    const line = (x: number, colour: string, dash: number[], width = 1) => {
      ctx.strokeStyle = colour;
      ctx.lineWidth = width * ratio;
      ctx.setLineDash(dash.map((d) => d * ratio));
      ctx.beginPath();
      ctx.moveTo(x, bbox.top);
      ctx.lineTo(x, bbox.top + bbox.height);
      ctx.stroke();
    };
    ctx.save();
    ctx.font = `${11 * ratio}px system-ui, sans-serif`;
    ctx.textBaseline = "bottom";
    let right = -Infinity;
    const marks = [
      ...critical.weave.map((v): [number, string] => [v, "weave"]),
      ...critical.capsize.map((v): [number, string] => [v, "capsize"]),
    ].sort(([a], [b]) => a - b);
    for (const [speed, name] of marks) {
      const x = plot.valToPos(speed, "x", true);
      if (x < bbox.left || x > bbox.left + bbox.width) continue;
      line(x, colourOf(name), [2, 3]);
      const text = `${name} ${readable(speed, 3)}`;
      const width = ctx.measureText(text).width;
      const left = Math.min(Math.max(x - width / 2, bbox.left), bbox.left + bbox.width - width);
      // A second row where the words would meet.
      const row = left < right + 4 * ratio ? 12 * ratio : 0;
      ctx.fillStyle = colourOf(name);
      ctx.fillText(text, left, bbox.top - row - 2 * ratio);
      if (row === 0) right = left + width;
    }
    this.nameCurves(plot);
    line(plot.valToPos(this.speed, "x", true), COLOURS.text, [], 1.5);
    ctx.strokeStyle = COLOURS.text;
    ctx.lineWidth = ratio;
    ctx.beginPath();
    const zero = plot.valToPos(0, "y", true);
    ctx.moveTo(bbox.left, zero);
    ctx.lineTo(bbox.left + bbox.width, zero);
    ctx.stroke();
    ctx.restore();
  }
}
