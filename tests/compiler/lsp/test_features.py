"""Each feature, asked by a real client of a real server."""

from __future__ import annotations

from pathlib import Path

import pytest
from lsprotocol import types
from lsprotocol.types import Position, PositionEncodingKind, Range
from pygls.exceptions import JsonRpcException

from plutoc.format.run import format_source
from plutoc.lsp.places import Places
from plutoc.source import Source, Span
from tests.compiler.lsp.client import Client, uri_of
from tests.compiler.lsp.conftest import EXAMPLES, talk

TEXT = (EXAMPLES / "alfalfa" / "app.pluto").read_text(encoding="utf-8")
URI = "untitled:alfalfa.pluto"
DOCUMENT = types.TextDocumentIdentifier(uri=URI)


def place(text: str, what: str, at: int = 0) -> Position:
    """Return the position of the first place where something stands."""
    return Places(text=text).position(text.index(what) + at)


def applied(text: str, edits: list[types.TextEdit]) -> str:
    """Return a text with edits made, which do not overlap."""
    places = Places(text=text)
    for edit in sorted(edits, key=lambda one: places.span(one.range), reverse=True):
        start, end = places.span(edit.range)
        text = text[:start] + edit.new_text + text[end:]
    return text


def test_what_is_legal_is_offered_as_edits_of_the_word_that_is_begun() -> None:
    text = TEXT.replace("first -> retry when FAILED", "first -> re when FAILED")

    async def act(client: Client) -> types.CompletionList:
        client.open(URI, text)
        at = place(text, "first -> re", len("first -> re"))
        found = await client.text_document_completion_async(types.CompletionParams(DOCUMENT, at))
        assert isinstance(found, types.CompletionList)
        return found

    first = talk(act).items[0]
    assert isinstance(first.text_edit, types.TextEdit)
    assert applied(text, [first.text_edit]) == TEXT


def test_renaming_and_back_gives_the_bytes_there_were(alfalfa: Path) -> None:
    """Of a hook, in hooks.py too."""
    app, hooks = alfalfa / "app.pluto", alfalfa / "hooks.py"

    async def act(client: Client) -> tuple[list[str], list[str]]:
        texts = {uri_of(path): path.read_text(encoding="utf-8") for path in (app, hooks)}
        before = dict(texts)
        client.open(uri_of(app), texts[uri_of(app)])
        taken = types.RenameParams(
            types.TextDocumentIdentifier(uri_of(app)), place(texts[uri_of(app)], "retry ="), "first"
        )
        with pytest.raises(JsonRpcException, match="`first` is declared already"):
            await client.text_document_rename_async(taken)
        for version, (old, new) in enumerate((("find_blooms", "see"), ("see", "find_blooms"))):
            text = texts[uri_of(app)]
            for uri, now in texts.items():
                client.open(uri, now, version)
            document = types.TextDocumentIdentifier(uri=uri_of(app))
            at = place(text, f"hook: {old}", len("hook: "))
            named = await client.text_document_prepare_rename_async(
                types.PrepareRenameParams(document, at)
            )
            assert isinstance(named, Range) and Places(text=text).span(named) == Span(
                text.index(f"hook: {old}") + 6, text.index(f"hook: {old}") + 6 + len(old)
            )
            done = await client.text_document_rename_async(types.RenameParams(document, at, new))
            assert done is not None and done.changes is not None
            for uri, edits in done.changes.items():
                texts[uri] = applied(texts[uri], list(edits))
            if version == 0:
                assert "def see(" in texts[uri_of(hooks)] and "hook: see)" in texts[uri_of(app)]
        return list(before.values()), list(texts.values())

    before, after = talk(act)
    assert before == after


def test_a_hook_leads_to_its_function_and_back(alfalfa: Path) -> None:
    app, hooks = uri_of(alfalfa / "app.pluto"), uri_of(alfalfa / "hooks.py")
    code = (alfalfa / "hooks.py").read_text(encoding="utf-8")

    async def act(client: Client) -> tuple[object, object]:
        client.open(app, TEXT)
        client.open(hooks, code)
        used = await client.text_document_references_async(
            types.ReferenceParams(
                types.ReferenceContext(True),
                types.TextDocumentIdentifier(app),
                place(TEXT, "-> retry", 4),
            )
        )
        assert len(used or []) == TEXT.count("retry")
        there = await client.text_document_definition_async(
            types.DefinitionParams(types.TextDocumentIdentifier(app), place(TEXT, "find_blooms\n"))
        )
        back = await client.text_document_definition_async(
            types.DefinitionParams(types.TextDocumentIdentifier(hooks), place(code, "find_blooms"))
        )
        return there, back

    there, back = talk(act)
    assert isinstance(there, list | tuple) and isinstance(back, list | tuple)
    assert [(one.uri, one.range.start) for one in there] == [(hooks, place(code, "find_blooms"))]
    assert [(one.uri, one.range.start) for one in back] == [(app, place(TEXT, "find_blooms\n"))]


def test_formatting_whole_and_in_part_is_that_of_fmt() -> None:
    ugly = TEXT.replace("  wait = Clock", "wait=Clock").replace(
        "  again = MissionRepeater", "     again   = MissionRepeater"
    )

    async def act(client: Client) -> tuple[str, str]:
        client.open(URI, ugly)
        how = types.FormattingOptions(tab_size=2, insert_spaces=True)
        whole = await client.text_document_formatting_async(
            types.DocumentFormattingParams(DOCUMENT, how)
        )
        at = place(ugly, "wait=Clock")
        part = await client.text_document_range_formatting_async(
            types.DocumentRangeFormattingParams(DOCUMENT, Range(at, at), how)
        )
        return applied(ugly, list(whole or [])), applied(ugly, list(part or []))

    whole, part = talk(act)
    assert whole == format_source(Source("a", ugly)) == TEXT
    assert part == ugly.replace("wait=Clock", "  wait = Clock")


def test_a_fix_and_the_page_of_its_code_are_offered() -> None:
    text = TEXT.replace("take_photo, measure", "take_photo, measure, measure", 1)

    async def act(client: Client) -> tuple[list[types.CodeAction], str, list[str]]:
        client.open(URI, text)
        at = place(text, "measure, measure", 9)
        asked = types.CodeActionParams(DOCUMENT, Range(at, at), types.CodeActionContext([]))
        found = list(await client.text_document_code_action_async(asked) or [])
        page = await client.workspace_execute_command_async(
            types.ExecuteCommandParams("pluto.explain", ["P1025"])
        )
        actions = [one for one in found if isinstance(one, types.CodeAction)]
        return actions, str(page), client.shown

    actions, page, shown = talk(act)
    changes = actions[0].edit.changes if actions and actions[0].edit else None
    assert changes is not None and applied(text, list(changes[URI])) == TEXT
    assert page.startswith("# P1025: ") and shown[0].endswith("/P1025.md")


def test_a_hook_that_lacks_is_written(alfalfa: Path) -> None:
    app = uri_of(alfalfa / "app.pluto")
    hooks = alfalfa / "hooks.py"
    code = hooks.read_text(encoding="utf-8")
    hooks.write_text(code[: code.index("def find_blooms")], encoding="utf-8")

    async def act(client: Client) -> dict[str, str]:
        client.open(app, TEXT)
        at = place(TEXT, "find_blooms\n", 2)
        document = types.TextDocumentIdentifier(app)
        asked = types.CodeActionParams(document, Range(at, at), types.CodeActionContext([]))
        found = await client.text_document_code_action_async(asked) or []
        writing = [one for one in found if isinstance(one, types.CodeAction) and one.edit]
        assert "find_blooms" in writing[0].title and writing[0].edit is not None
        changes = writing[0].edit.changes or {}
        before = hooks.read_text(encoding="utf-8")
        return {uri: applied(before, list(edits)) for uri, edits in changes.items()}

    changed = talk(act)
    assert changed.keys() == {uri_of(hooks)}
    assert (
        "def find_blooms(mission: Mission, results: Results) -> Verdict:" in changed[uri_of(hooks)]
    )


def test_outline_folds_and_colours() -> None:
    async def act(client: Client) -> tuple[list[str], list[types.FoldingRange], list[int]]:
        client.open(URI, TEXT)
        symbols = await client.text_document_document_symbol_async(
            types.DocumentSymbolParams(DOCUMENT)
        )
        folds = await client.text_document_folding_range_async(types.FoldingRangeParams(DOCUMENT))
        colours = await client.text_document_semantic_tokens_full_async(
            types.SemanticTokensParams(DOCUMENT)
        )
        (app,) = symbols or []
        assert isinstance(app, types.DocumentSymbol) and colours is not None
        return [one.name for one in app.children or []], list(folds or []), list(colours.data)

    names, folds, colours = talk(act)
    assert names[:4] == ["scout", "carrier", "field_scout", "sprayer"]
    assert {"pollinate", "find_blooms", "again"} <= {*names}
    assert any(fold.end_line - fold.start_line > 30 for fold in folds)
    assert len(colours) % 5 == 0 and len(colours) // 5 > 90


@pytest.mark.parametrize("encoding", list(PositionEncodingKind))
def test_letters_beyond_the_plain_ones_are_counted_as_agreed(
    encoding: PositionEncodingKind,
) -> None:
    """A title with letters of two, three and four bytes; a name behind a comment with some."""
    text = 'pluto 1\napp a "Blüten – 🌼🌼" { }\n'

    async def act(client: Client) -> tuple[list[types.Diagnostic], list[types.Diagnostic]]:
        client.open(URI, text)
        before = await client.findings(URI)
        places = Places(text=text, encoding=encoding)
        span = Span(text.index("🌼🌼"), text.index("🌼🌼") + 2)
        client.change(URI, 1, places.range(span), "\u00e4\u200b")
        return before, await client.findings(URI, 1)

    before, after = talk(act, [encoding])
    assert [one.code for one in before] == ["P2001"]
    (hidden,) = after
    now = Places(text=text.replace("🌼🌼", "ä\u200b"), encoding=encoding)
    assert hidden.code == "P0004" and now.text[now.span(hidden.range).start] == "\u200b"
