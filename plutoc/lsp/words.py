"""What the service answers, in the protocol's words."""

from __future__ import annotations

from collections.abc import Iterable
from functools import cache
from importlib.resources import files
from pathlib import Path

from lsprotocol import types

from plutoc.diagnostic import Diagnostic, Fix, Severity
from plutoc.explain.pages import codes
from plutoc.lsp.apps import App, uri_of
from plutoc.lsp.places import Places
from plutoc.service.answers import Hover, Item, Sort
from plutoc.service.reading.outline import Coloured, Symbol
from plutoc.service.symbols import Role

SOURCE = "plutoc"

_ITEMS = {
    Sort.KEYWORD: types.CompletionItemKind.Keyword,
    Sort.BLOCK: types.CompletionItemKind.Variable,
    Sort.KIND: types.CompletionItemKind.Class,
    Sort.PACKAGE: types.CompletionItemKind.Module,
    Sort.CATEGORY: types.CompletionItemKind.Struct,
    Sort.HOOK: types.CompletionItemKind.Function,
    Sort.PARAMETER: types.CompletionItemKind.Property,
    Sort.VALUE: types.CompletionItemKind.Value,
    Sort.UNIT: types.CompletionItemKind.Unit,
    Sort.STATUS: types.CompletionItemKind.EnumMember,
    Sort.TYPE: types.CompletionItemKind.TypeParameter,
    Sort.STATEMENT: types.CompletionItemKind.Snippet,
    Sort.ATTRIBUTE: types.CompletionItemKind.Field,
    Sort.METHOD: types.CompletionItemKind.Method,
}

_SYMBOLS = {
    Role.APP: types.SymbolKind.Module,
    Role.CATEGORY: types.SymbolKind.Struct,
    Role.BLOCK: types.SymbolKind.Object,
    Role.FIELD: types.SymbolKind.Field,
    Role.EVENT: types.SymbolKind.Event,
}
"""All others are functions."""

_COLOURS = {
    None: "keyword",
    Role.APP: "namespace",
    Role.PREFIX: "namespace",
    Role.CATEGORY: "struct",
    Role.ACTION: "function",
    Role.EVALUATOR: "function",
    Role.MODIFIER: "function",
    Role.POLICY: "function",
    Role.CREATOR: "function",
    Role.EVENT: "event",
    Role.BLOCK: "variable",
    Role.KIND: "class",
    Role.FIELD: "property",
    Role.PARAMETER: "parameter",
    Role.TYPE: "type",
    Role.STATUS: "enumMember",
    Role.TERMINAL: "keyword",
    Role.OPTION: "property",
    Role.WAY: "property",
}
LEGEND = types.SemanticTokensLegend(
    token_types=list(dict.fromkeys(_COLOURS.values())), token_modifiers=["declaration"]
)


def diagnostic(app: App, one: Diagnostic) -> types.Diagnostic:
    """Say a finding."""
    places = _places(app, one.source.path)
    return types.Diagnostic(
        range=places.range(one.span),
        message="\n".join(filter(None, (one.message, one.help))),
        severity=(
            types.DiagnosticSeverity.Error
            if one.severity is Severity.ERROR
            else types.DiagnosticSeverity.Warning
        ),
        code=one.code,
        code_description=(
            types.CodeDescription(href=page_of(one.code)) if one.code in _pages() else None
        ),
        source=SOURCE,
        related_information=[
            types.DiagnosticRelatedInformation(
                location=types.Location(
                    uri=_uri(app, each.source.path),
                    range=_places(app, each.source.path).range(each.span),
                ),
                message=each.label,
            )
            for each in one.related
        ],
    )


def page_of(code: str) -> str:
    """Return where the page is that explains a code."""
    return uri_of(Path(str(files("plutoc.explain") / "pages" / f"{code}.md")))


@cache
def _pages() -> frozenset[str]:
    return frozenset(codes())


def uri_of_finding(app: App, one: Diagnostic) -> str:
    """Return the file that a finding is about."""
    return _uri(app, one.source.path)


def _is_hooks(app: App, path: str) -> bool:
    return app.document.hooks is not None and path == app.document.hooks.path


def _places(app: App, path: str) -> Places:
    hooks = app.hooks_places() if _is_hooks(app, path) else None
    return hooks or app.places


def _uri(app: App, path: str) -> str:
    return (app.hooks_uri if _is_hooks(app, path) else None) or app.uri


def edits(places: Places, fixes: Iterable[Fix]) -> list[types.TextEdit]:
    """Say changes of a text; a new line ends as the text's own do."""
    end = "\r\n" if "\r\n" in places.text else "\n"
    return [
        types.TextEdit(range=places.range(fix.span), new_text=fix.text.replace("\n", end))
        for fix in fixes
    ]


def hover(places: Places, found: Hover | None) -> types.Hover | None:
    """Say what is to be known about a place."""
    if found is None:
        return None
    content = types.MarkupContent(kind=types.MarkupKind.Markdown, value=found.markdown)
    return types.Hover(contents=content, range=places.range(found.span))


def item(places: Places, number: int, one: Item, prefix: str) -> types.CompletionItem:
    """Say a completion; the list keeps the service's order."""
    return types.CompletionItem(
        label=one.label,
        kind=_ITEMS[one.kind],
        detail=one.detail or None,
        documentation=(
            types.MarkupContent(kind=types.MarkupKind.Markdown, value=one.doc) if one.doc else None
        ),
        sort_text=f"{number:04}",
        filter_text=one.label if one.label.lower().startswith(prefix.lower()) else prefix,
        text_edit=types.TextEdit(range=places.range(one.span), new_text=one.insert),
        insert_text_format=types.InsertTextFormat.PlainText,
    )


def symbol(places: Places, one: Symbol) -> types.DocumentSymbol:
    """Say a declaration."""
    return types.DocumentSymbol(
        name=one.name,
        detail=one.detail,
        kind=_SYMBOLS.get(one.role, types.SymbolKind.Function),
        range=places.range(one.span),
        selection_range=places.range(one.name_span),
        children=[symbol(places, child) for child in one.children],
    )


def colours(places: Places, found: Iterable[Coloured]) -> types.SemanticTokens:
    """Say what words are, each by its distance from the one before."""
    data: list[int] = []
    line = column = 0
    for one in found:
        at = places.position(one.span.start)
        if at.line != line:
            column = 0
        kind = LEGEND.token_types.index(_COLOURS[one.role])
        data += [at.line - line, at.character - column, places.length(one.span), kind]
        data.append(int(one.declares))
        line, column = at.line, at.character
    return types.SemanticTokens(data=data)
