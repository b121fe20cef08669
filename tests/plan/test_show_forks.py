"""Plans with forks as text: a fork and its gate are one step."""

from __future__ import annotations

from plutoc.plan.show import show
from tests.plan.graphs import GRAPHS
from tests.plan.plans import structured


def shown(name: str) -> str:
    return "\n" + show(structured(GRAPHS[name]))


def test_a_gate_that_forks_at_once() -> None:
    """The gate's status is taken by an edge to one side, by a fork to the other."""
    assert shown("a gate that forks at once") == """
plan app
  call create
  loop allocate
    call allocate
    call launch
    join launch -> first
      branch _watch: launch -> watch -> first
        call watch
        end
      branch _timer: launch -> timer -> first
        call timer
        end
    switch
      COMPLETED -> end: end
      FAILED -> retry:
        call retry
        switch
          FAILED -> end: end
          STANDBY -> allocate: go on
        continue
      STANDBY -> [left, right]: go on
    join first -> both
      branch _left: first -> left -> both
        call left
        end
      branch _right: first -> right -> both
        call right
        end
"""


def test_a_fork_in_a_branch_of_a_fork() -> None:
    """A branch that forks is written like the flow itself.

    Three forks with the same branches are one join.
    """
    assert shown("a fork in a branch of a fork") == """
plan app
  call create
  loop allocate
    call allocate
    call launch
    join launch -> first
      branch _watch: launch -> watch -> ... -> first
        call watch
        join watch -> both
          branch _left: watch -> left -> both
            call left
            end
          branch _right: watch -> right -> both
            call right
            end
        end
      branch _timer: launch -> timer -> first
        call timer
        end
    switch
      STANDBY -> allocate: continue
      COMPLETED -> end: end
      FAILED -> retry: go on
    call retry
    switch
      FAILED -> end: end
      STANDBY -> allocate: go on
"""


def test_one_gate_that_closes_two_forks_in_turn() -> None:
    """Two forks meet behind their gate: a loop can begin there."""
    assert shown("one gate that closes two forks in turn") == """
plan app
  call create
  join create -> both
    branch _left: create -> left -> both
      call left
      end
    branch _right: create -> right -> both
      call right
      end
  loop both
    loop allocate
      call allocate
      call launch
      call watch
      switch
        STANDBY -> [left, right]: break
        COMPLETED -> end: end
        FAILED -> retry: go on
      call retry
      switch
        FAILED -> end: end
        STANDBY -> allocate: go on
    join watch -> both
      branch _left_2: watch -> left -> both
        call left
        end
      branch _right_2: watch -> right -> both
        call right
        end
"""


def test_a_branch_without_a_block() -> None:
    """A branch may lead straight to its gate."""
    assert shown("a branch without a block") == """
plan app
  call create
  loop allocate
    call allocate
    call launch
    join launch -> first
      branch _watch: launch -> watch -> first
        call watch
        end
      branch _timer: launch -> timer -> first
        call timer
        end
    switch
      COMPLETED, FAILED -> end: end
      STANDBY -> tell: go on
    call tell
    join tell -> all
      branch _note: tell -> note -> all
        call note
        end
      branch _all: tell -> all
        end
"""


def test_a_block_in_two_branches() -> None:
    """Each branch has its own call of a block that they share."""
    assert shown("a block in two branches") == """
plan app
  call create
  join create -> both
    branch _left: create -> left -> note -> both
      call left
      call note
      end
    branch _right: create -> right -> note -> both
      call right
      call note
      end
  call done
  end
"""
