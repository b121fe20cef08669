"""`check`: what is wrong with apps."""

from __future__ import annotations

from pathlib import Path

from plutoc.cli.endings import CLEAN, ERRORS, USAGE, Unusable
from plutoc.cli.files import default_folder, find_hooks, read_app, shown
from plutoc.cli.options import Options
from plutoc.cli.say import say
from plutoc.compile import analyse, check_hooks
from plutoc.diagnostic import Diagnostic, Rejected
from plutoc_runtime.cli import output


def check(options: Options) -> int:
    """Check every file, and say what was found in all of them."""
    found: list[Diagnostic] = []
    code = CLEAN
    for file in options.files:
        try:
            warnings = _warnings(file)
        except Unusable as error:
            output.tell(f"plutoc: {error}")
            code = USAGE
        except Rejected as rejected:
            found += rejected.diagnostics
            code = max(code, ERRORS)
        else:
            found += warnings
            if options.format == "text":
                output.line(f"{shown(file)}: no errors")
    say(found, options.format)
    return code


def _warnings(file: Path) -> tuple[Diagnostic, ...]:
    checked, warnings = analyse(read_app(file))
    hooks = find_hooks(checked, file, default_folder(file, checked))
    return warnings + check_hooks(checked, hooks)
