"""`edit`: an app's graph in a browser, beside its text."""

from __future__ import annotations

from importlib.util import find_spec

from plutoc.cli.endings import CLEAN, UsageError
from plutoc.cli.options import Options

_EXTRA = ("starlette", "uvicorn", "websockets")


def edit(options: Options) -> int:
    """Serve the editor until Ctrl-C, which is its proper end."""
    if any(find_spec(name) is None for name in _EXTRA):
        raise UsageError('edit needs a web server: pip install "plutoc[editor]"')
    from plutoc.editor.disk import CannotRead
    from plutoc.editor.run import CannotServe, run

    try:
        run(options.file, host=options.host, port=options.port, opens=not options.no_open)
    except (CannotRead, CannotServe) as error:
        raise UsageError(str(error)) from None
    except KeyboardInterrupt:
        pass
    return CLEAN
