// In the making.

/** @import { World } from "../core/world.js" */

/** @param {{ world: World, live?: boolean, chosen?: string | null }} props */
export function Targets({ world }) {
  void world;
  return null;
}
