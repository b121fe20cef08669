"""The types that hooks are written with: what is refused, and what is believed."""

from __future__ import annotations

import pytest

from plutoc.check.model import Checked
from plutoc.compile import analyse, check_hooks
from plutoc.diagnostic import Diagnostic, Rejected
from plutoc.emit.hooks_file import hooks_file
from plutoc.source import Source
from tests.compiler.emit.apps import ODD_NAMES
from tests.compiler.hooks.test_check import APP

HEAD = "from . import Context, Drone, Mission, Results, Status, Trip, Verdict\n"
WAITING = f"{HEAD}from . import Again, Assignment, Waiting\n"
HOOKS = {
    "pollinate": "(drone, trip, context, *, dose)",
    "find_blooms": "(mission, results)",
    "limit_trip": "(mission, context, *, limit)",
    "by_battery": "(trip, candidates)",
}


@pytest.fixture(scope="module")
def crop() -> Checked:
    """An app with a hook of each kind; the types of its package are called as in every one."""
    return analyse(Source("app.pluto", APP))[0]


def found(checked: Checked, hooks: str) -> list[Diagnostic]:
    """Return what is found in a hooks.py."""
    try:
        check_hooks(checked, Source("hooks.py", hooks))
    except Rejected as rejected:
        return list(rejected.diagnostics)
    return []


def written(changed: str, signature: str, *, head: str = HEAD, body: str = "...") -> str:
    """Return a hooks.py of which one hook has another signature."""
    parts = [head]
    for name, plain in HOOKS.items():
        mine = name == changed
        parts.append(f"def {name}{signature if mine else plain}: {body if mine else '...'}\n")
    return "".join(parts)


@pytest.mark.parametrize(
    ("name", "signature", "head"),
    [
        ("find_blooms", "(mission: Mission, results: Results) -> Verdict", HEAD),
        ("find_blooms", '(mission: "Mission", results: "Results") -> "Verdict"', HEAD),
        ("find_blooms", '(mission: "Mission", results: "Results") -> "Verdict"', ""),
        ("find_blooms", "(mission: Mission, results: Results) -> Verdict",
         "from __future__ import annotations\n"),
        ("find_blooms", "(mission: crop.Mission, results: crop.Results)", "import crop\n"),
        ("find_blooms", "(mission: c.Mission, results: c.Results)", "import crop as c\n"),
        ("find_blooms", "(mission: M, results: object) -> V",
         "from . import Mission as M\nV = 1\n"),
        ("find_blooms", "(mission: Mission, results)", "from .model import Mission\n"),
        ("find_blooms", "(mission: Crop, results)", "from .fields import Crop\n"),
        ("find_blooms", "(mission: Crop, results)", "from . import Crop\n"),
        ("find_blooms", "(mission: Crop, results)", "class Crop: ...\n"),
        ("find_blooms", "(mission: Crop, results)", "with a as Crop: pass\n"),
        ("find_blooms", "(mission: Crop, results)", "from fields import *\n"),
        ("find_blooms", "(mission, results) -> Verdict | None", HEAD),
        ("find_blooms", "(mission, results) -> Judgement[Verdict]",
         "from x import Judgement\n" + HEAD),
        ("pollinate", "(drone, trip, context, *, dose: float)", ""),
        ("pollinate", "(drone, trip, context, *, dose: int | float)", ""),
        ("pollinate", "(drone, trip, context, *, dose: float | Grams)", "Grams = 1\n"),
        ("pollinate", "(drone, trip, context, *, dose: complex)", ""),
        ("pollinate", "(drone, trip, context, *, dose: builtins.float)", "import builtins\n"),
        ("pollinate", "(drone, trip, context, *, dose: Any)", "from typing import Any\n"),
        ("pollinate", "(drone, trip, context, *, dose: t.Optional[float])", "import typing as t\n"),
        ("pollinate", "(drone, trip, context, *, dose: t.Annotated[float, 'kg'])",
         "import typing as t\n"),
        ("pollinate", "(drone, trip, context, *, dose: t.Literal['x y'])", "import typing as t\n"),
        ("pollinate", "(drone, trip, context, *, dose: 'in kilograms')", ""),
        ("pollinate", "(drone, trip, context, *, dose: any)", ""),
        ("pollinate", "(*args: str, **kwargs: str) -> str", ""),
        ("pollinate", "(drone, trip, context, *, dose, more: str = '') -> dict[str, int]", ""),
        ("limit_trip", "(mission, context, *, limit) -> Status", HEAD),
        ("by_battery", "(trip, candidates: tuple[Drone, ...]) -> Drone | None", HEAD),
        ("by_battery", "(waiting, drones, now)", HEAD),
        ("by_battery", "(all, free, at: float) -> dict[Waiting, Drone]", WAITING),
        ("by_battery", "(waiting: list[Waiting], drones: tuple[Drone, ...], now) -> Assignment",
         WAITING),
        ("by_battery", "(waiting, drones, now, seed=1) -> list[tuple[Waiting, Drone]]", WAITING),
        ("by_battery", "(waiting, drones, now) -> Again", WAITING),
        ("by_battery", "(waiting, drones, now) -> Iterator[tuple[Waiting, Drone]]",
         f"from collections.abc import Iterator\n{WAITING}"),
        ("by_battery", "(trip, candidates: s.Sequence[Drone])",
         "import collections.abc as s\n" + HEAD),
        ("by_battery", "(trip, candidates: x.Sequence['Drone'])", "import typing as x\n"),
        ("by_battery", f"(trip: {'Trip | ' * 1500}Trip, candidates)", HEAD),
    ],
)  # fmt: skip
def test_what_is_right_or_cannot_be_known_is_believed(
    crop: Checked, name: str, signature: str, head: str
) -> None:
    """In quotes or not, by any name under which it was imported."""
    assert found(crop, written(name, signature, head=head)) == []


@pytest.mark.parametrize(
    ("name", "signature", "code", "label"),
    [
        ("find_blooms", "(mission: Misson, results)", "P3012", "did you mean `Mission`?"),
        ("find_blooms", "(mission: 'Misson', results)", "P3012", "did you mean `Mission`?"),
        ("find_blooms", "(mission: c.Misson, results)", "P3012", "did you mean `Mission`?"),
        ("find_blooms", "(mission: list[Misson], results)", "P3012", "did you mean `Mission`?"),
        ("find_blooms", "(mission, results) -> Verdickt", "P3012", "did you mean `Verdict`?"),
        ("find_blooms", "(mission, results: Nowhere)", "P3012", "nothing of this name"),
        ("find_blooms", "(mission: Photo, results: Results)", "P3012",
         "write `from . import Photo`"),
        ("find_blooms", "(mission: Trip, results)", "P3013", "a `Mission` arrives here"),
        ("find_blooms", "(mission: 'Trip', results)", "P3013", "a `Mission` arrives here"),
        ("find_blooms", "(mission, results: dict)", "P3013", "a `Results` arrives here"),
        ("find_blooms", "(mission, results: list[str])", "P3013", "a `Results` arrives here"),
        ("find_blooms", "(mission, results) -> bool", "P3014", "must be `Verdict`"),
        ("find_blooms", "(mission, results) -> None", "P3014", "must be `Verdict`"),
        ("pollinate", "(drone, trip, context, *, dose: str)", "P3013", "a `float` arrives here"),
        ("pollinate", "(drone, trip, context, *, dose: int)", "P3013", "a `float` arrives here"),
        ("pollinate", "(drone, trip, context, dose: c.Trip)", "P3013", "a `float` arrives here"),
        ("pollinate", "(drone: Trip, trip, context, dose)", "P3013", "a `Drone` arrives here"),
        ("pollinate", "(drone, trip, context: t.Optional[str], dose)", "P3013",
         "a `Context` arrives here"),
        ("pollinate", "(drone, trip, context: str | None, dose)", "P3013",
         "a `Context` arrives here"),
        ("pollinate", "(drone, trip, context, dose: t.Union[str, int])", "P3013",
         "a `float` arrives here"),
        ("limit_trip", "(mission, context, *, limit) -> str", "P3014", "must be `Status`"),
        ("by_battery", "(trip, candidates: Drone)", "P3013", "a `Sequence` arrives here"),
        ("by_battery", "(trip, candidates) -> Trip", "P3014", "must be `Drone`"),
        ("by_battery", "(waiting, drones, now) -> Drone | None", "P3014", "must be `Assignment`"),
        ("by_battery", "(waiting, drones, now) -> None", "P3014", "must be `Assignment`"),
        ("by_battery", "(waiting: Trip, drones, now)", "P3013", "a `Sequence` arrives here"),
        ("by_battery", "(waiting, drones, now: int)", "P3013", "a `float` arrives here"),
    ],
)  # fmt: skip
def test_a_type_of_something_else_is_found_at_its_place(
    crop: Checked, name: str, signature: str, code: str, label: str
) -> None:
    """The app says what comes, and what it needs."""
    head = HEAD + "import crop as c, typing as t\n"
    hooks = written(name, signature, head=head)
    (one,) = found(crop, hooks)
    assert (one.code, one.label, one.source.path) == (code, label, "hooks.py")
    place = one.source.quote(one.span)
    assert place in signature
    assert one.help is not None
    assert f"def {name}(" in one.help


def test_a_misspelt_import_of_the_package_is_found(crop: Checked) -> None:
    """It would only fail when the package is loaded."""
    hooks = written("find_blooms", "(mission: Misson, results)", head="from . import Misson\n")
    assert [(one.code, one.label) for one in found(crop, hooks)] == [
        ("P3012", "did you mean `Mission`?")
    ]


def test_an_await_needs_an_async_def(crop: Checked) -> None:
    """A policy may not wait at all."""
    waiting = "await context.sleep(1)"
    for name, code in (("limit_trip", "P3015"), ("pollinate", "P3015"), ("by_battery", "P3010")):
        hooks = written(name, HOOKS[name], body=waiting)
        assert [one.code for one in found(crop, hooks)] == [code]
    inner = "return [(lambda: 1), [x async for x in y]]"
    assert [one.code for one in found(crop, written("limit_trip", HOOKS["limit_trip"], body=inner))]


def test_what_only_the_bytecode_shows_is_no_python_either(crop: Checked) -> None:
    """`await` in a function that is no hook, and a parameter twice."""
    for more in ("def help():\n  await x\n", "def help(a, a): ...\n", "return 1\n"):
        (one,) = found(crop, written("", "") + more)
        assert one.code == "P3001"
        assert one.source.position(one.span.start)[0] > len(HOOKS)


def test_fresh_stubs_are_right_for_all_names_of_an_app(crop: Checked) -> None:
    """Also where an action is called like a type of Python's."""
    for checked in (crop, analyse(Source("odd.pluto", ODD_NAMES))[0]):
        assert found(checked, hooks_file(checked)) == []


def test_a_modifier_without_emits_returns_nothing() -> None:
    """A status that it returned would be a fault."""
    app = APP.replace(" emits STANDBY, COMPLETED, FAILED", "").replace(
        "judge -> allocate", "judge -> spoken when STANDBY\n  spoken -> allocate"
    )
    app = app.replace("[watch, limit] -> first", "watch").replace("first ->", "watch ->")
    app = app.replace("limit = Mission", "spoken = Mission").replace("  first = GateFIFO\n", "")
    checked = analyse(Source("app.pluto", app))[0]
    hooks = written("limit_trip", "(mission, context, *, limit) -> Status")
    (one,) = found(checked, hooks)
    assert (one.code, one.label) == ("P3014", "must be `None`")
