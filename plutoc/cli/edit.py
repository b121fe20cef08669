"""`edit`: an app's graph in a browser, beside its text."""

from __future__ import annotations

from contextlib import suppress
from importlib.util import find_spec

from plutoc.cli.endings import CLEAN, UsageError
from plutoc.cli.options import Options

_EXTRA = ("starlette", "uvicorn", "websockets")


def edit(options: Options) -> int:
    """Serve the editor until Ctrl-C, which is its proper end."""
    if any(find_spec(name) is None for name in _EXTRA):
        raise UsageError('edit needs a web server: pip install "plutoc[editor]"')
    from plutoc.editor.run import run

    with suppress(KeyboardInterrupt):
        run(options.file, host=options.host, port=options.port, opens=not options.no_open)
    return CLEAN
