// Where places of the map are on the Earth, where it lies there: the same formulas as those of geodesy.py.

const EQUATOR = 6378137;
const FLATTENING = 1 / 298.257223563;
const POLE = EQUATOR * (1 - FLATTENING);
const ECCENTRICITY = FLATTENING * (2 - FLATTENING); // its square
const DEGREE = Math.PI / 180;
const { sin, cos, sqrt, atan2, hypot } = Math;

/** Latitude and longitude of a place, in degrees. @param {Plane} plane @param {readonly number[]} place @returns {[number, number]} */
export function degrees({ latitude, longitude, altitude, bearing }, [x, y]) {
  const [lat, lon] = [latitude * DEGREE, longitude * DEGREE];
  const east = x * cos(bearing) + y * sin(bearing);
  const north = y * cos(bearing) - x * sin(bearing);
  const across = EQUATOR / sqrt(1 - ECCENTRICITY * sin(lat) ** 2);
  const fromAxis = (across + altitude) * cos(lat);
  const alongAxis = (across * (1 - ECCENTRICITY) + altitude) * sin(lat);
  let up = -(east * east + north * north) / (2 * EQUATOR);
  let found = [lat, lon, altitude];
  for (let turn = 0; turn < 2; turn += 1) { // down to the level of the origin, which sinks below the plane
    const out = fromAxis - north * sin(lat) + up * cos(lat);
    found = geodetic(
      out * cos(lon) - east * sin(lon),
      out * sin(lon) + east * cos(lon),
      alongAxis + north * cos(lat) + up * sin(lat),
    );
    up += altitude - found[2];
  }
  return [found[0] / DEGREE, found[1] / DEGREE];
}

/** Latitude, longitude and height of Earth-centred coordinates, by Bowring's formula. @param {number} x @param {number} y @param {number} z */
function geodetic(x, y, z) {
  const fromAxis = hypot(x, y);
  let reduced = atan2(z * EQUATOR, fromAxis * POLE);
  let latitude = 0;
  for (let turn = 0; turn < 2; turn += 1) {
    latitude = atan2(
      z + (ECCENTRICITY / (1 - ECCENTRICITY)) * POLE * sin(reduced) ** 3,
      fromAxis - ECCENTRICITY * EQUATOR * cos(reduced) ** 3,
    );
    reduced = atan2(POLE * sin(latitude), EQUATOR * cos(latitude));
  }
  const ground = EQUATOR * sqrt(1 - ECCENTRICITY * sin(latitude) ** 2);
  return [latitude, atan2(y, x), fromAxis * cos(latitude) + z * sin(latitude) - ground];
}
