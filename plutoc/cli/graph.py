"""`graph`: the picture of an app."""

from __future__ import annotations

from plutoc.check.model import Checked
from plutoc.cli.endings import CLEAN, Unusable
from plutoc.cli.files import read_app
from plutoc.cli.options import Options
from plutoc.cli.say import say
from plutoc.compile import analyse
from plutoc.report.graph import NoGraphviz, dot, dot_to_svg, json, mermaid
from plutoc_runtime import output


def graph(options: Options) -> int:
    """Draw the graph of an app without errors."""
    checked, warnings = analyse(read_app(options.file))
    say(warnings)
    output.line(_drawn(checked, options.picture).rstrip("\n"))
    return CLEAN


def _drawn(checked: Checked, picture: str) -> str:
    match picture:
        case "mermaid":
            return mermaid(checked)
        case "dot":
            return dot(checked)
        case "json":
            return json(checked)
        case _:
            try:
                return dot_to_svg(dot(checked))
            except NoGraphviz as error:
                raise Unusable(str(error)) from None
