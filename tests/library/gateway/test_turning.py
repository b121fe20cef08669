"""A drone that is sent elsewhere on its way: without a stop, with one answer, and never near another."""

from __future__ import annotations

from math import dist
from typing import Any

from pluto_fleet.jobs.flown import BROKEN_OFF, DONE
from pluto_fleet.shared.domain.model import Point
from pluto_fleet.shared.time.kernel import FLEET
from tests.library.gateway.flights import THERE, Commander, Field, Task


def go(link: Commander, heard: list[Any], *target: float, seconds: float = 0.0) -> int:
    """Send cf1 to a point, and listen to what comes of it."""
    number = link._expect(heard.append)
    order = {"do": "go", "id": number, "drone": "cf1", "stops": [target], "seconds": seconds}
    link.link.send(order)
    return number


def up(field: Field, link: Commander) -> None:
    """Have cf1 hover above its dock."""
    field.kernel.run(field.kernel.spawn(link.goes("cf1", (1.0, 1.0, 1.2)), FLEET, "up"))


def test_what_goes_somewhere_is_sent_on_without_a_stop_and_answers_the_last_order() -> None:
    field = Field(measures=True)
    link = field.link(1)
    up(field, link)
    first = list[object]()
    last = list[object]()
    go(link, first, 9.0, 1.0, 1.2)
    field.advance(4.0)  # it is at (3, 1) by then
    go(link, last, 3.0, 5.0, 1.2)
    field.advance(7.9)
    assert last == []
    field.advance(0.2)  # it has kept its speed: 8 s for 4 m
    assert (first, last) == ([], [None])
    assert field.navigation.bodies["cf1"].location == (3.0, 5.0, 1.2)
    go(link, last, 4.0, 5.0, 1.2)
    field.advance(5.0)
    _, *legs = (told["ended"] for told in link.flown if told["what"] == "leg")
    assert legs == [BROKEN_OFF, DONE]  # nobody learns from the first how fast a leg is


def test_an_order_that_came_in_the_place_of_another_is_cancelled_by_its_own_number() -> None:
    field = Field()
    link = field.link(1)
    up(field, link)
    go(link, [], 9.0, 1.0, 1.2)
    field.advance(2.0)
    number = go(link, [], 9.0, 2.0, 1.2)
    field.advance(2.0)
    link.link.send({"do": "cancel", "order": number})
    here = field.navigation.bodies["cf1"].location
    field.advance(5.0)
    assert field.navigation.bodies["cf1"].location == here


def test_a_job_that_is_sent_elsewhere_is_done_there_once_and_reported_once() -> None:
    field = Field()
    link = field.link(1)
    heard = list[object]()
    job = Task()
    link.fly(job, heard.append)
    redirect = {**job.order(99), "do": "redirect"}
    link.link.send({**redirect, "stops": [(2.0, 5.0, 1.2)]})  # while it takes off
    field.advance(8.0)
    elsewhere: Point = (1.0, 5.0, 1.2)
    link.link.send({**redirect, "stops": [elsewhere]})
    field.advance(60.0)
    assert len(heard) == 1
    assert field.deeds == [job.id]
    assert field.navigation.bodies["cf1"].location == elsewhere


def test_one_that_is_sent_where_another_is_goes_on_to_where_it_was_to_go_and_yields() -> None:
    field = Field()
    link = field.link(1)
    other = Task(id="o", drone="cf2", stops=((3.0, 3.0, 1.2),), action=None, item=None)
    link.fly(other, lambda _: None)
    up(field, link)
    field.advance(20.0)
    heard = list[object]()
    go(link, heard, 5.0, 1.0, 1.2)
    field.advance(4.0)
    go(link, heard, 3.0, 3.2, 1.2)
    one, two = (field.navigation.bodies[id] for id in ("cf1", "cf2"))
    for _ in range(100):
        field.advance(0.1)
        assert dist(one.location, two.location) >= 0.5
    assert one.location[0] > 3.1  # it did not stop where it was told so
    field.kernel.run(field.kernel.spawn(link.home("cf2"), FLEET, "away"))
    field.advance(40.0)
    assert heard == [None]
    assert one.location == (3.0, 3.2, 1.2)


def test_one_that_waits_for_its_way_asks_for_the_other() -> None:
    field = Field()
    link = field.link(1)
    other = Task(id="o", drone="cf2", stops=(THERE,), action=None, item=None)
    link.fly(other, lambda _: None)
    up(field, link)
    field.advance(30.0)
    heard = list[object]()
    go(link, heard, *THERE)  # which is taken
    field.advance(1.0)
    go(link, heard, 1.0, 3.0, 1.2)
    field.advance(6.0)
    assert heard == [None]
    assert field.navigation.bodies["cf1"].location == (1.0, 3.0, 1.2)


def test_a_real_drone_may_shoot_past_where_it_turns_and_others_keep_away_from_there() -> None:
    """For two seconds, as after a stop: then it is surely on its new way."""
    field = Field(homes=((1, 1), (3.9, 1)), slack=0.15)
    link = field.link(1)
    up(field, link)
    go(link, [], 9.0, 1.0, 1.2)
    field.advance(0.1)
    other = Task(id="o", drone="cf2", stops=((3.9, 1.0, 1.2),), action=None, item=None)
    link.fly(other, lambda _: None)  # which is on the way of the first
    field.advance(3.9)  # that is at (3, 1) by then
    go(link, [], 3.0, 5.0, 1.2)
    beside = field.navigation.bodies["cf2"]
    field.advance(1.5)
    assert beside.landed
    field.advance(2.0)
    assert not beside.landed
