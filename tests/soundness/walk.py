"""The states that were come to, how, and which of them no end can be reached from."""

from __future__ import annotations

from collections import deque
from collections.abc import Collection

from tests.soundness.state import State

Run = tuple[str, ...]
"""What happened, step by step."""

ENOUGH_LOST = 40
"""Hopeless states that are looked at."""


class Walk:
    """All that was come to, the shortest ways first."""

    def __init__(self) -> None:
        self.came: dict[State, tuple[State | None, str]] = {}
        self.queue: deque[State] = deque()
        self.after: dict[State, list[State]] = {}
        self.before: dict[State, list[State]] = {}
        self.settled: list[State] = []
        """Ended, or stopped by a mistake."""
        self.failing: set[tuple[State, State]] = set()
        """Steps that come only of a hook which fails a mission with nothing left to fly, for no need."""

    def come(self, state: State | None, then: State, step: str) -> None:
        """Remember a step."""
        if state is not None:
            self.before.setdefault(then, []).append(state)
            self.after.setdefault(state, []).append(then)
        if then not in self.came:
            self.came[then] = (state, step)
            self.queue.append(then)

    def run(self, state: State) -> Run:
        """Return a shortest way to a state."""
        steps: list[str] = []
        at: State | None = state
        while at is not None:
            at, step = self.came[at]
            steps.append(step)
        return tuple(reversed(steps))

    def hopeless(self) -> list[State]:
        """Return states from which nothing settled can be reached, the nearest first."""
        hopeful = self._leading_to(self.settled)
        return [state for state in self.came if state not in hopeful][:ENOUGH_LOST]

    def left_to_hooks(self) -> list[State]:
        """Return states with nothing left to fly that only a hook which fails the mission would end."""
        if not self.failing:
            return []
        flying = [state for state in self.came if not state.idle]
        hopeful = self._leading_to([*self.settled, *flying], self.failing)
        return [state for state in self.came if state not in hopeful][:ENOUGH_LOST]

    def _leading_to(
        self, ends: list[State], never: Collection[tuple[State, State]] = ()
    ) -> set[State]:
        hopeful, look = set(ends), list(ends)
        while look:
            then = look.pop()
            for state in self.before.get(then, ()):
                if state not in hopeful and (state, then) not in never:
                    hopeful.add(state)
                    look.append(state)
        return hopeful

    def keeps_waiting(self, state: State) -> bool:
        """Return whether a clone waits at a gate from here on in any case."""
        waiting = {token for token in state.tokens if token.phase == "waits"}
        look, known = [state], {state}
        while look and waiting:
            at = look.pop()
            waiting.intersection_update(at.tokens)
            for then in self.after.get(at, ()):
                if then not in known:
                    known.add(then)
                    look.append(then)
        return bool(waiting)
