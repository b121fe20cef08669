// What one sees without the station's token, or with a wrong one: where to find it, and a place
// to put it.

import { h } from "./dom.js";
import { icon } from "./icons.js";
import { keepToken, token } from "./token.js";

// The token out of what was pasted: the whole address, or the token alone.
const tokenIn = (text) => text.trim().replace(/^.*#token=/, "");

export function gate() {
  const wrong = token() && h("p", { class: "problem", role: "alert" }, icon("warning"),
    "The station knows no such token: it makes a new one each time it is started.");
  const input = h("input", {
    id: "token", type: "password", autocomplete: "off", spellcheck: "false", required: true,
  });
  const form = h("form", {
    class: "stack",
    onsubmit: (event) => {
      event.preventDefault();
      keepToken(tokenIn(input.value));
      location.reload();
    },
  },
  h("div", { class: "field" }, h("label", { for: "token" }, "Address or token"), input),
  wrong,
  h("div", {}, h("button", { class: "button primary" }, "Open the station")));
  return h("main", { class: "gate" }, h("div", { class: "card stack" },
    h("h1", {}, "This station asks for its token"),
    h("p", {}, "It was printed where the station was started, in the line that begins with ",
      h("code", {}, "station:"), ". Open the whole address from there, or paste it here."),
    form));
}
