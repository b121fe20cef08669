"""What the checks say of a graph and find out about it, for each case of `cases/`.

`mistakes.txt`, `advice.txt` and `followed.txt` are refused, and whoever does what is said of the last has a sound graph; in `sound.txt`, `allowed.txt` and `gates.txt` nothing is wrong;
`warnings.txt` is most likely not meant; `resume.txt` is about where missions go on after a Stop.
"""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import plutoc.check
from plutoc.check.run import check
from plutoc.diagnostic import Diagnostic, Rejected
from tests.compiler.check.facts import told
from tests.compiler.check.follow import followed
from tests.compiler.check.graphs import build, checked
from tests.kit.sections import Section, compare, params, sections

CASES = sorted(Path(__file__).with_name("cases").glob("*.txt"))
REFUSED = ("mistakes", "advice", "followed")
FOLLOWED = Path(__file__).parent / "cases/followed.txt"


@pytest.mark.parametrize("case", params(*CASES))
def test_of_a_graph_just_this_is_said_and_found_out(case: Section, update: bool) -> None:
    """Each finding with its place and what to do; of a sound graph, which statuses pass where."""
    comes = told(case.given)
    compare(case, comes, update)
    assert comes.startswith("-- refused") == (case.path.stem in REFUSED)


@pytest.mark.parametrize("case", params(FOLLOWED))
def test_advice_that_is_followed_to_the_letter_leads_to_a_sound_graph(case: Section) -> None:
    """Each time fewer mistakes are left, or another one: none comes twice."""
    text = case.given
    said = set[str]()
    while found := _errors(text):
        assert found[0].message not in said, text
        said.add(found[0].message)
        text = followed(text, found[0])


def _errors(text: str) -> tuple[Diagnostic, ...]:
    try:
        check(build(text))
    except Rejected as rejected:
        return rejected.diagnostics
    return ()


def test_each_code_of_the_checks_is_shown_by_a_case() -> None:
    """Too many states are in `test_bounds`."""
    rooms = Path(plutoc.check.__file__).parent.glob("*.py")
    written = {code for room in rooms for code in re.findall(r'"(P2\d\d\d)"', room.read_text())}
    said = "\n".join(case.comes for case in sections(*CASES))
    shown = set(re.findall(r"^(?:error|warning) (P2\d\d\d)", said, re.MULTILINE))
    assert written - shown == {"P2026"}


def test_any_number_of_branches_is_explored_without_a_product_of_them() -> None:
    """Each further branch adds as many states as the first one: the exploration stays exact."""

    def explored(width: int) -> int:
        names = [f"note{n}" for n in range(width)]
        declared = "\n".join(f"{name} = MissionModifier" for name in names)
        return checked(f"""create = MissionCreator
    allocate = DroneAllocator
    launch = TripLauncher
    watch = TripMonitor
    both = GateFunnel
{declared}
    start -> create -> allocate -> launch -> [{", ".join(["watch", *names])}] -> both
    both -> allocate when STANDBY
    both -> end""").explored

    one, two, many = explored(1), explored(2), explored(40)
    assert many - one == 39 * (two - one)


def test_a_graph_may_be_very_long() -> None:
    """A thousand blocks in a row with a fork at every other one: no recursion, no blow-up."""
    lines = ["make = MissionCreator", "start -> make -> m0"]
    for i in range(250):
        lines += [f"{letter}{i} = MissionModifier" for letter in "mab"]
        lines += [f"g{i} = GateFunnel", f"m{i} -> [a{i}, b{i}] -> g{i} -> m{i + 1}"]
    lines += ["m250 = MissionModifier emits COMPLETED", "m250 -> end"]
    found, warnings = check(build("\n".join(lines)))
    assert len(found.forks) == 250
    assert warnings == ()
