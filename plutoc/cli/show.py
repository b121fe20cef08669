"""`graph`, `blocks` and `explain`: the commands that show something."""

from __future__ import annotations

import sys
from collections.abc import Iterator

from plutoc.block import Block
from plutoc.check.model import Checked
from plutoc.cli.endings import CLEAN, ERRORS, UsageError
from plutoc.cli.files import read_app
from plutoc.cli.options import Options
from plutoc.cli.say import in_colour, say
from plutoc.compile import analyse
from plutoc.explain.pages import code_meant, codes, page, render, render_list
from plutoc.graph.names import near
from plutoc.registry import STD, RegistryError, blocks_of, installed_packages
from plutoc.report import block_page
from plutoc.report.pictures import NoGraphviz, dot, dot_to_svg, json, mermaid
from plutoc_runtime import output
from plutoc_runtime.domain.text import printable


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
                raise UsageError(str(error)) from None


def blocks(options: Options) -> int:
    """List the blocks, or print one's page."""
    broken: list[str] = []
    found = dict(installed(broken))
    for sentence in broken:
        output.tell(f"plutoc: {sentence}")
    if options.kind is not None:
        output.line(_page_of_block(options.kind, found))
        return CLEAN
    width = max((len(name) for name in found), default=0)
    for name, block in found.items():
        output.line(f"{name:{width}}  {block_page.first_line(block)}")
    return ERRORS if broken else CLEAN


def installed(broken: list[str]) -> Iterator[tuple[str, Block]]:
    """Yield every block with its name as an app writes it; packages that are `broken` are told there."""
    for package in installed_packages():
        try:
            declared = blocks_of(package)
        except RegistryError as error:
            broken.append(str(error))
            continue
        for kind, block in declared.items():
            yield kind if package == STD else f"{package}.{kind}", block


def _page_of_block(kind: str, found: dict[str, Block]) -> str:
    if kind not in found:
        part = [name for name in found if len(kind) > 2 and kind.lower() in name.lower()]
        meant = part or near(kind, found)
        raise UsageError(
            f"there is no block `{kind}`"
            + (f"; did you mean {' or '.join(meant)}?" if meant else ": `plutoc blocks` lists them")
        )
    return block_page.page(kind, found[kind]).rstrip("\n")


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
    raise UsageError(
        f"there is no code `{printable(asked)}`"
        + (f"; did you mean {' or '.join(meant)}?" if meant else ": `plutoc explain` lists them")
    )
