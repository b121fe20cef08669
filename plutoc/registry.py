"""The blocks that are installed: found by their packages' entry points, loaded when first used.

To look for entry points takes longer than to check an app. So it is done only where an app uses
another package: where ours are is known.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from functools import cache
from importlib import import_module
from importlib.metadata import entry_points
from types import MappingProxyType

from plutoc.block import Block
from plutoc.declarations import is_name, mistakes_in
from plutoc.foreign_code import Terminated, by_a_person, isolated
from plutoc_runtime.domain.text import printable, said

GROUP = "plutoc.blocks"
STD = "std"
"""The package whose kinds need no prefix: ours."""
OURS = "plutoc_blocks:BLOCKS"
"""Its entry point."""


class RegistryError(Exception):
    """A package of blocks cannot be used. The message is a sentence for a person.

    It may quote what a stranger has written: nothing in it can command a terminal.
    """

    def __init__(self, message: str) -> None:
        super().__init__("\n".join(map(printable, message.split("\n"))))


@dataclass(frozen=True, slots=True, kw_only=True)
class Blocks:
    """The packages there are, and how to get one's blocks by kind."""

    packages: tuple[str, ...]
    of: Callable[[str], Mapping[str, Block]]
    """Raises `RegistryError` where the package is broken."""


def blocks() -> Blocks:
    """Return the installed packages. Nothing is loaded yet."""
    return Blocks(packages=installed_packages(), of=blocks_of)


def standard() -> Blocks:
    """Return ours alone, for an app that uses no other package."""
    return Blocks(packages=(STD,), of=blocks_of)


def installed() -> Mapping[str, Mapping[str, Block]]:
    """Load every package: its name, then its kinds. One broken package fails the whole."""
    return {name: blocks_of(name) for name in installed_packages()}


def installed_packages() -> tuple[str, ...]:
    """Return the names of the installed packages of blocks, ours first."""
    names = {point.name for point in entry_points(group=GROUP)} - {STD}
    return (STD, *sorted(names))


@cache
def blocks_of(package: str) -> Mapping[str, Block]:
    """Load a package's blocks, by kind; raise `RegistryError` where that fails."""
    if package == STD:
        return _loaded(package, OURS, _ours)
    points = list(entry_points(group=GROUP, name=package))
    if not points:
        raise RegistryError(f"no package of blocks named {package} is installed")
    values = {point.value for point in points}  # one may be found twice on the path
    if len(values) > 1:
        raise RegistryError(
            f"two installed packages call their blocks {package}: {', '.join(sorted(values))}"
        )
    return _loaded(package, points[0].value, points[0].load)


def _ours() -> object:
    module, _, attribute = OURS.partition(":")
    declared: object = getattr(import_module(module), attribute)
    return declared


def _theirs(package: str, value: str, load: Callable[[], object]) -> object:
    """Load a package's own code, which may raise anything, or end Python: neither passes for ours."""
    with isolated():
        try:
            declared = load()
            return tuple(declared) if isinstance(declared, Iterable) else declared
        except Terminated:
            raise
        except BaseException as error:
            if by_a_person(error):
                raise
            raise RegistryError(
                f"the blocks of {package} cannot be loaded from {value}: {said(error)}"
            ) from error


def _loaded(package: str, value: str, load: Callable[[], object]) -> Mapping[str, Block]:
    declared = load() if package == STD else _theirs(package, value, load)
    if not isinstance(declared, tuple):
        raise RegistryError(
            f"{value} of {package} is of type {type(declared).__name__}, not a tuple of blocks"
        )
    found: dict[str, Block] = {}
    for block in declared:
        if not isinstance(block, Block):
            raise RegistryError(
                f"{value} of {package} holds something of type {type(block).__name__}, not only blocks"
            )
        if package != STD:  # ours are looked at by our tests: this takes its time
            _look_at(block, package)
        if (block.holds or block.allocates) and not block.named:
            what = "gives missions their drones" if block.allocates else "holds missions back"
            raise RegistryError(
                f"{block.name} of {package} {what} and is not declared with named=True:"
                " an interrupted mission may go on there, and its step must say so by run.meets(block)"
            )
        if block.name in found:
            raise RegistryError(f"{package} declares {block.name} twice")
        found[block.name] = block
    return MappingProxyType(found)


def _look_at(block: Block, package: str) -> None:
    """Raise `RegistryError` if a declaration is not what it must be."""
    try:
        mistakes = list(mistakes_in(block))
    except (KeyboardInterrupt, Terminated):
        raise
    except BaseException as error:  # noqa: BLE001 - their classes may raise anything
        mistakes = [f"it cannot be looked at: {type(error).__name__}"]
    if mistakes:
        given = getattr(block, "name", None)
        name = given if is_name(given) else "one of its blocks"
        raise RegistryError(f"{name} of {package} is not declared as a block is: {mistakes[0]}")
