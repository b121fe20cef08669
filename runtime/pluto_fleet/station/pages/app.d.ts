// What the station says of its app and of the plan (station/config.py, station/plan/shape.py).

import type { Layer } from "./wire";

export type Scalar = string | number | boolean;
export type Point = number[];

export interface FieldShape {
  name: string;
  type: string;
  label?: string;
  default?: Scalar | null;
  own?: boolean;
  needed?: boolean;
  units?: string[];
  hint?: string;
}

export interface ActionShape {
  name: string;
  item: boolean;
  parameters: FieldShape[];
}

export interface CategoryShape {
  name: string;
  payload: number;
  speed: number;
  flight_time: number;
  actions: string[] | null;
}

export interface FleetDrone {
  id: string;
  category: string;
  home: Point;
}

export interface MapShape {
  size: [number, number];
  cruise_height: number;
  ceiling: number | null;
  no_fly: Point[][];
  image: string | null;
}

export interface BlockShape {
  name: string;
  kind: string;
  shape: string;
  doc: string;
  x: number;
  y: number;
  w: number;
  h: number;
}

export interface EdgeShape {
  from: string;
  to: string;
  statuses: string[];
  points: Point[];
  label: Point | null;
  fork?: boolean;
  dotted?: boolean;
}

export interface GraphShape {
  width: number;
  height: number;
  blocks: BlockShape[];
  edges: EdgeShape[];
}

export interface AppShape {
  server: string;
  name: string;
  title: string;
  sim: boolean;
  speed: number;
  role?: "watch" | "fly";
  fields: { mission: FieldShape[]; trip: FieldShape[] };
  evaluators: string[];
  layers: Layer[];
  actions: ActionShape[];
  categories: CategoryShape[];
  drones: FleetDrone[];
  map: MapShape;
  retries: boolean;
  rounds: boolean;
  graph: GraphShape | null;
}

export interface PlanTrip {
  key: string;
  name?: string;
  action: string;
  target: Point | null;
  source?: Point;
  parameters: Record<string, Scalar>;
  item: { name?: string; mass?: Scalar } | null;
  [field: string]: unknown;
}

export interface PlanMission {
  key: string;
  name: string;
  launched: boolean;
  ended: string | null;
  opens?: Scalar;
  deadline?: Scalar;
  after?: string[];
  trips: PlanTrip[];
  [field: string]: unknown;
}

export interface PlanProblem {
  mission: string | null;
  trip: string | null;
  field: string | null;
  text: string;
}

export interface PlanShape {
  revision: number;
  missions: PlanMission[];
  problems: PlanProblem[];
  said?: string;
}
