"""A file as it is being typed: broken, unsaved, changed elsewhere."""

from __future__ import annotations

import random
import subprocess
import sys
from pathlib import Path

import pytest
from lsprotocol import types

from plutoc.cli import main
from plutoc.lsp.answers import Answers
from plutoc.lsp.places import Places
from plutoc.lsp.server import Server
from plutoc.source import Source, Span
from tests.compiler.lsp.client import Client, uri_of
from tests.compiler.lsp.conftest import EXAMPLES, talk
from tests.kit.command import run
from tests.test_cases import diagnostics_of

TEXT = (EXAMPLES / "alfalfa" / "app.pluto").read_text(encoding="utf-8")
URI = "untitled:alfalfa.pluto"


def test_a_text_that_is_torn_up_is_followed_and_always_answered() -> None:
    """The server's text is the client's, after any changes: its findings are those of that text."""
    chance = random.Random(1)
    signs = ("\n", "\r\n", "\r", "🌼", "(", "]", '"', "#", "->", "when ", "\u2028", "\x00", "")

    async def act(client: Client) -> str:
        text = TEXT
        client.open(URI, text)
        document = types.TextDocumentIdentifier(uri=URI)
        for version in range(1, 16):
            places = Places(text=text)
            start = chance.randrange(len(text))
            span = Span(start, min(start + chance.randrange(9), len(text)))
            new = chance.choice(signs)
            client.change(URI, version, places.range(span), new)
            start, end = places.span(places.range(span))
            text = text[:start] + new + text[end:]
            at = Places(text=text).position(chance.randrange(len(text)))
            whole = types.Range(types.Position(0, 0), types.Position(999, 0))
            await client.text_document_hover_async(types.HoverParams(document, at))
            await client.text_document_completion_async(types.CompletionParams(document, at))
            await client.text_document_inlay_hint_async(types.InlayHintParams(document, whole))
            await client.text_document_document_symbol_async(types.DocumentSymbolParams(document))
            await client.text_document_folding_range_async(types.FoldingRangeParams(document))
            asked = types.CodeActionParams(
                document, types.Range(at, at), types.CodeActionContext([])
            )
            await client.text_document_code_action_async(asked)
            found = await client.findings(URI, version)
            wanted = diagnostics_of(Source(URI, text), None)
            assert [one.code for one in found] == [one.code for one in wanted]
        return text

    assert talk(act) != TEXT


def test_hooks_count_as_they_are_in_the_editor_and_then_as_they_are_on_the_disk(
    alfalfa: Path,
) -> None:
    app, hooks = uri_of(alfalfa / "app.pluto"), alfalfa / "hooks.py"
    code = hooks.read_text(encoding="utf-8")
    broken = code.replace("def find_blooms(mission: Mission, ", "def find_blooms(")

    async def act(client: Client) -> list[list[str]]:
        async def codes() -> list[str]:
            document = types.TextDocumentIdentifier(app)
            await client.text_document_folding_range_async(types.FoldingRangeParams(document))
            found = client.published.get(uri_of(hooks))
            return [str(one.code) for one in found.diagnostics] if found else []

        client.open(app, TEXT)
        await client.findings(app)
        seen = [await codes()]
        client.open(uri_of(hooks), broken)
        seen.append(await codes())
        closing = types.TextDocumentIdentifier(uri_of(hooks))
        client.text_document_did_close(types.DidCloseTextDocumentParams(closing))
        seen.append(await codes())
        hooks.write_text(broken, encoding="utf-8")
        change = types.FileEvent(uri_of(hooks), types.FileChangeType.Changed)
        client.workspace_did_change_watched_files(types.DidChangeWatchedFilesParams([change]))
        seen.append(await codes())
        return seen

    assert talk(act) == [[], ["P3005"], [], ["P3005"]]


@pytest.mark.process
def test_what_is_no_client_gets_no_traceback() -> None:
    said = b"Content-Length: 5\r\n\r\n{{{{{"
    done = subprocess.run(
        [sys.executable, "-m", "plutoc", "lsp", "--stdio"],
        input=said,
        capture_output=True,
        check=False,
    )
    assert b"Traceback" not in done.stderr + done.stdout.split(b'"traceback"')[0]


def test_without_the_extra_one_line_says_how_to_get_it(monkeypatch: pytest.MonkeyPatch) -> None:
    """A module of that name that cannot be imported stands for one that is not there."""
    for name in [name for name in sys.modules if name.startswith("plutoc.lsp")]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, "pygls", None)
    monkeypatch.setitem(sys.modules, "lsprotocol", None)
    ran = run(main, "lsp")
    assert (ran.code, ran.err) == (2, 'plutoc: lsp needs a library: pip install "plutoc[editor]"\n')


@pytest.mark.parametrize(("asked", "shows"), [("", False), ("1", True)])
def test_a_mistake_of_ours_is_logged_with_its_place_where_that_is_asked_for(
    monkeypatch: pytest.MonkeyPatch, asked: str, shows: bool
) -> None:
    logged: list[str] = []

    def broken(*_: object) -> None:
        raise KeyError("x")

    def log(params: types.LogMessageParams) -> None:
        logged.append(params.message)

    monkeypatch.setenv("PLUTO_DEBUG", asked)
    monkeypatch.setattr(Answers, "diagnostics", broken)
    server = Server()
    monkeypatch.setattr(server, "window_log_message", log)
    server.apps.open("untitled:farm.pluto", "pluto 1\n", 1, "pluto")
    server.publish("untitled:farm.pluto")
    (said,) = logged
    assert said.startswith("internal error (P9001): KeyError: 'x'")
    assert ("Traceback" in said) == shows
