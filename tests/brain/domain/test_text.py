"""Numbers, units and names as people write and read them."""

from __future__ import annotations

from collections.abc import Callable
from datetime import time

import pytest

from pluto_fleet.shared.domain import text
from pluto_fleet.shared.domain.fields import time_of_day
from pluto_fleet.shared.domain.quantities import (
    UNITS,
    Type,
    parse_quantity,
    time_from,
    units_of,
    whole,
)


@pytest.mark.parametrize(
    ("write", "value", "written"),
    [
        (text.number, 2.0, "2"),
        (text.number, 0.5, "0.5"),
        (text.number, 4 / 3, "1.333"),
        (text.number, 100.0, "100"),
        (text.number, -0.0001, "0"),
        (text.place, (1.25, 30.0, 2.0), "(1.25, 30)"),
        (text.duration, 0.0, "0 s"),
        (text.duration, 42.54, "42.5 s"),
        (text.duration, 59.9, "59.9 s"),
        (text.duration, 60.0, "1 min"),
        (text.duration, 200.4, "3 min 20 s"),
        (text.duration, 3_600.0, "1 h"),
        (text.duration, 7_530.0, "2 h 5 min"),
        (text.mass, 0.008, "8 g"),
        (text.mass, 0.9999, "999.9 g"),
        (text.mass, 1.0, "1 kg"),
        (text.mass, 1.5, "1.5 kg"),
        (text.percent, 0.205, "20 %"),
        (lambda count: text.counted(count, "trip"), 0, "0 trips"),
        (lambda count: text.counted(count, "trip"), 1, "1 trip"),
        (lambda count: text.counted(count, "trip"), 2, "2 trips"),
        (text.quoted, "a\nb", '"a\\nb"'),
        (text.quoted, "x" * 60, f'"{"x" * 60}"'),
        (text.quoted, "x" * 61, f'"{"x" * 59}…"'),
        (lambda long: text.bounded(long, 3), "abc", "abc"),
        (lambda long: text.bounded(long, 3), "abcd" * 300, "abc… (1,200 characters in all)"),
        (text.shown, [2.5, None, {"b": 1, "a": (1,)}], "[2.5, None, {'a': (1,), 'b': 1}]"),
        (text.said, ValueError("no"), "ValueError: no"),
        (text.said, ValueError(), "ValueError"),
        (text.said, KeyError("no"), "KeyError: 'no'"),
        (text.said, ValueError(1, 2), "ValueError: (1, 2)"),
    ],
)
def test_what_people_read(write: Callable[[object], str], value: object, written: str) -> None:
    assert write(value) == written


@pytest.mark.parametrize(
    ("written", "kind", "si"),
    [
        ("3 min", Type.TIME, 180.0),
        ("2h", Type.TIME, 7_200.0),
        ("250 ms", Type.TIME, 0.25),
        ("7", Type.TIME, 7.0),
        ("40 cm", Type.LENGTH, 0.4),
        ("+1.5 km", Type.LENGTH, 1_500.0),
        ("-2 mm", Type.LENGTH, -0.002),
        ("50 mg", Type.MASS, 5e-05),
        ("8 g", Type.MASS, 0.008),
        ("180 deg", Type.ANGLE, 3.14159265358979),
        ("20 %", Type.PERCENT, 0.2),
        ("36 km/h", Type.SPEED, 10.0),
        ("21 C", Type.TEMPERATURE, 294.15),
        ("21 K", Type.TEMPERATURE, 21.0),
    ],
)
def test_what_people_write(written: str, kind: Type, si: float) -> None:
    assert parse_quantity(written, kind) == si


@pytest.mark.parametrize(
    ("written", "says"),
    [
        ("soon", "is not a time: write a number and a unit (ms, s, min, h)"),
        ("3 lightyears", "is not a time: write a number and a unit (ms, s, min, h)"),
        ("3 m", "is a length, not a time: it takes ms, s, min, h"),
        ("9" * 400, "is not a finite number"),
    ],
)
def test_what_is_no_time_is_told(written: str, says: str) -> None:
    with pytest.raises(ValueError) as told:
        parse_quantity(written, Type.TIME)
    assert str(told.value) == says


def test_every_unit_is_one_of_its_type() -> None:
    assert {unit for kind in Type for unit in units_of(kind)} == set(UNITS)
    assert units_of(Type.INT) == ()


@pytest.mark.parametrize("written", ["0", "0 s", "-1 s", "3 m", ""])
def test_a_time_to_end_at_is_more_than_0(written: str) -> None:
    assert (time_from("2 h"), time_from("0.001")) == (7_200.0, 0.001)
    with pytest.raises(ValueError, match='^"' + written):
        time_from(written)


def test_a_whole_number_of_a_flag_is_of_bounded_length() -> None:
    """Python refuses a long one with a hint that nobody can follow."""
    assert [whole(one) for one in ("7", "-3", "9" * 600)] == [7, -3, int("9" * 600)]
    for written, sentence in (
        ("x", '"x" is not a whole number'),
        ("9" * 5000, '9…" is not a whole number'),
    ):
        with pytest.raises(ValueError, match=sentence):
            whole(written)


def test_a_time_of_day_is_seconds_since_midnight() -> None:
    assert [time_of_day(one) for one in ("08:00", "8:01", "23:59:59", "00:00", time(1, 2, 3))] == [
        28_800.0, 28_860.0, 86_399.0, 0.0, 3_723.0,
    ]  # fmt: skip
    for wrong in ("24:00", "8:60", "08", "08:00:60", 8, None):
        with pytest.raises(ValueError, match='is not a time of day: write it like "08:00"'):
            time_of_day(wrong)
