// Where the floor plan is on the screen: `{left, bottom, scale}`, that is, at how many pixels from
// the box's left and top edge the map's corner (0, 0) is, and how many pixels a metre takes.
// Nothing here knows of the page.

const CLOSEST = 800; // pixels a metre: one centimetre is easy to hit
const ROOM = { left: 34, right: 16, top: 16, bottom: 28 }; // around the whole map, for its rulers

export const round = (value, step = 0.1) => Number((Math.round(value / step) * step).toFixed(3));

/** The view in which the whole map fills the box. */
export function whole(size, box) {
  const across = Math.max(40, box.width - ROOM.left - ROOM.right);
  const down = Math.max(40, box.height - ROOM.top - ROOM.bottom);
  const scale = Math.min(across / size[0], down / size[1]);
  return {
    left: ROOM.left + (across - size[0] * scale) / 2,
    bottom: ROOM.top + (down + size[1] * scale) / 2,
    scale,
  };
}

/** The view after zooming by `factor`, with the pixel `at` staying where it is. */
export function zoomed(view, factor, at, size, box) {
  const least = whole(size, box).scale * 0.7;
  const scale = Math.min(Math.max(view.scale * factor, least), Math.max(CLOSEST, least));
  const by = scale / view.scale;
  return held({
    left: at.x - (at.x - view.left) * by,
    bottom: at.y - (at.y - view.bottom) * by,
    scale,
  }, size, box);
}

export function moved(view, dx, dy, size, box) {
  return held({ ...view, left: view.left + dx, bottom: view.bottom + dy }, size, box);
}

/** The nearest view in which the map cannot get lost: the box's middle is always on it. */
function held(view, size, box) {
  const between = (value, low, high) => Math.min(Math.max(value, low), high);
  const x = box.width / 2;
  const y = box.height / 2;
  return {
    left: between(view.left, x - size[0] * view.scale, x),
    bottom: between(view.bottom, y, y + size[1] * view.scale),
    scale: view.scale,
  };
}

export const toMetres = (view, pixel) => ({
  x: (pixel.x - view.left) / view.scale,
  y: (view.bottom - pixel.y) / view.scale,
});

export const toPixels = (view, place) => ({
  x: view.left + place.x * view.scale,
  y: view.bottom - place.y * view.scale,
});

/** The least of 1, 2, 5, 10, 20, … (and 0.5, 0.2, …) metres that takes so many pixels. */
export function step(scale, pixels) {
  const wanted = pixels / scale;
  const power = 10 ** Math.floor(Math.log10(wanted));
  const factor = [1, 2, 5, 10].find((one) => one * power >= wanted - 1e-9);
  return Number((factor * power).toPrecision(3));
}
