"""Plans as text: what a graph becomes, step by step."""

from __future__ import annotations

from plutoc.plan.show import show
from tests.plan.graphs import GRAPHS
from tests.plan.plans import structured


def shown(name: str) -> str:
    return "\n" + show(structured(GRAPHS[name]))


def test_alfalfa() -> None:
    """The sample of the language: one loop, what is rare indented, what is usual flat."""
    assert shown("alfalfa") == """
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
"""


def test_nested_loops() -> None:
    """The inner loop is left by `break`, which is to begin the outer one again."""
    assert shown("nested loops") == """
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
"""


def test_ways_that_meet_again() -> None:
    """What two arms lead to stands once, behind them; what a loop is left for, behind it."""
    assert shown("ways that meet again") == """
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
"""


def test_two_meetings_one_in_an_arm() -> None:
    """Ways that meet earlier than others share an arm."""
    assert shown("two meetings, one in an arm") == """
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
"""


def test_ways_that_cross() -> None:
    """A last block that nothing but the end follows is written twice rather than jumped to."""
    assert shown("ways that cross") == """
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
"""


def test_a_loop_with_two_entries() -> None:
    """Who enters it at the second one finds a copy of what stands between the two."""
    assert shown("a loop with two entries") == """
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
"""


def test_loops_left_to_each_loop_around_them() -> None:
    """Python's `break` leaves one loop only: the head of another one is written before it."""
    assert shown("loops left to each loop around them") == """
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
"""


def test_a_loop_left_to_two_places_that_others_come_to_as_well() -> None:
    """Python has no `break` to two places: one of them is written inside the loop once more."""
    assert shown("a loop left to two places that others come to as well") == """
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
"""


def test_a_maze() -> None:
    """What would take many copies is a dispatch."""
    assert shown("a maze") == """
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
"""
