// What opens over every page: the preflight of a Start, the list of what wants attention, the tour.

import { h } from "preact";
import { isOpen } from "../attention/button.js";
import { AttentionList } from "../attention/list.js";
import { preflight } from "../start/commands.js";
import { Tour, touring } from "../help/tour.js";
import { Preflight } from "../start/preflight.js";

export const Over = () => h("div", { class: "over" },
  preflight.value && h(Preflight, preflight.value), isOpen.value && h(AttentionList, null),
  touring.value !== null && h(Tour, null));
