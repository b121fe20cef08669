"""Who may ask what."""

from __future__ import annotations

import pytest

from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.station.web.guard import (
    Access,
    Guard,
    is_loopback,
    needs_token,
    proper_name,
    refusal,
    role_by,
)
from pluto_fleet.station.web.http import Request

from .asking import OURS, without

LOOPBACK = Guard(host="127.0.0.1", port=8765)
EVERYWHERE = Guard(
    host="0.0.0.0", port=8765, names=("ward.example",), token="sesame", watch_token="poppy"
)


def status(
    guard: Guard, headers: dict[str, str], access: Access, local: str = "127.0.0.1"
) -> int | None:
    why = refusal(guard, Request(method="", path="", headers=headers, local=local), access)
    return None if why is None else why.status


@pytest.mark.parametrize("access", Access)
def test_a_page_of_the_station_may_ask_everything(access: Access) -> None:
    assert status(LOOPBACK, OURS, access) is None


@pytest.mark.parametrize("host", ["127.0.0.1:8765", "localhost:8765", "[::1]:8765"])
def test_a_station_on_loopback_goes_by_these_names(host: str) -> None:
    assert status(LOOPBACK, {"host": host}, Access.READ) is None


BENT = [
    "127.0.0.1",
    "127.0.0.1:8766",
    "127.0.0.1:08765x",
    "127.0.0.2:8765",
    "localhost",
    "localhost.:8765",
    "rebound.example:8765",
    "127.0.0.1.rebound.example:8765",
    "localhost:8765@rebound.example",
    "[::1]",
    "::1:8765",
    "192.168.0.7:8765",
    "0.0.0.0:8765",
    "2130706433:8765",
    "127.1:8765",
]


@pytest.mark.parametrize(
    "host", [*BENT, "", "127.0.0.1:8765, 127.0.0.1:8765", "127.0.0.1:8765\x00"]
)
@pytest.mark.parametrize("access", Access)
def test_a_name_that_was_bent_to_this_machine_gets_nothing(host: str, access: Access) -> None:
    assert status(LOOPBACK, without(host=host), access) == 403
    assert status(LOOPBACK, without("host"), access) == 403


def test_at_the_usual_port_the_name_has_none() -> None:
    assert status(Guard(host="127.0.0.1", port=80), {"host": "localhost"}, Access.READ) is None


@pytest.mark.parametrize(
    ("host", "local", "is_ours"),
    [
        ("192.168.0.7:8765", "192.168.0.7", True),
        ("192.168.0.7:8765", "::ffff:192.168.0.7", True),
        ("[fe80::1]:8765", "fe80::1%eth0", True),
        ("192.168.0.8:8765", "192.168.0.7", False),
        ("localhost:8765", "127.0.0.1", True),
        ("localhost:8765", "192.168.0.7", False),
        ("ward.example:8765", "192.168.0.7", True),
        ("ward.example", "192.168.0.7", True),
        ("ward.example:9000", "192.168.0.7", False),
        ("other.example:8765", "192.168.0.7", False),
        ("0.0.0.0:8765", "192.168.0.7", False),
    ],
)
def test_elsewhere_it_goes_by_its_addresses_and_the_names_it_was_given(
    host: str, local: str, is_ours: bool
) -> None:
    headers = {"host": host, "authorization": "Bearer sesame"}
    assert status(EVERYWHERE, headers, Access.READ, local) == (None if is_ours else 403)


def test_a_name_may_have_a_port_of_its_own() -> None:
    guard = Guard(host="127.0.0.1", port=8765, names=("ward.example:8443",))
    for host, why in (("ward.example:8443", None), ("ward.example", 403)):
        headers = {"host": host, "origin": f"https://{host}"}
        assert status(guard, headers, Access.READ) == why


FOREIGN = ["http://evil.example", "null", "http://127.0.0.1:8766", "http://localhost:8765", "", "x"]


@pytest.mark.parametrize("origin", FOREIGN)
@pytest.mark.parametrize("access", [Access.READ, Access.COMMAND, Access.LIVE])
def test_a_page_of_another_site_may_ask_nothing(origin: str, access: Access) -> None:
    assert status(LOOPBACK, without(origin=origin), access) == 403


@pytest.mark.parametrize("site", ["cross-site", "same-site", "none"])
def test_a_browser_that_says_cross_site_is_believed(site: str) -> None:
    headers = without(sec_fetch_site=site)
    assert status(LOOPBACK, headers, Access.COMMAND) == 403
    assert status(LOOPBACK, headers, Access.READ) == (None if site == "none" else 403)
    assert status(LOOPBACK, headers, Access.LIVE) == (403 if site == "cross-site" else None)


@pytest.mark.parametrize("mark", [None, "0", "", "1, 1", "true"])
def test_a_command_needs_the_mark(mark: str | None) -> None:
    headers = without("x-pluto") if mark is None else without(x_pluto=mark)
    assert status(LOOPBACK, headers, Access.COMMAND) == 403


def test_who_is_no_browser_needs_no_origin_but_the_mark() -> None:
    headers = without("origin", "sec-fetch-site")
    assert status(LOOPBACK, headers, Access.COMMAND) is None
    assert status(LOOPBACK, headers, Access.LIVE) is None
    del headers["x-pluto"]
    assert status(LOOPBACK, headers, Access.COMMAND) == 403
    assert status(LOOPBACK, headers, Access.LIVE) == 403


@pytest.mark.parametrize(
    "bearer", ["", "sesame", "Basic sesame", "Bearer", "Bearer sesam", "Bearer Sesame", "Bearer é"]
)
def test_elsewhere_nothing_is_told_without_the_token(bearer: str) -> None:
    headers = {**OURS, "host": "ward.example", "origin": "http://ward.example"}
    for access in (Access.READ, Access.COMMAND):
        assert status(EVERYWHERE, {**headers, "authorization": bearer}, access) == 401
        assert status(EVERYWHERE, {**headers, "authorization": "bearer sesame"}, access) is None


def test_the_pages_themselves_need_no_token() -> None:
    assert status(EVERYWHERE, {"host": "ward.example"}, Access.PAGE) is None


def test_the_token_is_known_to_who_knows_it() -> None:
    assert role_by(EVERYWHERE, "sesame") == "fly"
    assert role_by(EVERYWHERE, "poppy") == "watch"
    assert role_by(LOOPBACK, "") == "fly"
    for wrong in ("", "sesame ", "\ud800", "s" * 100_000):
        assert role_by(EVERYWHERE, wrong) is None


def test_what_a_proxy_says_is_not_believed() -> None:
    headers = without(
        "host", x_forwarded_host="127.0.0.1:8765", x_forwarded_for="127.0.0.1", forwarded="x"
    )
    assert status(LOOPBACK, {**headers, "host": "evil.example"}, Access.COMMAND) == 403


def test_the_token_shows_nowhere() -> None:
    assert "sesame" not in repr(EVERYWHERE)


@pytest.mark.parametrize(
    ("host", "is_so"),
    [
        ("127.0.0.1", True),
        ("127.8.8.8", True),
        ("::1", True),
        ("localhost", True),
        ("0.0.0.0", False),
        ("::", False),
        ("192.168.0.7", False),
        ("localhost.example", False),
        ("", False),
    ],
)
def test_only_this_machine_reaches_loopback(host: str, is_so: bool) -> None:
    assert is_loopback(host) is is_so
    assert needs_token(host, ()) is not is_so


@pytest.mark.parametrize(
    ("name", "browsers_say"),
    [
        ("ward.example", "ward.example"),
        ("WARD.example:8443", "ward.example:8443"),
        ("ward.example:443", "ward.example"),
        ("192.0.2.7", "192.0.2.7"),
        ("[2001:db8::1]:80", "[2001:db8::1]"),
        ("ward_1", "ward_1"),
    ],
)
def test_a_name_is_what_a_browser_says(name: str, browsers_say: str) -> None:
    assert proper_name(name) == browsers_say


@pytest.mark.parametrize(
    "name",
    ["", "https://ward.example", "ward.example/", "ward.example:x", "a:99999", "a b", "*", "é.x"],
)
def test_what_no_browser_says_is_no_name(name: str) -> None:
    with pytest.raises(BadInput, match="a name is like"):
        proper_name(name)


def test_a_station_with_another_name_is_reached_by_others() -> None:
    assert needs_token("127.0.0.1", ("ward.example",))
