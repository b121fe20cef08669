// All that can be filled in for a trip: what an open card shows. Made anew for another action.
//
//   const body = tripBody(app, action, { set(name, value, typing), …, copy(), remove() });
//   body.element   body.update({ trip, place, problems, pickedIn, locked, first, last })

import { called } from "./action_signs.js";
import { coordinates } from "./coordinates.js";
import { fill, h, put, set, shown, unique } from "./dom.js";
import { fieldFor } from "./fields.js";
import { icon } from "./dom.js";
import { number } from "./numbers.js";
import { problemLine, textOf } from "./problems.js";
import { RELEASE } from "./trip_edits.js";

const MASS = { name: "mass", label: "Mass", type: "mass", units: ["g", "mg", "kg"] };

export function tripBody(app, action, act) {
  const where = coordinates(app.map, (target, typing) => act.set("target", target, typing));
  const name = fieldFor({ name: "name", type: "text", label: "Name" },
    { change: (value, typing) => act.set("name", value, typing) });
  const what = kinds(app, action, act);
  const releases = action.name === RELEASE;
  const carried = h("p", { class: "carried" });
  const item = action.item && !releases ? itemFields(act) : [];
  const parameters = action.parameters.map((parameter) => ({
    about: `parameters.${parameter.name}`,
    value: (trip) => trip.parameters?.[parameter.name],
    field: fieldFor(parameter, {
      change: (value, typing) => act.parameter(parameter.name, value, typing),
    }),
  }));
  const own = app.fields.trip.map((field) => ({
    about: field.name,
    value: (trip) => trip[field.name],
    field: fieldFor(field, {
      evaluators: app.evaluators, change: (value, typing) => act.set(field.name, value, typing),
    }),
  }));
  const fields = [...item, ...parameters, ...own];
  const known = new Set(["name", "action", "target", ...fields.map(({ about }) => about)]);
  const general = h("div", { class: "trip-troubles" });
  const from = h("p", { class: "hint" });
  const source = h("div", { class: "row" }, from, h("button", {
    type: "button", class: "button small", onclick: () => act.set("source", undefined),
  }, "Begin where the drone is"));
  const more = h("details", { class: "more" }, h("summary", {}, "More"), where.height, source);
  const button = (sign, text, onclick) =>
    h("button", { type: "button", class: "button small", onclick }, icon(sign), text);
  const arrow = (sign, text, by) => h("button", {
    type: "button", class: "button icon", "aria-label": text, title: text, onclick: () => act.move(by),
  }, icon(sign));
  const [up, down] = [arrow("up", "Fly it earlier", -1), arrow("down", "Fly it later", 1)];
  const rest = [button("copy", "Copy", act.copy), button("bin", "Delete", act.remove)];
  const foot = h("div", { class: "row trip-foot" }, up, down, h("span", { class: "spread row" }, rest));
  const element = h("div", { class: "trip-body" }, general,
    h("div", { class: "trip-fields" }, what.element, name.element, where.element,
      releases && carried, fields.map(({ field }) => field.element)),
    more, foot);
  let told = "";

  return {
    element,
    update({ trip, number: turn, place, problems, pickedIn, locked, first, last }) {
      name.input.placeholder = String(turn);
      name.update(trip.name, { problem: textOf(problems, "name"), locked });
      what.update(textOf(problems, "action"), locked);
      where.update(trip.target, place, locked);
      for (const { about, value, field } of fields) {
        field.update(value(trip), { problem: textOf(problems, about), locked });
      }
      if (releases) put(carried, released(trip, pickedIn));
      shown(source, trip.source);
      source.lastChild.disabled = locked;
      put(from, trip.source ? `The flight begins at ${trip.source.map(number).join(", ")} m.` : "");
      if (trip.target?.length === 3 || trip.source) more.open = true;
      const others = problems.filter(({ field }) => !known.has(field)).map(({ text }) => text);
      if (told !== others.join("\n")) fill(general, others.map(problemLine));
      told = others.join("\n");
      shown(foot, !locked);
      up.disabled = first;
      down.disabled = last;
    },
  };
}

function itemFields(act) {
  const one = (spec, key) => ({
    about: `item.${key}`,
    value: (trip) => trip.item?.[key],
    field: fieldFor(spec, { change: (value, typing) => act.item(key, value, typing) }),
  });
  return [one({ name: "item", label: "Item", type: "text" }, "name"), one(MASS, "mass")];
}

function released(trip, pickedIn) {
  if (!pickedIn) return "Put a trip with “Pick item” before this one: then this one knows its item.";
  const mass = trip.item?.mass ? ` (${trip.item.mass})` : "";
  return `Puts down “${trip.item?.name ?? ""}”${mass}, which trip ${pickedIn} picks.`;
}

function kinds(app, action, act) {
  const id = unique("action");
  const input = h("select", { id, onchange: () => act.action(input.value) },
    app.actions.map(({ name }) => h("option", { value: name }, called(name))));
  if (!app.actions.includes(action)) input.append(h("option", { value: action.name }, action.name));
  input.value = action.name;
  const problem = h("p", { class: "problem", hidden: true });
  return {
    element: h("div", { class: "field", "data-field": "action" },
      h("label", { for: id }, "Action"), input, problem),
    update(text, locked) {
      input.disabled = locked;
      set(input, "aria-invalid", text ? "true" : null);
      put(problem, text);
      shown(problem, text);
    },
  };
}
