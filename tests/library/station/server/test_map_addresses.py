"""The floor plan by its addresses."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from pluto_fleet.station.map.pictures import LARGEST
from tests.library.station.jumping import run
from tests.library.station.map.test_drawn import ward

from .asking import AStation
from .serving import served, status

PNG = b"\x89PNG\r\n\x1a\n"


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
