"""What a simulated vehicle hears from a ground station and tells it: messages, how often, and parameters."""

from __future__ import annotations

import struct
from collections.abc import Callable
from math import degrees, hypot, isfinite, pi
from typing import Any

from pymavlink.dialects.v20 import common as mavlink

from .vehicle import (
    ACCEPTED,
    ALL,
    AUTOPILOT,
    CAMERA,
    COMPANION,
    DENIED,
    IN_PROGRESS,
    READY,
    SATELLITES,
    SENSORS,
    Asked,
    Parameter,
    Vehicle,
)

ARMED = mavlink.MAV_MODE_FLAG_SAFETY_ARMED | mavlink.MAV_MODE_FLAG_CUSTOM_MODE_ENABLED
_WHOLE = mavlink.MAV_PARAM_TYPE_INT32
_REAL = mavlink.MAV_PARAM_TYPE_REAL32
_FENCE = mavlink.MAV_MISSION_TYPE_FENCE
_BYTEWISE = mavlink.MAV_PROTOCOL_CAPABILITY_PARAM_ENCODE_BYTEWISE
_BY_VALUE = mavlink.MAV_PROTOCOL_CAPABILITY_PARAM_ENCODE_C_CAST
_CAN = (
    mavlink.MAV_PROTOCOL_CAPABILITY_MAVLINK2
    | mavlink.MAV_PROTOCOL_CAPABILITY_COMMAND_INT
    | mavlink.MAV_PROTOCOL_CAPABILITY_FLIGHT_TERMINATION
    | mavlink.MAV_PROTOCOL_CAPABILITY_MISSION_FENCE
    | mavlink.MAV_PROTOCOL_CAPABILITY_MISSION_INT
)
_UNKNOWN = 255
"""Of a command in progress: how far it is."""
_USUAL = {
    mavlink.MAVLINK_MSG_ID_SYS_STATUS: 1.0,
    mavlink.MAVLINK_MSG_ID_BATTERY_STATUS: 2.0,
    mavlink.MAVLINK_MSG_ID_GLOBAL_POSITION_INT: 0.2,
    mavlink.MAVLINK_MSG_ID_EXTENDED_SYS_STATE: 0.2,
    mavlink.MAVLINK_MSG_ID_GPS_RAW_INT: 1.0,
    mavlink.MAVLINK_MSG_ID_HOME_POSITION: 2.0,
}
"""Seconds between two messages of a PX4 that was not asked otherwise; an ArduPilot sends none of them then."""
_SENSES = 0.5
"""Seconds between two values of a sensor."""
FOCAL = 3.875
SENSOR = (6.2, 4.65)
PIXELS = (4000, 3000)
"""Millimetres of its camera, which sees as much as those of other simulations, and the size of its pictures."""


class StationLink:
    """One vehicle's part of the protocol."""

    def __init__(self, vehicle: Vehicle, send: Callable[[bytes], object]) -> None:
        self.vehicle = vehicle
        self._send = send
        self._begin()
        self._coming: list[tuple[float, float] | None] = []
        """The corners of a fence that is being sent."""
        self._captured = 0.0
        """The number of the last capture that was asked for."""
        self._asked_by: dict[int, tuple[int, int]] = {}
        """Who has asked for what is in progress: the system and the component, by the command."""
        self._make: dict[int, Callable[[], Any]] = {
            mavlink.MAVLINK_MSG_ID_SYS_STATUS: self._status,
            mavlink.MAVLINK_MSG_ID_BATTERY_STATUS: self._battery,
            mavlink.MAVLINK_MSG_ID_GLOBAL_POSITION_INT: self._position,
            mavlink.MAVLINK_MSG_ID_EXTENDED_SYS_STATE: self._landed,
            mavlink.MAVLINK_MSG_ID_GPS_RAW_INT: self._satellites,
            mavlink.MAVLINK_MSG_ID_HOME_POSITION: self._home,
            mavlink.MAVLINK_MSG_ID_AUTOPILOT_VERSION: self._version,
        }

    def _begin(self) -> None:
        """Tell as one does that was just switched on: what it was asked for is forgotten."""
        px4 = self.vehicle.MAKE == mavlink.MAV_AUTOPILOT_PX4
        self._every: dict[int, float] = dict(_USUAL) if px4 else {}
        """Seconds between two messages, by their number."""
        self._due = dict.fromkeys(self._every, 0.0)
        self._beat = self._spoke = self._sensed = 0.0
        self._system = system = self.vehicle.build.system
        self._writers = {
            component: mavlink.MAVLink(None, srcSystem=system, srcComponent=component)
            for component in (AUTOPILOT, CAMERA, COMPANION)
        }

    # Telling

    def speak(self) -> None:
        """Send what is due."""
        vehicle = self.vehicle
        now = vehicle.now
        if now < self._spoke or self._system != vehicle.build.system:
            self._begin()
        self._spoke = now
        if now >= self._beat:
            self._beat = now + 1.0
            self._heartbeats()
        for number, every in self._every.items():
            if now >= self._due[number]:
                self._due[number] = now + every
                self._tell(number)
        if now >= self._sensed:
            self._sensed = now + _SENSES
            self._values()
        for command, result in vehicle.done:
            self._put(self._answer(command, result, self._asked_by.get(command, (0, 0))))
        vehicle.done.clear()
        for severity, text in vehicle.said:
            self._put(self._of().statustext_encode(severity, text.encode()[:50]))
        vehicle.said.clear()

    def _of(self, component: int = AUTOPILOT) -> Any:
        return self._writers[component]

    def _tell(self, number: int) -> None:
        """Send a message of this number, if there is one to send."""
        message = self._make[number]()
        if message is not None:
            self._put(message)

    def _put(self, message: Any, component: int = AUTOPILOT) -> None:
        self._send(message.pack(self._writers[component]))

    def _heartbeats(self) -> None:
        vehicle = self.vehicle
        custom = mavlink.MAV_MODE_FLAG_CUSTOM_MODE_ENABLED
        self._put(
            self._of().heartbeat_encode(
                mavlink.MAV_TYPE_QUADROTOR,
                vehicle.MAKE,
                ARMED if vehicle.armed else custom,
                vehicle.mode_number,
                mavlink.MAV_STATE_ACTIVE if vehicle.armed else mavlink.MAV_STATE_STANDBY,
            )
        )
        if vehicle.faults.eyeless:
            return
        invalid = mavlink.MAV_AUTOPILOT_INVALID
        beat = self._of(CAMERA).heartbeat_encode(mavlink.MAV_TYPE_CAMERA, invalid, 0, 0, 0)
        self._put(beat, CAMERA)
        if vehicle.build.senses:
            kind = mavlink.MAV_TYPE_ONBOARD_CONTROLLER
            beat = self._of(COMPANION).heartbeat_encode(kind, invalid, 0, 0, 0)
            self._put(beat, COMPANION)

    def _values(self) -> None:
        """Tell what the sensors read."""
        vehicle = self.vehicle
        if vehicle.around is None or vehicle.faults.numb:
            return
        place = vehicle.place
        for name, quantity in vehicle.build.senses.items():
            value = vehicle.around.measure(quantity, place, vehicle.now)
            told = self._of(COMPANION).named_value_float_encode(self._boot, name.encode(), value)
            self._put(told, COMPANION)

    @property
    def _boot(self) -> int:
        return int((self.vehicle.now + self.vehicle.faults.ahead) * 1000)

    def _status(self) -> Any:
        vehicle = self.vehicle
        well = SENSORS | (0 if vehicle.faults.blind else SATELLITES)
        well |= 0 if vehicle.problem else READY
        volts = round(vehicle.volts * 1000)
        left = vehicle.gauge
        return self._of().sys_status_encode(ALL, ALL, well, 0, volts, -1, left, 0, 0, 0, 0, 0, 0)

    def _battery(self) -> Any:
        vehicle = self.vehicle
        cells = [round(vehicle.volts * 1000), *[65535] * 9]
        left = vehicle.gauge
        none = mavlink.INT16_MAX if hasattr(mavlink, "INT16_MAX") else 32767
        return self._of().battery_status_encode(0, 0, 0, none, cells, -1, -1, -1, left)

    def _position(self) -> Any:
        vehicle = self.vehicle
        latitude, longitude, altitude = vehicle.place
        east, north, up = vehicle.velocity
        return self._of().global_position_int_encode(
            self._boot,
            round(latitude * 1e7),
            round(longitude * 1e7),
            round(altitude * 1000),
            round((vehicle.body.at[2] - vehicle.faults.raised) * 1000),
            round(north * 100),
            round(east * 100),
            round(-up * 100),
            round(degrees(vehicle.body.heading % (2 * pi)) * 100) % 36000,
        )

    def _landed(self) -> Any:
        state = self.vehicle.landed_state
        return self._of().extended_sys_state_encode(mavlink.MAV_VTOL_STATE_UNDEFINED, state)

    def _satellites(self) -> Any:
        vehicle = self.vehicle
        blind = vehicle.faults.blind
        latitude, longitude, altitude = vehicle.place
        return self._of().gps_raw_int_encode(
            int(vehicle.now * 1e6),
            mavlink.GPS_FIX_TYPE_NO_FIX if blind else mavlink.GPS_FIX_TYPE_3D_FIX,
            round(latitude * 1e7),
            round(longitude * 1e7),
            round(altitude * 1000),
            70,
            100,
            round(hypot(*vehicle.velocity) * 100),
            65535,
            0 if blind else 14,
        )

    def _home(self) -> Any:
        faults = self.vehicle.faults
        if faults.homeless:
            return None
        latitude, longitude, altitude = self.vehicle.build.home
        return self._of().home_position_encode(
            round(latitude * 1e7),
            round(longitude * 1e7),
            round((altitude + faults.raised) * 1000),
            *(0.0, 0.0, 0.0),
            (1.0, 0.0, 0.0, 0.0),
            *(0.0, 0.0, 0.0),
        )

    def _version(self) -> Any:
        px4 = self.vehicle.MAKE == mavlink.MAV_AUTOPILOT_PX4
        can = _CAN | (_BYTEWISE if px4 else _BY_VALUE)
        version = (1 << 24 | 16 << 16 if px4 else 4 << 24 | 6 << 16) | 255  # a release
        nothing = [0] * 8
        uid = self.vehicle.build.system
        return self._of().autopilot_version_encode(
            can, version, 0, 0, 0, nothing, nothing, nothing, 0, 0, uid
        )

    # Hearing

    def hear(self, message: Any) -> None:
        """Take a message that is for this vehicle, or for all."""
        match message.get_type():
            case "HEARTBEAT" if message.type == mavlink.MAV_TYPE_GCS:
                self._station(message)
            case "COMMAND_LONG" | "COMMAND_INT":
                self._command(message)
            case "PARAM_REQUEST_READ":
                self._read(message)
            case "PARAM_REQUEST_LIST":
                for name in self.vehicle.parameters:
                    self._parameter(name)
            case "PARAM_SET":
                self._set(message)
            case "MISSION_COUNT" if message.mission_type == _FENCE:
                self._fence_comes(message)
            case "MISSION_ITEM_INT" if message.mission_type == _FENCE:
                if message.seq < len(self._coming):
                    self._coming[message.seq] = (message.x / 1e7, message.y / 1e7)
                self._next_corner(message)

    def _station(self, message: Any) -> None:
        mine = self.vehicle.parameters.get("SYSID_MYGCS", Parameter(message.get_srcSystem()))
        if message.get_srcSystem() == int(mine.value):
            self.vehicle.heard = self.vehicle.now

    def _command(self, message: Any) -> None:
        asked = asked_by(message)
        if message.target_component == CAMERA:
            result: int | None = self._of_camera(asked)
            component = CAMERA
        else:
            result = self._of_autopilot(asked)
            component = AUTOPILOT
        by = message.get_srcSystem(), message.get_srcComponent()
        if result is not None:
            self._put(self._answer(asked.command, result, by, component), component)
        if result == IN_PROGRESS:
            self._asked_by[asked.command] = by
        if asked.command == mavlink.MAV_CMD_IMAGE_START_CAPTURE and result == ACCEPTED:
            number = asked.values[3]  # of the capture: a command that comes again has the same
            if not number or number != self._captured:
                self._put(self._picture(), CAMERA)
            self._captured = number

    def _answer(
        self, command: int, result: int, to: tuple[int, int], component: int = AUTOPILOT
    ) -> Any:
        progress = _UNKNOWN if result == IN_PROGRESS else 0
        return self._of(component).command_ack_encode(command, result, progress, 0, *to)

    def _of_autopilot(self, asked: Asked) -> int | None:
        number = int(asked.values[0]) if isfinite(asked.values[0]) else -1
        if asked.command == mavlink.MAV_CMD_REQUEST_MESSAGE:
            if number not in self._make:
                return DENIED
            self._tell(number)
            return ACCEPTED
        if asked.command == mavlink.MAV_CMD_SET_MESSAGE_INTERVAL:
            if number not in self._make:
                return DENIED
            if asked.values[1] > 0:
                self._every[number] = asked.values[1] / 1e6
                self._due.setdefault(number, 0.0)
            return ACCEPTED
        return self.vehicle.do(asked)

    def _of_camera(self, asked: Asked) -> int | None:
        if self.vehicle.faults.eyeless:
            return None
        if asked.command == mavlink.MAV_CMD_REQUEST_MESSAGE:
            writes = {
                mavlink.MAVLINK_MSG_ID_CAMERA_INFORMATION: self._camera,
                mavlink.MAVLINK_MSG_ID_CAMERA_CAPTURE_STATUS: self._captures,
            }.get(int(asked.values[0]))
            if writes is None:
                return DENIED
            self._put(writes(), CAMERA)
            return ACCEPTED
        if asked.command == mavlink.MAV_CMD_IMAGE_START_CAPTURE:
            return ACCEPTED
        return DENIED

    def _camera(self) -> Any:
        name = [*b"Simulated"]
        return self._of(CAMERA).camera_information_encode(
            self._boot,
            [*b"Pluto", *[0] * 27],
            [*name, *[0] * (32 - len(name))],
            1,
            FOCAL,
            *SENSOR,
            *PIXELS,
            0,
            mavlink.CAMERA_CAP_FLAGS_CAPTURE_IMAGE,
            0,
            b"",
        )

    def _captures(self) -> Any:
        images = self.vehicle.images
        return self._of(CAMERA).camera_capture_status_encode(self._boot, 0, 0, 0.0, 0, 1e4, images)

    def _picture(self) -> Any:
        vehicle = self.vehicle
        taken = not vehicle.faults.blank
        if taken:
            vehicle.record.photos.append(vehicle.truth)
            vehicle.images += 1
        place = vehicle.place
        latitude, longitude, altitude = place
        sight = "" if vehicle.around is None else vehicle.around.sight(place, vehicle.now)
        return self._of(CAMERA).camera_image_captured_encode(
            self._boot,
            int(vehicle.now * 1e6),
            0,
            round(latitude * 1e7),
            round(longitude * 1e7),
            round(altitude * 1000),
            round(vehicle.body.at[2] * 1000),
            (1.0, 0.0, 0.0, 0.0),
            vehicle.images - 1,
            int(taken),
            f"mftp:///{vehicle.build.id}-{vehicle.images}.jpg{sight}".encode(),
        )

    # Its fence

    def _fence_comes(self, message: Any) -> None:
        if self.vehicle.faults.unfenced:
            to = message.get_srcSystem(), message.get_srcComponent()
            full = mavlink.MAV_MISSION_NO_SPACE
            self._put(self._of().mission_ack_encode(*to, full, _FENCE))
            return
        self._coming = [None] * message.count
        self._next_corner(message)

    def _next_corner(self, message: Any) -> None:
        """Ask for the first corner that has not come, or take the fence: MAVLink's mission protocol."""
        to = message.get_srcSystem(), message.get_srcComponent()
        if None in self._coming:
            missing = self._coming.index(None)
            self._put(self._of().mission_request_int_encode(*to, missing, _FENCE))
            return
        self.vehicle.fence = tuple(corner for corner in self._coming if corner is not None)
        accepted = mavlink.MAV_MISSION_ACCEPTED
        self._put(self._of().mission_ack_encode(*to, accepted, _FENCE))

    # Parameters

    def _read(self, message: Any) -> None:
        name = message.param_id
        if message.param_index >= 0:
            names = [*self.vehicle.parameters]
            name = names[message.param_index] if message.param_index < len(names) else ""
        if name in self.vehicle.parameters:
            self._parameter(name)

    def _set(self, message: Any) -> None:
        known = self.vehicle.parameters.get(message.param_id)
        if known is not None:
            px4 = self.vehicle.MAKE == mavlink.MAV_AUTOPILOT_PX4
            given = message.param_value
            if px4 and message.param_type == _WHOLE:
                (given,) = struct.unpack("<i", struct.pack("<f", given))
            if not self.vehicle.faults.stubborn:
                known.value = float(given)
            self._parameter(message.param_id)

    def _parameter(self, name: str) -> None:
        """Tell a parameter: PX4 sends the bytes of a whole number, ArduPilot the number as a float."""
        parameters = self.vehicle.parameters
        one = parameters[name]
        value = one.value
        if one.whole and self.vehicle.MAKE == mavlink.MAV_AUTOPILOT_PX4:
            (value,) = struct.unpack("<f", struct.pack("<i", int(value)))
        kind = _WHOLE if one.whole else _REAL
        index = [*parameters].index(name)
        self._put(self._of().param_value_encode(name.encode(), value, kind, len(parameters), index))


def asked_by(message: Any) -> Asked:
    """Return the command of a message of either kind."""
    values = (message.param1, message.param2, message.param3, message.param4)
    if message.get_type() == "COMMAND_INT":
        place = (message.x / 1e7, message.y / 1e7)
        return Asked(
            command=message.command,
            values=values,
            place=place if message.x != 0x7FFFFFFF else None,
            height=message.z,
            frame=message.frame,
            exact=True,
        )
    finite = isfinite(message.param5) and isfinite(message.param6)
    return Asked(
        command=message.command,
        values=values,
        place=(message.param5, message.param6) if finite else None,
        height=message.param7,
        frame=mavlink.MAV_FRAME_GLOBAL,
        exact=False,
    )
