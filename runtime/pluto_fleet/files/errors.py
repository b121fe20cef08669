"""The messages for plan files that cannot be flown, one function each."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from datetime import date, datetime, time

from plutoc_runtime.domain.text import number, quoted


def shown(value: object) -> str:
    """Format a value as in the file, shortened."""
    match value:
        case bool():
            return "true" if value else "false"
        case int() if abs(value) > 10**30:
            return "this number"  # 0xfff… may have more digits than Python likes to write
        case int() | float():
            return f"{value}"
        case str():
            return quoted(value)
        case list():
            return "[…]" if value else "[]"
        case dict():
            return "{…}"
        case datetime() | date() | time():
            return value.isoformat()
        case _:
            return "this value"


def listed(words: Iterable[str]) -> str:
    """Join words for a message; say so if there are none."""
    return ", ".join(words) or "none"


def near(word: str, words: Iterable[str]) -> str:
    """Return `; did you mean "x"?` if one of the words is near, else nothing."""
    from difflib import get_close_matches

    found = get_close_matches(word, list(words), n=1, cutoff=0.6)
    return f"; did you mean {quoted(found[0])}?" if found else ""


# The file


def unreadable(error: Exception) -> str:
    match error:
        case FileNotFoundError():
            return "there is no such file"
        case IsADirectoryError():
            return "is a folder, not a file"
        case PermissionError():
            return "may not be read: its permissions forbid it"
        case OSError():
            return f"cannot be read: {error.strerror or error}"
        case _:
            return "is not a file name"


def too_large(largest: int) -> str:
    return f"is larger than {largest // 1024} KiB: this is not a plan file"


def not_utf_8() -> str:
    return "is not UTF-8 text"


def nested_too_deep() -> str:
    return "is nested too deep"


def syntax(message: str) -> str:
    return f"is not valid TOML: {message[:1].lower()}{message[1:]}"


def and_more(count: int) -> str:
    return f"… and {count} more" + (" problem" if count == 1 else " problems")


# Keys


def missing(key: str) -> str:
    return f"has no {key}"


def unknown_key(key: str, keys: Sequence[str], what: str) -> str:
    hint = near(key, keys)
    end = " " if hint else "; "
    return f"unknown key {quoted(key)}{hint}{end}{what} has: {listed(keys)}"


def no_such_field(key: str, what: str, keys: Sequence[str]) -> str:
    return (
        f"{quoted(key)} is not a field of this app's {what}s: its graph has no block that needs "
        f"it; a {what} of this app has: {listed(keys)}"
    )


def not_a_table(header: str) -> str:
    return f"is not a table: write {header}"


def single_table(header: str) -> str:
    return f"is not a list of tables: write [[{header}]], with two brackets"


def none_given(header: str) -> str:
    return f"has no [[{header}]]: nothing to fly"


# Names


def not_unique(what: str, name: str, line: int | None) -> str:
    where = f", in line {line}" if line else ""
    return f"there is another {what} {quoted(name)}{where}: names must differ"


def unknown_name(what: str, name: str, names: Sequence[str], there_are: str) -> str:
    hint = near(name, names)
    return f"unknown {what} {quoted(name)}" + (hint or f"; {there_are}: {listed(names)}")


def no_evaluators() -> str:
    return "this app has no evaluators"


# Trips


def no_trips() -> str:
    return "has no [[mission.trip]]"


def parameter_missing(action: str, parameter: str) -> str:
    return f"{action} needs the parameter {parameter}"


def unknown_parameter(action: str, parameter: str, parameters: Sequence[str]) -> str:
    if not parameters:
        return f"{action} has no parameters, and {quoted(parameter)} is given"
    return unknown_name("parameter", parameter, parameters, f"{action} has")


def item_missing(action: str) -> str:
    return f'{action} needs an item, such as item = {{ name = "pills", mass = "4 g" }}'


def item_unwanted(action: str, carriers: Sequence[str]) -> str:
    return f"{action} takes no item: only {' and '.join(carriers)} do"


def carries_already(item: str, carried: str, since: str) -> str:
    return f"picks {quoted(item)}, but {quoted(carried)} is still aboard since trip {since}"


def never_picked(item: str) -> str:
    return f"releases {quoted(item)}, which no trip before it has picked"


def other_item(item: str, carried: str, since: str) -> str:
    return f"releases {quoted(item)}, but trip {since} picked {quoted(carried)}"


def other_mass(item: str, since: str) -> str:
    return f"{quoted(item)} has another mass here than in trip {since}"


def never_released(item: str) -> str:
    return f"picks {quoted(item)}, which no trip after it releases"


# Fleet


def category_missing(categories: Sequence[str]) -> str:
    return f"has no category; this app has: {listed(categories)}"


def shared_home(other: str) -> str:
    return f"home is where drone {quoted(other)} has its own: each needs a place to stand"


def shared_uri(other: str, line: int | None) -> str:
    where = f", in line {line}" if line else ""
    return f"uri is that of {other}{where}: it would be one and the same drone"


def navigation_unused(name: str, used: Sequence[str]) -> str:
    hint = near(name, used)
    end = hint or f"; in this fleet there is: {listed(used)}"
    return f"nothing is flown by a navigation {quoted(name)}" + end


def localization_unused() -> str:
    return (
        "[localization] is for a source of positions that [fleet] names with localization = …;"
        " here each drone finds its own"
    )


def no_fleet_file() -> str:
    return (
        "real drones are named in a fleet file: give it with --fleet;"
        " the command drones --save F.toml writes one of those that the radio hears"
    )


def no_uri(drone: str, line: int | None) -> str:
    where = f" (line {line})" if line else ""
    return (
        f"drone {quoted(drone)}{where} has no uri: where is it reached?"
        ' Such as uri = "radio://0/80/2M/E7E7E7E7E7"'
    )


def too_fast(category: str, speed: float, followed: float) -> str:
    return (
        f"drones of the category {quoted(category)} fly at up to {number(speed)} m/s: a Crazyflie"
        f" follows no course faster than {number(followed)} m/s as its firmware comes, and will not"
        " take off; lower the speed, or set its posCtlPid.xVelMax and yVelMax"
    )


def no_fly_area(place: int, problem: str) -> str:
    return f"no_fly area {place} {problem}"


def cruise_above_ceiling(cruise: float, ceiling: float) -> str:
    return f"cruise_height, {number(cruise)} m, is above the ceiling, {number(ceiling)} m"
