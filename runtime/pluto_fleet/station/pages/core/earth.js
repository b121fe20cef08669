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

/** Where on the map a latitude and a longitude are, in metres. @param {Plane} plane @param {readonly number[]} place in degrees @returns {[number, number]} */
export function onMap({ latitude, longitude, altitude, bearing }, [toLatitude, toLongitude]) {
  const from = centred(latitude * DEGREE, longitude * DEGREE, altitude);
  const to = centred(toLatitude * DEGREE, toLongitude * DEGREE, altitude);
  const [dx, dy, dz] = to.map((one, axis) => one - from[axis]);
  const [lat, lon] = [latitude * DEGREE, longitude * DEGREE];
  const east = dy * cos(lon) - dx * sin(lon);
  const north = dz * cos(lat) - (dx * cos(lon) + dy * sin(lon)) * sin(lat);
  return [east * cos(bearing) - north * sin(bearing), east * sin(bearing) + north * cos(bearing)];
}

/** @param {number} lat @param {number} lon @param {number} height */
function centred(lat, lon, height) {
  const across = EQUATOR / sqrt(1 - ECCENTRICITY * sin(lat) ** 2);
  return [(across + height) * cos(lat) * cos(lon), (across + height) * cos(lat) * sin(lon), (across * (1 - ECCENTRICITY) + height) * sin(lat)];
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
