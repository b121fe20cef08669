"""What is drawn on the map is in the fleet file, and nothing else of that has changed; which pictures it may be on."""

from __future__ import annotations

import asyncio
import json
import os
from collections.abc import Mapping
from pathlib import Path

import pytest

from pluto_fleet.files.fleet import load_fleet
from pluto_fleet.geodesy import LocalPlane
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.station.config import StationConfig
from pluto_fleet.station.map.drawn import DrawnMap, StaleMap
from pluto_fleet.station.map.pictures import ending_of, safe_name
from pluto_fleet.station.station import Station
from tests.library.files.an_app import APP
from tests.library.station.in_threads import InThreads
from tests.library.station.plan.drawing import FLEET as PLAIN_FLEET
from tests.library.station.plan.drawing import a_plan

SVG = b'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 2 1"/>'
FLEET = """\
# Our ward.
[map]
size = [20.0, 12.0]
image = "ward.svg"  # by the architect

[[map.places]]
name = "Bed 1"  # by the window
at = [1, 1]

# Our drones.
[[drone]]
id = "a"
category = "scout"
home = [1, 1]
"""
BED = {"name": "Bed 1", "x": 1, "y": 1}


def ward(folder: Path, text: str = FLEET) -> DrawnMap:
    """Return the map of a fleet file with this text, its floor plan beside it."""
    (folder / "ward.svg").write_bytes(SVG)
    (folder / "fleet.toml").write_bytes(text.encode())
    airspace = load_fleet(folder / "fleet.toml", APP).airspace
    return DrawnMap(airspace, folder / "fleet.toml", now=lambda: 0.0)


def change(drawn: DrawnMap, **given: object) -> Mapping[str, object]:
    """Draw on the newest map."""
    asyncio.run(drawn.change(drawn.revision, given))
    return drawn.data()


def text(folder: Path) -> str:
    return (folder / "fleet.toml").read_bytes().decode()


def test_what_is_drawn_stands_in_the_fleet_file(tmp_path: Path) -> None:
    """To the millimetre; all that is not sent stays, with its comments."""
    drawn, heard = ward(tmp_path), list[int]()
    drawn.changed = lambda: heard.append(drawn.revision)
    zone = {"name": "Ward", "corners": [[0, 0], [5, 0], [5, 5.00001]]}
    data = change(
        drawn, places=[BED, {"name": "Bed 2", "x": 2.12345, "y": 3, "z": 1}], zones=[zone]
    )
    assert data["places"] == [BED, {"name": "Bed 2", "x": 2.123, "y": 3.0, "z": 1.0}]
    assert text(tmp_path) == FLEET.replace(
        "at = [1, 1]\n",
        'at = [1, 1]\n\n[[map.places]]\nname = "Bed 2"\nat = [2.123, 3.0, 1.0]\n\n'
        '[[map.zones]]\nname = "Ward"\ncorners = [[0.0, 0.0], [5.0, 0.0], [5.0, 5.0]]\n',
    )
    assert heard == [data["revision"]] == [1]
    assert (drawn.name_of((2.2, 3.3)), drawn.name_of((4.0, 2.0))) == ("Bed 2", "Ward")
    change(drawn, places=[BED], zones=[], north=0)
    assert text(tmp_path) == FLEET
    assert load_fleet(tmp_path / "fleet.toml", APP).landmarks == drawn.landmarks


def test_a_file_that_was_changed_by_hand_counts(tmp_path: Path) -> None:
    """A page that has not seen that is told; what does not concern the map is no conflict."""
    drawn = ward(tmp_path)
    by_hand = FLEET.replace('id = "a"', 'id = "b"  # mended')
    (tmp_path / "fleet.toml").write_text(by_hand, "utf-8")
    change(drawn, north=30)
    assert 'id = "b"  # mended' in text(tmp_path)
    by_hand = text(tmp_path).replace("[1, 1]", "[2, 2]", 1)
    (tmp_path / "fleet.toml").write_text(by_hand, "utf-8")
    with pytest.raises(StaleMap):
        change(drawn, places=[])
    assert drawn.data()["places"] == [{**BED, "x": 2.0, "y": 2.0}]
    assert text(tmp_path) == by_hand
    change(drawn, places=[])
    assert "Bed 1" not in text(tmp_path)


@pytest.mark.parametrize("broken", ["[map", None, "[map]\nnorth = 'x'\n"])
def test_a_file_that_cannot_be_read_any_more_is_not_replaced(
    tmp_path: Path, broken: str | None
) -> None:
    """It is said what is wrong with it."""
    drawn, file = ward(tmp_path), tmp_path / "fleet.toml"
    if broken is None:
        file.unlink()
    else:
        file.write_text(broken, "utf-8")
    with pytest.raises(BadInput, match=r"fleet\.toml"):
        change(drawn, north=3)
    assert (file.read_text() if file.exists() else None) == broken


@pytest.mark.skipif(os.geteuid() == 0, reason="root may write everywhere")
def test_a_file_that_may_only_be_read_says_so(tmp_path: Path) -> None:
    """Before anything is drawn, and when it is."""
    drawn = ward(tmp_path)
    (tmp_path / "fleet.toml").chmod(0o444)
    assert drawn.data()["writable"] is False
    with pytest.raises(BadInput, match="may only be read"):
        change(drawn, north=3)


def test_permissions_links_marks_and_line_ends_stay(tmp_path: Path) -> None:
    """A link leads to the same file, which others may write as before."""
    crlf = "\ufeff" + FLEET.replace("\n", "\r\n")
    ward(tmp_path, crlf)
    (tmp_path / "fleet.toml").rename(tmp_path / "real.toml")
    (tmp_path / "real.toml").chmod(0o664)
    (tmp_path / "fleet.toml").symlink_to("real.toml")
    drawn = DrawnMap(Airspace(size=(20.0, 12.0)), tmp_path / "fleet.toml")
    change(drawn, north=3)
    assert (tmp_path / "fleet.toml").is_symlink()
    assert (tmp_path / "real.toml").stat().st_mode & 0o777 == 0o664
    assert text(tmp_path) == crlf.replace("architect\r\n", "architect\r\nnorth = 3.0\r\n")


def test_without_a_fleet_file_the_station_keeps_it(tmp_path: Path) -> None:
    """In a file of its own, which it finds again."""
    drawn = DrawnMap(Airspace(), tmp_path / "map.toml")
    change(drawn, places=[BED])
    asyncio.run(drawn.take_picture(drawn.revision, "x", SVG))
    again = DrawnMap(Airspace(), tmp_path / "map.toml")
    assert again.landmarks == drawn.landmarks
    assert again.image == drawn.image != None


def test_what_another_program_has_drawn_is_taken_and_told(tmp_path: Path) -> None:
    """Places and zones; that a no-fly area is left out is said, and what is no drawing changes nothing."""
    origin = "{ latitude = 47.0, longitude = 8.0, altitude = 400 }"
    on_earth = FLEET.replace("[map]\n", f"[map]\norigin = {origin}\n")
    drawn = ward(tmp_path, on_earth)
    plane = LocalPlane(47.0, 8.0, 400.0)

    def at(x: float, y: float) -> list[float]:
        latitude, longitude, _ = plane.to_degrees((x, y, 0.0))
        return [longitude, latitude]

    area = [at(2, 2), at(8, 2), at(8, 6), at(2, 2)]
    features = [
        {"geometry": {"type": "Point", "coordinates": at(3, 4)}, "properties": {"name": "Well"}},
        {"geometry": {"type": "Polygon", "coordinates": [area]}, "properties": {"name": "Beds"}},
        {"geometry": {"type": "Polygon", "coordinates": [area]}, "properties": {"no_fly": True}},
    ]
    text_of_it = json.dumps(
        {
            "type": "FeatureCollection",
            "features": [{"type": "Feature", **one} for one in features],
        }
    )
    asyncio.run(drawn.take_drawing(drawn.revision, "field.geojson", text_of_it.encode()))
    told = drawn.data()
    assert [one["name"] for one in told["places"]] == ["Bed 1", "Well"]
    assert [one["name"] for one in told["zones"]] == ["Beds"]
    assert told["said"].startswith("field.geojson: 1 place, 1 zone\n1 no-fly area is left out")
    kept = text(tmp_path)
    with pytest.raises(BadInput, match="is a plan of Pluto"):
        asyncio.run(drawn.take_drawing(drawn.revision, "plan.toml", b"[[mission]]\n"))
    outside = text_of_it.replace("8.0", "8.1")
    with pytest.raises(BadInput):
        asyncio.run(drawn.take_drawing(drawn.revision, "far.geojson", outside.encode()))
    assert text(tmp_path) == kept
    assert change(drawn, north=0)["said"] == ""


def test_a_floor_plan_lies_where_it_was_laid(tmp_path: Path) -> None:
    """Another one is as large as the map until then; each has an address of its own."""
    drawn = ward(tmp_path)
    laid = {"x": 1.0, "y": 0.5, "width": 10.0, "height": 5.0, "turn": 90.0}
    first = change(drawn, image=laid)["image"]
    assert first == {**laid, "address": drawn.address}
    asyncio.run(drawn.take_picture(drawn.revision, "../../New ward.PNG", SVG + b" "))
    second = drawn.data()["image"]
    assert second == {
        "address": drawn.address,
        "x": 0.0,
        "y": 0.0,
        "width": 20.0,
        "height": 12.0,
        "turn": 0.0,
    }
    assert first["address"] != second["address"]
    [new] = [file for file in tmp_path.iterdir() if file.name.startswith("new-ward-")]
    assert new.suffix == ".svg" and new.read_bytes() == SVG + b" "
    assert drawn.image == new.resolve()
    assert f'image = "{new.name}"  # by the architect' in text(tmp_path)
    assert (tmp_path / "ward.svg").read_bytes() == SVG
    assert change(drawn, image=None)["image"] is None


def test_a_floor_plan_that_cannot_be_named_is_not_left_behind(tmp_path: Path) -> None:
    """Where the file's map is written in a way that is not touched."""
    drawn = ward(tmp_path, FLEET.replace("[map]\nsize", "map.size").replace('image', 'map.image')
                 .split("[[map.places]]")[0] + FLEET[FLEET.index("# Our drones") :])  # fmt: skip
    with pytest.raises(BadInput, match=r"write the line \[map\]"):
        asyncio.run(drawn.take_picture(drawn.revision, "x", SVG))
    assert sorted(file.name for file in tmp_path.iterdir()) == ["fleet.toml", "ward.svg"]


def test_all_pages_learn_of_a_new_map(tmp_path: Path) -> None:
    """By its revision in what they are told; its names are known to plans that are taken in."""
    config = StationConfig(folder=tmp_path, fleet=PLAIN_FLEET, faults={})
    config.own_folder.mkdir()
    files = InThreads(APP, config)
    station = Station(APP, config, a_plan(), files)
    station.begin()

    async def scene() -> list[int]:
        first = json.loads(await station.newer("", 0, 0, 0))
        place = {"name": "Desk", "x": 1, "y": 2}
        await station.map.change(station.map.revision, {"places": [place]})
        second = json.loads(await station.newer("", first["version"], 0, 0))
        return [first["state"]["map"], second["state"]["map"]]

    before, after = asyncio.run(scene())
    assert after == before + 1
    assert station.plan.landmarks.place == {"Desk": (1.0, 2.0)}
    again = Station(APP, config, a_plan(), files)
    assert again.plan.landmarks == station.plan.landmarks


@pytest.mark.parametrize(
    ("content", "ending"),
    [
        (b"\x89PNG\r\n\x1a\n...", ".png"),
        (b"\xff\xd8\xff\xe0...", ".jpg"),
        (b"RIFF\x00\x00\x00\x00WEBPVP8 ", ".webp"),
        ('\ufeff<?xml version="1.0"?>\n<!DOCTYPE svg>'.encode() + SVG, ".svg"),
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
        b'<!DOCTYPE svg [<!ENTITY a "b">]>' + SVG,
    ],
)
def test_anything_else_is_refused(content: bytes) -> None:
    with pytest.raises(BadInput):
        ending_of(content)


def test_of_a_tiff_it_is_said_how_to_make_what_is_shown() -> None:
    with pytest.raises(BadInput, match=r"`pluto-fleet map FLEET\.toml FIELD\.tif` makes a picture"):
        ending_of(b"II*\0...")


@pytest.mark.parametrize("name", ["", "..", "/etc/passwd", "a/../b.png", "\0", "é" * 300, "C:\\x"])
def test_a_name_leads_nowhere_else(name: str) -> None:
    """It is short, and has letters, digits and - alone."""
    found = safe_name(name, SVG).removesuffix(".svg")
    assert len(found) < 60 and found.replace("-", "").isalnum() and found.isascii()
