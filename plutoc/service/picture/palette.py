"""All kinds of blocks that are installed, as an editor offers them; plain data."""

from __future__ import annotations

from collections.abc import Iterator

from plutoc.block import Block, HookParam
from plutoc.registry import STD, RegistryError, blocks_of, installed_packages
from plutoc.report.block_page import first_line, page
from plutoc.service.picture.arguments import argument
from plutoc.service.picture.view import kind_of

Data = dict[str, object]


def palette() -> list[Data]:
    """Return every kind of block, ours first; of a package that is broken, why."""
    return list(_palette())


def _palette() -> Iterator[Data]:
    for package in installed_packages():
        try:
            declared = blocks_of(package)
        except RegistryError as error:
            yield {"package": package, "broken": str(error)}
            continue
        for kind, block in declared.items():
            yield _entry(package, kind, block)


def _entry(package: str, kind: str, block: Block) -> Data:
    hooks = [one.kind.value for one in block.params if isinstance(one, HookParam)]
    return {
        "kind": kind,
        "package": package,
        "doc": page(kind if package == STD else f"{package}.{kind}", block),
        "first": first_line(block),
        **kind_of(block),
        "gate": block.gate is not None,
        "params": [argument(one) for one in block.params],
        "hook": hooks[0] if hooks else None,
    }
