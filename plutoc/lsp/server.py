"""The server: it hears what a client says, and answers; what is wrong is published as one types."""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Generator
from typing import Any, BinaryIO

from lsprotocol import types
from pygls.exceptions import FeatureRequestError, JsonRpcException, PyglsError
from pygls.lsp.server import LanguageServer
from pygls.protocol import LanguageServerProtocol, lsp_method

from plutoc import __version__
from plutoc.explain.pages import code_meant, codes, page
from plutoc.lsp import words
from plutoc.lsp.answers import COMPLETE_AT, EXPLAIN, Answers
from plutoc.lsp.apps import Apps, is_hooks
from plutoc.mistake import traceback_of
from plutoc.service.editing.edit import CannotEdit

LARGE = 20_000
"""In characters: while a larger app is being typed, it is analysed in the pauses."""
PAUSE = 0.02
"""In seconds."""

_WATCHED = ("**/hooks.py", "**/*.pluto")


class _Protocol(LanguageServerProtocol):
    """Keeps no texts of its own: ours are counted as the protocol counts them."""

    @lsp_method(types.TEXT_DOCUMENT_DID_OPEN)
    def lsp_text_document__did_open(self, params: Any) -> Generator[Any, Any, None]:
        """Hand on."""
        yield self.fm.features[types.TEXT_DOCUMENT_DID_OPEN], (params,), None

    @lsp_method(types.TEXT_DOCUMENT_DID_CHANGE)
    def lsp_text_document__did_change(self, params: Any) -> Generator[Any, Any, None]:
        """Hand on."""
        yield self.fm.features[types.TEXT_DOCUMENT_DID_CHANGE], (params,), None

    @lsp_method(types.TEXT_DOCUMENT_DID_CLOSE)
    def lsp_text_document__did_close(self, params: Any) -> Generator[Any, Any, None]:
        """Hand on."""
        yield self.fm.features[types.TEXT_DOCUMENT_DID_CLOSE], (params,), None


class Server(LanguageServer):
    """One client, and the files that it has open."""

    def __init__(self) -> None:
        super().__init__("plutoc", f"v{__version__}", protocol_cls=_Protocol)
        self.apps = Apps()
        self.answers = Answers(apps=self.apps)
        self.shows_pages = True
        """A page that explains a code is opened by the server; else the client shows what it returns."""
        self._published: dict[str, dict[str, list[types.Diagnostic]]] = {}
        self._waiting: dict[str, asyncio.TimerHandle] = {}

    def report_server_error(
        self, error: Exception, source: type[PyglsError | JsonRpcException]
    ) -> None:
        """Tell a mistake of ours to the log of the editor: no window pops up while one types."""
        if source is FeatureRequestError:  # that is answered already
            return
        said = f"internal error (P9001): {type(error).__name__}: {error}"
        if where := traceback_of(error):
            said += f"\n{where}"
        self.window_log_message(types.LogMessageParams(type=types.MessageType.Error, message=said))

    def changed(self, uri: str) -> None:
        """Publish what is wrong with a file that has changed, and with the apps it belongs to."""
        if is_hooks(uri):
            for app in self.apps.apps():
                self.publish(app.uri)
            return
        file = self.apps.file(uri)
        pause = PAUSE if file and len(file.places.text) > LARGE else 0.0
        if waiting := self._waiting.pop(uri, None):
            waiting.cancel()
        loop = asyncio.get_running_loop()
        self._waiting[uri] = loop.call_later(pause, self.publish, uri)

    def publish(self, uri: str) -> None:
        """Publish what is wrong with an app, in each of its files."""
        try:
            app = self.apps.app(uri)
            found = self.answers.diagnostics(app) if app else {}
        except Exception as error:  # noqa: BLE001 - told where one types; the next text may do
            self.report_server_error(error, JsonRpcException)
            return
        before = self._published.pop(uri, {})
        if app:
            self._published[uri] = found
        others = dict.fromkeys(each for each in (*before, *found) if each != uri)
        for each in (*others, uri):
            every = [one for by_file in self._published.values() for one in by_file.get(each, [])]
            file = self.apps.file(each)
            self.text_document_publish_diagnostics(
                types.PublishDiagnosticsParams(
                    uri=each, diagnostics=every, version=file.version if file else None
                )
            )


def server() -> Server:
    """Return a server with all that it can answer."""
    made = Server()
    _hear(made)
    _answer(made)
    _change(made)
    return made


def serve(reads: BinaryIO, writes: BinaryIO) -> None:
    """Serve one client until it leaves."""
    logging.getLogger("pygls").addHandler(logging.NullHandler())
    logging.getLogger("pygls").propagate = False  # its errors are told to the client
    server().start_io(reads, writes)


def _hear(ls: Server) -> None:
    """Hear of files that are opened, changed, closed."""

    @ls.feature(types.INITIALIZE)
    def begin(params: types.InitializeParams) -> None:
        asked = params.initialization_options
        ls.shows_pages = not (isinstance(asked, dict) and asked.get("showsPages"))
        agreed = ls.workspace.position_encoding
        ls.apps.encoding = str(getattr(agreed, "value", agreed))

    @ls.feature(types.INITIALIZED)
    async def begun(_: types.InitializedParams) -> None:
        watching = ls.client_capabilities.workspace
        files = watching.did_change_watched_files if watching else None
        if files and files.dynamic_registration:
            watchers = [types.FileSystemWatcher(glob_pattern=each) for each in _WATCHED]
            await ls.client_register_capability_async(
                types.RegistrationParams(
                    registrations=[
                        types.Registration(
                            id="hooks",
                            method=types.WORKSPACE_DID_CHANGE_WATCHED_FILES,
                            register_options=types.DidChangeWatchedFilesRegistrationOptions(
                                watchers=watchers
                            ),
                        )
                    ]
                )
            )

    @ls.feature(types.TEXT_DOCUMENT_DID_OPEN)
    def opened(params: types.DidOpenTextDocumentParams) -> None:
        one = params.text_document
        ls.apps.open(one.uri, one.text, one.version, one.language_id)
        ls.changed(one.uri)

    @ls.feature(types.TEXT_DOCUMENT_DID_CHANGE)
    def changed(params: types.DidChangeTextDocumentParams) -> None:
        one = params.text_document
        if file := ls.apps.file(one.uri):
            text = file.places.changed(params.content_changes).text
            ls.apps.open(one.uri, text, one.version, file.language)
            ls.changed(one.uri)

    @ls.feature(types.TEXT_DOCUMENT_DID_CLOSE)
    def closed(params: types.DidCloseTextDocumentParams) -> None:
        ls.apps.close(params.text_document.uri)
        ls.changed(params.text_document.uri)

    @ls.feature(types.TEXT_DOCUMENT_DID_SAVE)
    def saved(_: types.DidSaveTextDocumentParams) -> None:
        _look_again(ls)

    @ls.feature(types.WORKSPACE_DID_CHANGE_WATCHED_FILES)
    def changed_on_disk(_: types.DidChangeWatchedFilesParams) -> None:
        _look_again(ls)


def _look_again(ls: Server) -> None:
    ls.apps.look_again()
    for app in ls.apps.apps():
        ls.publish(app.uri)


def _answer(ls: Server) -> None:
    """Answer questions about places."""
    answers = ls.answers

    @ls.feature(types.TEXT_DOCUMENT_HOVER)
    def hover(params: types.HoverParams) -> types.Hover | None:
        return answers.hover(params.text_document.uri, params.position)

    @ls.feature(
        types.TEXT_DOCUMENT_COMPLETION,
        types.CompletionOptions(trigger_characters=list(COMPLETE_AT)),
    )
    def complete(params: types.CompletionParams) -> types.CompletionList:
        return answers.complete(params.text_document.uri, params.position)

    @ls.feature(types.TEXT_DOCUMENT_DEFINITION)
    def definition(params: types.DefinitionParams) -> list[types.Location]:
        return answers.definition(params.text_document.uri, params.position)

    @ls.feature(types.TEXT_DOCUMENT_REFERENCES)
    def references(params: types.ReferenceParams) -> list[types.Location]:
        whole = params.context.include_declaration
        return answers.references(params.text_document.uri, params.position, declaration=whole)

    @ls.feature(types.TEXT_DOCUMENT_DOCUMENT_SYMBOL)
    def symbols(params: types.DocumentSymbolParams) -> list[types.DocumentSymbol]:
        return answers.symbols(params.text_document.uri)

    @ls.feature(types.TEXT_DOCUMENT_SEMANTIC_TOKENS_FULL, words.LEGEND)
    def colours(params: types.SemanticTokensParams) -> types.SemanticTokens:
        return answers.colours(params.text_document.uri)

    @ls.feature(types.TEXT_DOCUMENT_FOLDING_RANGE)
    def folds(params: types.FoldingRangeParams) -> list[types.FoldingRange]:
        return answers.folds(params.text_document.uri)

    @ls.feature(types.TEXT_DOCUMENT_INLAY_HINT)
    def hints(params: types.InlayHintParams) -> list[types.InlayHint]:
        return answers.hints(params.text_document.uri, params.range)


def _change(ls: Server) -> None:
    """Answer what to change."""
    answers = ls.answers

    @ls.feature(
        types.TEXT_DOCUMENT_CODE_ACTION,
        types.CodeActionOptions(code_action_kinds=[types.CodeActionKind.QuickFix]),
    )
    def actions(params: types.CodeActionParams) -> list[types.CodeAction]:
        return answers.actions(params.text_document.uri, params.range)

    @ls.feature(types.TEXT_DOCUMENT_FORMATTING)
    def formatted(params: types.DocumentFormattingParams) -> list[types.TextEdit]:
        return answers.formatted(params.text_document.uri, None)

    @ls.feature(types.TEXT_DOCUMENT_RANGE_FORMATTING)
    def formatted_range(params: types.DocumentRangeFormattingParams) -> list[types.TextEdit]:
        return answers.formatted(params.text_document.uri, params.range)

    @ls.feature(types.TEXT_DOCUMENT_PREPARE_RENAME)
    def prepare_rename(params: types.PrepareRenameParams) -> types.Range | None:
        return answers.prepare_rename(params.text_document.uri, params.position)

    @ls.feature(types.TEXT_DOCUMENT_RENAME, types.RenameOptions(prepare_provider=True))
    def rename(params: types.RenameParams) -> types.WorkspaceEdit | None:
        try:
            changes, note = answers.rename(
                params.text_document.uri, params.position, params.new_name
            )
        except CannotEdit as error:
            raise JsonRpcException(str(error), code=types.LSPErrorCodes.RequestFailed) from None
        if note:
            ls.window_show_message(
                types.ShowMessageParams(type=types.MessageType.Info, message=note)
            )
        return changes

    @ls.command(EXPLAIN)
    async def explain(code: str) -> str:
        return await _explain(ls, code_meant(code))


async def _explain(ls: Server, code: str) -> str:
    """Open the page of a code; return its text, for clients that show it themselves."""
    if code not in codes():
        return f"there is no code {code}"
    shown = ls.client_capabilities.window
    if ls.shows_pages and shown and shown.show_document and shown.show_document.support:
        await ls.window_show_document_async(types.ShowDocumentParams(uri=words.page_of(code)))
    return page(code).text
