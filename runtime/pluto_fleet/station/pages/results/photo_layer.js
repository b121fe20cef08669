// Photos where they were taken: the ground that each covers, and its picture once it is large enough
// to be seen, the sharpest on top.

import { h } from "preact";
import { prefs } from "../core/prefs.js";
import { useCamera } from "../map/camera.js";
import { pictureAt } from "../map/ground.js";
import { useCalm } from "../ui/calm.js";

/** @import { Box, View } from "../map/view.js" */
/** @import { PhotoOnMap } from "./layers.js" */
/** @import { ResultsModel } from "./model.js" */

const LEAST = 40; // pixels across, from which on the picture is drawn
const MOST_PICTURES = 300;

/** @param {PhotoOnMap} photo @param {View} view @param {Box} box */
function isInView({ x, y, width, height }, { left, bottom, scale }, box) {
  const [middle, line] = [left + x * scale, bottom - y * scale];
  const [half, high] = [(width * scale) / 2, (height * scale) / 2];
  return middle + half > 0 && middle - half < box.width && line + high > 0 && line - high < box.height;
}

/** @param {{ model: ResultsModel }} props */
export function PhotoLayer({ model }) {
  const camera = useCamera();
  const view = useCalm(camera.view, 200).value;
  const photos = model.photos.value;
  const seen = photos.filter((photo) => photo.picture !== null && photo.width * view.scale > LEAST
    && isInView(photo, view, camera.box.peek())).slice(-MOST_PICTURES);
  const drawn = new Set(seen.map(({ result }) => result.number));
  const layer = model.shown.value.find(({ kind }) => kind === "photos");
  const chosen = photos.find(({ result }) => result.number === model.chosen.value);
  return h("g", { class: "layer photos", "aria-hidden": true, opacity: layer ? prefs.opacity.value[layer.id] ?? 1 : 1 },
    photos.map((photo) => h(Photo, {
      key: photo.result.number, photo, isDrawn: drawn.has(photo.result.number),
    })),
    chosen && h(Outline, { photo: chosen }));
}

/** @param {{ photo: PhotoOnMap, isDrawn: boolean }} props */
function Photo({ photo: { x, y, width, height, picture, result, sharpness }, isDrawn }) {
  const address = isDrawn && picture !== null ? pictureAt(`${picture}&size=thumb`) : null;
  const [left, low] = [x - width / 2, y - height / 2];
  if (!address) {
    return h("rect", { class: "footprint", x: left, y: low, width, height, "data-result": result.number, "data-sharp": sharpness >= 0.7 });
  }
  return h("image", {
    class: "thumb", "data-result": result.number, href: address, width, height, preserveAspectRatio: "none",
    transform: `translate(${left} ${low + height}) scale(1 -1)`,
  });
}

/** @param {{ photo: PhotoOnMap }} props */
const Outline = ({ photo: { x, y, width, height } }) =>
  h("rect", { class: "footprint chosen", x: x - width / 2, y: y - height / 2, width, height });
