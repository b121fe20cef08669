"""`blocks`: which there are, and what each does."""

from __future__ import annotations

from collections.abc import Iterator

from plutoc.block import Block
from plutoc.cli.endings import CLEAN, ERRORS, Unusable
from plutoc.cli.options import Options
from plutoc.graph.names import near
from plutoc.registry import STD, RegistryError, blocks_of, installed_packages
from plutoc.report.block_page import first_line, page
from plutoc_runtime import output


def blocks(options: Options) -> int:
    """List the blocks, or print one's page."""
    broken: list[str] = []
    found = dict(_installed(broken))
    for sentence in broken:
        output.tell(f"plutoc: {sentence}")
    if options.kind is not None:
        output.line(_page(options.kind, found))
        return CLEAN
    width = max((len(name) for name in found), default=0)
    for name, block in found.items():
        output.line(f"{name:{width}}  {first_line(block)}")
    return ERRORS if broken else CLEAN


def _installed(broken: list[str]) -> Iterator[tuple[str, Block]]:
    """Yield every block with its name as an app writes it."""
    for package in installed_packages():
        try:
            declared = blocks_of(package)
        except RegistryError as error:
            broken.append(str(error))
            continue
        for kind, block in declared.items():
            yield kind if package == STD else f"{package}.{kind}", block


def _page(kind: str, found: dict[str, Block]) -> str:
    if kind not in found:
        part = [name for name in found if len(kind) > 2 and kind.lower() in name.lower()]
        meant = part or near(kind, found)
        raise Unusable(
            f"there is no block `{kind}`"
            + (f"; did you mean {' or '.join(meant)}?" if meant else ": `plutoc blocks` lists them")
        )
    return page(kind, found[kind]).rstrip("\n")
