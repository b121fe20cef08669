// What opens over every page: the preflight of a Start, and the list of what wants attention.

import { h } from "preact";
import { isOpen } from "../attention/button.js";
import { AttentionList } from "../attention/list.js";
import { preflight } from "../start/commands.js";
import { Preflight } from "../start/preflight.js";

export const Over = () => h("div", { class: "over" },
  preflight.value && h(Preflight, preflight.value), isOpen.value && h(AttentionList, null));
