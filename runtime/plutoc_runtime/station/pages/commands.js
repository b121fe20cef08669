// Commands with what the station says to them.
//
//   await tell("pause", { mission: "Mission 1" })   // → true if it was done; says why not
//   await stop("rtl") · await stop("land")          // tried for a minute, whatever happens

import { command } from "./api.js";
import { say, unsay } from "./say.js";

export async function tell(name, given = {}, patience = undefined) {
  try {
    const said = await command(name, given, patience);
    if (said) say(said);
    return true;
  } catch (error) {
    say(error.message, { bad: true });
    return false;
  }
}

const TRYING = "Stop has not reached the station yet: trying again. "
  + "If it is urgent, use the drones' own switches.";
const FAILED = "Stop did not reach the station. Use the drones' own switches.";

export async function stop(how) {
  const alarm = setTimeout(say, 1500, TRYING, { bad: true });
  say("Stop: telling the station…");
  try {
    const said = await command("stop", { how }, 60000);
    unsay();
    say(said);
  } catch (error) {
    say(error.status ? error.message : FAILED, { bad: true });
  } finally {
    clearTimeout(alarm);
  }
}
