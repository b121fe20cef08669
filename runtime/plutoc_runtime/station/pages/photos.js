// Photos: the piece of the floor plan that the camera saw, and what can be made out on it.
import { h, svg } from "./dom.js";
import { metres, spoken } from "./standing.js";
import { clock } from "./dom.js";

const SHOWN = 60;

// The ground under the camera, y upwards as on the map.
function ground(map, photo) {
  const { position, width, height } = photo;
  const [left, bottom] = [position[0] - width / 2, position[1] - height / 2];
  const [across, up] = map.size;
  const box = `${left} ${up - bottom - height} ${width} ${height}`;
  const picture = svg("svg", { class: "seen", viewBox: box, "aria-hidden": "true" });
  picture.append(svg("rect", { class: "seen-ground", width: across, height: up }));
  if (map.image) {
    const place = { href: map.image, width: across, height: up, preserveAspectRatio: "none" };
    picture.append(svg("image", place));
  }
  for (let x = Math.ceil(left); x < left + width; x += 1) {
    const line = { x1: x, x2: x, y1: 0, y2: up, class: "seen-grid" };
    picture.append(svg("line", line));
  }
  for (let y = Math.ceil(bottom); y < bottom + height; y += 1) {
    const line = { x1: 0, x2: across, y1: up - y, y2: up - y, class: "seen-grid" };
    picture.append(svg("line", line));
  }
  return picture;
}

const sharpness = (share) =>
  share >= 0.7 ? "sharp" : share >= 0.4 ? "a little blurred" : "blurred";

export function photos(map, floor, chosen) {
  const list = h("ul", { class: "photos" });
  const empty = h("p", { class: "empty" }, "No photo has been taken yet.");
  const element = h("div", {}, empty, list);
  const layer = floor.layer("photo");
  const [across, up] = map.size;

  const frame = (photo) => {
    if (!photo) {
      layer.replaceChildren();
      return;
    }
    const [x, y] = [photo.position[0] - photo.width / 2, photo.position[1] - photo.height / 2];
    const { width, height } = photo;
    layer.replaceChildren(svg("rect", { class: "photo-frame", x, y, width, height }));
  };
  const card = ([, time, mission, trip, , , , , photo]) => {
    const seen = photo.sees.map(spoken);
    const sees = seen.length ? seen.join(", ") : "Nothing special";
    const place = `${metres(photo.position[0])}, ${metres(photo.position[1])}`;
    const button = h(
      "button",
      { type: "button", class: "m-photo" },
      ground(map, photo),
      h("strong", {}, sees),
      h("span", {}, `${mission}, ${trip}`),
      h("small", {}, `${clock(time)} at ${place}, ${sharpness(photo.sharpness)}`),
    );
    if (photo.sharpness < 0.4) button.classList.add("blurred");
    if (seen.length) button.classList.add("found");
    for (const kind of ["pointerenter", "focus"]) {
      button.addEventListener(kind, () => frame(photo));
    }
    for (const kind of ["pointerleave", "blur"]) button.addEventListener(kind, () => frame(null));
    button.addEventListener("click", () => {
      chosen.set(mission);
      floor.reveal(Math.min(across, photo.position[0]), Math.min(up, photo.position[1]));
    });
    return h("li", {}, button);
  };
  const update = (entries) => {
    list.prepend(...entries.slice(-SHOWN).map(card).reverse());
    while (list.childElementCount > SHOWN) list.lastElementChild.remove();
    empty.hidden = true;
  };
  const clear = () => {
    frame(null);
    list.replaceChildren();
    empty.hidden = false;
  };
  return { element, update, clear };
}
