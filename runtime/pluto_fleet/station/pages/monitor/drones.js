// In the making.

/** @import { World } from "../core/world.js" */

/** @param {{ world: World, live?: boolean }} props */
export function DroneList({ world }) {
  void world;
  return null;
}

/** @param {{ world: World, id: string, live?: boolean }} props */
export function DroneCard({ world }) {
  void world;
  return null;
}
