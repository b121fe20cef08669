// The rulers at the left and lower edge of a floor plan, which stay there however it is moved,
// and the bar that says how long some metres are.

import { svg } from "./dom.js";
import { step } from "./floor_view.js";

export function rulers(size) {
  const element = svg("g", { class: "rulers", "aria-hidden": "true" });
  return {
    element,
    redraw(view, box) {
      element.replaceChildren(...across(view, box, size[0]), ...upwards(view, box, size[1]));
    },
  };
}

function across(view, box, width) {
  const y = Math.min(Math.max(view.bottom, 20), box.height - 20);
  const [from, to] = [24 - view.left, box.width - 8 - view.left];
  return ticks(view.scale, 56, from, Math.min(to, width * view.scale)).map(([along, text]) => {
    const x = view.left + along;
    return tick(x, y, { x, y: y + 17 }, text, "M0 0v5");
  });
}

function upwards(view, box, height) {
  const [from, to] = [view.bottom - box.height + 24, view.bottom - 12];
  const found = ticks(view.scale, 44, from, Math.min(to, height * view.scale));
  const wide = 7.5 * Math.max(0, ...found.map(([, text]) => text.length)) + 12;
  const x = Math.min(Math.max(view.left, wide), box.width - 4);
  return found.map(([along, text]) => {
    const y = view.bottom - along;
    return tick(x, y, { x: x - 8, y: y + 4, class: "left" }, text, "M0 0h-5");
  });
}

/** What is seen of the ticks: how far along each is, in pixels, and what it says. */
function ticks(scale, apart, from, to) {
  const every = step(scale, apart);
  const found = [];
  const first = Math.max(0, Math.ceil(from / scale / every));
  for (let count = first; count * every * scale <= to + 0.5; count += 1) {
    found.push([count * every * scale, String(Number((count * every).toFixed(3)))]);
  }
  return found;
}

const tick = (x, y, place, text, d) => svg("g", {},
  svg("path", { d, transform: `translate(${x} ${y})` }), svg("text", place, text));

export function scaleBar() {
  const line = svg("path", { d: "" });
  const text = svg("text", { y: 9 });
  const element = svg("svg", { class: "scale-bar", height: 20, role: "img" }, line, text);
  return {
    element,
    redraw(view) {
      const metres = step(view.scale, 56);
      const length = metres * view.scale;
      line.setAttribute("d", `M1 12v5h${length.toFixed(1)}v-5`);
      text.setAttribute("x", 1 + length / 2);
      text.textContent = `${metres} m`;
      element.setAttribute("width", Math.ceil(length) + 4);
      element.setAttribute("aria-label", `Scale: the bar is ${metres} metres long`);
    },
  };
}
