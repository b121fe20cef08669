// The map of a report: what was measured, photographed and found, still, as paper is.

import { h } from "preact";
import { useEffect, useMemo, useRef } from "preact/hooks";
import { Camera, Seen } from "../map/camera.js";
import { Ground, Rulers } from "../map/ground.js";
import { fitting } from "../map/view.js";
import { HeatLayers } from "../results/heat_layer.js";
import { Legend } from "../results/legend.js";
import { PhotoLayer } from "../results/photo_layer.js";
import { PinLayer } from "../results/pin_layer.js";

/** @import { ResultsModel } from "../results/model.js" */

const WIDTH = 640; // pixels
const HIGHEST = 560;

/** @param {{ shape: AppShape, model: ResultsModel }} props */
export function ReportMap({ shape, model }) {
  const world = useRef(/** @type {SVGGElement | null} */ (null));
  const picture = useRef(/** @type {SVGSVGElement | null} */ (null));
  const { size } = shape.map;
  const height = Math.min(HIGHEST, Math.round((WIDTH - 56) * (size[1] / size[0])) + 62);
  const camera = useMemo(() => {
    const still = new Camera(size);
    still.resize(WIDTH, height);
    return still;
  }, [size, height]);
  useEffect(() => {
    const { left, bottom, scale } = camera.view.peek();
    world.current?.setAttribute("transform", `matrix(${scale} 0 0 ${-scale} ${left} ${bottom})`);
    picture.current?.style.setProperty("--metre", String(1 / fitting({ width: WIDTH, height }, size)));
  }, [camera, height, size]);
  return h(Seen.Provider, { value: camera }, h("figure", { class: "report-map" },
    h("div", { class: "floor" }, h("svg", { ref: picture, class: "floor-picture", viewBox: `0 0 ${WIDTH} ${height}`, "aria-hidden": true },
      h("g", { ref: world }, h(Ground, { map: shape.map }), h(HeatLayers, { model, size }), h(PhotoLayer, { model }), h(PinLayer, { model })),
      h(Rulers, { map: shape.map }))),
    h(Legend, { model })));
}
