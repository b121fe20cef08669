"""Tables and bars. At a terminal `rich` draws them; a file gets plain lines, as wide as they need.

`rich` takes as long to import as a small simulation, and is imported only where it draws.
"""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from typing import TextIO

from ..shared import output
from ..shared.domain.text import printable

_AFTER = 1.0
_EVERY = 0.1
_EVERY_LINE = 10.0
"""Seconds of real time until a bar appears, between two updates of it, and between two lines instead of it."""

_WIDTH = 30

_STYLES = {
    "COMPLETED": "green",
    "FAILED": "red",
    "CANCELLED": "yellow",
    "UNCERTAIN": "yellow",
    "HELD": "yellow",
    "LOST": "red",
    "ready": "green",
}
"""How cells with these words are drawn."""


def table(
    header: Sequence[str], rows: Sequence[Sequence[str]], *, right: Sequence[int]
) -> Iterator[str]:
    """Yield the lines of a table; the columns named by `right` hold numbers."""
    cells = [[printable(cell) for cell in row] for row in (header, *rows)]
    if is_terminal(sys.stdout):
        yield from _drawn(cells, right)
        return
    widths = [max(len(row[column]) for row in cells) for column in range(len(header))]
    for row in cells:
        aligned = [
            cell.rjust(width) if column in right else cell.ljust(width)
            for column, (cell, width) in enumerate(zip(row, widths, strict=True))
        ]
        yield "  ".join(aligned).rstrip()


def _drawn(cells: Sequence[Sequence[str]], right: Sequence[int]) -> Iterator[str]:
    """Yield the lines of a table that is no wider than the terminal: words wrap in their columns."""
    from rich.console import Console
    from rich.table import Table
    from rich.text import Text

    header, *rows = cells
    drawn = Table(box=None, padding=(0, 2, 0, 0), pad_edge=False, header_style="bold")
    for column, title in enumerate(header):
        number = column in right
        drawn.add_column(Text(title), justify="right" if number else "left", no_wrap=number)
    for row in rows:
        drawn.add_row(*(Text(cell, _STYLES.get(cell, "")) for cell in row))
    console = Console()
    with console.capture() as capture:
        console.print(drawn)
    yield from map(str.rstrip, capture.get().splitlines())


class Progress:
    """Shows the progress of a long task: by a bar at a terminal, or else by a line now and then."""

    def __init__(
        self,
        stream: TextIO | None,
        say: Callable[[str], object] | None = None,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        """`stream` is the terminal, if there is one; `say` is called with a line where there is none."""
        self._stream = stream
        self._clock = clock
        self._say = say if stream is None else None
        self._next = clock() + (_EVERY_LINE if stream is None else _AFTER)
        self._is_drawn = False

    @property
    def is_told(self) -> bool:
        """Whether an update is worth its while."""
        return self._stream is not None or self._say is not None

    def update(self, share: float, text: str) -> None:
        """Show this share, from 0 to 1."""
        if not self.is_told or (now := self._clock()) < self._next:
            return
        if self._say is not None:
            self._next = now + _EVERY_LINE
            self._say(text)
        elif self._stream is not None:
            self._next = now + _EVERY
            self._write(_GONE + _bar(self._stream, share, text))
            self._is_drawn = True

    def clear(self) -> None:
        """Remove the bar."""
        if self._is_drawn:
            self._write(_GONE)
            self._is_drawn = False

    def _write(self, text: str) -> None:
        try:
            assert self._stream is not None
            self._stream.write(text)
            self._stream.flush()
        except OSError:
            self._stream = None


_GONE = "\r\x1b[2K"
"""Empties the line of a terminal."""


def _bar(stream: TextIO, share: float, text: str) -> str:
    from rich.console import Console
    from rich.progress_bar import ProgressBar
    from rich.table import Table
    from rich.text import Text

    console = Console(file=stream, force_terminal=True)
    words = Text(text)
    words.truncate(console.width - _WIDTH - 1, overflow="ellipsis")
    line = Table.grid(padding=(0, 1))
    line.add_row(ProgressBar(total=1.0, completed=min(share, 1.0), width=_WIDTH), words)
    with console.capture() as capture:
        console.print(line, end="")
    return capture.get().rstrip("\n")


def simulation_progress(*, quiet: bool) -> Progress:
    """Return a bar, shown on a terminal to which nothing else is printed."""
    busy = not quiet and is_terminal(sys.stdout)
    return Progress(None if busy else _terminal())


def trial_progress(*, lines: bool) -> Progress:
    """Return a bar on a terminal, or lines elsewhere."""
    say = (lambda text: output.tell(f"plutoc test: {text}")) if lines else None
    return Progress(_terminal(), say)


def _terminal() -> TextIO | None:
    """Return standard error, if it is a terminal on which a line can be replaced."""
    return sys.stderr if is_terminal(sys.stderr) and os.environ.get("TERM") != "dumb" else None


def is_terminal(stream: TextIO | None) -> bool:
    """Return whether a person reads what is written there."""
    return stream is not None and not stream.closed and stream.isatty()
