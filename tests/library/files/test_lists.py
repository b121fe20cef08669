"""A list makes missions: one of each row of a CSV file, with its values in their texts."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from pluto_fleet.files.landmarks import Landmarks
from pluto_fleet.files.missions import load_missions, missions_of
from pluto_fleet.files.reading import parsed
from pluto_fleet.geodesy import LocalPlane
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.shared.domain.model import Item
from tests.library.files.an_app import APP

MAP = Airspace()
BEDS = """
[[mission]]
name = "Bed {nr}"
each = "beds.csv"

  [[mission.trip]]
  action = "take_photo"
  target = ["{x}", "{y}"]
"""
LIST = "nr,x,y\n1,2.5,3\n7,4,3.25\n"


def load(folder: Path, text: str = BEDS, rows: str | bytes = LIST) -> list[Any]:
    """Return the missions of a file, with a list beside it."""
    (folder / "beds.csv").write_bytes(rows if isinstance(rows, bytes) else rows.encode())
    file = folder / "m.toml"
    file.write_text(text, encoding="utf-8")
    return load_missions(file, APP, MAP)


def said(folder: Path, text: str = BEDS, rows: str | bytes = LIST) -> list[str]:
    """Return what is said of both."""
    with pytest.raises(BadInput) as caught:
        load(folder, text, rows)
    return str(caught.value).replace(f"{folder}/", "").split("\n")


def test_each_row_is_a_mission(tmp_path: Path) -> None:
    """Numbers may be written as texts with a column."""
    first, second = load(tmp_path)
    assert (first.name, first.index, second.name, second.index) == ("Bed 1", 0, "Bed 7", 1)
    assert first.trips[0].target == (2.5, 3.0, 1.2)
    assert second.trips[0].target == (4.0, 3.25, 1.2)


@pytest.mark.parametrize(
    "rows",
    [
        LIST.encode("utf-8-sig"),
        LIST.replace(",", ";"),
        LIST.replace("\n", "\r\n"),
        LIST.replace(",", " , "),
        LIST.rstrip("\n"),
        LIST + "\n,,\n\n",
        "\n" + LIST,
        "nr,x,y,\n1,2.5,3,\n7,4,3.25,\n",
        "nr;x;y;;;\n1;2.5;3;;;\n7;4;3.25;;;\n",
        LIST.replace("3\n", "3,\n").replace("25\n", "25, ,\n"),
        'nr,x,y\n"1","2.5",3\n"7",4,"3.25"\n',
        "nr,note,x,y\n1,,2.5,3\n7,unused,4,3.25\n",
    ],
)
def test_it_may_be_written_as_spreadsheets_write_it(tmp_path: Path, rows: str | bytes) -> None:
    """With a byte-order mark, semicolons, quotes, empty rows, and columns that nothing asks for."""
    found = load(tmp_path, rows=rows)
    assert [mission.name for mission in found] == ["Bed 1", "Bed 7"]
    assert [mission.trips[0].target[:2] for mission in found] == [(2.5, 3.0), (4.0, 3.25)]


def test_every_text_of_the_mission_may_name_columns(tmp_path: Path) -> None:
    """Names, fields, parameters, items and quantities, and areas; others are as they are."""
    text = """
[[mission]]
name = "{crop}: {nr}"
each = "lists/plan.csv"
safe_time = "{minutes} min"
repeat = "{rounds}"
at = "{at}"

  [[mission.trip]]
  name = "{{{nr}}}"
  action = "pollinate"
  target = ["{x} cm", 2, "{z}"]
  priority = "{p}"
  delay = 5
  parameters = { dose = "{dose}", gently = "{gently}", note = "{nr}", strokes = "{p}" }

  [[mission.trip]]
  action = "pick_item"
  target = [1, 1]
  item = { name = "{crop}", mass = "{mass}" }

  [[mission.trip]]
  action = "release_item"
  target = [2, 1]
  item = { name = "{crop}", mass = "{mass}" }

  [[mission.area]]
  name = "Around {nr}"
  polygon = [[0, 0], ["{w}", 0], ["{w}", 1], [0, 1]]
  action = "take_photo"
  spacing = "{w}"

[[mission]]
name = "{crop}"
  [[mission.trip]]
  action = "take_photo"
  target = [1, 1]
"""
    (tmp_path / "lists").mkdir()
    (tmp_path / "lists/plan.csv").write_text(
        "nr;crop;minutes;rounds;at;x;z;p;dose;gently;mass;w\n"
        '3;"Roses; red";2.5;true;08:30;250;1.5;4;40 mg;FALSE;4 g;2\n',
        encoding="utf-8",
    )
    made, other = load(tmp_path, text)
    assert (made.name, other.name) == ("Roses; red: 3", "{crop}")
    assert (made.safe_time, made.repeat, made.at) == (150.0, True, 8.5 * 3600)
    first, picks, _, swept = made.trips
    assert (first.name, first.target, first.priority, first.delay) == ("{3}", (2.5, 2, 1.5), 4, 5.0)
    assert first.parameters["dose"] == pytest.approx(40e-6)
    assert (first.parameters["gently"], first.parameters["strokes"]) == (False, 4)
    assert first.parameters["note"] == "3"
    assert picks.item == Item(name="Roses; red", mass=0.004)
    assert (swept.name, swept.target) == ("Around 3 1", (1.0, 0.5, 1.2))


def test_without_a_name_each_has_its_number(tmp_path: Path) -> None:
    """Among all missions of the file."""
    plain = '[[mission]]\n[[mission.trip]]\naction = "take_photo"\ntarget = [1, 1]\n'
    found = load(tmp_path, plain + BEDS.replace('name = "Bed {nr}"\n', ""))
    assert [(mission.name, mission.index) for mission in found] == [("1", 0), ("2", 1), ("3", 2)]


def load_missions_of(text: str) -> list[Any]:
    return missions_of(parsed("m.toml", text), APP, MAP)


def test_a_plan_that_is_no_file_has_no_list_beside_it() -> None:
    with pytest.raises(BadInput) as caught:
        load_missions_of(BEDS)
    assert 'each "beds.csv" lies beside a missions file, and this one is in no folder' in str(
        caught.value
    )


@pytest.mark.parametrize(
    ("rows", "sentence"),
    [
        (" \n\n", "is empty: its first line names the columns"),
        ("nr\tx\n1\t2\n", "has tabs between its columns: separate them by commas or semicolons"),
        (
            'nr,x,y\n"1\n2",2,3\n4,Süd,3\n'.encode("latin-1"),
            'cannot be used: is not UTF-8 text, in row 3, "4,Süd,3": save it as "CSV UTF-8"',
        ),
        (
            "ä,x\n".encode("cp1252"),
            'cannot be used: is not UTF-8 text, in row 1, "ä,x": save it as "CSV UTF-8"',
        ),
        *(
            (
                "nr,x,y\n1,2,3\n".encode(wide),
                'cannot be used: is not UTF-8 text but UTF-16, from row 1 on: save it as "CSV UTF-8"',
            )
            for wide in ("utf-16", "utf-32")
        ),
        (
            "nr,x\n".encode("utf-16-le"),
            "cannot be used: is UTF-16, or no text, and not CSV: save it",
        ),
        (
            '{"type": "FeatureCollection", "features": []}',
            "cannot be used: is GeoJSON, and not CSV: it is taken as missions",
        ),
        (
            b"PK\x03\x04\x14\0[Content_Types].xml xl/workbook.xml",
            'cannot be used: is an Excel workbook, and not CSV: save its sheet as "CSV UTF-8"',
        ),
    ],
)
def test_of_a_list_in_another_form_it_is_said_why(
    tmp_path: Path, rows: str | bytes, sentence: str
) -> None:
    """What can be shown of lists that cannot be used is in `sentences/lists.txt`."""
    [told] = said(tmp_path, rows=rows)
    assert told.startswith(f'm.toml:4: mission "Bed {{nr}}": each "beds.csv" {sentence}')


def test_of_each_wrong_value_the_row_and_the_column_are_told(tmp_path: Path) -> None:
    """As a spreadsheet counts: the first line is row 1, and empty ones count."""
    text = BEDS + '  priority = "{p}"\n'
    rows = "nr;x;y;p\n1;2;3;4\n\n2;2,5;3;high\n1;99;3;1\n5;;3;1\n"
    assert said(tmp_path, text, rows) == [
        (
            'm.toml:8: mission "Bed 2" (beds.csv, row 4), trip 1: target ["2,5", "3"] is wrong at number 1, which is'
            " not a length: write a number and a unit (mm, cm, m, km)"
            ' (column "x": "2,5"; a number has a point: 2.5)'
        ),
        (
            'm.toml:9: mission "Bed 2" (beds.csv, row 4), trip 1: priority "high" is not a whole number'
            ' from -1,000,000,000 to 1,000,000,000 (column "p")'
        ),
        (
            'm.toml:3: mission "Bed 1" (beds.csv, row 5): there is another mission "Bed 1", of beds.csv,'
            ' row 2: names must differ (column "nr")'
        ),
        (
            'm.toml:8: mission "Bed 1" (beds.csv, row 5), trip 1: target ["99", "3"] is outside the map:'
            ' x goes from 0 to 20 m, y from 0 to 20 m (columns "x" and "y")'
        ),
        (
            'm.toml:8: mission "Bed 5" (beds.csv, row 6), trip 1: target ["", "3"] is wrong at number 1, which is'
            ' not a length: write a number and a unit (mm, cm, m, km) (column "x": "")'
        ),
    ]


ALL = "all lists of a file make at most"
TWICE = BEDS + BEDS.replace("Bed", "Old bed")
MANY = LIST + "".join(f"{n},1,1\n" for n in range(100, 10_098))
MUCH = BEDS.replace("Bed {nr}", "{nr}" * 8_000)


@pytest.mark.parametrize(
    ("text", "rows", "sentence"),
    [
        (BEDS, MANY + "9,1,1\n", f"has too many rows: {ALL} 10,000 missions"),
        (TWICE, MANY, f"has too many rows: {ALL} 10,000 missions"),
        (MUCH, LIST + f"{'9' * 400},1,1\n" * 500, f"makes too much: {ALL} 10,000,000 characters"),
        (f"{BEDS}x = [{'1,' * 100}]\n", MANY, f"makes too much: {ALL} 1,000,000 values"),
        (BEDS, ",".join(map("c{}".format, range(1_001))) + "\n1\n", "has more than 1,000 columns"),
        (BEDS, "n" * 200_000 + "\n1\n", "cannot be read in row 1: a value is longer than 131,072"),
        (BEDS, "n" * 201 + "\n1\n", "is longer than 200 characters"),
    ],
)  # fmt: skip
def test_lists_make_only_so_much_and_it_is_counted_before(
    tmp_path: Path, text: str, rows: str, sentence: str
) -> None:
    """In sum."""
    told = [one for one in said(tmp_path, text, rows) if "another mission" not in one]
    assert len(told) == 1 and sentence in told[0]


def test_of_wrong_rows_and_columns_only_so_many_are_looked_at(tmp_path: Path) -> None:
    """A list of 10,000 rows may have as many mistakes, and each is told with its like."""
    told = said(tmp_path, rows=MANY.replace(",1\n", ",x\n"))
    assert (len(told), told[-1]) == (51, "… and 951 more problems")
    columns = ",".join(map("c{}".format, range(1_000)))
    names = "".join(map("{{u{}}}".format, range(8_000)))
    told = said(tmp_path, BEDS.replace("{nr}", names), f"{columns}\n{columns}\n")
    assert len(told) < 60 and "c9, … and 990 more" in told[0]


def test_what_comes_after_another_may_be_named_by_a_column(tmp_path: Path) -> None:
    """One that comes after none that there is is told with its row."""
    text = BEDS.replace("each =", 'after = ["Bed {before}"]\neach =')
    plain = (
        '[[mission]]\nname = "Bed 0"\n[[mission.trip]]\naction = "take_photo"\ntarget = [1, 1]\n'
    )
    rows = "nr,x,y,before\n1,2,3,0\n2,3,3,1\n"
    found = load(tmp_path, plain + text, rows)
    assert [mission.promises.get("after") for mission in found] == [None, ["Bed 0"], ["Bed 1"]]
    [told] = said(tmp_path, plain + text, rows.replace("3,1", "3,9"))
    assert (
        'mission "Bed 2" (beds.csv, row 3): comes after "Bed 9", and there is no such mission'
        in told
    )
    assert told.endswith('(column "before")')


def test_places_in_degrees_have_their_metres(tmp_path: Path) -> None:
    """A height that one row says is asked of all."""
    (tmp_path / "beds.csv").write_text(
        "Bed,Lat,Lon,height\nA,45.4643,9.1902,3\nB,45.4644,9.1904,\n"
    )
    text = BEDS.replace("{nr}", "{Bed}")
    document = parsed("m.toml", text)
    document.folder = tmp_path
    document.landmarks = Landmarks(plane=LocalPlane(45.4642, 9.19))
    field = Airspace(size=(300.0, 200.0), cruise_height=10.0)
    first, second = missions_of(document, APP, field)
    assert first.trips[0].target == pytest.approx((15.642, 11.114, 10.0), abs=0.001)
    assert second.trips[0].target == pytest.approx((31.283, 22.229, 10.0), abs=0.001)
    high = parsed("m.toml", text.replace('"{y}"]', '"{y}", "{z}"]'))
    high.folder, high.landmarks = document.folder, document.landmarks
    with pytest.raises(BadInput, match=r'row 3.*column "z"'):
        missions_of(high, APP, field)
