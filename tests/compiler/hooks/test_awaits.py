"""Calls without `await`: what is told, and what may be right and is not."""

from __future__ import annotations

from inspect import iscoroutinefunction

import pytest

from plutoc.check.model import Checked
from plutoc.compile import analyse, check_hooks
from plutoc.diagnostic import Diagnostic, Rejected
from plutoc.edits import applied
from plutoc.hooks.awaits import MUST_BE_AWAITED
from plutoc.source import Source
from plutoc_runtime.hooks.context import Context, LiveDrone
from tests.compiler.hooks.test_check import APP, GOOD

BODY = "def pollinate(drone, trip, context, *, dose): ..."
OWN = """
async def rinse(seconds): ...
@cached
async def decorated(): ...
async def numbers():
    yield 1
def plain(): ...
"""


@pytest.fixture(scope="module")
def crop() -> Checked:
    """An app with a hook of each kind."""
    return analyse(Source("app.pluto", APP))[0]


def found(checked: Checked, body: str, head: str = "async def pollinate") -> list[Diagnostic]:
    """Return what is found where the action has this body."""
    lines = "\n".join(f"    {line}" for line in body.split("\n"))
    action = f"{head}(drone, trip, context, *, dose):\n{lines}\n"
    assert BODY in GOOD
    return found_in(checked, OWN + GOOD.replace(BODY, action))


def found_in(checked: Checked, text: str) -> list[Diagnostic]:
    """Return what is found in a hooks.py."""
    try:
        check_hooks(checked, Source("hooks.py", text))
    except Rejected as rejected:
        return [*rejected.diagnostics]
    return []


def test_the_methods_are_those_that_must_be_awaited() -> None:
    """All `async def` of what hooks are given, and no others."""
    for of in (Context, LiveDrone):
        waits = {name for name, what in vars(of).items() if iscoroutinefunction(what)}
        assert {name for name in waits if not name.startswith("_")} == MUST_BE_AWAITED[of.__name__]


@pytest.mark.parametrize(
    ("body", "called"),
    [
        ("context.sleep(1)", "context.sleep"),
        ("context.trip_ended(trip)", "context.trip_ended"),
        ("rinse(1)", "rinse"),
        ("context.live(drone).write('a', 1)", "context.live(drone).write"),
        ("live = context.live(drone)\nlive.write('a', 1)", "live.write"),
        ("live = context.live(drone)\nagain = live\nagain.read('a')", "again.read"),
        ("live: LiveDrone = given()\nlive.read('a')", "live.read"),
        ("live = context.live(drone)\nif live.read('a') > 1: pass", "live.read"),
        ("if context.trip_ended(trip): pass", "context.trip_ended"),
        ("while not context.trip_ended(trip): pass", "context.trip_ended"),
        ("if dose and context.trip_ended(trip): pass", "context.trip_ended"),
        ("return -context.live(drone).read('a')", "context.live(drone).read"),
        ("return context.live(drone).read('a')", "context.live(drone).read"),
        ("return float(context.live(drone).read('a'))", "context.live(drone).read"),
        ("context.log(context.live(drone).read('a'))", "context.live(drone).read"),
        ("x = context.live(drone).read('a')", "context.live(drone).read"),
        ("x = context.live(drone).read('a')\nreturn x * 2", "context.live(drone).read"),
        ("total = 0\ntotal += rinse(1)", "rinse"),
        ("for each in rinse(1): pass", "rinse"),
        ("if dose:\n    with open(trip) as file:\n        rinse(1)", "rinse"),
        ("try: rinse(1)\nfinally: pass", "rinse"),
    ],
)
def test_a_call_without_await_is_told_and_can_be_mended(
    crop: Checked, body: str, called: str
) -> None:
    """The fix is right: with it nothing is found any more."""
    head = "from . import LiveDrone\nasync def pollinate"
    (mistake,) = found(crop, body, head)
    assert mistake.code == "P3018"
    assert mistake.message == f"`pollinate` calls `{called}` without `await`, so it is not done"
    assert mistake.fix is not None
    assert mistake.source.quote(mistake.span).startswith(called)
    mended = applied(mistake.source, [mistake.fix])
    assert f"await {called}" in mended
    assert found_in(crop, mended) == []


@pytest.mark.parametrize(
    "body",
    [
        "await context.sleep(1)",
        "pause = context.sleep(1)\nawait pause",
        "pause = context.sleep(1)\nif dose: await pause",
        "await asyncio.gather(rinse(1), context.sleep(2))",
        "task = asyncio.create_task(rinse(1))",
        "waits = [rinse(1)]\nfor one in waits: await one",
        "pause = rinse(1)\nlater(pause)",
        "pause = rinse(1)\ndef end(): return pause",
        "def end(): return rinse(1)\nawait end()",
        "end = lambda: rinse(1)\nawait end()",
        "await (rinse(1) if dose else rinse(2))",
        "await (dose or rinse(1))",
        "yes = rinse(1) if dose else None\nif yes: await yes",
        "pause = rinse(1)\npause = 3",
        "rinse(1).close()",
        "def rinse(one): ...\nrinse(1)",
        "context = other()\ncontext.sleep(1)",
        "live = context.live(drone)\nlive = other()\nlive.read('a')",
        "live = other()\nlive.read('a')",
        "for context in trip: context.sleep(1)",
        "from elsewhere import rinse\nrinse(1)",
        "float = other\nfloat(rinse(1))",
        "print(plain(), decorated(), numbers())",
        "decorated()\nnumbers()\nplain()",
        "async for one in numbers(): pass",
        "context.now\ncontext.log('x')\ncontext.live(drone).battery",
    ],
)
def test_what_may_be_right_is_not_told(crop: Checked, body: str) -> None:
    """A coroutine may be awaited later, or elsewhere; a name may stand for something else."""
    assert found(crop, body) == []


def test_a_def_is_told_to_become_an_async_def_first(crop: Checked) -> None:
    """There is no fix by one word; and what it returns the app itself awaits."""
    (mistake,) = found(crop, "context.sleep(1)", "def pollinate")
    assert mistake.fix is None
    assert mistake.help == (
        "`pollinate` is a plain `def`: make it an `async def` first, "
        "then write `await context.sleep(…)`"
    )
    assert found(crop, "return context.sleep(1)", "def pollinate") == []


def test_a_policy_cannot_wait(crop: Checked) -> None:
    """It is told to do without."""
    forgets = "def by_battery(trip, candidates):\n    rinse(1)\n    return candidates[0]"
    policy = "def by_battery(trip, candidates): return candidates[0]"
    (mistake,) = found_in(crop, OWN + GOOD.replace(policy, forgets))
    assert mistake.help is not None
    assert mistake.help.startswith("a policy answers at once, and cannot wait for anything")


def test_helpers_are_looked_at_where_their_types_are_written(crop: Checked) -> None:
    """In functions within functions and in classes, too; without a type nothing is known."""
    helper = "from . import Context\nasync def waits(about: Context):\n    about.sleep(1)\n"
    (mistake,) = found_in(crop, helper + GOOD)
    assert mistake.message.startswith("`waits` calls `about.sleep` without `await`")
    assert found_in(crop, helper.replace(": Context", "") + GOOD) == []
    (mistake,) = found(crop, "async def inner():\n    context.sleep(1)\nawait inner()")
    assert mistake.message.startswith("`inner` calls `context.sleep` without `await`")
    method = "class Pump:\n    async def stop(self):\n        rinse(1)\n"
    (mistake,) = found_in(crop, OWN + method + GOOD)
    assert mistake.message.startswith("`stop` calls `rinse` without `await`")


def test_where_one_word_does_not_mend_it_there_is_no_fix(crop: Checked) -> None:
    """In a text with values, and before an index."""
    for body in ("context.log(f'{rinse(1)}')", "return rinse(1)[0]"):
        (mistake,) = found(crop, body)
        assert (mistake.code, mistake.fix) == ("P3018", None)


@pytest.mark.parametrize(
    ("returned", "said"),
    [
        ("Status.RUNNING", "`RUNNING`"),
        ("Status.FAILED if mission.round else Status.RUNNING", "`RUNNING`"),
        ("'done'", "`'done'`"),
        ("True", "`True`"),
        ("", "nothing"),
        ("None", "nothing"),
    ],
)
def test_what_a_modifier_does_not_declare_is_told(crop: Checked, returned: str, said: str) -> None:
    """Where the text says what is returned."""
    hooks = "from . import Status\n" + GOOD.replace("return mission.status", f"return {returned}")
    (mistake,) = found_in(crop, hooks)
    assert mistake.code == "P3019"
    assert mistake.message == (
        f"`limit_trip` returns {said}, and emits only `STANDBY`, `COMPLETED` and `FAILED`"
    )


@pytest.mark.parametrize(
    "returned",
    ["mission.status", "Status.FAILED", "Status.RUNING", "look(mission)", "Status[mission.name]"],
)
def test_what_it_may_declare_is_not_told(crop: Checked, returned: str) -> None:
    """A value that only a flight knows, and one that it declares."""
    hooks = "from . import Status\n" + GOOD.replace("return mission.status", f"return {returned}")
    assert found_in(crop, hooks) == []
