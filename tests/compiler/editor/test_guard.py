"""Who may use the editor: its own pages, with the token."""

from __future__ import annotations

import pytest

from plutoc.editor.guard import Guard, headers, is_ours, is_own_page, knows

LOOPBACK = Guard(host="127.0.0.1", port=8765, token="sesame")
EVERYWHERE = Guard(host="0.0.0.0", port=8765, token="sesame")


@pytest.mark.parametrize(
    "host", ["127.0.0.1:8765", "localhost:8765", "[::1]:8765", "LOCALHOST:8765"]
)
def test_on_loopback_it_goes_by_these_names(host: str) -> None:
    assert is_ours(LOOPBACK, {"host": host}, "127.0.0.1")


BENT = (
    *("", "127.0.0.1", "127.0.0.1:8766", "127.0.0.1:08765x", "127.0.0.1:8765, 127.0.0.1:8765"),
    *(
        "127.0.0.2:8765",
        "localhost",
        "localhost.:8765",
        "rebound.example:8765",
        "[::1]",
        "::1:8765",
    ),
    *("127.0.0.1.rebound.example:8765", "localhost:8765@rebound.example", "192.168.0.7:8765"),
    *("0.0.0.0:8765", "2130706433:8765", "127.1:8765", "127.0.0.1:8765\x00"),
)


@pytest.mark.parametrize("host", BENT)
def test_a_name_that_was_bent_to_this_machine_gets_nothing(host: str) -> None:
    assert not is_ours(LOOPBACK, {"host": host}, "127.0.0.1")
    assert not is_ours(LOOPBACK, {"x-forwarded-host": "127.0.0.1:8765"}, "127.0.0.1")


def test_at_the_usual_port_the_name_has_none() -> None:
    assert is_ours(Guard(host="127.0.0.1", port=80), {"host": "localhost"}, "127.0.0.1")


@pytest.mark.parametrize(
    ("host", "local", "is_so"),
    [
        ("192.168.0.7:8765", "192.168.0.7", True),
        ("192.168.0.7:8765", "::ffff:192.168.0.7", True),
        ("[fe80::1]:8765", "fe80::1%eth0", True),
        ("192.168.0.8:8765", "192.168.0.7", False),
        ("localhost:8765", "127.0.0.1", True),
        ("localhost:8765", "192.168.0.7", False),
        ("rebound.example:8765", "192.168.0.7", False),
        ("0.0.0.0:8765", "192.168.0.7", False),
    ],
)
def test_elsewhere_it_goes_by_the_address_that_was_reached(
    host: str, local: str, is_so: bool
) -> None:
    assert is_ours(EVERYWHERE, {"host": host}, local) is is_so


HOST = "127.0.0.1:8765"


@pytest.mark.parametrize(
    "origin",
    ["http://evil.example", "null", "http://127.0.0.1:8766", "http://localhost:8765", "", "x"],
)
def test_a_page_of_another_site_may_ask_nothing(origin: str) -> None:
    assert not is_own_page({"host": HOST, "origin": origin})


def test_its_own_pages_and_programs_may() -> None:
    assert is_own_page({"host": HOST, "origin": f"http://{HOST}"})
    assert is_own_page({"host": "ward.example", "origin": "https://ward.example"})  # behind TLS
    assert is_own_page({"host": HOST})


def test_a_browser_that_says_cross_site_is_believed() -> None:
    sent = {"host": HOST, "origin": f"http://{HOST}", "sec-fetch-site": "cross-site"}
    assert not is_own_page(sent)


def test_the_token_is_known_to_who_knows_it_and_shows_nowhere() -> None:
    assert knows(LOOPBACK, "sesame")
    for wrong in ("", "sesame ", "Sesame", "\ud800", "s" * 100_000):
        assert not knows(LOOPBACK, wrong)
    assert "sesame" not in repr(LOOPBACK)
    assert Guard(host="::1", port=1).token != Guard(host="::1", port=1).token


@pytest.mark.parametrize(
    ("host", "address"),
    [
        ("127.0.0.1", "http://127.0.0.1:8765/?token=sesame"),
        ("::1", "http://[::1]:8765/?token=sesame"),
        ("0.0.0.0", "http://127.0.0.1:8765/?token=sesame"),
    ],
)
def test_the_address_can_be_opened(host: str, address: str) -> None:
    assert Guard(host=host, port=8765, token="sesame").address == address


def test_pages_run_our_scripts_only() -> None:
    policy = headers(page=True)["Content-Security-Policy"]
    assert "script-src 'self';" in policy
    assert "unsafe" not in policy
    assert "style-src 'self';" in policy
    assert "default-src 'none'" in headers()["Content-Security-Policy"]
