"""What the server publishes is what `check` says: the same codes, places and sentences."""

from __future__ import annotations

import asyncio
from json import loads
from pathlib import Path

import pytest
from lsprotocol import types

from plutoc.cli import main
from plutoc.lsp.places import Places
from plutoc.source import Source
from tests.compiler.lsp.client import Client, uri_of
from tests.paths import CASES

SOURCES = sorted(path.parent for path in CASES.glob("*/app.pluto"))[::4]
SOURCES += [path.parent for path in CASES.glob("p30*/hooks.py")][:3]
Finding = tuple[str, str, int, int, int, int]
"""Its code, its file's name, and its place."""


def of_check(folder: Path, capsys: pytest.CaptureFixture[str]) -> list[Finding]:
    """Return what the command says."""
    main(["check", str(folder / "app.pluto"), "--format", "json"])
    found = map(loads, capsys.readouterr().out.splitlines())
    keys = ("line", "column", "end_line", "end_column")
    return sorted((d["code"], Path(d["file"]).name, *(d[key] for key in keys)) for d in found)


def of_server(folder: Path, published: dict[str, list[types.Diagnostic]]) -> list[Finding]:
    """Return what was published, its places counted as the command counts them."""
    found = []
    for name in ("app.pluto", "hooks.py"):
        path = folder / name
        said = published.get(uri_of(path), [])
        text = path.read_bytes().decode() if said else ""
        if name == "hooks.py":
            text = text.replace("\r\n", "\n").replace("\r", "\n")
        places, source = Places(text=text), Source(name, text)
        for one in said:
            span = places.span(one.range)
            start, end = source.position(span.start), source.position(span.end)
            found.append((str(one.code), name, *start, *end))
    return sorted(found)


def test_a_case_is_published_as_check_tells_it(capsys: pytest.CaptureFixture[str]) -> None:
    async def all_cases() -> dict[Path, dict[str, list[types.Diagnostic]]]:
        client, found = Client(), {}
        await client.begin()
        for folder in SOURCES:
            uri = uri_of(folder / "app.pluto")
            client.open(uri, (folder / "app.pluto").read_bytes().decode())
            await client.findings(uri)
            hooks = client.published.get(uri_of(folder / "hooks.py"))
            found[folder] = {uri: list(client.published[uri].diagnostics)}
            if hooks:
                found[folder][uri_of(folder / "hooks.py")] = list(hooks.diagnostics)
            closing = types.TextDocumentIdentifier(uri=uri)
            client.text_document_did_close(types.DidCloseTextDocumentParams(closing))
        assert client.logged == []
        await client.end()
        return found

    published = asyncio.run(all_cases())
    for folder in SOURCES:
        assert of_server(folder, published[folder]) == of_check(folder, capsys), folder.name
    assert any(uri_of(folder / "hooks.py") in published[folder] for folder in SOURCES)
