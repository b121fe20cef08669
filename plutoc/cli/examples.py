"""The examples that a new app can begin with: in a wheel within the package, in a checkout beside it."""

from __future__ import annotations

from functools import cache
from importlib.resources import files
from importlib.resources.abc import Traversable

from plutoc.cli.endings import UsageError
from plutoc.graph.names import near
from plutoc.source import Source
from plutoc.syntax.parse import parse
from plutoc.syntax.tree import AppDecl
from plutoc_runtime.domain.text import printable

_APP, _HOOKS = "app.pluto", "hooks.py"
_BESIDE = ("missions.toml", "fleet.toml", "map.svg")


def names() -> list[str]:
    """Return the names of all examples."""
    return sorted(each.name for each in _home().iterdir() if each.joinpath(_APP).is_file())


def listing() -> str:
    """Return a line for each example: its name and its title."""
    every = names()
    width = max(map(len, every))
    return "\n".join(f"{name:{width}}  {title(name)}" for name in every)


def title(example: str) -> str:
    """Return what an example is about, as its app says it."""
    said = _declared(_source(example)).title
    return said.value if said else example


def has_hooks(example: str) -> bool:
    """Return whether code of the developer's belongs to an example."""
    return _home().joinpath(example, _HOOKS).is_file()


def copied(example: str, name: str) -> dict[str, str]:
    """Return an example's files, for an app of another name; `UsageError` where there is none."""
    every = names()
    if example not in every:
        meant = near(example, every)
        raise UsageError(
            f"there is no example `{printable(example)}`"
            + (f"; did you mean {' or '.join(meant)}?" if meant else "")
            + "\nhelp: `plutoc new --list` lists them"
        )
    source = _source(example)
    start, end = _declared(source).name.span
    lists = [one.name for one in _home().joinpath(example).iterdir() if one.name.endswith(".csv")]
    others = [*_BESIDE, *([_HOOKS] if has_hooks(example) else []), *sorted(lists)]
    return {
        f"{name}.pluto": source.text[:start] + name + source.text[end:],
        **{file: _text(example, file) for file in others},
    }


def _declared(source: Source) -> AppDecl:
    return parse(source).app


def _source(example: str) -> Source:
    return Source(f"{example}/{_APP}", _text(example, _APP))


def _text(example: str, file: str) -> str:
    return _home().joinpath(example, file).read_text(encoding="utf-8")


@cache
def _home() -> Traversable:
    inside = files("plutoc").joinpath("examples")
    return inside if inside.is_dir() else files("plutoc").joinpath("..", "examples")
