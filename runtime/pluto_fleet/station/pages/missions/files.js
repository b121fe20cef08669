// Plans that come from elsewhere: the example, a file; and the plan as a file.

import { download, send, StationError } from "../core/api.js";
import { tellUndoable } from "../core/drawing.js";
import { t } from "../core/i18n.js";
import { tell } from "../core/notices.js";
import { app, plan, undo } from "../core/station.js";
import { markOne } from "./marked.js";

/** @param {unknown} error */
export function tellError(error) {
  if (!(error instanceof StationError)) throw error;
  tell(error.message, { bad: true, isSaid: error.isSaid });
}

/**
 * Let the station put another plan in place of this one.
 * @param {(revision: number) => Promise<{ status: number, data: any }>} ask @param {string} said
 */
export async function take(ask, said) {
  await plan.saved();
  const before = plan.missions.peek();
  try {
    const { status, data } = await ask(plan.revision);
    if (!data.missions) throw new StationError(data.said, status);
    plan.take(data);
    if (status === 409) throw new StationError(t("missions.changed-meanwhile"), status, false);
  } catch (error) {
    tellError(error);
    return;
  }
  undo.record(before, plan.missions.peek());
  markOne(plan.missions.peek().find(({ launched }) => !launched)?.key ?? null);
  tellUndoable(before, said);
}

export const example = () => take(
  (revision) => send("POST", "/api/plan/example", { revision }), t("missions.example-here"));

/** Ask for a file, and read it into the plan. */
export function importFile() {
  const input = document.createElement("input");
  Object.assign(input, { type: "file", accept: ".toml" });
  input.addEventListener("change", async () => {
    const file = input.files?.[0];
    if (!file) return;
    take((revision) => send("POST", `/api/plan/import?revision=${revision}&file=${encodeURIComponent(file.name)}`,
      file, { type: "application/toml" }), t("missions.imported", { file: file.name }));
  });
  input.click();
}

export async function exportFile() {
  await plan.saved();
  download("/api/plan.toml", `${app.peek()?.name}-missions.toml`).catch(tellError);
}
