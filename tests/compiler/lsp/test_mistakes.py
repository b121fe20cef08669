"""A mistake of ours goes into the log of the editor, and ends nothing."""

from __future__ import annotations

import pytest
from lsprotocol.types import LogMessageParams

from plutoc.lsp.answers import Answers
from plutoc.lsp.server import Server

URI = "untitled:farm.pluto"


@pytest.mark.parametrize(("asked", "shows"), [("", False), ("1", True)])
def test_a_mistake_of_ours_is_logged_with_its_place_where_that_is_asked_for(
    monkeypatch: pytest.MonkeyPatch, asked: str, shows: bool
) -> None:
    logged: list[str] = []

    def broken(*_: object) -> None:
        raise KeyError("x")

    def log(params: LogMessageParams) -> None:
        logged.append(params.message)

    monkeypatch.setenv("PLUTO_DEBUG", asked)
    monkeypatch.setattr(Answers, "diagnostics", broken)
    server = Server()
    monkeypatch.setattr(server, "window_log_message", log)
    server.apps.open(URI, "pluto 1\n", 1, "pluto")
    server.publish(URI)
    (said,) = logged
    assert said.startswith("internal error (P9001): KeyError: 'x'")
    assert ("Traceback" in said) == shows
