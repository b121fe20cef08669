// How a value went, as a line of a few pixels; a ring marks the newest.
import { svg } from "./dom.js";

const [WIDTH, HEIGHT, EDGE, POINTS] = [96, 26, 4, 60];

export function sparkline() {
  const line = svg("polyline", { class: "spark-line" });
  const dot = svg("circle", { class: "spark-dot", r: 2.6 });
  const box = { class: "spark", viewBox: `0 0 ${WIDTH} ${HEIGHT}`, width: WIDTH, height: HEIGHT };
  const element = svg("svg", { ...box, "aria-hidden": "true" }, line, dot);
  const show = (values) => {
    const last = values.slice(-POINTS);
    const [low, high] = [Math.min(...last), Math.max(...last)];
    const x = (i) => EDGE + (i * (WIDTH - 2 * EDGE)) / Math.max(1, last.length - 1);
    const share = (value) => (high > low ? (value - low) / (high - low) : 0.5);
    const y = (value) => HEIGHT - EDGE - share(value) * (HEIGHT - 2 * EDGE);
    const points = last.map((value, i) => `${x(i).toFixed(1)},${y(value).toFixed(1)}`);
    line.setAttribute("points", points.join(" "));
    dot.setAttribute("cx", x(last.length - 1));
    dot.setAttribute("cy", y(last.at(-1)));
  };
  return { element, show };
}
