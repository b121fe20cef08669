"""The files that a client has open: apps, each with all that the compiler says of it, and hooks."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

from pygls.uris import from_fs_path, to_fs_path

from plutoc.diagnostic import Diagnostic, Rejected
from plutoc.graph.model import Graph
from plutoc.lsp import disk
from plutoc.lsp.places import Places
from plutoc.project.hooks import HOOKS
from plutoc.service.document import Document
from plutoc.source import Source
from plutoc.syntax.tree import File

LANGUAGE = "pluto"


@dataclass(kw_only=True, eq=False)
class OpenFile:
    """A file that a client has open."""

    uri: str
    places: Places
    version: int | None
    language: str

    @property
    def is_app(self) -> bool:
        """It is an app, by what the client says or by its name."""
        return self.language == LANGUAGE or self.uri.endswith(".pluto")

    @property
    def path(self) -> Path | None:
        """Where it is; None where it is not saved yet."""
        return path_of(self.uri)


@dataclass(kw_only=True, eq=False)
class App:
    """An app, as its text is now."""

    uri: str
    places: Places
    document: Document
    hooks: list[Path] = field(default_factory=list)
    """Where the hooks.py is that was looked at, if there is one."""
    refused: list[Diagnostic] = field(default_factory=list)
    """Why the hooks.py that is there is not looked at."""

    @property
    def findings(self) -> tuple[Diagnostic, ...]:
        """What `plutoc check` says of it."""
        found = self.document.diagnostics
        return found if self.document.checked is None else (*found, *self.refused)

    @property
    def hooks_uri(self) -> str | None:
        """The hooks.py that counts; None where there is none."""
        return uri_of(self.hooks[0]) if self.document.hooks and self.hooks else None

    def hooks_places(self) -> Places | None:
        """Return the places in its hooks.py."""
        hooks = self.document.hooks
        return Places(text=hooks.text, encoding=self.places.encoding) if hooks else None


class Apps:
    """All open files, and the apps among them."""

    def __init__(self) -> None:
        self.encoding = "utf-16"
        self._open: dict[str, OpenFile] = {}
        self._apps: dict[str, App] = {}

    def open(self, uri: str, text: str, version: int | None, language: str) -> None:
        """Take in a file, or a new text of it."""
        places = Places(text=text, encoding=self.encoding)
        self._open[uri] = OpenFile(uri=uri, places=places, version=version, language=language)
        self._forget(uri)

    def close(self, uri: str) -> None:
        """Let go of a file: from now on the disk counts."""
        self._open.pop(uri, None)
        self._forget(uri)
        self._apps.pop(uri, None)

    def file(self, uri: str) -> OpenFile | None:
        """Return an open file."""
        return self._open.get(uri)

    def apps(self) -> list[App]:
        """Return the apps that are open."""
        return [app for uri in self._open if (app := self.app(uri))]

    def app(self, uri: str) -> App | None:
        """Return an open app, analysed as far as was asked."""
        file = self._open.get(uri)
        if file is None or not file.is_app:
            return None
        app = self._apps.get(uri)
        if app is None or app.places is not file.places:
            sound = app.document.sound if app else None
            app = self._apps[uri] = self._read(uri, file.places, sound)
        return app

    def app_of(self, uri: str) -> App | None:
        """Return the app that a hooks.py belongs to: an open one, or one on the disk."""
        path = path_of(uri)
        if path is None:
            return None
        for app in self.apps():
            if path in self._places(app):
                return app
        for beside in disk.apps_beside(path):
            text = disk.read_app(beside)
            if text is not None and uri_of(beside) not in self._open:
                app = self._read(uri_of(beside), Places(text=text, encoding=self.encoding))
                if path in self._places(app):
                    return app
        return None

    def look_again(self) -> None:
        """Forget what was read from the disk."""
        for app in self._apps.values():
            app.document = app.document.with_hooks_anew()

    def _forget(self, uri: str) -> None:
        if is_hooks(uri):
            self.look_again()

    def _places(self, app: App) -> tuple[Path, ...]:
        path = path_of(app.uri)
        return disk.hooks_places(app.document.graph, path) if path else ()

    def _read(self, uri: str, places: Places, before: File | None = None) -> App:
        path = path_of(uri)
        found: list[Path] = []
        refused: list[Diagnostic] = []

        def find(graph: Graph) -> Source | None:
            found.clear()
            refused.clear()
            if path is None:
                return None
            try:
                where, source = self._hooks(graph, path)
            except Rejected as rejected:  # it is a link, or a folder
                refused.extend(rejected.diagnostics)
                return None
            found.extend([where] if where else [])
            return source

        shown = str(path) if path else uri
        document = Document(path=shown, text=places.text, find_hooks=find, before=before)
        return App(uri=uri, places=places, document=document, hooks=found, refused=refused)

    def _hooks(self, graph: Graph, app: Path) -> tuple[Path | None, Source | None]:
        """Return the hooks.py that counts: as it is in the editor, else on the disk."""
        on_disk = disk.read_hooks(graph, app)
        for place in disk.hooks_places(graph, app):
            opened = next((one for one in self._open.values() if one.path == place), None)
            if opened is not None:
                text = opened.places.text.replace("\r\n", "\n").replace("\r", "\n")
                return place, Source(str(place), text)
            if on_disk is not None and on_disk[0] == place:
                return on_disk
        return None, None


def is_hooks(uri: str) -> bool:
    """Return whether a file may be hooks, by its name."""
    return uri.rpartition("/")[2] == HOOKS


def path_of(uri: str) -> Path | None:
    """Return where a file is; None where it is not on the disk."""
    path = to_fs_path(uri) if uri.startswith("file:") else None
    return Path(path) if path else None


def uri_of(path: Path) -> str:
    """Return how the protocol names a file."""
    return from_fs_path(str(path)) or path.as_uri()
