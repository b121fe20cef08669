"""The map by its addresses."""

from __future__ import annotations

import asyncio
import json
from pathlib import Path
from typing import Any

import pytest

from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.station.map.pictures import LARGEST
from pluto_fleet.station.map.ways import DrawnWays
from pluto_fleet.station.web.http import Reply
from tests.library.station.map.test_drawn import BED, SVG, text, ward

from .asking import Asked, AStation, asked, said, without
from .serving import served, status


def of(reply: Reply) -> Any:
    return json.loads(reply.body)


def asking(folder: Path) -> Asked:
    """Return a station that serves the map of a fleet file."""
    station: Any = AStation()
    station.map, station.ways = ward(folder), DrawnWays(Airspace(size=(20.0, 12.0)))
    station.map.changed = lambda: setattr(station, "image", station.map.image)
    station.map.changed()
    return asked(station)


def test_a_page_draws_and_gets_the_newest(tmp_path: Path) -> None:
    """One that has drawn on an old map gets that, too, and is refused."""
    ask = asking(tmp_path)
    assert of(ask("GET", "/api/map"))["places"] == [{**BED, "x": 1.0, "y": 1.0}]
    reply = ask("PUT", "/api/map", {"revision": 0, "places": []})
    assert (reply.status, of(reply)["revision"], of(reply)["places"]) == (200, 1, [])
    late = ask("PUT", "/api/map", {"revision": 0, "north": 3})
    assert (late.status, of(late)) == (409, of(reply))
    bad = ask("PUT", "/api/map", {"revision": 1, "north": 999})
    assert (bad.status, said(bad)) == (
        400,
        "the map: north 999 is no angle from -360 to 360 degrees",
    )


def test_a_floor_plan_is_taken_and_served(tmp_path: Path) -> None:
    """By its real type, so that it can run nothing."""
    ask = asking(tmp_path)
    assert ask("GET", "/map").body == SVG
    new = b"\x89PNG\r\n\x1a\n"
    png = without(content_type="image/jpeg")
    reply = ask("PUT", "/api/map/image", new, png, name="a.jpg", revision="0")
    assert reply.status == 200
    served = ask("GET", "/map", v="any")
    assert (served.body, served.type) == (new, "image/png")
    assert "default-src 'none'" in dict(served.headers)["Content-Security-Policy"]


@pytest.mark.parametrize(
    ("body", "kind", "status"),
    [(SVG, "text/html", 415), (b"<html/>", "image/svg+xml", 400), (SVG, "image/svg+xml", 409)],
)
def test_what_is_no_floor_plan_changes_nothing(
    tmp_path: Path, body: bytes, kind: str, status: int
) -> None:
    ask, before = asking(tmp_path), text(tmp_path) if (tmp_path / "fleet.toml").exists() else ""
    headers = without(content_type=kind)
    reply = ask("PUT", "/api/map/image", body, headers, name="x", revision="7" * (status == 409))
    assert reply.status == status
    assert text(tmp_path) == (before or text(tmp_path))
    assert sorted(file.name for file in tmp_path.iterdir()) == ["fleet.toml", "ward.svg"]


def test_another_site_draws_nothing(tmp_path: Path) -> None:
    ask = asking(tmp_path)
    for headers in (without("x-pluto"), without(origin="http://evil.example")):
        assert ask("PUT", "/api/map", {"revision": 0, "north": 3}, headers).status == 403
    assert ask("DELETE", "/api/map").status == 405


def test_a_floor_plan_may_be_larger_than_other_bodies(tmp_path: Path) -> None:
    """Up to its own limit, beyond which nothing is read."""
    png = b"\x89PNG\r\n\x1a\n" + b"x" * (2 << 20)

    async def scene() -> None:
        station: Any = AStation()
        station.map = ward(tmp_path)
        async with served(station=station) as there:
            for length, answer in ((len(png), 200), (LARGEST + 1, 413)):
                put = there.request(
                    "PUT", "/api/map/image", Content_Length=str(length), Content_Type="image/png"
                )
                sent = png if length == len(png) else b""
                assert status(await there.say(put, sent)) == answer
        assert station.map.image.read_bytes() == png

    asyncio.run(scene())
