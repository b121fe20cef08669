// Made from pluto_fleet/station/wire.py by `python -m station_interface`: change that.

/** An action that a drone of the fleet can do. */
export interface ActionData {
  name: string;
  /** Whether it takes an item or puts one down. */
  item: boolean;
  parameters: ParameterData[];
}

/** Something that a person must know of, until it is over. */
export interface Alert {
  id: string;
  kind: "battery" | "crashed" | "drained" | "failed" | "finding" | "late" | "lost" | "uncertain" | "waiting";
  urgent: boolean;
  mission: string | null;
  drone: string | null;
  x: number | null;
  y: number | null;
  since_at: number;
  said: Words;
  over: boolean;
  /** Who has acknowledged it: a name, or an empty text if none was said; null: it was not. */
  by: string | null;
  by_at: number | null;
}

/** The app and its fleet, which stay the same while the station runs. */
export interface AppData {
  name: string;
  /** What the station is called: as its app, if `--title` says no other. */
  title: string;
  /** The address of the picture that `--logo` names. */
  logo: string | null;
  /** Another after each start of the station. */
  server: string;
  /** What who asks this may do: `watch` reads, `fly` commands, too. */
  role: "fly" | "watch";
  sim: boolean;
  speed: number;
  fields: FieldsData;
  evaluators: string[];
  actions: ActionData[];
  categories: CategoryData[];
  drones: FleetDrone[];
  /** Those that it declares, which can be raised. */
  events: EventData[];
  /** How results are shown on the map. */
  layers: Layer[];
  map: MapShape;
  /** Whether the graph flies a failed trip again. */
  retries: boolean;
  /** Whether missions may be flown in rounds. */
  rounds: boolean;
  graph: GraphData | null;
}

/** A block of the app's graph, or its start or end, by its upper left corner. */
export interface BlockData {
  name: string;
  /** Start and end have none. */
  kind?: string;
  gate?: boolean;
  x: number;
  y: number;
}

/** A category of drones. */
export interface CategoryData {
  name: string;
  /** Kilograms. */
  payload: number;
  /** Metres per second. */
  speed: number;
  /** Seconds with a full battery. */
  flight_time: number;
  /** The actions that it can do; null: all. */
  actions: string[] | null;
}

/** What a drone has flown, over all flights kept here. */
export interface DroneHours {
  id: string;
  flights: number;
  trips: number;
  hours: number;
  /** Full charges, by what its battery gave. */
  cycles: number;
  lost: number;
  /** Flights, among those, of which its hours and cycles are not known. */
  unmeasured: number;
}

/** A drone, as it was heard of last. */
export interface DroneRow {
  id: string;
  status: string;
  x: number | null;
  y: number | null;
  z: number | null;
  /** When it was heard of; None: just now, or never where x is None. */
  seen_at: number | null;
  battery: number | null;
  mission: string | null;
  trips: number;
  retired: boolean;
  why: string;
  /** Seconds until its battery is high enough to fly, while it charges. */
  ready_in?: number | null;
}

/** An edge of the app's graph, with the statuses that pass. */
export interface EdgeData {
  source: string;
  target: string;
  statuses: string[];
  /** Whether it is a branch of a fork. */
  fork?: boolean;
  /** Whether the app has no such edge: missions end there all the same. */
  implicit?: boolean;
}

/** An event that the app declares. */
export interface EventData {
  name: string;
  fields: ParameterData[];
  /** Whether a creator is asked to make a mission of it. */
  creates: boolean;
}

/** Something that has happened, and what has come of it. */
export interface EventRow {
  id: string;
  name: string;
  time: number;
  at: number[] | null;
  track: string | null;
  /** That whose hook or drone has raised it. */
  mission: string | null;
  trip: string | null;
  drone: string | null;
  /** Those that the app declares. */
  fields: Record<string, string | number | number | boolean | null>;
  /** The missions that were made of it. */
  made: string[];
  /** The missions whose flights it has broken off. */
  broke_off: string[];
  /** Why no mission was made of it; empty: one was, no creator was asked, or none has answered yet. */
  why: string;
  /** When that was decided, in seconds of the flight. */
  over: number | null;
}

/** A field of missions or of trips that the user of an app fills in. */
export interface FieldData {
  name: string;
  /** `time`, `int`, `rounds`, `time of day`, `evaluator`, `along`, or a type of the language. */
  type: string;
  label: string;
  default: string | number | number | boolean | null;
  /** Whether the app itself has declared it. */
  own?: boolean;
  /** Whether it must be filled in. */
  needed?: boolean;
  units?: string[];
  /** Of `along`: what can be done on the way. */
  actions?: string[];
  /** Those of them that are done again and again, `every` so far or so long. */
  spaced?: string[];
}

/** The fields that this app has. */
export interface FieldsData {
  mission: FieldData[];
  trip: FieldData[];
}

/** A drone of the fleet file. */
export interface FleetDrone {
  id: string;
  category: string;
  home: number[];
}

/** What is to be said of a flight on paper. */
export interface FlightReport {
  flight: FlightSummary;
  missions: ReportMission[];
  results: ReportResults[];
  drones: ReportDrone[];
  incidents: Incident[];
  commands: ReportCommand[];
}

/** A flight of the past, by its journal. */
export interface FlightSummary {
  id: string;
  /** None: its journal cannot be read. */
  begun_at: number | null;
  ended_at: number | null;
  seconds: number;
  /** Who started it, if that is known. */
  by: string | null;
  simulated: boolean | null;
  end: "flying" | "interrupted" | "over" | "stopped" | "unknown";
  missions: number;
  completed: number;
  failed: number;
  cancelled: number;
  trips: number;
  results: number;
  drones: string[];
  lost: string[];
  /** What is wrong with its journal; empty: nothing. */
  said: string;
}

/** What is expected of a Start, by many runs in virtual time. */
export interface Forecast {
  revision: number;
  runs: number;
  /** Whether drones were kept apart in them, or each had the air to itself. */
  world: "alone" | "traffic";
  median: number | null;
  /** 95 % of runs end before. */
  high: number | null;
  missions: MissionForecast[];
  drones: Readiness[];
  lowest_battery: number | null;
  bottlenecks: Words[];
  /** What is supposed of the whole. */
  assumed: Words[];
  /** Why a Start would be refused, and which promises cannot be kept. */
  problems: Words[];
  /** The id under which the median run can be replayed. */
  rehearsal: string | null;
}

/** What changed on the pages at an instant of a flight; a keyframe has every row. */
export interface Frame {
  t: number;
  state: State;
  missions: MissionRow[];
  drones: DroneRow[];
  alerts: Alert[];
}

/** The app's graph as plutoc has laid it out: the package's `graph.json`, as it is. */
export interface GraphData {
  /** What blocks of each kind do. */
  kinds: Record<string, string>;
  blocks: BlockData[];
  edges: EdgeData[];
}

/** Something that did not go as planned, or that was found. */
export interface Incident {
  time: number;
  kind: "drained" | "failed" | "finding" | "held" | "late" | "lost" | "stopped" | "uncertain";
  mission: string | null;
  drone: string | null;
  text: string;
}

/** What a drone carries. */
export interface ItemData {
  name?: string;
  /** With its unit, as in `4 g`. */
  mass?: string | number | number | boolean;
}

/** Where the floor plan is to lie. */
export interface Laid {
  x: number;
  y: number;
  width: number;
  height: number;
  turn?: number;
}

/** A layer of the map: what of the results it shows, and how. The id of a layer of `measure` without a quantity stands for a layer for each quantity that is measured and has none of its own. */
export interface Layer {
  id: string;
  action: string;
  kind: "findings" | "heat" | "photos" | "values";
  /** As the app calls it; None: a page calls it by its kind, or by its quantity. */
  title: string | null;
  quantity: string | null;
  unit: string | null;
  /** The values at the ends of the colours; None: the lowest, or the highest, that was measured. */
  low: number | null;
  high: number | null;
  /** Of a heat map: how many metres around its place a value speaks for. */
  reach: number | null;
}

/** What has changed since a page looked; the rows are whole. */
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
  /** Results of before of which more is known now. */
  amended: Result[];
  alerts: Alert[];
  /** Of those that were raised, or of which something has come; of many the newest. */
  events: EventRow[];
  /** All that is tracked, if that has changed. */
  tracks?: TrackRow[];
  /** All others, if that has changed. */
  people?: Person[];
}

/** What a page has seen, and what it tells of itself. */
export interface LiveRequest {
  token?: string;
  flight: string;
  seen: number;
  log: number;
  results: number;
  me?: Me;
}

/** A line of the console. */
export interface LogLine {
  number: number;
  time: number;
  mission: string | null;
  text: string;
  kind: "bad" | "good" | "hook" | "info";
}

/** What can be drawn on the map by pages, and is kept in the fleet file. */
export interface MapData {
  revision: number;
  places: Place[];
  zones: Zone[];
  /** Degrees by which north is turned from up, clockwise. */
  north: number;
  /** Where the map lies; null: it is not said. */
  plane: Plane | null;
  image: Picture | null;
  writable: boolean;
  /** Why nothing that is drawn can be kept, or else what the last drawing of another program has brought. */
  said: string;
}

/** What of the map does not change while the station runs. */
export interface MapShape {
  size: number[];
  cruise_height: number;
  ceiling: number;
  no_fly: number[][][];
  /** The address of the floor plan. */
  image: string | null;
}

/** Who looks, for the others. */
export interface Me {
  id: string;
  name: string;
  page: string;
  touches: string;
}

/** What is expected of a mission. */
export interface MissionForecast {
  key: string;
  name: string;
  trips: number;
  median: number | null;
  high: number | null;
  /** The share of runs in which it is late. */
  late: number;
  fails: number;
}

/** A mission of the flight. */
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
  /** The blocks of the graph at which it is. */
  at: string[];
  /** Why it waits; None: it does not. */
  wait: Words | null;
  until: number | null;
  attempt: number;
  attempts: number;
  round: number;
  question: Question | null;
  due: number | null;
  late: boolean;
  fields: Record<string, string | number | number | boolean>;
}

/** A parameter of an action. */
export interface ParameterData {
  name: string;
  type: string;
  units: string[];
  default: string | number | number | boolean | null;
}

/** Another browser that looks at the station. */
export interface Person {
  id: string;
  name: string;
  role: "fly" | "watch";
  page: string;
  /** The key of the mission or trip that it has selected; empty: none. */
  touches: string;
}

/** A photo: what it covers and shows, and where its picture is, if the camera took one. */
export interface PhotoValue {
  position: number[];
  width: number;
  height: number;
  sees: string[];
  sharpness: number;
  /** The address of the picture; `&size=thumb` of a small one. */
  picture: string | null;
}

/** The floor plan, and where it lies: its lower left corner, its size, and its turn in degrees. */
export interface Picture {
  address: string;
  x: number;
  y: number;
  width: number;
  height: number;
  turn: number;
}

/** A named place of the map. */
export interface Place {
  name: string;
  x: number;
  y: number;
  z?: number;
}

/** The plan that users draw. */
export interface PlanData {
  revision: number;
  missions: PlanMission[];
  problems: PlanProblemData[];
  /** Why it could not be stored; empty: it was. */
  said: string;
}

/** A mission of the plan, with the fields that the app's missions have beside these. */
export interface PlanMission {
  key: string;
  name: string;
  /** Whether it flies, and may not be changed; what a page says of that is ignored. */
  launched?: boolean;
  /** How its last flight ended, if it has not been changed since. */
  ended?: string | null;
  opens?: string | number | number | boolean;
  deadline?: string | number | number | boolean;
  after?: string[];
  trips: PlanTrip[];
  [field: string]: unknown;
}

/** What keeps the plan from being flown. */
export interface PlanProblemData {
  /** The key of the mission. */
  mission: string | null;
  trip: string | null;
  field: string | null;
  text: string;
}

/** A trip of the plan, with the fields that the app's trips have beside these. */
export interface PlanTrip {
  key: string;
  name?: string;
  action: string;
  target: number[] | null;
  source?: number[];
  parameters: Record<string, string | number | number | boolean>;
  item: ItemData | null;
  [field: string]: unknown;
}

/** Where the map lies on the Earth. */
export interface Plane {
  /** Of the map's corner (0, 0), in degrees of WGS 84. */
  latitude: number;
  longitude: number;
  /** Of the map's z = 0, in metres above sea level. */
  altitude: number;
  /** The compass direction of the map's y, in radians, clockwise. */
  bearing: number;
}

/** A number with what it is and its unit. */
export interface Quantity {
  quantity: string;
  value: number;
  unit: string | null;
}

/** What only a person can know. */
export interface Question {
  said: Words;
  answers: string[];
}

/** A drone before a Start. */
export interface Readiness {
  id: string;
  battery: number | null;
  ready: boolean;
  why: Words | null;
  /** Seconds until its battery is high enough for one of the missions; None: it never is there. */
  ready_in: number | null;
  /** What is supposed of it, as it is not known. */
  assumed: Words | null;
}

/** A part of a replay, from a keyframe on. */
export interface Replay {
  flight: string;
  begun_at: number | null;
  /** What is missing, or not known; empty: nothing. */
  said: string;
  /** The length of the whole replay. */
  seconds: number;
  frames: Frame[];
  /** Where the next part begins. */
  next: number | null;
  /** All lines of the flight; only with the first part. */
  log: LogLine[];
  results: Result[];
  alerts: Alert[];
  /** What has happened, as it is at the end; only with the first part, like the next. */
  events: EventRow[];
  tracks: TrackWay[];
  /** Of each drone pairs of time and level; only with the first part. */
  batteries: Record<string, number[][]>;
}

/** What somebody commanded. */
export interface ReportCommand {
  /** In the flight; None: only the station's log has it. */
  time: number | null;
  at: number | null;
  command: string;
  given: Record<string, string | number | number | boolean | null>;
  by: string | null;
  /** The address from which it came. */
  client: string | null;
  said: string;
}

/** What a drone did in a flight; None: that was not measured. */
export interface ReportDrone {
  id: string;
  trips: number;
  launched: number;
  hours: number | null;
  first_battery: number | null;
  lowest_battery: number | null;
  last_battery: number | null;
  lost: number;
}

/** A mission in a report. */
export interface ReportMission {
  name: string;
  status: string;
  why: string;
  /** When its first trip was launched. */
  began: number | null;
  ended: number | null;
  due: number | null;
  late: boolean;
  rounds: number;
  trips: ReportTrip[];
}

/** All results of one kind; the three numbers are there where each value is one. */
export interface ReportResults {
  action: string | null;
  kind: string;
  quantity: string | null;
  unit: string | null;
  count: number;
  lowest: number | null;
  mean: number | null;
  highest: number | null;
}

/** A trip in a report, as it was flown last. */
export interface ReportTrip {
  name: string;
  action: string;
  status: string;
  drone: string | null;
  attempts: number;
  began: number | null;
  ended: number | null;
  why: string;
}

/** One value that a flight brought, with what it is, where and when. `values` are its numbers as quantities, `tags` its findings: what a layer of the map shows. */
export interface Result {
  number: number;
  time: number;
  mission: string;
  trip: string | null;
  round: number | null;
  attempt: number | null;
  drone: string | null;
  kind: "handling" | "measurement" | "photo" | "result" | "verdict";
  action: string | null;
  parameters: Record<string, string | number | number | boolean>;
  target: number[] | null;
  /** Where it was really done; None: at the target. */
  at: number[] | null;
  /** The named place or zone that it belongs to. */
  place: string | null;
  value: string | number | number | boolean | PhotoValue | null;
  values: Quantity[];
  tags: string[];
  /** The ids of the layers that show it. */
  layers: string[];
  /** The level with which its drone came home after this trip, if that was less than its reserve. */
  drained: number | null;
}

/** What was done, or why it was not: a sentence for people. */
export interface Said {
  said: string;
}

/** A plan, or a template, that is kept under a name. */
export interface SavedPlan {
  name: string;
  saved_at: number;
  by: string;
  /** How many it has; None: it cannot be read. */
  missions: number | null;
  template: boolean;
  /** What is wrong with it, or still to be done before it can fly; empty: nothing. */
  said: string;
}

/** All plans that are kept under names, and what was deleted of them. */
export interface SavedPlans {
  plans: SavedPlan[];
  trash: TrashedPlan[];
}

/** How the station stands. */
export interface State {
  phase: "flying" | "idle" | "interrupted" | "over" | "stopped" | "stopping";
  time: number;
  /** The revision of the plan. */
  plan: number;
  /** The revision of the map's places, zones and picture. */
  map: number;
  /** How many drones there are; once it grows, `/api/app` describes the new one. */
  fleet: number;
  /** What is wrong; empty: nothing. */
  said: string;
  /** How the drones come down. */
  how: "land" | "rtl" | null;
  /** What all missions wait for: drones to be found, or asked where they are. */
  busy: "" | "asking" | "connecting";
}

/** How an area is flown over. */
export interface Swept {
  /** In their order. */
  trips: SweptTrip[];
  /** At which the action is done. */
  places: number;
  /** The way from the first place to the last. */
  metres: number;
  /** Of that, what is not over the area. */
  outside: number;
  /** How long one drone takes for that, with what it does there; null: none can do the action. */
  seconds: number | null;
  /** The share of the area that may not be flown over. */
  forbidden: number;
}

/** A trip of those that fly over an area. */
export interface SweptTrip {
  target: number[];
  /** Where its line begins; null: it is no line, but one place. */
  source: number[] | null;
  /** After how many metres of a line the action is done, each time. */
  every: number | null;
}

/** Something that moves, and is tracked. */
export interface TrackRow {
  id: string;
  kind: string;
  x: number;
  y: number;
  z: number;
  /** When it was reported last, in seconds of the flight; where it is since then is not known. */
  seen: number;
  /** Where it was in the minute before that, the oldest first. */
  trail: number[][];
}

/** Where something was that was tracked. */
export interface TrackWay {
  id: string;
  kind: string;
  /** Of each report the second of the flight, x, y and z. */
  way: number[][];
}

/** A plan that was deleted, and can be restored. */
export interface TrashedPlan {
  id: string;
  name: string;
  deleted_at: number;
}

/** A trip as the Monitor shows it. Where it follows what moves, its place is where its drone will meet that. */
export interface TripRow {
  name: string;
  status: string;
  x: number;
  y: number;
  priority: number | number | null;
  action: string;
  /** The id of the track that it follows. */
  track?: string;
}

/** The way of each pair of places, both ends included; None: there is none. */
export interface Ways {
  ways: (number[][] | null)[];
}

/** A sentence that each page says in its own language: a key of its catalogue, and its facts. `text` is the sentence in English, for whatever does not know the key. */
export interface Words {
  key: "alert.battery" | "alert.battery-stays" | "alert.crashed" | "alert.drained" | "alert.failed" | "alert.finding" | "alert.late" | "alert.lost" | "alert.uncertain" | "alert.uncertain-action" | "alert.waiting" | "preflight.beside" | "preflight.brought-back" | "preflight.busy" | "preflight.cannot" | "preflight.charges" | "preflight.charging" | "preflight.endless" | "preflight.few" | "preflight.few-lift" | "preflight.flies" | "preflight.given-up" | "preflight.heard-before" | "preflight.in-the-air" | "preflight.lost" | "preflight.low" | "preflight.low-away" | "preflight.never-heard" | "preflight.no-rehearsal" | "preflight.not-apart" | "preflight.not-ready" | "preflight.promise" | "preflight.refused" | "preflight.retired" | "preflight.room" | "preflight.too-far" | "preflight.uncharged" | "question.action" | "question.other" | "wait.after" | "wait.drone" | "wait.drone-full" | "wait.paused" | "wait.time" | "wait.verdict" | "wait.you";
  facts: Record<string, string | number | number | boolean | string[]>;
  text: string;
}

/** A named area of the map. */
export interface Zone {
  name: string;
  corners: number[][];
}
