"""Who may ask what, where sessions/loopback.txt and sessions/everywhere.txt do not say it."""

from __future__ import annotations

import pytest
from starlette.requests import HTTPConnection

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

from .asking import Request, without

LOOPBACK = Guard(host="127.0.0.1", port=8765)
EVERYWHERE = Guard(
    host="0.0.0.0", port=8765, names=("ward.example",), token="sesame", watch_token="poppy"
)


def status(guard: Guard, headers: dict[str, str], access: Access) -> int | None:
    asked = Request(method="GET", path="/", query={}, headers=headers, body=b"")
    why = refusal(guard, HTTPConnection(asked.scope("http")), access)
    return None if why is None else why.status


def test_a_connection_that_lives_is_for_pages_of_the_station_and_for_no_browsers() -> None:
    assert status(LOOPBACK, without(origin="http://evil.example"), Access.LIVE) == 403
    assert status(LOOPBACK, without(sec_fetch_site="cross-site"), Access.LIVE) == 403
    assert status(LOOPBACK, without(sec_fetch_site="none"), Access.LIVE) is None
    assert status(LOOPBACK, without("origin", "sec-fetch-site"), Access.LIVE) is None
    assert status(LOOPBACK, without("origin", "sec-fetch-site", "x-pluto"), Access.LIVE) == 403


def test_at_the_usual_port_a_name_has_none() -> None:
    assert status(Guard(host="127.0.0.1", port=80), {"host": "localhost"}, Access.READ) is None


def test_the_token_is_known_to_who_knows_it_and_shows_nowhere() -> None:
    assert role_by(EVERYWHERE, "sesame") == "fly"
    assert role_by(EVERYWHERE, "poppy") == "watch"
    assert role_by(LOOPBACK, "") == "fly"
    for wrong in ("", "sesame ", "\ud800", "s" * 100_000):
        assert role_by(EVERYWHERE, wrong) is None
    assert "sesame" not in repr(EVERYWHERE)


def test_only_this_machine_reaches_loopback_unless_it_has_another_name() -> None:
    for host in ("127.0.0.1", "127.8.8.8", "::1", "localhost"):
        assert is_loopback(host) and not needs_token(host, ())
    for host in ("0.0.0.0", "::", "192.168.0.7", "localhost.example", ""):
        assert not is_loopback(host) and needs_token(host, ())
    assert needs_token("127.0.0.1", ("ward.example",))


def test_a_name_is_what_a_browser_says() -> None:
    for name in ("ward.example", "192.0.2.7", "ward_1"):
        assert proper_name(name) == name
    assert proper_name("WARD.example:8443") == "ward.example:8443"
    assert proper_name("ward.example:443") == "ward.example"
    assert proper_name("[2001:db8::1]:80") == "[2001:db8::1]"
    for name in ("", "https://ward.example", "ward.example/", "a:x", "a:99999", "a b", "*", "é.x"):
        with pytest.raises(BadInput, match="a name is like"):
            proper_name(name)
