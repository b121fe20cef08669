"""The description of an app by its generated package: its fields, actions, hooks and flow."""

from __future__ import annotations

from collections.abc import Callable, Coroutine, Iterable, Mapping
from dataclasses import asdict, dataclass, field, replace
from math import inf
from typing import TYPE_CHECKING, Any, TypeVar

from .status import Status

if TYPE_CHECKING:
    from .actions import Action, Parameter
    from .fields import Field
    from .model import Category, Mission, Trip
    from .motion import Motion

A = TypeVar("A", bound="App")

SEAM = 1
"""The seam to the library: it changes with whatever crosses, and both sides must have the same one."""

Flow = Callable[[Any], Coroutine[Any, Any, Status]]
"""The coroutine function that takes one mission from start to end."""


@dataclass(frozen=True, slots=True, kw_only=True)
class App:
    """An app: everything that its command line and its engine need to know."""

    name: str
    title: str
    flow: Flow
    mission: type[Mission[Any]]
    trip: type[Trip]
    fields: tuple[Field, ...]
    """The fields that exist besides the basic ones, missions' before trips'."""
    categories: tuple[Category, ...]
    actions: Mapping[str, Action]  # all actions, the built-in ones before the app's own
    evaluators: Mapping[str, Callable[..., Any]] = field(default_factory=dict)
    """The app's evaluators, by name."""
    resumes: tuple[str, ...] = ()
    """The blocks at which an interrupted mission can resume: `flow` can be entered there."""
    results: tuple[Mapping[str, Any], ...] = ()
    """What the results of actions are, and how they are shown: for the library alone."""
    parts: tuple[Any, ...] = ()
    """What this app has beside missions and drones, such as events: each a `PartOf`."""

    @property
    def entries(self) -> tuple[str, ...]:
        """The blocks at which `flow` can be entered: where missions go on, and where events' missions begin."""
        return (*self.resumes, *(block for part in self.parts for block in part.entries()))


def needs_library(what: str, extra: str = "") -> str:
    """Say how to install what a package alone cannot do."""
    library = f'"pluto-fleet{extra}{library_for(SEAM)}"'
    said = f"needs pluto-fleet, the library that flies: pip install {library}"
    sources = f'Pluto\'s sources: pip install "PLUTO/runtime{extra}")'
    return f"{what} {said} (without an index, from {sources}"


def library_for(seam: int) -> str:
    """Return which versions of the library speak a seam, as a requirement writes it."""
    return f"==0.{seam}.*"


def moving(app: A, motion: Motion, *, charges: bool = True) -> A:
    """Return an app whose drones move so; without `charges`, what they have is never charged."""
    kinds = [replace(one, motion=motion) for one in app.categories]
    if not charges:
        kinds = [replace(one, charge_time=inf) for one in kinds]
    return replace(app, categories=tuple(kinds))


def about(app: App) -> dict[str, Any]:
    """Return what an app is made of as plain data: all that a library knows of it."""
    return {
        "name": app.name,
        "title": app.title,
        "fields": [{**asdict(f), "on": f.on.value, "type": f.type.value} for f in app.fields],
        "categories": [
            {**asdict(one), "actions": one.actions and sorted(one.actions)}
            for one in app.categories
        ],
        "actions": [
            {
                "name": one.name,
                "parameters": parameters_data(one.parameters),
                "repeat": one.repeat,
                "takes": one.takes,
                "own": one.hook is not None,
            }
            for one in app.actions.values()
        ],
        "evaluators": list(app.evaluators),
        "resumes": list(app.resumes),
        "results": list(app.results),
        **{name: each for part in app.parts for name, each in part.about().items()},
    }


def parameters_data(parameters: Iterable[Parameter]) -> list[dict[str, Any]]:
    """Return parameters as plain data."""
    return [{**asdict(each), "type": each.type.value} for each in parameters]
