// A download; where it does not work, it says so.
import { download } from "./api.js";

export async function fetched(context, path, name) {
  try {
    await download(path, name);
  } catch (error) {
    context.say(error.message, { bad: true });
  }
}
