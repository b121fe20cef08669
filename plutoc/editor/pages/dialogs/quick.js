// The quick palette: type a part of a kind, press Enter, and the block is there, connected.

import { add, guardTo, origin } from "../operations.js";
import { HEIGHT, WIDTH, app, isSource, snap } from "../state.js";
import { choose } from "./chooser.js";

// at: where on the graph; from, when, statuses: the end of a wire that was let go of in the open.
export async function quickAdd({ at = null, clientX, clientY, from, when = [], statuses = null } = {}) {
  const options = app.palette.filter((one) => !one.broken).map((one) => {
    const takes = isSource(from ?? "") ? one.accepts.length === 0 : one.accepts.some((status) => statuses?.includes(status));
    const byGuard = when.some((status) => one.accepts_by_guard.includes(status));
    return {
      id: one.kind, label: one.kind, detail: one.first,
      why: statuses && !takes && !byGuard && one.accepts.length + (isSource(from ?? "") ? 1 : 0) > 0
        ? `It does not take ${statuses.join(" or ") || "what is left"}.` : null,
    };
  });
  const source = from ?? null;
  const kind = await choose({
    title: source ? `Add a block behind ${source}` : "Add a block", at: clientX === undefined ? null : [clientX, clientY],
    options: ranked(options), placeholder: "Type a part of its name",
  });
  if (!kind) return;
  const place = at && [snap(at[0] - WIDTH / 2), snap(at[1] - (from ? 0 : HEIGHT / 2))];
  const declared = app.palette.find((one) => one.kind === kind);
  await add(kind, {
    at: place, from, when: when.length ? when : from ? guardTo(from, declared.accepts) ?? [] : undefined,
  });
}

// What can be connected from the selected block comes first.
function ranked(options) {
  const fits = ({ id }) => (origin(app.palette.find((one) => one.kind === id).accepts) ? 0 : 1);
  return [...options].sort((a, b) => fits(a) - fits(b));
}
