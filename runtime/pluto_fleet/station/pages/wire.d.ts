// Made from station/wire.py: do not edit.

export interface Words {
  key: string;
  facts: Record<string, string | number | boolean | string[]>;
  text: string;
}

export interface State {
  phase: "idle" | "flying" | "stopping" | "stopped" | "interrupted" | "over";
  time: number;
  plan: number;
  map: number;
  said: string;
  how: "rtl" | "land" | null;
  busy: "" | "connecting" | "asking";
}

export interface TripRow {
  name: string;
  status: string;
  x: number;
  y: number;
  priority: number | null;
  action: string;
}

export interface Question {
  text: string;
  answers: string[];
}

export interface MissionRow {
  name: string;
  index: number;
  status: string;
  reason: string;
  trips: TripRow[];
  current: number | null;
  done: number;
  total: number;
  drone: string | null;
  at: string[];
  wait: string;
  until: number | null;
  attempt: number;
  attempts: number;
  round: number;
  question: Question | null;
  due: number | null;
  late: boolean;
  fields: Record<string, string | number | boolean>;
}

export interface DroneRow {
  id: string;
  status: string;
  x: number | null;
  y: number | null;
  z: number | null;
  seen_at: number | null;
  battery: number | null;
  mission: string | null;
  trips: number;
  retired: boolean;
  why: string;
  ready_in?: number | null;
}

export interface LogLine {
  number: number;
  time: number;
  mission: string | null;
  text: string;
  kind: "good" | "bad" | "info" | "hook";
}

export interface PhotoValue {
  position: number[];
  width: number;
  height: number;
  sees: string[];
  sharpness: number;
  picture: string | null;
}

export interface Result {
  number: number;
  time: number;
  mission: string;
  trip: string | null;
  round: number | null;
  attempt: number | null;
  drone: string | null;
  kind: "measurement" | "photo" | "result" | "verdict" | "handling";
  action: string | null;
  parameters: Record<string, string | number | boolean>;
  target: number[] | null;
  at: number[] | null;
  place: string | null;
  value: string | number | boolean | PhotoValue | null;
  values: Quantity[];
  tags: string[];
}

export interface Quantity {
  quantity: string;
  value: number;
  unit: string | null;
}

export interface Alert {
  id: string;
  kind: "lost" | "crashed" | "battery" | "uncertain" | "finding" | "late" | "waiting" | "failed";
  urgent: boolean;
  mission: string | null;
  drone: string | null;
  x: number | null;
  y: number | null;
  since_at: number;
  said: Words;
  over: boolean;
  by: string | null;
  by_at: number | null;
}

export interface Person {
  id: string;
  name: string;
  role: "watch" | "fly";
  page: string;
  touches: string;
}

export interface LiveMessage {
  server: string;
  flight: string;
  version: number;
  made_at: number;
  state: State;
  missions: MissionRow[];
  drones: DroneRow[];
  log: LogLine[];
  results: Result[];
  alerts: Alert[];
  people?: Person[];
}

export interface LiveRequest {
  token?: string;
  flight: string;
  seen: number;
  log: number;
  results: number;
  me?: Me;
}

export interface Me {
  id: string;
  name: string;
  page: string;
  touches: string;
}

export interface FlightSummary {
  id: string;
  begun_at: number;
  ended_at: number | null;
  seconds: number;
  by: string | null;
  simulated: boolean;
  end: "idle" | "flying" | "stopping" | "stopped" | "interrupted" | "over";
  missions: number;
  completed: number;
  failed: number;
  cancelled: number;
  trips: number;
  results: number;
  drones: string[];
  lost: string[];
  recorded: boolean;
}

export interface Frame {
  t: number;
  state: State;
  missions: MissionRow[];
  drones: DroneRow[];
}

export interface Replay {
  flight: string;
  begun_at: number;
  seconds: number;
  frames: Frame[];
  next: number | null;
  log: LogLine[];
  results: Result[];
  alerts: Alert[];
  batteries: Record<string, number[][]>;
}

export interface DroneHours {
  id: string;
  flights: number;
  trips: number;
  hours: number;
  cycles: number;
  lost: number;
}

export interface Readiness {
  id: string;
  battery: number | null;
  ready: boolean;
  why: Words | null;
  ready_in: number | null;
  assumed: Words | null;
}

export interface MissionForecast {
  key: string;
  name: string;
  trips: number;
  median: number | null;
  high: number | null;
  late: number;
  fails: number;
}

export interface ForecastRequest {
  revision: number;
  missions: string[] | null;
  only_failed?: boolean;
  runs?: number | null;
}

export interface Forecast {
  revision: number;
  runs: number;
  world: "traffic" | "alone";
  median: number | null;
  high: number | null;
  missions: MissionForecast[];
  drones: Readiness[];
  lowest_battery: number | null;
  bottlenecks: Words[];
  assumed: Words[];
  problems: Words[];
  rehearsal: string | null;
}

export interface Place {
  name: string;
  x: number;
  y: number;
  z?: number;
}

export interface Zone {
  name: string;
  corners: number[][];
}

export interface MapData {
  revision: number;
  places: Place[];
  zones: Zone[];
  north: number;
  image: Picture | null;
  writable: boolean;
}

export interface Picture {
  address: string;
  x: number;
  y: number;
  width: number;
  height: number;
  turn: number;
}
