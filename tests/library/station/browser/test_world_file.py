"""A picture of the ground lies where its world file says."""

from __future__ import annotations

import struct
import zlib

import pytest
from playwright.sync_api import FilePayload, expect

from tests.kit.station import until
from tests.library.station.browser.conftest import Serve, Visit
from tests.library.station.browser.steps import open_page

pytestmark = pytest.mark.long

WIDE, HIGH = 8, 4


def png() -> bytes:
    """Return a grey picture of so many pixels."""

    def chunk(kind: bytes, data: bytes) -> bytes:
        return (
            struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
        )

    rows = b"".join(b"\0" + b"\x80" * WIDE for _ in range(HIGH))
    head = struct.pack(">IIBBBBB", WIDE, HIGH, 8, 0, 0, 0, 0)
    return (
        b"\x89PNG\r\n\x1a\n"
        + chunk(b"IHDR", head)
        + chunk(b"IDAT", zlib.compress(rows))
        + chunk(b"IEND", b"")
    )


def test_a_picture_with_its_world_file_lies_where_that_says(serve: Serve, visit: Visit) -> None:
    """And one of which the world file says nothing is not taken."""
    station = serve("drugs_distribution", own=True)
    page = visit(station)
    open_page(page, "Map")
    page.get_by_text("Floor plan and north").click()
    chosen = page.get_by_label("A picture of the ground")
    picture = FilePayload(name="ward.png", mimeType="image/png", buffer=png())
    before = station.get("/api/map")["image"]
    beside = FilePayload(name="ward.pgw", mimeType="text/plain", buffer=b"nothing")
    chosen.set_input_files([beside, picture])
    expect(page.get_by_text("does not say where the picture lies")).to_be_visible()
    assert station.get("/api/map")["image"] == before
    beside["buffer"] = b"0.5\n0\n0\n-0.5\n1.25\n3.75\n"
    chosen.set_input_files([beside, picture])

    def lies() -> bool:
        image = station.get("/api/map")["image"]
        return [image[key] for key in ("x", "y", "width", "height", "turn")] == [1, 2, 4, 2, 0]

    until(lies, "it lies there")
