"""A flight as an MCAP file, which Foxglove and other tools of robotics read.

Each drone has a pose and a transform of Foxglove's own schemas, and a battery; each mission its row; what moves beside
them a pose; the console is a `foxglove.Log`, and each result a message. All are JSON.
"""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from io import BytesIO
from typing import TYPE_CHECKING, Any

from ...shared.domain.errors import BadInput
from ..shown import Frame
from .logbook import Logbook
from .replay import Past

if TYPE_CHECKING:
    from mcap.writer import Writer

    from ..wire import TrackWay

FRAME = "map"
"""The name of the fleet's own coordinates: metres, z up."""

HOW_TO_INSTALL = (
    "an MCAP file needs a package that the extra `station` brings since one can be written here:"
    " pip install mcap"
)

LARGEST = 1024 * 1024 * 1024
"""Bytes of a file, which is made in memory."""

_NO_TURN = {"x": 0.0, "y": 0.0, "z": 0.0, "w": 1.0}
_SECOND = 1_000_000_000
_LATEST = 2**64 - 1
_LEVELS = {"bad": 4, "info": 2, "good": 2, "hook": 2}
"""Foxglove's levels of a log: 2 is information, 4 an error."""


def mcap_of(past: Past, book: Logbook) -> bytes:
    """Return the file; raise `BadInput` if its library is not installed."""
    try:
        from mcap.writer import CompressionType, Writer
    except ImportError:
        raise BadInput(HOW_TO_INSTALL) from None
    file = BytesIO()
    writer = Writer(file, compression=CompressionType.ZSTD)
    writer.start(profile="", library="pluto-fleet")
    begun_at = past.begun_at
    _Writing(writer, file, begun_at or 0).write(past, book)
    writer.add_metadata("flight", {"id": past.id, "said": book.said})
    writer.finish()  # type: ignore[no-untyped-call] # of that library
    return file.getvalue()


class _Writing:
    def __init__(self, writer: Writer, file: BytesIO, begun_at: int) -> None:
        self._writer = writer
        self._file = file
        self._begin = begun_at * 1_000_000
        self._schemas: dict[str, int] = {}
        self._channels: dict[str, int] = {}
        self._told: dict[str, Mapping[str, Any]] = {}
        """What was written last where only changes are."""

    def write(self, past: Past, book: Logbook) -> None:
        """Write all: first what is shown over time, then the console, what moved and happened, and the results."""
        for frame in past.frames():
            self._frame(frame)
        for line in book.lines:
            self._line(line)
        for way in past.ways():
            self._way(way)
        for happened in book.events:
            self._put("/events", "pluto.Event", happened["time"], happened)
        for result in book.feed.brought():
            assert isinstance(result, Mapping)
            self._put("/results", "pluto.Result", result["time"], result)

    def _frame(self, frame: Frame) -> None:
        t = frame["t"]
        stands = {**frame["state"]}
        stands.pop("time", None)
        self._put_change("/station", "pluto.State", t, stands)
        for row in frame["missions"]:
            wait = row.get("wait")
            plain = {**row, "wait": wait["text"] if wait else ""}
            self._put_change(f"/missions/{_topic(row['name'])}", "pluto.Mission", t, plain)
        moved = [moved for row in frame["drones"] if (moved := self._drone(t, row)) is not None]
        if moved:
            self._put("/tf", "foxglove.FrameTransforms", t, {"transforms": moved})

    def _drone(self, t: float, row: Mapping[str, Any]) -> dict[str, Any] | None:
        """Write what is known of a drone; return its transform, if it is known where it is."""
        moved = None
        drone, topic = row["id"], f"/drones/{_topic(row['id'])}"
        stamp = self._stamp(t)
        position = {axis: row.get(axis) for axis in "xyz"}
        if None not in position.values():
            self._put_pose(topic, t, position)
            moved = {"timestamp": stamp, "parent_frame_id": FRAME, "child_frame_id": drone}
            moved |= {"translation": position, "rotation": _NO_TURN}
        if row.get("battery") is not None:
            level = {"level": row["battery"]}
            self._put_change(f"{topic}/battery", "pluto.Battery", t, level)
        standing = {fact: row.get(fact) for fact in ("status", "mission", "why")}
        self._put_change(f"{topic}/status", "pluto.DroneStatus", t, standing)
        return moved

    def _way(self, way: TrackWay) -> None:
        """Write where something was that moves."""
        for t, *at in way["way"]:
            self._put_pose(f"/tracks/{_topic(way['id'])}", t, dict(zip("xyz", at, strict=True)))

    def _put_pose(self, topic: str, t: float, position: Mapping[str, Any]) -> None:
        pose = {"position": position, "orientation": _NO_TURN}
        put = {"timestamp": self._stamp(t), "frame_id": FRAME, "pose": pose}
        self._put(f"{topic}/pose", "foxglove.PoseInFrame", t, put)

    def _line(self, line: Any) -> None:
        number, t, mission, text, kind = _parts(line)
        said = {
            "timestamp": self._stamp(t),
            "level": _LEVELS[kind],
            "message": text,
            "name": mission or "",
            "file": "",
            "line": number,
        }
        self._put("/log", "foxglove.Log", t, said)

    def _put_change(self, topic: str, schema: str, t: float, data: Mapping[str, Any]) -> None:
        if self._told.get(topic) != data:
            self._told[topic] = data
            self._put(topic, schema, t, data)

    def _put(self, topic: str, schema: str, t: float, data: Mapping[str, Any]) -> None:
        channel = self._channels.get(topic)
        if channel is None:
            channel = self._channels[topic] = self._writer.register_channel(
                topic, "json", self._schema(schema)
            )
        at = min(max(self._begin + round(t * _SECOND), 0), _LATEST)
        if self._file.tell() > LARGEST:
            raise BadInput(f"the MCAP file would be larger than {LARGEST // 2**20} MiB")
        self._writer.add_message(channel, at, json.dumps(data, default=str).encode(), at)

    def _schema(self, name: str) -> int:
        known = self._schemas.get(name)
        if known is None:
            text = json.dumps({"title": name, **SCHEMAS[name]}).encode()
            known = self._schemas[name] = self._writer.register_schema(name, "jsonschema", text)
        return known

    def _stamp(self, t: float) -> dict[str, int]:
        seconds, rest = divmod(self._begin + round(t * _SECOND), _SECOND)
        return {"sec": seconds, "nsec": rest}


def _topic(name: str) -> str:
    """Return a name as a part of a topic."""
    return re.sub(r"[^\w.-]+", "_", name) or "_"


def _parts(line: Any) -> tuple[Any, ...]:
    """Return number, time, mission, text and kind of a line of the console."""
    if isinstance(line, Mapping):
        return tuple(line[key] for key in ("number", "time", "mission", "text", "kind"))
    return tuple(line)


def _object(**properties: Mapping[str, Any]) -> dict[str, Any]:
    return {"type": "object", "properties": properties}


_NUMBER, _TEXT, _WHOLE = {"type": "number"}, {"type": "string"}, {"type": "integer"}
_TIME = _object(sec=_WHOLE, nsec=_WHOLE)
_VECTOR = _object(x=_NUMBER, y=_NUMBER, z=_NUMBER)
_TURN = _object(x=_NUMBER, y=_NUMBER, z=_NUMBER, w=_NUMBER)
_TRANSFORM = _object(
    timestamp=_TIME,
    parent_frame_id=_TEXT,
    child_frame_id=_TEXT,
    translation=_VECTOR,
    rotation=_TURN,
)

SCHEMAS: Mapping[str, dict[str, Any]] = {
    "foxglove.PoseInFrame": _object(
        timestamp=_TIME, frame_id=_TEXT, pose=_object(position=_VECTOR, orientation=_TURN)
    ),
    "foxglove.FrameTransforms": _object(transforms={"type": "array", "items": _TRANSFORM}),
    "foxglove.Log": _object(
        timestamp=_TIME, level=_WHOLE, message=_TEXT, name=_TEXT, file=_TEXT, line=_WHOLE
    ),
    "pluto.State": _object(phase=_TEXT, said=_TEXT),
    "pluto.Mission": _object(name=_TEXT, status=_TEXT, reason=_TEXT, wait=_TEXT, done=_WHOLE),
    "pluto.Battery": _object(level=_NUMBER),
    "pluto.DroneStatus": _object(status=_TEXT, mission={}, why=_TEXT),
    "pluto.Event": _object(id=_TEXT, name=_TEXT, time=_NUMBER, made={}, why=_TEXT),
    "pluto.Result": _object(time=_NUMBER, mission=_TEXT, kind=_TEXT, value={}),
}
"""Their JSON schemas, by their names; those of Foxglove have all of its fields that are used here."""
