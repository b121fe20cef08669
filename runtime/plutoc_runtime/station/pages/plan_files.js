// The plan from elsewhere and for elsewhere: missions files, and the example.
//
//   await importFile(context) · await exportFile(context) · await example(context)

import { download, send } from "./api.js";
import { h } from "./dom.js";
import { many } from "./words.js";

const LARGEST = 1 << 20;
const CHANGED = "Somebody else changed the plan meanwhile: please try again.";

// Takes away what came, and brings back what went; what was done since then stays.
function back(before, after) {
  const keys = (missions) => new Set(missions.map((mission) => mission.key));
  const [was, came] = [keys(before), keys(after)];
  const gone = before.filter((mission) => !came.has(mission.key));
  return (missions) => {
    const now = keys(missions);
    return [
      ...missions.filter((mission) => was.has(mission.key) || !came.has(mission.key)),
      ...gone.filter((mission) => !now.has(mission.key)),
    ];
  };
}

// Asks the station for another plan; where somebody was quicker, on top of theirs.
async function another({ plan, say, selected }, ask, said) {
  await plan.saved();
  const before = plan.missions;
  try {
    let answer = await ask(plan.revision());
    if (answer.status === 409 && answer.data.missions) {
      plan.take(answer.data);
      answer = await ask(plan.revision());
    }
    if (answer.status === 409) throw new Error(answer.data.said ?? CHANGED);
    plan.take(answer.data);
  } catch (error) {
    say(error.message, { bad: true });
    return false;
  }
  selected.set(plan.missions.find((mission) => !mission.launched)?.key ?? null);
  const after = plan.missions;
  say(said(after), { undo: () => plan.edit(back(before, after)) });
  return true;
}

export async function example(context) {
  return another(context,
    (revision) => send("POST", "/api/plan/example", { revision }),
    () => "The example plan is here: look at it, change it, or press Start.");
}

export function importFile(context) {
  const input = h("input", { type: "file", accept: ".toml,text/plain,application/toml" });
  input.addEventListener("change", async () => {
    const file = input.files[0];
    if (!file) return;
    if (file.size > LARGEST) {
      context.say(`${file.name} is too large for a missions file.`, { bad: true });
      return;
    }
    const text = await file.text();
    await another(context,
      (revision) =>
        send("POST", `/api/plan/import?revision=${revision}`, text, "application/toml"),
      (missions) => `${file.name}: ${many(missions.length, "mission")} in the plan now.`);
  });
  input.click();
}

export async function exportFile({ app, plan, say }) {
  await plan.saved();
  try {
    await download("/api/plan.toml", `${app.name}-missions.toml`);
  } catch (error) {
    say(error.message, { bad: true });
  }
}
