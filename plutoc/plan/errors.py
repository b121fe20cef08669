"""The errors of a plan, each of which is a bug of the compiler."""

from __future__ import annotations

from collections.abc import Iterable

from plutoc_runtime.domain.status import Status


class BadPlan(Exception):
    """The compiler made a plan that does not do what the graph says."""


def falls_off(where: str) -> BadPlan:
    return BadPlan(f"{where}: a way comes to its end without a jump")


def after_jump(where: str) -> BadPlan:
    return BadPlan(f"{where}: steps behind a jump are never reached")


def outside_loop(where: str, jump: str) -> BadPlan:
    return BadPlan(f"{where}: {jump} outside of a loop")


def outside_dispatch(where: str, label: str) -> BadPlan:
    return BadPlan(f"{where}: goto {label} outside of a dispatch")


def no_label(where: str, label: str) -> BadPlan:
    return BadPlan(f"{where}: there is no case {label}")


def label_twice(where: str, label: str) -> BadPlan:
    return BadPlan(f"{where}: two cases are called {label}")


def name_twice(name: str) -> BadPlan:
    return BadPlan(f"two branches are called {name}")


def bad_name(name: str) -> BadPlan:
    return BadPlan(f"a branch is called {name}, which is not a private name in Python")


def dispatch_inside(where: str) -> BadPlan:
    return BadPlan(f"{where}: a dispatch is not the whole of its body")


def loop_in_case(where: str) -> BadPlan:
    return BadPlan(f"{where}: a loop inside a case would catch its jumps")


def no_clone(where: str, name: str) -> BadPlan:
    return BadPlan(f"{where}: no clone goes into branch {name}, which does something")


def few_arms(where: str) -> BadPlan:
    return BadPlan(f"{where}: a switch needs two arms, each with a status")


def other_watchers(where: str) -> BadPlan:
    return BadPlan(f"{where}: a wait does not stand for all blocks that watch the trip")


def arms_overlap(where: str, status: Status) -> BadPlan:
    return BadPlan(f"{where}: two arms take {status.value}")


def no_arm(where: str, status: Status) -> BadPlan:
    return BadPlan(f"{where}: no arm takes {status.value}, which arrives")


def idle_arm(where: str, status: Status) -> BadPlan:
    return BadPlan(f"{where}: an arm takes {status.value}, which never arrives")


def asked_before(where: str, source: str, status: Status) -> BadPlan:
    return BadPlan(f"{where}: a mission {source} is asked for its status, {status.value}, too soon")


def no_way_in(where: str, source: str) -> BadPlan:
    return BadPlan(f"{where}: no arm is for a mission {source}")


def never_entered(where: str, name: str) -> BadPlan:
    return BadPlan(f"{where}: no way leads an interrupted mission to {name}")


def led_astray(where: str, place: str | None) -> BadPlan:
    return BadPlan(f"{where}: a mission is led astray that {place or 'the beginning'} lies behind")


def places_twice(where: str, place: str | None) -> BadPlan:
    return BadPlan(f"{where}: two arms are for {place or 'the beginning'}")


def no_edge(where: str, source: str, target: str, status: Status) -> BadPlan:
    return BadPlan(f"{where}: from {source} no edge leads {status.value} to {target}")


def no_fork(where: str, source: str, status: Status) -> BadPlan:
    return BadPlan(f"{where}: the graph has no such fork at {source} ({status.value})")


def other_branches(where: str, source: str, status: Status) -> BadPlan:
    return BadPlan(f"{where}: the fork at {source} ({status.value}) has other branches")


def branch_never_ends(where: str) -> BadPlan:
    return BadPlan(f"{where}: the branch never comes to its gate")


def not_called(names: Iterable[str]) -> BadPlan:
    return BadPlan(f"missions can reach what the plan never does: {', '.join(names)}")


def never_reached(where: str, what: str) -> BadPlan:
    return BadPlan(f"{where}: nothing ever comes to {what}")
