// The missions of the plan: a list, and beside it the one that is selected; and what an empty plan says.

import { h } from "preact";
import { useEffect, useRef } from "preact/hooks";
import { t } from "../core/i18n.js";
import { wantedField } from "../core/route.js";
import { mayFly, plan } from "../core/station.js";
import { Steps } from "../help/tour.js";
import { Button } from "../ui/parts.js";
import { Others } from "../ui/people.js";
import { UndoButtons } from "../ui/undo.js";
import { add, example, exportFile, importFile, isMarking } from "./commands.js";
import { Library, LibraryButton } from "./library.js";
import { MissionList } from "./list.js";
import { Panel } from "./panel.js";

export default function Page() {
  const page = useRef(/** @type {HTMLDivElement | null} */ (null));
  const wanted = wantedField.value;
  const find = (/** @type {string} */ what) => /** @type {HTMLInputElement | null | undefined} */ (page.current?.querySelector(`.mission-panel ${what}`));
  async function rename() {
    await null; // drawn by then, and before the next key: what is typed at once is in the field
    const name = find('[data-field="name"] input');
    name?.focus();
    name?.select();
  }
  useEffect(() => {
    if (!wanted) return;
    requestAnimationFrame(() => { // the panel may only now be opened
      (find(`[data-field="${wanted.field}"] :is(input, select)`) ?? find(".set-trips"))?.focus();
      wantedField.value = null;
    });
  }, [wanted]);
  const onAdd = () => {
    add();
    rename();
  };
  if (!plan.isLoaded.value) return null;
  const isEmpty = !plan.missions.value.length;
  return h("div", { ref: page, class: "missions" },
    isEmpty ? h(Welcome, { onAdd }, h(LibraryButton, { small: false }), h(UndoButtons, null)) : h("div", { class: "missions-split" },
      h("section", { class: "card mission-side stack", "aria-label": t("missions.all") },
        h("div", { class: "row" }, h("h2", null, t("page.missions")), h(Others, null),
          h("span", { class: "spread row" }, mayFly.value && h(UndoButtons, null),
            mayFly.value && h(Button, { kind: "primary", icon: "plus", onClick: onAdd }, t("missions.add")))),
        h(MissionList, { onRename: rename }),
        h("p", { class: "hint" }, t("missions.how-to-move")),
        h("div", { class: "row" },
          h(Button, { small: true, pressed: isMarking.value, onClick: () => { isMarking.value = !isMarking.peek(); } }, t("missions.select-several")),
          mayFly.value && h(Button, { small: true, onClick: importFile }, t("missions.import")),
          h(Button, { small: true, onClick: () => { exportFile(); } }, t("missions.export")),
          h(LibraryButton, null))),
      h("div", null, h(Panel, { wanted: wanted?.field ?? null }))),
    h(Library, null));
}

/** @param {{ onAdd: () => void, children?: ComponentChildren }} props */
export const Welcome = ({ onAdd, children }) => h("section", { class: "card welcome stack" },
  h("h2", null, t("missions.nothing")), h("p", { class: "muted" }, t("missions.what-is-one")),
  h(Steps, { class: "welcome-steps" }),
  mayFly.value && h("div", { class: "row" },
    h(Button, { kind: "primary", icon: "plus", onClick: onAdd }, t("missions.add-first")),
    h(Button, { onClick: () => { example(); } }, t("missions.example")),
    h(Button, { onClick: importFile }, t("missions.import")), children),
  h("p", { class: "hint" }, h("a", { href: "#help" }, t("missions.more-help"))));
