"""A page of another site, in the same browser, can neither command nor read the station."""

from __future__ import annotations

import json
from collections.abc import Iterator
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from threading import Thread
from typing import Any

import pytest
from playwright.sync_api import Browser, Page

from tests.kit.station import Station, until
from tests.library.station.browser.conftest import Serve
from tests.library.station.browser.exercise import put_in

TRIES = Path(__file__).with_name("other_sites.js").read_text(encoding="utf-8")


@pytest.fixture
def elsewhere(tmp_path: Path) -> Iterator[int]:
    """Another web server of this machine, with the page of an empty folder; its port."""
    empty = partial(SimpleHTTPRequestHandler, directory=str(tmp_path))
    with ThreadingHTTPServer(("127.0.0.1", 0), empty) as server:
        thread = Thread(target=server.serve_forever)
        thread.start()
        yield server.server_address[1]
        server.shutdown()
        thread.join()


@pytest.fixture
def station(serve: Serve) -> Station:
    """A station whose missions fly, slowly."""
    station = put_in(serve("drugs_distribution", "--speed", "1"))
    assert station.post("/api/start", {"id": "start"})[0] == 200
    until(lambda: station.phase == "flying", "the missions fly")
    return station


@pytest.fixture
def page(chrome: Browser) -> Iterator[Page]:
    """A page that is not watched: it is meant to fail."""
    context = chrome.new_context()
    yield context.new_page()
    context.close()


@pytest.mark.parametrize(
    "host", ["localhost", pytest.param("127.0.0.1", marks=pytest.mark.long)]  # another port of ours
)
def test_a_page_elsewhere_can_neither_stop_nor_see_what_flies(
    station: Station, page: Page, elsewhere: int, host: str
) -> None:
    page.goto(f"http://{host}:{elsewhere}/")
    came: dict[str, Any] = page.evaluate(TRIES, station.url.rstrip("/"))
    assert came == {
        "plain": came["plain"],
        "typed": "nothing",
        "beacon": True,  # it says no more than that it was sent
        "socket": "nothing",
        "frame": "nothing",
        "app": "nothing",
        "plan": came["plan"],
        "script": "nothing",
        "map": "nothing",
    }
    assert {came["plain"], came["plan"]} <= {"nothing", "opaque 0 "}
    assert station.phase == "flying"
    refused = [line for line in station.audit() if "refused" in line]
    assert {"POST /api/stop", "OPTIONS /api/stop", "GET /api/live", "GET /api/plan"} <= {
        line["refused"] for line in refused
    }
    assert {line["status"] for line in refused} == {403}
    assert not any("evil" in json.dumps(line.get("given")) for line in station.audit())
