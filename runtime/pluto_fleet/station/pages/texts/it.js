// In the making.

import en from "./en.js";

export default { ...en };
