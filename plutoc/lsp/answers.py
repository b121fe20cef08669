"""The answers to a client's questions: each is asked of the service, about one place of one file."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from lsprotocol import types

from plutoc.diagnostic import Fix, Rejected
from plutoc.format.run import TooLarge, format_source
from plutoc.hooks.python import Unreadable
from plutoc.lsp import words
from plutoc.lsp.apps import App, Apps, is_hooks, path_of, uri_of
from plutoc.lsp.places import Places
from plutoc.service.completion.complete import complete
from plutoc.service.editing.rename import renamed
from plutoc.service.hooks import help as hook_help
from plutoc.service.hooks.places import definition_of, hook_at
from plutoc.service.reading import fixes
from plutoc.service.reading.hints import hints
from plutoc.service.reading.hover import hover
from plutoc.service.reading.outline import coloured, folds, outline
from plutoc.service.symbols import DECLARED, HOOKS, Occurrence, Role, at, same
from plutoc.source import Span

EXPLAIN = "pluto.explain"
COMPLETE_AT = (".", " ", "(", ",", ":", "=", ">", "[")


@dataclass(frozen=True, kw_only=True)
class Answers:
    """What can be asked about the open files."""

    apps: Apps

    def diagnostics(self, app: App) -> dict[str, list[types.Diagnostic]]:
        """Return what is wrong with an app, by file."""
        found: dict[str, list[types.Diagnostic]] = {app.uri: []}
        for one in app.findings:
            said = words.diagnostic(app, one)
            found.setdefault(words.uri_of_finding(app, one), []).append(said)
        return found

    def hover(self, uri: str, position: types.Position) -> types.Hover | None:
        """Return what is to be known about a place."""
        if app := self.apps.app(uri):
            found = hover(app.document, app.places.offset(position))
            return words.hover(app.places, found)
        if inside := self._in_hooks(uri):
            app, places = inside
            found = hook_help.hover(app.document, places.text, places.offset(position))
            return words.hover(places, found)
        return None

    def complete(self, uri: str, position: types.Position) -> types.CompletionList:
        """Return what may stand at a place."""
        if app := self.apps.app(uri):
            places = app.places
            items = complete(app.document, places.offset(position))
        elif inside := self._in_hooks(uri):
            app, places = inside
            items = hook_help.complete(app.document, places.text, places.offset(position))
        else:
            return types.CompletionList(is_incomplete=False, items=[])
        offset = places.offset(position)
        said = [
            words.item(places, i, one, places.text[one.span.start : offset])
            for i, one in enumerate(items)
        ]
        return types.CompletionList(is_incomplete=True, items=said)

    def definition(self, uri: str, position: types.Position) -> list[types.Location]:
        """Return where what stands at a place is declared; of a hook's declaration, its function."""
        if inside := self._in_hooks(uri):
            app, places = inside
            name = hook_at(app.document, places.text, places.offset(position))
            return [] if name is None else self._declared(app, name)
        found = self._name(uri, position)
        if found is None:
            return []
        app, one = found
        if one.declares and one.role in HOOKS:
            return self._function(app, one.name)
        if one.role is Role.FIELD:
            spans = (each.span for each in same(app.document.names, one) if each.declares)
            return [types.Location(uri=app.uri, range=app.places.range(span)) for span in spans]
        return self._declared(app, one.name) if one.role in DECLARED else []

    def references(
        self, uri: str, position: types.Position, *, declaration: bool
    ) -> list[types.Location]:
        """Return every place where what stands there is named."""
        named = self._name(uri, position)
        if named is None:
            return []
        app, one = named
        found = [
            types.Location(uri=app.uri, range=app.places.range(each.span))
            for each in same(app.document.names, one)
            if declaration or not each.declares
        ]
        return found + (self._function(app, one.name) if one.role in HOOKS else [])

    def prepare_rename(self, uri: str, position: types.Position) -> types.Range | None:
        """Return the name that can be renamed at a place."""
        named = self._name(uri, position)
        if named is None or named[1].role not in {*DECLARED, Role.FIELD}:
            return None
        app, one = named
        declared = any(each.declares for each in same(app.document.names, one))
        return app.places.range(one.span) if declared else None

    def rename(
        self, uri: str, position: types.Position, new: str
    ) -> tuple[types.WorkspaceEdit | None, str]:
        """Return the changes that rename what stands at a place, and what is left to people.

        Raises `CannotEdit` if it cannot be renamed.
        """
        named = self._name(uri, position)
        if named is None:
            return None, ""
        app, one = named
        name = f"{one.owner}.{one.name}" if one.role is Role.FIELD else one.name
        done = renamed(app.document, name, new)
        changes = {app.uri: words.edits(app.places, done.edits)}
        hooks, places = app.hooks_uri, app.hooks_places()
        if done.hooks and hooks and places:
            changes[hooks] = words.edits(places, done.hooks)
        return types.WorkspaceEdit(changes=changes), done.note

    def symbols(self, uri: str) -> list[types.DocumentSymbol]:
        """Return the outline of an app."""
        app = self.apps.app(uri)
        return [words.symbol(app.places, one) for one in outline(app.document)] if app else []

    def formatted(self, uri: str, range: types.Range | None) -> list[types.TextEdit]:
        """Return the changes that bring an app, or a part of it, into canonical form."""
        app = self.apps.app(uri)
        if app is None:
            return []
        try:
            text = format_source(app.document.source)
        except (Rejected, TooLarge):  # what cannot be read is not formatted: the mistakes are shown
            return []
        changes: Iterable[Fix] = fixes.changes(app.document.source, text)
        if range is not None:
            start, end = app.places.span(range)
            changes = [one for one in changes if one.span.start <= end and start < one.span.end]
        return words.edits(app.places, changes)

    def actions(self, uri: str, range: types.Range) -> list[types.CodeAction]:
        """Return what can be done about a place: fixes, a stub, an explanation."""
        app = self.apps.app(uri)
        if app is None:
            return []
        within = app.places.span(range)
        found = [
            types.CodeAction(
                title=mend.title,
                kind=types.CodeActionKind.QuickFix,
                diagnostics=[words.diagnostic(app, mend.diagnostic)],
                is_preferred=True,
                edit=types.WorkspaceEdit(changes={app.uri: words.edits(app.places, [mend.fix])}),
            )
            for mend in fixes.mends(app.document, within)
        ]
        name = fixes.lacking_hook(app.document, within.start)
        edit = self.stub(app, name) if name else None
        if edit:
            title = f"Write the hook `{name}` into hooks.py"
            kind = types.CodeActionKind.QuickFix
            found.append(types.CodeAction(title=title, kind=kind, edit=edit))
        return found + [_explaining(code) for code in self._codes(app, within)]

    def stub(self, app: App, name: str) -> types.WorkspaceEdit | None:
        """Return the change that writes a hook's stub; it makes hooks.py where there is none."""
        try:
            changes = fixes.with_stub(app.document, name)
        except Unreadable:  # what is wrong with hooks.py is shown
            return None
        hooks, places, path = app.hooks_uri, app.hooks_places(), path_of(app.uri)
        if changes and hooks and places:
            return types.WorkspaceEdit(changes={hooks: words.edits(places, changes)})
        if not changes or path is None:
            return None
        new = uri_of(path.parent / "hooks.py")
        text = types.TextDocumentEdit(
            text_document=types.OptionalVersionedTextDocumentIdentifier(uri=new),
            edits=list(words.edits(Places(text=""), changes)),
        )
        return types.WorkspaceEdit(document_changes=[types.CreateFile(uri=new), text])

    def colours(self, uri: str) -> types.SemanticTokens:
        """Return what the words of an app are."""
        app = self.apps.app(uri)
        if app is None:
            return types.SemanticTokens(data=[])
        return words.colours(app.places, coloured(app.document))

    def folds(self, uri: str) -> list[types.FoldingRange]:
        """Return what can be folded."""
        app = self.apps.app(uri)
        found = []
        for one in folds(app.document) if app else ():
            range = app.places.range(one.span) if app else None
            if range and range.end.line > range.start.line:
                ends = range.end.line - (one.is_comment and range.end.character == 0)
                kind = types.FoldingRangeKind.Comment if one.is_comment else None
                found.append(
                    types.FoldingRange(start_line=range.start.line, end_line=ends, kind=kind)
                )
        return found

    def hints(self, uri: str, range: types.Range) -> list[types.InlayHint]:
        """Return the statuses of arrows."""
        app = self.apps.app(uri)
        if app is None:
            return []
        return [
            types.InlayHint(
                position=app.places.position(one.offset), label=one.text, padding_left=True
            )
            for one in hints(app.document, app.places.span(range))
        ]

    def _codes(self, app: App, within: Span) -> list[str]:
        found = (
            one.code
            for one in app.document.diagnostics
            if one.source is app.document.source
            and one.span.start <= within.end
            and within.start <= one.span.end
        )
        return list(dict.fromkeys(found))

    def _name(self, uri: str, position: types.Position) -> tuple[App, Occurrence] | None:
        app = self.apps.app(uri)
        one = at(app.document.names, app.places.offset(position)) if app else None
        return (app, one) if app and one else None

    def _declared(self, app: App, name: str) -> list[types.Location]:
        return [
            types.Location(uri=app.uri, range=app.places.range(one.span))
            for one in app.document.names
            if one.declares and one.name == name and one.role in DECLARED
        ]

    def _function(self, app: App, name: str) -> list[types.Location]:
        hooks, places = app.hooks_uri, app.hooks_places()
        span = definition_of(places.text, name) if places else None
        if hooks is None or places is None or span is None:
            return []
        return [types.Location(uri=hooks, range=places.range(span))]

    def _in_hooks(self, uri: str) -> tuple[App, Places] | None:
        file = self.apps.file(uri) if is_hooks(uri) else None
        app = self.apps.app_of(uri) if file else None
        return (app, file.places) if app and file else None


def _explaining(code: str) -> types.CodeAction:
    command = types.Command(title=f"Explain {code}", command=EXPLAIN, arguments=[code])
    return types.CodeAction(
        title=f"Explain {code}", kind=types.CodeActionKind.Empty, command=command
    )
