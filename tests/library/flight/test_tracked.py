"""What is known of what moves, and how much of that a journal is given."""

from __future__ import annotations

from pluto_fleet.flight.tracked import KEPT, MOST, TrackedObjects


def reported(x: float, kind: str | None = None) -> dict[str, object]:
    """Return a report of one object on a line."""
    return {"t1": {"at": [x, 0.0, 0.0]} | ({} if kind is None else {"kind": kind})}


def test_a_journal_has_a_place_a_second_of_what_moves_and_a_sign_of_life_of_what_stands() -> None:
    objects = TrackedObjects()
    told = [objects.take(reported(0.5 * step, "person"), 0.5 * step) for step in range(5)]
    assert [[*news] for news in told] == [["t1"], [], ["t1"], [], ["t1"]]
    assert [news["t1"].get("kind") for news in told if news] == ["person", None, None]
    stands = [objects.take(reported(2.0), 2.0 + 0.5 * step) for step in range(1, 5)]
    assert [bool(news) for news in stands] == [False, False, False, True]


def test_what_is_not_reported_any_more_is_known_for_a_minute_as_it_was_seen_last() -> None:
    objects = TrackedObjects()
    for second in range(100):
        objects.take(reported(float(second)), float(second))
    [(id, one)] = objects.now(99.0 + KEPT)
    assert (id, one.at, one.seen) == ("t1", (99.0, 0.0, 0.0), 99.0)
    assert [when for when, _ in one.way] == [float(second) for second in range(39, 100)]
    assert [*objects.now(99.1 + KEPT)] == []


def test_what_a_tracker_saw_a_while_ago_was_there_then() -> None:
    objects = TrackedObjects()
    news = objects.take({"t1": {"at": [1.0, 0.0, 0.0], "ago": 1.5}}, 10.0)
    [(_, one)] = objects.now(10.0)
    assert (news["t1"]["ago"], one.seen, one.way[0][0]) == (1.5, 8.5, 8.5)


def test_of_a_flood_of_objects_the_last_are_known() -> None:
    objects = TrackedObjects()
    for number in range(5 * MOST):
        objects.take({f"t{number}": {"at": [0.0, 0.0, 0.0]}}, 1.0)
    assert [id for id, _ in objects.now(1.0)] == [f"t{4 * MOST + one}" for one in range(MOST)]
