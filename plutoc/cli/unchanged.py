"""Compiling what was compiled before: where nothing at all has changed, nothing is done.

After a compile that leaves a package as it shall be, a record is kept in the user's cache: what was
read, what the package's files hold, which compiler it was, and the words that the same command would
say next time. Next time these words are said, if all of it is still so. Contents are compared and
not times, so that no hand edit goes unnoticed; of the compiler's own files, size and time must do.
What is in doubt is compiled.

It is what most compiles come to, in an editor or a build. So nothing is imported that can be spared.
"""

from __future__ import annotations

import os
import stat
import sys
from hashlib import sha256

from plutoc import cache
from plutoc.cli import output
from plutoc.cli.colour import in_colour
from plutoc.cli.compiler import identity
from plutoc.installed import digest, fact, last_facts_of_package

TYPE_CHECKING = False  # `typing` itself is slow to import
if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping, Sequence
    from pathlib import Path

    Words = Iterable[tuple[bool, str]]
    """Texts, and whether each goes to standard output."""

SHELF = "compiled"
_MOST = 1 << 23
"""In bytes, on the shelf."""
_LARGEST = 1 << 25
"""In bytes, of a file."""
_TO_READ = os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0)
"""Without waiting for what comes out of a pipe."""
_LINE_ENDS = ((b"\r\n", b"\n"), (b"\r", b"\n"))


def said_again(arguments: Sequence[str]) -> bool:
    """Say what a command would say, and return True, where it is known to have nothing to do."""
    try:
        file = _file(arguments)
        record = cache.kept(file, b"") if file is not None else None
        if record is None:
            return False
        compiler, typed, held, facts, read, written, there, others, words = _apart(record)
        app, hooks, folder, beside = _texts(read)
        files = _texts(written)
        if (
            _digest(_typed(app, hooks, beside)) != typed  # first what most likely has changed
            or identity() != compiler
            or digest(map(fact, _texts(others))) != facts
            or not _is_as_left(folder, files, _texts(there))
            or _digest(_held(folder, files)) != held
        ):
            return False
    except (OSError, ValueError):
        return False
    told = _texts(words)
    speak((on_output == "1", text) for on_output, text in zip(told[::2], told[1::2], strict=True))
    return True


def remember(
    arguments: Sequence[str],
    app: tuple[str, str],
    hooks: tuple[str, str],
    beside: tuple[str, str | None],
    folder: str,
    written: Mapping[str, str],
    there: Iterable[str],
    others: Iterable[str],
    words: Words,
) -> None:
    """Keep what a compile has left, and what it would say next time.

    Of the app and its hooks.py the path and the text that were compiled; `beside` is the place of
    a hooks.py that is passed over for that one, and its text if there is one. Of the folder the texts
    that were written, and what else is there. `others` are files and folders of other packages, on
    which the outcome hangs.
    """
    try:
        file = _file(arguments)
        if file is None:
            return
        on = list(others)
        record = [
            identity(last_facts_of_package),  # what was compiled with, whatever came meanwhile
            _digest(one.encode() for one in (app[1], hooks[1], beside[1]) if one is not None),
            _digest(text.encode() for text in written.values()),
            digest(map(fact, on)),
            _bytes([app[0], hooks[0], folder, beside[0]]),
            _bytes(written),
            _bytes(there),
            _bytes(on),
            _bytes(one for on_output, text in words for one in (str(int(on_output)), text)),
        ]
        cache.keep(file, b"", b"".join(_strung(record)))
        cache.tidy(file.parent, _MOST)
    except (OSError, ValueError):
        return


def speak(words: Words) -> None:
    """Say some words, each where it belongs."""
    for on_output, text in words:
        (output.line if on_output else output.tell)(text)


def _file(arguments: Sequence[str]) -> Path | None:
    """Return where the record of a command is, given in this folder and on this terminal."""
    facts = (os.getcwd(), in_colour(sys.stderr), *arguments)
    return cache.cache_file(sha256(os.fsencode(repr(facts))).hexdigest(), SHELF)


def _is_as_left(folder: str, written: Iterable[str], there: Iterable[str]) -> bool:
    """Say whether all files are in their places, and no link is in the way."""
    folders = {folder}
    for path in (*written, *there):
        target = os.path.join(folder, *path.split("/"))
        if not stat.S_ISREG(os.lstat(target).st_mode):
            return False
        while (target := os.path.dirname(target)) not in folders:
            folders.add(target)
    return all(stat.S_ISDIR(os.lstat(one).st_mode) for one in folders)


def _typed(app: str, hooks: str, beside: str) -> Iterator[bytes]:
    """Yield what people wrote, as the compiler reads it."""
    yield _read(app)
    yield _module(hooks)
    if os.path.lexists(beside):
        yield _module(beside)


def _module(path: str) -> bytes:
    own = _read(path).removeprefix(b"\xef\xbb\xbf")
    for end, plain in _LINE_ENDS:
        own = own.replace(end, plain)
    return own


def _held(folder: str, written: Iterable[str]) -> Iterator[bytes]:
    """Yield what the package's files hold, as the compiler compares it."""
    for path in written:
        data = _read(os.path.join(folder, *path.split("/")))
        # one byte is found ten times as fast as two
        yield data.replace(b"\r\n", b"\n") if b"\r" in data else data


def _read(path: str) -> bytes:
    """Return what a file holds; raise `OSError` where it is no ordinary one.

    By the system's own calls: there are hundreds of files, and a file object takes as long again.
    """
    handle = os.open(path, _TO_READ)
    try:
        facts = os.fstat(handle)
        if not stat.S_ISREG(facts.st_mode) or facts.st_size > _LARGEST:
            raise OSError(path)
        return os.read(handle, facts.st_size + 1)
    finally:
        os.close(handle)


def _digest(contents: Iterable[bytes]) -> bytes:
    whole = sha256()
    for piece in _strung(contents):
        whole.update(piece)
    return whole.digest()


def _strung(parts: Iterable[bytes]) -> Iterator[bytes]:
    """Yield parts so that they can be told apart again: each behind its length."""
    for part in parts:
        yield b"%d:" % len(part)
        yield part


def _apart(record: bytes) -> list[bytes]:
    """Return the parts; raise `ValueError` where there are none."""
    parts: list[bytes] = []
    at = 0
    while at < len(record):
        begin = record.index(b":", at) + 1
        at = begin + int(record[at : begin - 1])
        parts.append(record[begin:at])
    return parts


def _bytes(texts: Iterable[str]) -> bytes:
    return b"".join(_strung(text.encode("utf-8", "surrogateescape") for text in texts))


def _texts(record: bytes) -> list[str]:
    return [part.decode("utf-8", "surrogateescape") for part in _apart(record)]
