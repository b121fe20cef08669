// The picture of the floor plan. Where the station has a token, the picture needs it, too, so it is
// fetched once and kept; all who show it get the same address.
//
//   mapPicture(app.map).then((address) => …)      null: there is none

import { token } from "./api.js";

let fetched = null;

export function mapPicture({ image }) {
  if (!image) return Promise.resolve(null);
  fetched ??= token() ? fetch(image, { headers: { Authorization: `Bearer ${token()}` } })
    .then((answer) => (answer.ok ? answer.blob() : null))
    .then((blob) => blob && URL.createObjectURL(blob))
    .catch(() => null) : Promise.resolve(image);
  return fetched;
}
