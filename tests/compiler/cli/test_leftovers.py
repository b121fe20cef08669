"""What is left over of hooks is told by each compile: a hooks.py that is passed over, former hooks."""

from __future__ import annotations

import json
import tomllib
from pathlib import Path

import pytest

from tests.compiler.cli.conftest import APP, Call

BESIDE, HOOKS, LOCK = Path("hooks.py"), Path("crop/src/crop/hooks.py"), Path("crop/pluto.lock")
CODE = """from . import Verdict


async def pollinate(drone, trip, context, *, dose):
    return dose


def find_blooms(mission, results):
    return Verdict(ok=True, log=())
"""
NO_ACTION = APP.replace("  action pollinate(dose: mass = 50 mg)\n", "").replace(", pollinate", "")
GONE = "the app has no action `pollinate` any more"
DONE = "\n\ndef pollinate_done(drone, trip):\n    return None\n"


def told(plutoc: Call, app: Path, *more: str) -> list[tuple[str, str, str, int]]:
    """Compile, which succeeds; return what is warned of, with the places."""
    said = plutoc("compile", app, *more, "--format", "json")
    assert (said.code, said.err) == (0, "")
    found = map(json.loads, said.out.splitlines())
    return [(one["code"], one["message"], one["file"], one["line"]) for one in found]


def tables() -> tuple[dict[str, str], dict[str, str]]:
    """Return the hooks that the lock has as declared, and as declared before."""
    lock = tomllib.loads(LOCK.read_text())
    return lock.get("hooks", {}), lock.get("former_hooks", {})


def test_a_first_compile_and_equal_files_are_quiet(plutoc: Call, app: Path) -> None:
    """Equal is what Python reads as the same."""
    BESIDE.write_text(CODE)
    assert told(plutoc, app) == []
    assert told(plutoc, app) == []
    BESIDE.write_bytes(b"\xef\xbb\xbf" + CODE.replace("\n", "\r\n").encode())
    assert told(plutoc, app) == []


def test_a_hooks_file_that_is_not_read_any_more_is_told(plutoc: Call, app: Path) -> None:
    """By each compile and by `--check`, at the line where the two begin to differ."""
    BESIDE.write_text(CODE)
    plutoc("compile", app)
    BESIDE.write_text(CODE.replace("return dose", "return 2 * dose"))
    message = "`hooks.py` is not read any more: `crop/src/crop/hooks.py` counts, and the two differ"
    for more in ([], [], ["--check"]):
        assert told(plutoc, app, *more) == [("P3016", message, "hooks.py", 5)]
    said = plutoc("compile", app)
    assert "help: edit `crop/src/crop/hooks.py`, and take over what it lacks; then" in said.err
    assert "then delete or rename `hooks.py`" in said.err
    BESIDE.rename("old_hooks.py")
    assert told(plutoc, app) == []


def test_it_does_not_matter_which_of_the_two_was_edited(plutoc: Call, app: Path) -> None:
    """Nor that the one beside the app has become longer, or broken."""
    BESIDE.write_text(CODE)
    plutoc("compile", app)
    HOOKS.write_text(CODE + "SIZE = 3\n")
    assert [one[0] for one in told(plutoc, app)] == ["P3016"]
    BESIDE.write_text(f"{CODE}SIZE = 3\nbroken(\n")
    ((code, _, file, line),) = told(plutoc, app)
    assert (code, file, line) == ("P3016", "hooks.py", 11)
    BESIDE.write_text(HOOKS.read_text())
    assert told(plutoc, app) == []


def test_what_cannot_be_read_beside_the_app_is_in_no_ones_way(
    plutoc: Call, app: Path, tmp_path: Path
) -> None:
    """It is told of, but nothing of it is shown; a link to the package's own is that one."""
    BESIDE.write_text(CODE)
    plutoc("compile", app)
    BESIDE.write_bytes(b"\xff")
    assert [one[0] for one in told(plutoc, app)] == ["P3016"]
    secret = tmp_path / "secret"
    secret.write_text("secret")
    BESIDE.unlink()
    BESIDE.symlink_to(secret)
    said = plutoc("compile", app)
    assert (said.code, "[P3016]" in said.err, "secret" in said.err) == (0, True, False)
    BESIDE.unlink()
    BESIDE.symlink_to(HOOKS)
    assert told(plutoc, app) == []
    BESIDE.unlink()
    BESIDE.mkdir()
    assert told(plutoc, app) == []


def test_a_compile_without_changes_looks_at_it_too(plutoc: Call, app: Path) -> None:
    """Each time, for the file may have come or changed."""
    plutoc("compile", app)
    assert not plutoc("compile", app).err
    for text in ("", "", "x = 1\n"):
        BESIDE.write_text(text)
        assert "[P3016]" in plutoc("compile", app).err
    BESIDE.unlink()
    assert not plutoc("compile", app).err


def test_a_hook_that_the_app_does_not_declare_any_more_is_told(plutoc: Call, app: Path) -> None:
    """For as long as it is there, by `--check` as well, and after any compile in between."""
    plutoc("compile", app)
    assert tables() == ({"find_blooms": "evaluator", "pollinate": "action"}, {})
    HOOKS.write_text(CODE + DONE)
    assert told(plutoc, app) == []
    app.write_text(NO_ACTION)
    wanted = [
        ("`pollinate` was an action of the app, which does not declare it any more", 4),
        (f"`pollinate_done` told whether `pollinate` was done, and {GONE}", 12),
    ]
    found = [("P3017", message, str(HOOKS), line) for message, line in wanted]
    for more in ([], ["--check"], ["--force"], []):
        assert told(plutoc, app, *more) == found
    app.write_text(NO_ACTION.replace("max_attempts: 3", "max_attempts: 5"))
    assert told(plutoc, app) == found
    assert tables() == (
        {"find_blooms": "evaluator"},
        {"pollinate": "action", "pollinate_done": "probe"},
    )
    said = plutoc("compile", app)
    assert "help: delete it, or declare it in `crop.pluto` again" in said.err
    assert "help: delete it, or declare that action in `crop.pluto` again" in said.err
    app.write_text(APP)
    assert told(plutoc, app) == []
    assert tables()[1] == {}


def test_a_probe_is_told_of_also_where_its_action_has_gone_before(plutoc: Call, app: Path) -> None:
    """Or has become a hook of another kind."""
    plutoc("compile", app)
    HOOKS.write_text(CODE + DONE)
    app.write_text(NO_ACTION)
    plutoc("compile", app)
    HOOKS.write_text(CODE.replace("pollinate", "_mine") + DONE)
    for _ in range(2):
        assert [one[1].split()[0] for one in told(plutoc, app)] == ["`pollinate_done`"]
    app.write_text(APP)
    HOOKS.write_text(CODE + DONE)
    plutoc("compile", app)
    app.write_text(NO_ACTION.replace("find_blooms", "pollinate"))
    HOOKS.write_text("def pollinate(mission, results): ...\n" + DONE)
    for _ in range(2):
        assert [one[1].split()[0] for one in told(plutoc, app)] == ["`pollinate_done`"]


def test_what_is_deleted_as_asked_leaves_nothing_out_of_date(plutoc: Call, app: Path) -> None:
    """The lock forgets it with the next compile, and no CI job fails until then."""
    plutoc("compile", app)
    app.write_text(NO_ACTION)
    plutoc("compile", app)
    HOOKS.write_text("def find_blooms(mission, results): ...\n")
    said = plutoc("compile", app, "--check")
    assert (said.code, said.out, said.err) == (0, "crop: up to date\n", "")
    assert tables()[1] == {"pollinate": "action"}
    assert "  ~ pluto.lock\n" in plutoc("compile", app).out
    assert tables()[1] == {}
    HOOKS.write_text(HOOKS.read_text() + "def pollinate(flower): ...\n")
    assert told(plutoc, app) == []


@pytest.mark.parametrize(
    "more",
    [
        "\n\ndef find_more(mission):\n    return pollinate\n",
        "\n\nTABLE = {'p': pollinate}\n",
        "\n\n__all__ = ['find_blooms', 'pollinate']\n",
        "\n\n@pollinate\ndef helper(): ...\n",
    ],
)
def test_a_former_hook_that_the_file_uses_is_a_helper(plutoc: Call, app: Path, more: str) -> None:
    """It is told of once it is not used any more: it is remembered all the while."""
    plutoc("compile", app)
    HOOKS.write_text(CODE + more)
    app.write_text(NO_ACTION)
    for _ in range(2):
        assert told(plutoc, app) == []
    HOOKS.write_text(CODE)
    assert [one[0] for one in told(plutoc, app)] == ["P3017"]


def test_functions_that_were_never_hooks_are_the_developers_own(plutoc: Call, app: Path) -> None:
    """By any name; and so is a name that something else than a function has."""
    own = "\n\ndef mean(values): ...\n\n\ndef flown_done(x): ...\n\n\ndef _old(): ...\n"
    plutoc("compile", app)
    HOOKS.write_text(CODE + own)
    assert told(plutoc, app) == []
    app.write_text(NO_ACTION)
    HOOKS.write_text(CODE.replace("async def pollinate(", "async def _pollinate(") + own)
    assert told(plutoc, app) == []
    HOOKS.write_text("from math import sin as pollinate\n" + HOOKS.read_text())
    assert told(plutoc, app) == []


def test_a_function_that_calls_itself_is_still_left_over(plutoc: Call, app: Path) -> None:
    """That is no use of it."""
    plutoc("compile", app)
    HOOKS.write_text(CODE.replace("return dose", "return await pollinate(1, 2, 3, dose=4)"))
    app.write_text(NO_ACTION)
    assert [one[0] for one in told(plutoc, app)] == ["P3017"]


def test_a_lock_of_before_knows_of_no_hooks(plutoc: Call, app: Path) -> None:
    """It is read as it is, and has them after the next compile."""
    plutoc("compile", app)
    text = LOCK.read_text()
    LOCK.write_text(text[: text.index("[hooks]")] + text[text.index("[files]") :])
    app.write_text(NO_ACTION)
    assert told(plutoc, app) == []
    assert tables() == ({"find_blooms": "evaluator"}, {})
