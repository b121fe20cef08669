// How missions, trips and drones stand, in words for people. The signs beside them: signs.js.

const MISSION = {
  UNEXECUTED: "Not started",
  RUNNING: "Flying",
  STANDBY: "Waiting",
  COMPLETED: "Completed",
  FAILED: "Failed",
  PAUSED: "Paused",
  CANCELLED: "Cancelled",
  UNCERTAIN: "Needs you",
  HELD: "Needs you",
};
const TRIP = {
  WAITING: "To do",
  EXECUTING: "Flying",
  COMPLETED: "Done",
  FAILED: "Failed",
  SKIPPED: "Skipped",
};
const DRONE = {
  FREE: "Ready",
  BUSY: "Flying",
  RETURNING: "Coming home",
  CHARGING: "Charging",
  RECOVERING: "Recovering",
  LOST: "Lost",
  OFFLINE: "Off line",
};

export const missionWord = (status) => MISSION[status] ?? status;
export const tripWord = (status) => TRIP[status] ?? status;
export const droneWord = (row) => (row.retired ? "Retired" : DRONE[row.status] ?? row.status);

const ENDED = new Set(["COMPLETED", "FAILED", "CANCELLED"]);
const FOR_A_PERSON = new Set(["UNCERTAIN", "HELD"]);
export const hasEnded = (row) => ENDED.has(row.status);
export const needsYou = (row) => Boolean(row.question) || FOR_A_PERSON.has(row.status);

export const percent = (share) => `${Math.round(share * 100)} %`;
export const metres = (n) => String(Math.round(n * 100) / 100);

// take_photo -> "Take photo": the name of an action at the start of a phrase.
export function spoken(name) {
  const words = String(name).replaceAll("_", " ");
  return words.charAt(0).toUpperCase() + words.slice(1);
}
