// The photos of a flight, small, to be leafed through; and one of them as it was taken.

import { h } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";
import { clock, t } from "../core/i18n.js";
import { pictureAt } from "../map/ground.js";
import { Button, Dialog, Empty, Icon, IconButton } from "../ui/parts.js";
import { Facts } from "./card.js";
import { placeWords, sharpnessWords, tagWords } from "./words.js";

const AT_ONCE = 48;

const photoOf = (/** @type {Result} */ result) => /** @type {PhotoValue} */ (result.value);

/** @param {{ model: ResultsModel }} props */
export function PhotosTab({ model }) {
  const [count, setCount] = useState(AT_ONCE);
  const photos = model.album.value.toReversed();
  if (!photos.length) return h(Empty, null, t("layer.empty.photos"));
  return h("div", { class: "stack" },
    h("ul", { class: "photo-grid" }, photos.slice(0, count).map((result) =>
      h("li", { key: result.number }, h(Thumb, { result, model })))),
    photos.length > count && h("div", null, h(Button, { onClick: () => setCount(count + AT_ONCE) },
      t("results.more-photos", { n: photos.length - count }))));
}

/** @param {{ result: Result, model: ResultsModel }} props */
function Thumb({ result, model }) {
  const { picture, sees } = photoOf(result);
  const address = picture === null ? null : pictureAt(`${picture}&size=thumb`);
  const where = placeWords(result);
  return h("button", {
    type: "button", class: "thumb-button", onClick: () => {
      model.chosen.value = result.number;
      model.opened.value = result.number;
    },
  }, address ? h("img", { src: address, alt: "", loading: "lazy" })
    : h("span", { class: "no-picture" }, h(Icon, { name: "photo", size: 28 })),
  h("span", { class: "thumb-words" }, h("span", { class: "num" }, clock(result.time)), h("span", null, where)),
  h("span", { class: "hint" }, tagWords(sees).join(", ")));
}

/** A photo as it was taken; the arrow keys lead to the others. @param {{ model: ResultsModel }} props */
export function Viewer({ model }) {
  const album = model.album.value;
  const at = album.findIndex(({ number }) => number === model.opened.value);
  const stage = useRef(/** @type {HTMLDivElement | null} */ (null));
  const isOpen = at >= 0;
  useEffect(() => { if (isOpen) stage.current?.focus(); }, [isOpen]);
  if (!isOpen) return null;
  const result = album[at];
  const { picture, sharpness } = photoOf(result);
  const close = () => { model.opened.value = null; };
  /** @param {number} to */
  const open = (to) => {
    const { number } = album[Math.min(Math.max(to, 0), album.length - 1)];
    model.opened.value = number;
    model.chosen.value = number;
  };
  /** @param {KeyboardEvent} event */
  function onKeyDown(event) {
    const to = { ArrowLeft: at - 1, ArrowRight: at + 1, Home: 0, End: album.length - 1 }[event.key];
    if (to === undefined) return;
    event.preventDefault();
    open(to);
  }
  const address = picture === null ? null : pictureAt(picture);
  const where = placeWords(result);
  return h(Dialog, { title: t("results.photo-of", { n: at + 1, all: album.length, place: where }), class: "viewer", onClose: close },
    h("div", { class: "viewer-body", ref: stage, tabIndex: -1, onKeyDown },
      h("div", { class: "viewer-stage" },
        picture === null ? h("p", { class: "no-picture muted" }, h(Icon, { name: "photo", size: 40 }), t("results.no-picture"))
          : address ? h("img", { src: address, alt: t("results.photo-alt", { place: where }) }) : h("p", { class: "muted" }, t("loading")),
        h(IconButton, { icon: "back", class: "before", label: t("results.photo-before"), onClick: () => open(at - 1) }),
        h(IconButton, { icon: "fold", class: "after", label: t("results.photo-after"), onClick: () => open(at + 1) })),
      h("p", { class: "muted" }, sharpnessWords(sharpness)),
      h(Facts, { result }),
      address && h("p", null, h("a", { href: address, target: "_blank", rel: "noopener" }, t("results.full-size")))));
}
