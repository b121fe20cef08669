"""An app as the library knows it: what its brain says of it in plain data, and the brain itself.

Of the package's own `_runtime` the library imports the module `brain` and no other. So each app has its
classes for itself, and several apps fly in one process.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, make_dataclass
from dataclasses import field as dataclass_field
from functools import lru_cache
from importlib import import_module
from types import ModuleType
from typing import TYPE_CHECKING, Any, NoReturn, TypeVar

from .process.signal_guard import IN_A_PROCESS
from .seam import check
from .shared.domain import app as shared
from .shared.domain.actions import Action, Parameter
from .shared.domain.errors import BadInput
from .shared.domain.fields import Entity, Field, FieldType
from .shared.domain.model import Category, Mission, Trip
from .shared.domain.own_fields import OwnField
from .shared.domain.quantities import Type
from .shared.events.declared import (
    FOLLOWING,
    AlongAction,
    AlongField,
    CompanyDeclared,
    Creator,
    EventsDeclared,
    EventType,
    FollowDeclared,
    TrackField,
    TracksDeclared,
)
from .shared.events.part import PartOf

if TYPE_CHECKING:
    from .shared.brain import Brain
    from .shared.domain.airspace import Airspace
    from .shared.time.told import HookRunner

T = TypeVar("T", bound=type)

_WHERE = ".domain."
"""The module of a brain in which its description of an app is."""


@dataclass(frozen=True, slots=True, kw_only=True)
class App(shared.App):
    """An app: its fields, actions and categories in the library's own classes, and its brain."""

    package: str
    """The name of the package."""
    seam: int
    given: object
    """The package's own description, for its brain alone."""
    brain: ModuleType
    """The package's module `_runtime.brain`."""

    def new_brain(
        self, fleet: Mapping[str, Any], *, space: Airspace, hooks: HookRunner | None = None
    ) -> Brain:
        """Return a brain of this app."""
        made: Brain = self.brain.Brain(self.given, fleet, space=space, hooks=hooks)
        return made

    def perform(self, brain: Any, request: Mapping[str, Any], now: float) -> None:
        """Have a brain carry out a command; raise the library's `BadInput` if it cannot be done."""
        try:
            brain.command(request, now)
        except self.brain.BadInput as error:
            raise BadInput(str(error)) from None


def described(given: Any) -> App:
    """Return the app that a package describes as its `APP`; raise `BadInput` if their seams do not match."""
    if isinstance(given, App):
        return given
    runtime = type(given).__module__.rpartition(_WHERE)[0]
    brain = import_module(f"{runtime}.brain")
    check(given.name, brain.SEAM)
    brain.put_guard(IN_A_PROCESS)
    about: Mapping[str, Any] = brain.about(given)
    fields = tuple(map(_field, about["fields"]))
    return App(
        name=about["name"],
        title=about["title"],
        flow=given.flow,
        mission=_with(Mission, Entity.MISSION, fields, given.mission.__module__),
        trip=_with(Trip, Entity.TRIP, fields, given.trip.__module__),
        fields=fields,
        categories=tuple(map(_category, about["categories"])),
        actions={
            one["name"]: _action(one, given.actions[one["name"]].hook) for one in about["actions"]
        },
        evaluators={name: given.evaluators[name] for name in about["evaluators"]},
        resumes=tuple(about["resumes"]),
        results=tuple(about["results"]),
        parts=_parts(about),
        package=runtime.rpartition(".")[0] or runtime,
        seam=brain.SEAM,
        given=given,
        brain=brain,
    )


def bare(name: str, package: str, seam: int) -> App:
    """Return an app with nothing but its name, for commands that need no more."""

    def flow(_: object) -> NoReturn:
        raise RuntimeError("nothing flies here")

    return App(
        name=name,
        title=name,
        flow=flow,
        mission=Mission,
        trip=Trip,
        fields=(),
        categories=(),
        actions={},
        package=package,
        seam=seam,
        given=None,
        brain=ModuleType("no brain"),
    )


def _field(data: Mapping[str, Any]) -> Field:
    known = {"name": data["name"], "label": data["label"], "default": data["default"]}
    if data.get("own"):
        return OwnField(**known, on=Entity(data["on"]), type=Type(data["type"]))
    kind = {one.value: one for one in (*Type, *FieldType)}[data["type"]]
    if kind is FieldType.ALONG:
        return AlongField(**known, on=Entity.TRIP, type=kind, actions=tuple(data["actions"]))
    of_class = TrackField if kind is Type.TEXT else Field
    return of_class(**known, on=Entity(data["on"]), type=kind)


def _parts(about: Mapping[str, Any]) -> tuple[PartOf, ...]:
    """Return what an app has beside missions and drones, as far as a library must know it."""
    if "events" not in about:
        return ()
    types = tuple(
        EventType(name=one["name"], fields=_parameters(one["parameters"]))
        for one in about["events"]
    )
    creators = tuple(Creator(**one, hook=_nobody) for one in about["creators"])
    own = tuple(
        AlongAction(name=one["name"], parameters=_parameters(one["parameters"]))
        for one in about["along"]
    )
    return EventsDeclared(types, creators), TracksDeclared(), CompanyDeclared(own)


def _nobody(*_: object) -> None:
    """Stand for a creator: only the brain calls it."""


def _category(data: Mapping[str, Any]) -> Category:
    able = data["actions"]
    known = {key: value for key, value in data.items() if key not in ("motion", "top_speed")}
    return Category(**{**known, "actions": None if able is None else frozenset(able)})


def _action(data: Mapping[str, Any], hook: Callable[..., Any] | None) -> Action:
    known = {key: data[key] for key in ("name", "repeat", "takes")}
    of_class = FollowDeclared if data["name"] == FOLLOWING else Action
    return of_class(**known, parameters=_parameters(data["parameters"]), hook=hook)


def _parameters(given: Iterable[Mapping[str, Any]]) -> tuple[Parameter, ...]:
    return tuple(
        Parameter(name=one["name"], type=Type(one["type"]), default=one["default"]) for one in given
    )


@lru_cache(maxsize=100)
def _with(base: T, entity: Entity, fields: tuple[Field, ...], module: str) -> T:
    """Return the class of an app's missions or trips, made once: with the fields that its graph adds."""
    added = [
        (one.name, object, dataclass_field(default=one.default))
        for one in fields
        if one.on is entity
    ]
    made: Any = make_dataclass(
        base.__name__, added, bases=(base,), kw_only=True, eq=False, slots=True
    )
    made.__module__ = module
    classes: T = made
    return classes
