// The types that all pages know without importing them: what the station says, and the words of Preact.

import type * as signals from "@preact/signals";
import type * as preact from "preact";
import type { World as TheWorld } from "./core/world.js";
import type { Camera as TheCamera } from "./map/camera.js";
import type { At as AtPlace } from "./map/view.js";
import type { ResultsModel as TheModel } from "./results/model.js";
import type { IconName as Sign } from "./ui/parts.js";
import type * as wire from "./wire";

declare global {
  type Signal<Value> = signals.Signal<Value>;
  type ReadonlySignal<Value> = signals.ReadonlySignal<Value>;
  type ComponentChildren = preact.ComponentChildren;
  type World = TheWorld;
  type At = AtPlace;
  type Camera = TheCamera;
  type ResultsModel = TheModel;
  type IconName = Sign;

  type Alert = wire.Alert;
  type DroneHours = wire.DroneHours;
  type DroneRow = wire.DroneRow;
  type EventRow = wire.EventRow;
  type EventShape = wire.EventData;
  type FlightReport = wire.FlightReport;
  type FlightSummary = wire.FlightSummary;
  type Forecast = wire.Forecast;
  type Frame = wire.Frame;
  type Layer = wire.Layer;
  type LiveMessage = wire.LiveMessage;
  type LiveRequest = wire.LiveRequest;
  type LogLine = wire.LogLine;
  type MapData = wire.MapData;
  type Plane = wire.Plane;
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
  type SweptTrip = wire.SweptTrip;
  type TrackRow = wire.TrackRow;
  type TrackWay = wire.TrackWay;
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
  /** What is done on the way of a trip. */
  type Along = { action: string; every?: string; parameters?: Record<string, Scalar> };
  /** A trip of the plan, with the fields that the app's trips have beside. */
  type PlanTrip = wire.PlanTrip;
  /** A mission of the plan, with the fields that the app's missions have beside. */
  type PlanMission = wire.PlanMission & { launched: boolean; ended: string | null };
  type PlanShape = Omit<wire.PlanData, "missions"> & { missions: PlanMission[] };

  /** A trip as its pin and its card show it. */
  interface About {
    key: string;
    trip: PlanTrip;
    /** from 1 */
    number: number;
    /** where it is now, also while it is dragged */
    target: Point | null;
    isHeld: boolean;
    /** so many trips before it are at the same place */
    beside: number;
    /** the name of the place where it is */
    place: string;
    /** it cannot be changed, or not any more */
    isFixed: boolean;
    problems: ShownProblem[];
    /** the number of the trip that picks what this one puts down */
    pickedIn: number | null;
  }

  /** A layer as it is shown. */
  interface ShownLayer {
    id: string;
    kind: Layer["kind"];
    /** as the app calls it */
    title: string | null;
    quantity: string | null;
    unit: string | null;
    /** at the ends of the colours; null: nothing has been measured */
    range: { low: number, high: number } | null;
    /** metres for which a value speaks */
    reach: number;
    /** the oldest first */
    results: Result[];
  }

  /** Things of a kind that were found at a place, on one photo or several. */
  interface Pin {
    key: string;
    tag: string;
    x: number;
    y: number;
    /** on the newest that shows any */
    count: number;
    /** the newest first */
    results: Result[];
  }

  interface Label {
    key: string;
    text: string;
    /** of what it names, in pixels */
    x: number;
    y: number;
    /** the higher, the earlier it gets its place */
    importance: number;
    /** it is shown though it covers others */
    always?: boolean;
    /** pixels between the middle of what it names and the label */
    gap?: number;
    /** a class */
    kind?: string;
  }

  interface Notice {
    text: string;
    bad: boolean;
    /** it is the station's own sentence */
    isSaid: boolean;
    undo: (() => void) | null;
  }

  /** What was typed and cannot be in the plan. */
  interface Draft {
    typed: string;
    why: string;
    /** its value in the plan */
    now: (thing: PlanMission | PlanTrip) => unknown;
  }

  /** What is selected, on all pages: a mission (by the key in the plan and its name in the flight) with one of its trips, or a drone. */
  interface Selected {
    key: string | null;
    mission: string | null;
    trip: string | null;
    drone: string | null;
  }

  interface StartWords {
    /** the button's */
    text: string;
    can: boolean;
    /** beside it: why not, or what will be left out */
    said: string;
    /** if that is what keeps it */
    problem: ShownProblem | null;
  }

  type PlacedDraft = Draft & { mission: string, trip: string | null, field: string };
  /** isOwn: this page says it, in its language. */
  type ShownProblem = PlanProblem & { typed?: string, isOwn?: boolean };
  type Change = (missions: PlanMission[]) => PlanMission[];
  type PhotoOnMap = { result: Result, x: number, y: number, width: number, height: number, sharpness: number, picture: string | null, sees: string[] };
  /** A place with its results, the newest first. */
  type Spot = { x: number, y: number, results: Result[] };
  /** y goes down in pixels, up in metres. */
  type View = { left: number, bottom: number, scale: number };
  /** In pixels. */
  type Box = { width: number, height: number };

  interface FieldProps {
    field: FieldShape;
    /** as the plan has it, or as it was typed in vain */
    value: unknown;
    problem?: string;
    /** the problem is said by this page, and not by the station */
    isOwn?: boolean;
    /** it is marked, though its problem is told elsewhere */
    isWrong?: boolean;
    locked?: boolean;
    /** what is typed counts only when the field is left */
    isLazy?: boolean;
    /** what stands in an empty field */
    hint?: string;
    evaluators?: readonly string[];
    /** why a value cannot be in the plan; empty: it can */
    wrong?: (value: unknown) => string;
    onKeyDown?: (event: KeyboardEvent) => void;
    onChange: Changed;
  }

  interface ButtonProps {
    kind?: "" | "primary" | "danger" | "quiet";
    icon?: IconName;
    small?: boolean;
    title?: string;
    /** its name, where that is longer than what it shows */
    label?: string;
    disabled?: boolean;
    /** why it cannot be pressed: it can be reached, and says so */
    why?: string | null;
    onClick?: (event: MouseEvent) => void;
    type?: "button" | "submit";
    class?: string;
    pressed?: boolean;
    expanded?: boolean;
    children?: ComponentChildren;
  }

  interface Ears {
    /** another server answers */
    restarted: () => void;
    /** the station wants its token */
    denied: () => void;
    /** who looks */
    me: () => Me;
  }

  /** Of a field: no value, it is empty; typing, more of the same is likely to come at once; wrong, what was typed cannot be in the plan. */
  type Changed = (value: Scalar | Along | undefined, typing: boolean, wrong: { typed: string; why: string } | null) => void;
}
