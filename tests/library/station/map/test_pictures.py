"""Which pictures may be a floor plan, and where one lies by two of its points."""

from __future__ import annotations

from math import dist

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.station.map.calibration import calibration, on_map
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


METRES = st.floats(-50, 50)
PIXELS = st.floats(0, 1000)


@settings(max_examples=60, derandomize=True, deadline=None)
@given(
    first=st.tuples(PIXELS, PIXELS),
    second=st.tuples(PIXELS, PIXELS),
    at=st.tuples(METRES, METRES),
    towards=st.tuples(METRES, METRES),
    metres=st.floats(0.1, 100),
)
def test_both_points_come_to_lie_where_they_are(
    first: tuple[float, float],
    second: tuple[float, float],
    at: tuple[float, float],
    towards: tuple[float, float],
    metres: float,
) -> None:
    """The first on its place, the second so far from there, in the direction that was pointed to."""
    pixels = (1000.0, 800.0)
    if dist(first, second) < 2 or dist(at, towards) < 0.1:
        return
    laid = calibration("x.png", pixels, first, second, metres, at=at, towards=towards)
    there = on_map(laid, pixels, second)
    assert on_map(laid, pixels, first) == pytest.approx(at, abs=1e-6)
    assert dist(at, there) == pytest.approx(metres)
    ray = [(end - start) / dist(at, towards) for start, end in zip(at, towards, strict=True)]
    assert there == pytest.approx([a + metres * r for a, r in zip(at, ray, strict=True)], abs=1e-6)


@pytest.mark.parametrize(("second", "metres"), [((1.0, 0.0), 3.0), ((9.0, 9.0), 0.0)])
def test_what_says_nothing_of_a_length_is_refused(
    second: tuple[float, float], metres: float
) -> None:
    with pytest.raises(BadInput):
        calibration("x", (10.0, 10.0), (0.0, 0.0), second, metres)
