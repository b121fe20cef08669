"""What a shell offers at TAB; argcomplete asks, and is loaded only then."""

from __future__ import annotations

import os
from argparse import Action, ArgumentParser, Namespace
from collections.abc import Iterator
from contextlib import suppress

from argcomplete import autocomplete
from argcomplete.completers import BaseCompleter


def complete(parser: ArgumentParser) -> None:
    """Tell the shell which words can come next, and end."""
    # options only behind a dash: files are typed more often
    autocomplete(parser, always_complete_options=False, default_completer=_Words())


class _Words(BaseCompleter):
    """Commands, options and choices are known to argcomplete; these are all others."""

    def __call__(
        self, *, prefix: str, action: Action, parser: ArgumentParser, parsed_args: Namespace
    ) -> Iterator[str]:
        match action.dest:
            case "file" | "files" | "old" | "new":
                yield from _paths(prefix, ".pluto")
            case "missions" | "fleet":
                yield from _paths(prefix, ".toml")
            case "folder":
                yield from _paths(prefix, None)
            case "kind":
                from plutoc.cli.show import installed

                yield from dict(installed([]))
            case "code":
                from plutoc.explain.pages import codes

                yield from codes()
            case "example":
                from plutoc.cli.examples import names

                yield from names()
            case "show":
                yield from ("graph", "plan", "plan=built")


def _paths(prefix: str, suffix: str | None) -> Iterator[str]:
    """Yield folders, and files with that ending; hidden ones only where a dot is typed."""
    folder, start = os.path.split(prefix)
    with suppress(OSError), os.scandir(os.path.expanduser(folder) or ".") as entries:
        # what is not there, or may not be read, offers nothing
        for entry in sorted(entries, key=lambda entry: entry.name):
            if entry.name.startswith(".") and not start.startswith("."):
                continue
            path = os.path.join(folder, entry.name)
            if entry.is_dir():
                yield f"{path}/"
            elif suffix is not None and entry.name.endswith(suffix):
                yield path
