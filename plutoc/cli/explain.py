"""`explain`: what a code means, and how to mend what it is about."""

from __future__ import annotations

import sys

from plutoc.cli.colour import in_colour
from plutoc.cli.endings import CLEAN, Unusable
from plutoc.cli.options import Options
from plutoc.explain.pages import code_meant, codes, page
from plutoc.explain.text import render, render_list
from plutoc.graph.names import near
from plutoc_runtime import output
from plutoc_runtime.domain.text import printable


def explain(options: Options) -> int:
    """Print the page of a code, or all codes with their titles."""
    colour = in_colour(sys.stdout)
    every = codes()
    if options.code is None:
        text = render_list(map(page, every), colour=colour)
    else:
        text = render(page(_known(options.code, every)), colour=colour)
    output.line(text.rstrip("\n"))
    return CLEAN


def _known(asked: str, every: tuple[str, ...]) -> str:
    code = code_meant(asked)
    if code in every:
        return code
    meant = near(code, every)
    raise Unusable(
        f"there is no code `{printable(asked)}`"
        + (f"; did you mean {' or '.join(meant)}?" if meant else ": `plutoc explain` lists them")
    )
