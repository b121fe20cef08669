"""The floor plan by its addresses."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from pluto_fleet.station.map.pictures import LARGEST
from tests.library.station.jumping import run
from tests.library.station.map.test_drawn import SVG, ward

from .asking import AStation, asked, without
from .serving import served, status

PNG = b"\x89PNG\r\n\x1a\n"


def test_a_floor_plan_is_taken_and_served_by_its_real_type(tmp_path: Path) -> None:
    """So that it can run nothing."""
    station: Any = AStation()
    station.map = ward(tmp_path)
    station.map.changed = lambda: setattr(station, "image", station.map.image)
    station.map.changed()
    ask = asked(station)
    assert ask("GET", "/map").body == SVG
    headers = without(content_type="image/jpeg")
    assert ask("PUT", "/api/map/image", PNG, headers, name="a.jpg", revision="0").status == 200
    reply = ask("GET", "/map", v="any")
    assert (reply.body, reply.type) == (PNG, "image/png")
    assert "default-src 'none'" in dict(reply.headers)["Content-Security-Policy"]


def test_a_floor_plan_may_be_larger_than_other_bodies(tmp_path: Path) -> None:
    """Up to its own limit, beyond which nothing is read."""
    png = PNG + b"x" * (2 << 20)

    async def scene() -> None:
        station: Any = AStation()
        station.map = ward(tmp_path)
        async with served(station=station) as there:
            for path, length, sent, answer in (
                ("/api/map/image", len(png), png, 200),
                ("/api/map/image", LARGEST + 1, b"", 413),
                ("/api/plan/import?revision=1", len(png), b"", 413),
            ):
                toml = path.startswith("/api/plan")
                head = there.request(
                    "POST" if toml else "PUT",
                    path,
                    Content_Length=str(length),
                    Content_Type="application/toml" if toml else "image/png",
                )
                assert status(await there.say(head, sent)) == answer
        assert station.map.image.read_bytes() == png

    run(scene())
