"""Which pictures may be a floor plan."""

from __future__ import annotations

import pytest

from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.station.map.pictures import ending_of, safe_name

SVG = '<svg xmlns="http://www.w3.org/2000/svg"/>'


@pytest.mark.parametrize(
    ("content", "ending"),
    [
        (b"\x89PNG\r\n\x1a\n...", ".png"),
        (b"\xff\xd8\xff\xe0...", ".jpg"),
        (b"RIFF\x00\x00\x00\x00WEBPVP8 ", ".webp"),
        (f'\ufeff<?xml version="1.0"?>\n<!DOCTYPE svg>{SVG}'.encode(), ".svg"),
    ],
)
def test_a_picture_is_what_its_bytes_say(content: bytes, ending: str) -> None:
    """Whatever it is called."""
    assert ending_of(content) == ending
    assert safe_name("evil.html", content).startswith("evil-")
    assert safe_name("evil.html", content).endswith(ending)


@pytest.mark.parametrize(
    "content",
    [
        b"",
        b"GIF89a",
        b"<html><script>alert(1)</script></html>",
        b"<svg",
        b"<svg/>",
        b"RIFF....WAVE",
        f'<!DOCTYPE svg [<!ENTITY a "b">]>{SVG}'.encode(),
    ],
)
def test_anything_else_is_refused(content: bytes) -> None:
    with pytest.raises(BadInput):
        ending_of(content)


@pytest.mark.parametrize("name", ["", "..", "/etc/passwd", "a/../b.png", "\0", "é" * 300, "C:\\x"])
def test_a_name_leads_nowhere_else(name: str) -> None:
    """It is short, and has letters, digits and - alone."""
    found = safe_name(name, SVG.encode()).removesuffix(".svg")
    assert len(found) < 60 and found.replace("-", "").isalnum() and found.isascii()
