"""No drone is dropped by mistake: "Cut motors" is held down, and Stop is not."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from playwright.sync_api import FloatRect, Locator, Page, expect

from tests.station.browser.conftest import TABLET, Serve, Visit
from tests.station.browser.exercise import put_in
from tests.station.browser.serving import Station, until
from tests.station.browser.steps import open_page, start

HELD = "(one) => Number(one.style.getPropertyValue('--held'))"
ABOVE = "(one) => one.closest('ul').prepend(Object.assign(document.createElement('li'),{ style: 'height: 90px' }))"
ALONE = """
async () => {
  const { holdButton } = await import("/pages/table.js");
  const box = holdButton("Drop", "cut", () => { window.dropped += 1; });
  window.dropped = 0;
  document.body.prepend(box);
  box.style.cssText = "position: fixed; z-index: 99; top: 0; left: 0";
}
"""
HIDDEN = "() => document.dispatchEvent(new Event('visibilitychange'))"
STUCK = """
() => { for (const since = performance.now(); performance.now() - since < 1100;); }
"""


@pytest.fixture
def aloft(serve: Serve, visit: Visit) -> Iterator[tuple[Station, Page, Locator]]:
    """A slow flight, and the button that drops the first drone that is in the air."""
    station = put_in(serve("drugs_distribution", "--speed", "1"))
    page = visit(station)
    start(page)
    open_page(page, "Monitor")
    cut = page.get_by_role("button", name="cut motors of").first
    cut.wait_for()
    yield station, page, cut


@pytest.fixture
def alone(ward: Station, visit: Visit) -> Iterator[tuple[Page, Locator]]:
    """The button by itself, which counts what it does."""
    page = visit(ward, size=TABLET, touch=True)
    page.get_by_role("tab", name="Missions").wait_for()
    page.evaluate(ALONE)
    yield page, page.get_by_role("button", name="Drop", exact=True)


def middle(button: Locator) -> tuple[float, float]:
    box: FloatRect | None = button.bounding_box()
    assert box is not None
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def drone_of(cut: Locator) -> str:
    return cut.inner_text().split()[-1].rstrip("?")


def status(station: Station, drone: str) -> str:
    return next(str(one["status"]) for one in station.now()["drones"] if one["id"] == drone)


def time(station: Station) -> float:
    return float(station.now()["state"]["time"])


def dropped(page: Page) -> int:
    count: int = page.evaluate("() => window.dropped")
    return count


def held(button: Locator) -> float:
    """Return which part of the second has gone by."""
    share: float = button.evaluate(HELD)
    return share


def test_a_double_click_drops_no_drone_and_a_second_of_holding_does(
    aloft: tuple[Station, Page, Locator],
) -> None:
    station, page, cut = aloft
    drone, before = drone_of(cut), time(station)
    cut.dblclick()
    page.mouse.click(*middle(cut))
    until(lambda: time(station) > before + 1, "what was pressed has been dealt with")
    assert status(station, drone) != "LOST"
    page.mouse.move(*middle(cut))
    page.mouse.down()
    until(lambda: held(cut) > 0.1, "it is seen to be held")
    line = page.get_by_role("region", name="Drones").get_by_role("listitem")
    expect(line.filter(has_text=drone).filter(has_text="Lost")).to_have_count(1)
    page.mouse.up()
    assert status(station, drone) == "LOST"


def test_letting_go_too_early_drops_nothing(alone: tuple[Page, Locator]) -> None:
    page, button = alone
    page.mouse.move(*middle(button))
    page.mouse.down()
    until(lambda: held(button) > 0.2, "a part of the second has gone by")
    page.mouse.up()
    assert (held(button), dropped(page)) == (0, 0)
    expect(page.get_by_label("type “cut”")).to_be_focused()


def test_keys_that_repeat_drop_nothing_and_a_key_that_is_held_does(
    alone: tuple[Page, Locator],
) -> None:
    page, button = alone
    page.keyboard.down("Enter")  # elsewhere; it repeats where the focus has come to
    button.focus()
    for _ in range(30):
        page.keyboard.down("Enter")
    assert held(button) == 0
    page.keyboard.up("Enter")
    for _ in range(5):
        page.keyboard.press(" ")
        button.focus()
    assert dropped(page) == 0
    page.keyboard.down(" ")
    until(lambda: dropped(page) == 1, "it is held for a second")
    page.keyboard.up(" ")
    assert dropped(page) == 1


def test_a_button_that_moves_away_from_the_pointer_is_not_held_any_more(
    aloft: tuple[Station, Page, Locator],
) -> None:
    station, page, cut = aloft
    drone = drone_of(cut)
    page.mouse.move(*middle(cut))
    page.mouse.down()
    until(lambda: held(cut) > 0.1, "it is held")
    cut.evaluate(ABOVE)
    until(lambda: held(cut) == 0, "what lies under the pointer is another line")
    page.mouse.up()
    assert status(station, drone) != "LOST"


def test_a_page_that_is_stuck_takes_no_click_for_a_hold(alone: tuple[Page, Locator]) -> None:
    page, button = alone
    page.mouse.move(*middle(button))
    page.mouse.down()
    until(lambda: held(button) > 0, "it is held")
    page.evaluate(STUCK)
    page.mouse.up()
    assert dropped(page) == 0


@pytest.mark.parametrize("away", [HIDDEN, "() => window.dispatchEvent(new Event('blur'))"])
def test_going_to_another_tab_or_window_holds_it_no_longer(
    alone: tuple[Page, Locator], away: str
) -> None:
    """Without focus on the button, as in some browsers, the pointer is not heard of again."""
    page, button = alone
    page.mouse.move(*middle(button))
    page.mouse.down()
    until(lambda: held(button) > 0.1, "it is held")
    page.evaluate(away)
    assert (held(button), dropped(page)) == (0, 0)


def test_a_finger_holds_it_and_without_holding_a_word_does_it(alone: tuple[Page, Locator]) -> None:
    """A screen reader presses a button without holding it: it hears what to do instead."""
    page, button = alone
    assert "type “cut”" in (button.get_attribute("title") or "")
    finger = page.context.new_cdp_session(page)
    x, y = middle(button)
    finger.send(
        "Input.dispatchTouchEvent", {"type": "touchStart", "touchPoints": [{"x": x, "y": y}]}
    )
    until(lambda: dropped(page) == 1, "a finger holds it")
    finger.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
    button.evaluate("(one) => one.click()")
    word = page.get_by_label("type “cut”")
    expect(word).to_be_focused()
    word.fill("no")
    word.press("Enter")
    assert dropped(page) == 1
    word.fill("cut")
    word.press("Enter")
    assert dropped(page) == 2
    expect(word).to_be_hidden()
    expect(button).to_be_focused()
