// In the making.

import { h } from "preact";

export default function Page() {
  return h("p", null, "…");
}
