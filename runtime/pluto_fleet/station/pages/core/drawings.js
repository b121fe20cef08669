// Files of missions, and drawings of other programs: what they are called, and how they are sent.

/** @type {Record<string, string>} */
const TYPES = {
  ".geojson": "application/geo+json",
  ".json": "application/geo+json",
  ".kml": "application/vnd.google-earth.kml+xml",
  ".plan": "application/json",
  ".waypoints": "text/csv",
  ".csv": "text/csv",
};

/** How the names of drawings end. */
export const DRAWN = Object.keys(TYPES);

/** The type of a file by its name; that of a missions file, if it is no drawing. @param {string} name */
export const typeOf = (name) => TYPES[name.slice(name.lastIndexOf(".")).toLowerCase()] ?? "application/toml";
