// The pages' names for what the station says of its app and of the plan.

import type * as wire from "./wire";

export type Scalar = string | number | boolean;
export type Point = number[];
export type AppShape = wire.AppData;
export type ActionShape = wire.ActionData;
export type CategoryShape = wire.CategoryData;
export type FleetDrone = wire.FleetDrone;
export type MapShape = wire.MapShape;
export type GraphShape = wire.GraphData;
export type BlockShape = wire.BlockData;
export type EdgeShape = wire.EdgeData;
export type PlanProblem = wire.ProblemData;
/** A field of missions, trips or actions; `hint` and `wrong` are the page's own. */
export type FieldShape = Omit<wire.FieldData, "label" | "default"> & {
  label?: string;
  default?: Scalar | null;
  hint?: string;
};
/** A trip of the plan, with the fields that the app's trips have beside. */
export type PlanTrip = wire.PlanTrip;
/** A mission of the plan, with the fields that the app's missions have beside. */
export type PlanMission = wire.PlanMission & { launched: boolean; ended: string | null };
export type PlanShape = Omit<wire.PlanData, "missions"> & { missions: PlanMission[] };
