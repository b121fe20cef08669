"""Which functions of hooks.py are left over: hooks that the app has not declared any more."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.compiler.cli.conftest import APP
from tests.kit.command import plutoc

HOOKS = Path("crop/src/crop/hooks.py")
CODE = """from . import Verdict


async def pollinate(drone, trip, context, *, dose):
    return dose


def find_blooms(mission, results):
    return Verdict(ok=True, log=())
"""
NO_ACTION = APP.replace("  action pollinate(dose: mass = 50 mg)\n", "").replace(", pollinate", "")
DONE = "\n\ndef pollinate_done(drone, trip):\n    return None\n"


@pytest.fixture
def app(app: Path) -> Path:
    """The app, compiled, whose hooks are written."""
    plutoc("compile", app)
    HOOKS.write_text(CODE)
    return app


def told(app: Path) -> list[str]:
    """Compile, which succeeds; return of which functions something is told."""
    said = plutoc("compile", app, "--format", "json")
    assert (said.code, said.err) == (0, "")
    return [json.loads(line)["message"].split()[0] for line in said.out.splitlines()]


def test_a_probe_is_told_of_also_where_its_action_has_gone_before(app: Path) -> None:
    """Or has become a hook of another kind."""
    HOOKS.write_text(CODE + DONE)
    app.write_text(NO_ACTION)
    for _ in range(2):  # for as long as it is there
        assert told(app) == ["`pollinate`", "`pollinate_done`"]
    HOOKS.write_text(CODE.replace("pollinate", "_mine") + DONE)
    assert told(app) == ["`pollinate_done`"]
    app.write_text(APP)
    HOOKS.write_text(CODE + DONE)
    assert told(app) == []
    app.write_text(NO_ACTION.replace("find_blooms", "pollinate"))
    HOOKS.write_text("def pollinate(mission, results): ...\n" + DONE)
    assert told(app) == ["`pollinate_done`"]


def test_what_was_deleted_as_asked_is_forgotten(app: Path) -> None:
    """A function of its name is the developer's own then."""
    app.write_text(NO_ACTION)
    assert told(app) == ["`pollinate`"]
    HOOKS.write_text("def find_blooms(mission, results): ...\n")
    assert told(app) == []
    HOOKS.write_text(HOOKS.read_text() + "def pollinate(flower): ...\n")
    assert told(app) == []


def test_a_former_hook_that_the_file_uses_is_a_helper(app: Path) -> None:
    """It is told of once it is not used any more: it is remembered all the while."""
    app.write_text(NO_ACTION)
    for more in (
        "\n\ndef find_more(mission):\n    return pollinate\n",
        "\n\nTABLE = {'p': pollinate}\n",
        "\n\n__all__ = ['find_blooms', 'pollinate']\n",
        "\n\n@pollinate\ndef helper(): ...\n",
    ):
        HOOKS.write_text(CODE + more)
        assert told(app) == []
    HOOKS.write_text(CODE)
    assert told(app) == ["`pollinate`"]


def test_functions_that_were_never_hooks_are_the_developers_own(app: Path) -> None:
    """By any name; and so is a name that something else than a function has."""
    own = "\n\ndef mean(values): ...\n\n\ndef flown_done(x): ...\n\n\ndef _old(): ...\n"
    HOOKS.write_text(CODE + own)
    assert told(app) == []
    app.write_text(NO_ACTION)
    HOOKS.write_text(CODE.replace("async def pollinate(", "async def _pollinate(") + own)
    assert told(app) == []
    HOOKS.write_text("from math import sin as pollinate\n" + HOOKS.read_text())
    assert told(app) == []
