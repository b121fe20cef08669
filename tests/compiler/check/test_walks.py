"""What the checks promise, walked: every mission on every way, of sound graphs and of random edits of them."""

from __future__ import annotations

from functools import partial

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from plutoc.check.run import check
from plutoc.diagnostic import Rejected
from tests.compiler.check.graphs import SOUND, build
from tests.compiler.check.walks import along_graph, edited, kept


@pytest.mark.parametrize("name", SOUND)
def test_a_sound_graph_keeps_its_promises(name: str) -> None:
    """Statuses stay on the edges that carry them, and every branch comes to its gate."""
    checked, _ = check(build(SOUND[name]))
    for seed in range(25):
        assert kept(partial(along_graph, checked), seed)


@settings(max_examples=60, deadline=None)
@given(text=edited(), seed=st.integers(0, 1000))
def test_an_edited_graph_is_refused_or_keeps_its_promises(text: str, seed: int) -> None:
    """All that the checks let through can be walked; and they say the same each time."""
    try:
        checked, warnings = check(build(text))
    except Rejected as rejected:
        with pytest.raises(Rejected) as again:
            check(build(text))
        assert again.value.diagnostics == rejected.diagnostics
        return
    assert check(build(text))[1] == warnings
    for step in range(20):
        assert kept(partial(along_graph, checked), seed + step)


def test_forks_without_gates_do_not_blow_up() -> None:
    """Forty forks, one behind the other, none of which closes: two to the forty clones."""
    lines = ["make = MissionCreator", "start -> make -> m0"]
    for i in range(40):
        lines += [f"{letter}{i} = MissionModifier" for letter in "mab"]
        lines.append(f"m{i} -> [a{i}, b{i}] -> m{i + 1}")
    lines += ["m40 = MissionModifier emits COMPLETED", "m40 -> end"]
    with pytest.raises(Rejected, match="P2011"):
        check(build("\n".join(lines)))
