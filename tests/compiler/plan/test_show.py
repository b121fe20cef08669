"""Plans as text: what a graph becomes, step by step; a fork and its gate are one step."""

from __future__ import annotations

import pytest

from plutoc.plan.show import show
from tests.compiler.plan.graphs import GRAPHS
from tests.compiler.plan.plans import structured

SHOWN = {
    # One loop, what is rare indented, what is usual flat.
    "alfalfa": """
plan app
  call create
  call wait
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
      STANDBY -> allocate: continue
      FAILED -> retry:
        call retry
        switch
          FAILED -> end: end
          STANDBY -> allocate: go on
        continue
      COMPLETED -> judge: go on
    call judge
    switch
      STANDBY -> allocate: continue
      FAILED -> end: end
      COMPLETED -> again: go on
    call again
    switch
      COMPLETED -> end: end
      STANDBY -> allocate: go on
""",
    # The inner loop is left by `break`, which is to begin the outer one again.
    "nested loops": """
plan app
  call create
  loop wait
    call wait
    loop allocate
      call allocate
      call launch
      call watch
      switch
        STANDBY -> wait: break
        COMPLETED -> end: end
        FAILED -> retry: go on
      call retry
      switch
        FAILED -> end: end
        STANDBY -> allocate: go on
""",
    # What two arms lead to stands once, behind them; what a loop is left for, behind it.
    "ways that meet again": """
plan app
  call create
  loop a
    call a
    switch
      FAILED -> end: end
      STANDBY -> b:
        call b
      COMPLETED -> c:
        call c
    call d
    switch
      COMPLETED, FAILED -> e: break
      STANDBY -> a: go on
  call e
  end
""",
    # Ways that meet earlier than others share an arm.
    "two meetings, one in an arm": """
plan app
  call create
  call a
  switch
    STANDBY, COMPLETED -> b, c:
      switch
        STANDBY -> b:
          call b
        COMPLETED -> c:
          call c
      call m
    FAILED -> d:
      call d
  call g
  call h
  end
""",
    # A last block that nothing but the end follows is written twice rather than jumped to.
    "ways that cross": """
plan app
  call create
  call a
  switch
    FAILED -> g:
      call g
      end
    STANDBY -> b:
      call b
      switch
        COMPLETED -> g:
          call g
          end
        STANDBY -> e: go on
    COMPLETED -> c:
      call c
      switch
        COMPLETED -> g:
          call g
          end
        STANDBY -> e: go on
  call e
  call f
  call g
  end
""",
    # Who enters it at the second one finds a copy of what stands between the two.
    "a loop with two entries": """
plan app
  call create
  call a
  switch
    FAILED -> c:
      call c
      switch
        FAILED -> end: end
        STANDBY -> b: go on
    COMPLETED -> b: go on
  loop b
    call b
    switch
      COMPLETED -> end: end
      STANDBY -> c: go on
    call c
    switch
      FAILED -> end: end
      STANDBY -> b: go on
""",
    # Python's `break` leaves one loop only: the head of another one is written before it.
    "loops left to each loop around them": """
plan app
  call create
  loop a
    call a
    switch
      FAILED -> end: end
      STANDBY -> b: go on
    loop b
      call b
      switch
        COMPLETED -> a: break
        STANDBY -> c: go on
      loop c
        call c
        switch
          COMPLETED -> b: break
          FAILED -> a:
            call a
            switch
              STANDBY -> b: break
              FAILED -> end: go on
            end
          STANDBY -> d: go on
        call d
        switch
          COMPLETED -> b: break
          FAILED -> a:
            call a
            switch
              STANDBY -> b: break
              FAILED -> end: go on
            end
          STANDBY -> c: go on
""",
    # Python has no `break` to two places: one of them is written inside the loop once more.
    "a loop left to two places that others come to as well": """
plan app
  call create
  loop a
    call a
    switch
      STANDBY -> b:
        loop b
          call b
          switch
            COMPLETED -> a: break
            STANDBY -> d:
              call d
              switch
                STANDBY -> a: break
                FAILED -> end: go on
              end
            FAILED -> b: go on
        continue
      FAILED -> d: go on
    call d
    switch
      FAILED -> end: end
      STANDBY -> a: go on
""",
    # What would take many copies is a dispatch.
    "a maze": """
plan app
  dispatch from create
    case create
      call create
      call a
      switch
        STANDBY -> b: goto b
        COMPLETED -> c: goto c
        FAILED -> d: go on
      goto d
    case d
      call d
      switch
        STANDBY -> e: goto e
        COMPLETED -> c: goto c
        FAILED -> b: go on
      goto b
    case b
      call b
      switch
        STANDBY -> c: goto c
        COMPLETED -> d: goto d
        FAILED -> e: go on
      goto e
    case c
      call c
      switch
        STANDBY -> d: goto d
        COMPLETED -> b: goto b
        FAILED -> e: go on
      goto e
    case e
      call e
      switch
        STANDBY -> b: goto b
        COMPLETED -> d: goto d
        FAILED -> end: go on
      end
""",
    # The gate's status is taken by an edge to one side, by a fork to the other.
    "a gate that forks at once": """
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
""",
    # A branch that forks is written like the flow itself; forks with the same branches are one join.
    "a fork in a branch of a fork": """
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
""",
    # Two forks meet behind their gate: a loop can begin there.
    "one gate that closes two forks in turn": """
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
""",
    # A branch may lead straight to its gate.
    "a branch without a block": """
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
""",
    # Each branch has its own call of a block that they share.
    "a block in two branches": """
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
""",
}
"""What some of the graphs become."""


@pytest.mark.parametrize("name", SHOWN)
def test_a_graph_becomes_a_plan(name: str) -> None:
    assert "\n" + show(structured(GRAPHS[name])) == SHOWN[name]
