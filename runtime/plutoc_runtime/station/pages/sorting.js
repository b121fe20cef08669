// In which orders the table can stand. Those that need a person come first when sorted by state.
import { needsYou } from "./standing.js";

const URGENCY = ["FAILED", "PAUSED", "RUNNING", "STANDBY", "UNEXECUTED", "COMPLETED", "CANCELLED"];

const urgency = (row) => (needsYou(row) ? -1 : URGENCY.indexOf(row.status));
const share = (row) => (row.total ? row.done / row.total : 0);

export const ORDERS = {
  index: { title: "Sort as on the Missions page", by: (row) => row.index },
  status: { title: "Sort by state: those that need you first", by: urgency },
  progress: { title: "Sort by how much is done", by: share },
  drone: { title: "Sort by drone", by: (row) => row.drone ?? "\uffff" },
  attempt: { title: "Sort by attempts", by: (row) => row.attempt },
  round: { title: "Sort by rounds", by: (row) => row.round },
};

export function ordered(rows, { key, down }) {
  const { by } = ORDERS[key];
  const compare = (a, b) => (a < b ? -1 : a > b ? 1 : 0);
  const sign = down ? -1 : 1;
  return rows.sort(
    (a, b) => sign * compare(by(a.data), by(b.data)) || a.data.index - b.data.index,
  );
}
