"""A real client of the protocol, with a real server in this process: each message is text on its way."""

from __future__ import annotations

import asyncio
import json
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

from lsprotocol import types
from pygls.lsp.client import LanguageClient
from pygls.protocol import JsonRPCProtocol
from pygls.uris import from_fs_path

from plutoc.lsp.server import server


def uri_of(path: Path) -> str:
    """Return how the protocol names a file."""
    uri = from_fs_path(str(path))
    assert uri is not None
    return uri


class Wire:
    """Hands messages on to the other side, in their turn."""

    def __init__(self, to: JsonRPCProtocol) -> None:
        self._to = to

    def write(self, data: bytes) -> None:
        """Take a message with its header."""
        asyncio.get_running_loop().call_soon(self._hand_on, data.partition(b"\r\n\r\n")[2])

    def close(self) -> None:
        """Do nothing: there is no stream."""

    def _hand_on(self, body: bytes) -> None:
        self._to.handle_message(json.loads(body, object_hook=self._to.structure_message))


class Client(LanguageClient):
    """Has a server of its own, and keeps what it publishes and asks for."""

    def __init__(self) -> None:
        super().__init__("tests", "v1")
        self.published: dict[str, types.PublishDiagnosticsParams] = {}
        self.logged: list[str] = []
        self.told: list[str] = []
        self.shown: list[str] = []
        self.registered: list[str] = []
        self._news = asyncio.Event()
        self._on(types.TEXT_DOCUMENT_PUBLISH_DIAGNOSTICS, self._hear)
        self._on(types.WINDOW_LOG_MESSAGE, self._log)
        self._on(types.WINDOW_SHOW_MESSAGE, self._tell)
        self._on(types.WINDOW_SHOW_DOCUMENT, self._show)
        self._on(types.CLIENT_REGISTER_CAPABILITY, self._register)

    def _on(self, method: str, act: Callable[[Any], object]) -> None:
        @self.feature(method)  # type: ignore[untyped-decorator]
        def heard(params: Any) -> object:
            return act(params)

    def _hear(self, params: types.PublishDiagnosticsParams) -> None:
        self.published[params.uri] = params
        self._news.set()

    def _log(self, params: types.LogMessageParams) -> None:
        self.logged.append(params.message)

    def _tell(self, params: types.ShowMessageParams) -> None:
        self.told.append(params.message)

    def _show(self, params: types.ShowDocumentParams) -> types.ShowDocumentResult:
        self.shown.append(params.uri)
        return types.ShowDocumentResult(success=True)

    def _register(self, params: types.RegistrationParams) -> None:
        self.registered += [one.method for one in params.registrations]

    async def begin(
        self, encodings: Iterable[types.PositionEncodingKind] = (), **more: Any
    ) -> types.InitializeResult:
        """Start the server and greet it."""
        other = server().protocol
        self.protocol.set_writer(Wire(other))
        other.set_writer(Wire(self.protocol))
        known = list(encodings) or None
        watching = types.DidChangeWatchedFilesClientCapabilities(dynamic_registration=True)
        answer = await self.initialize_async(
            types.InitializeParams(
                capabilities=types.ClientCapabilities(
                    general=types.GeneralClientCapabilities(position_encodings=known),
                    window=types.WindowClientCapabilities(
                        show_document=types.ShowDocumentClientCapabilities(support=True)
                    ),
                    workspace=types.WorkspaceClientCapabilities(did_change_watched_files=watching),
                ),
                **more,
            )
        )
        self.initialized(types.InitializedParams())
        return answer

    async def end(self) -> None:
        """Take leave as editors do."""
        await self.shutdown_async(None)

    def open(self, uri: str, text: str, version: int = 0) -> None:
        """Open a file with a text, whatever is on the disk."""
        language = "python" if uri.endswith(".py") else "pluto"
        item = types.TextDocumentItem(uri=uri, language_id=language, version=version, text=text)
        self.text_document_did_open(types.DidOpenTextDocumentParams(text_document=item))

    def change(self, uri: str, version: int, range: types.Range | None, text: str) -> None:
        """Change a part of a file, or all of it."""
        change: types.TextDocumentContentChangeEvent = (
            types.TextDocumentContentChangeWholeDocument(text=text)
            if range is None
            else types.TextDocumentContentChangePartial(range=range, text=text)
        )
        self.text_document_did_change(
            types.DidChangeTextDocumentParams(
                text_document=types.VersionedTextDocumentIdentifier(uri=uri, version=version),
                content_changes=[change],
            )
        )

    async def findings(self, uri: str, version: int | None = 0) -> list[types.Diagnostic]:
        """Wait for what is published of a version of a file."""
        while True:
            found = self.published.get(uri)
            if found is not None and (version is None or found.version == version):
                return list(found.diagnostics)
            self._news.clear()
            async with asyncio.timeout(60):
                await self._news.wait()
