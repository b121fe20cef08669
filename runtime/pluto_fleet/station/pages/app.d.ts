// The types that all pages know without importing them: what the station says, and the words of Preact.

import type * as signals from "@preact/signals";
import type * as preact from "preact";
import type { World as TheWorld } from "./core/world.js";
import type { At as AtPlace } from "./map/view.js";
import type * as wire from "./wire";

declare global {
  type Signal<Value> = signals.Signal<Value>;
  type ReadonlySignal<Value> = signals.ReadonlySignal<Value>;
  type ComponentChildren = preact.ComponentChildren;
  type World = TheWorld;
  type At = AtPlace;

  type Alert = wire.Alert;
  type DroneHours = wire.DroneHours;
  type DroneRow = wire.DroneRow;
  type FlightReport = wire.FlightReport;
  type FlightSummary = wire.FlightSummary;
  type Forecast = wire.Forecast;
  type Frame = wire.Frame;
  type Layer = wire.Layer;
  type LiveMessage = wire.LiveMessage;
  type LiveRequest = wire.LiveRequest;
  type LogLine = wire.LogLine;
  type MapData = wire.MapData;
  type Me = wire.Me;
  type MissionForecast = wire.MissionForecast;
  type MissionRow = wire.MissionRow;
  type Person = wire.Person;
  type PhotoValue = wire.PhotoValue;
  type Place = wire.Place;
  type Quantity = wire.Quantity;
  type Question = wire.Question;
  type Readiness = wire.Readiness;
  type Replay = wire.Replay;
  type ReportCommand = wire.ReportCommand;
  type ReportDrone = wire.ReportDrone;
  type ReportMission = wire.ReportMission;
  type ReportResults = wire.ReportResults;
  type Result = wire.Result;
  type SavedPlan = wire.SavedPlan;
  type SavedPlans = wire.SavedPlans;
  type State = wire.State;
  type Swept = wire.Swept;
  type TrashedPlan = wire.TrashedPlan;
  type TripRow = wire.TripRow;
  type Words = wire.Words;

  /** What was asked of the station, and why it cannot be had. */
  type Answer<Data> = { data: Data | null; trouble: string };

  type Scalar = string | number | boolean;
  type Point = number[];
  type AppShape = wire.AppData;
  type ActionShape = wire.ActionData;
  type MapShape = wire.MapShape;
  type GraphShape = wire.GraphData;
  type BlockShape = wire.BlockData;
  type EdgeShape = wire.EdgeData;
  type PlanProblem = wire.PlanProblemData;
  /** A field of missions, trips or actions; `hint` and `wrong` are the page's own. */
  type FieldShape = Omit<wire.FieldData, "label" | "default"> & {
    label?: string;
    default?: Scalar | null;
    hint?: string;
  };
  /** A trip of the plan, with the fields that the app's trips have beside. */
  type PlanTrip = wire.PlanTrip;
  /** A mission of the plan, with the fields that the app's missions have beside. */
  type PlanMission = wire.PlanMission & { launched: boolean; ended: string | null };
  type PlanShape = Omit<wire.PlanData, "missions"> & { missions: PlanMission[] };
}
