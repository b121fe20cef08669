// The results as files for other programs.

import { h } from "preact";
import { download, StationError } from "../core/api.js";
import { t } from "../core/i18n.js";
import { tell } from "../core/notices.js";
import { Button } from "../ui/button.js";

const KINDS = /** @type {const} */ (["csv", "geojson", "zip", "json"]);

/** Save what the station has at an address, and say so if that fails. @param {string} path @param {string} name */
export async function save(path, name) {
  try {
    await download(path, name);
  } catch (error) {
    if (!(error instanceof StationError)) throw error;
    tell(error.message, { bad: true, isSaid: error.isSaid });
  }
}

/** @param {{ flight: string | null, hasPictures: boolean, disabled?: boolean }} props flight: null is the one as it is now */
export function Exports({ flight, hasPictures, disabled }) {
  const query = flight === null ? "" : `?flight=${encodeURIComponent(flight)}`;
  const stem = flight === null ? "results" : `results-${flight}`;
  return h("div", { class: "exports row", role: "group", "aria-label": t("results.export") },
    h("span", { class: "muted hint" }, t("results.export")),
    KINDS.filter((kind) => kind !== "zip" || hasPictures).map((kind) => h(Button, {
      key: kind, small: true, kind: "quiet", icon: "save", disabled, onClick: () => { save(`/api/results.${kind}${query}`, `${stem}.${kind}`); },
    }, t(`results.export.${kind}`))));
}
