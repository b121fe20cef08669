// What only a person can know, above the map: it stands out until it is answered.

import { h } from "preact";
import { t, tOr } from "../core/i18n.js";
import { mayFly, perform, selectMission } from "../core/station.js";
import { Button } from "../ui/button.js";
import { Icon } from "../ui/icon.js";
import { SaidWords } from "../ui/parts.js";
import { SureButton } from "../ui/sure.js";

/** @param {{ world: World }} props */
export function Questions({ world }) {
  const rows = world.missions.all().filter(({ question }) => question !== null);
  return h("section", { class: "questions", role: "alert", hidden: !rows.length },
    rows.length > 0 && h("h2", null, h(Icon, { name: "warning" }), t("monitor.wait-for-you", { n: rows.length })),
    rows.map((row) => h(Asked, { key: row.name, row, question: /** @type {Question} */ (row.question) })));
}

/** @param {{ row: MissionRow, question: Question }} props */
function Asked({ row: { name }, question: { said, answers } }) {
  const decide = (/** @type {string} */ answer) => { perform("decide", { mission: name, answer }); };
  return h("div", { class: "question" },
    h("p", null, h("button", { type: "button", class: "link", onClick: () => selectMission(name) }, name), ": ", h(SaidWords, { words: said })),
    mayFly.value && h("div", { class: "row" }, answers.map((answer) => (answer === "cancel"
      ? h(SureButton, { key: answer, label: t("monitor.cancel"), sure: t("monitor.cancel-sure"), onSure: () => decide(answer) })
      : h(Button, { key: answer, onClick: () => decide(answer) }, tOr(`answer.${answer}`, answer))))));
}
