"""The messages for plan files that cannot be flown, one function each."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from ..shared.domain.text import number, quoted
from .filled import Filled, is_number

if TYPE_CHECKING:
    from ..shared.domain.fields import Field


_NAMED = 10
"""Of more drones than these it is said how many they are; of what is too much to list, so many are named."""
_MOST_LISTED = 100
_LONGEST_HINT = 100
"""Words that are listed, or compared for a hint, and characters of one: more would take long."""


def listed(words: Iterable[str]) -> str:
    """Join words for a message; say so if there are none."""
    found = [*words]
    more = [f"… and {len(found) - _NAMED} more"] if len(found) > _MOST_LISTED else []
    return ", ".join([*(found[:_NAMED] if more else found), *more]) or "none"


def near(word: str, words: Iterable[str]) -> str:
    """Return `; did you mean "x"?` if one of the words is near, else nothing."""
    from difflib import get_close_matches

    known = [one for one in words if len(one) <= _LONGEST_HINT]
    is_little = len(word) <= _LONGEST_HINT and len(known) <= _MOST_LISTED
    found = get_close_matches(word, known, n=1, cutoff=0.6) if is_little else []
    return f"; did you mean {quoted(found[0])}?" if found else ""


# The file


def and_more(count: int) -> str:
    return f"… and {count} more" + (" problem" if count == 1 else " problems")


# Keys


def missing(key: str) -> str:
    return f"has no {key}"


def field_missing(field: Field) -> str:
    return f"{missing(field.name)}{field.hint}"


def unknown_key(key: str, keys: Sequence[str], what: str) -> str:
    hint = near(key, keys)
    end = " " if hint else "; "
    return f"unknown key {quoted(key)}{hint}{end}{what} has: {listed(keys)}"


def no_such_field(key: str, what: str, keys: Sequence[str]) -> str:
    return (
        f"unknown key {quoted(key)}: this app's graph has no block that needs it; {what} of this "
        f"app has: {listed(keys)}"
    )


def not_a_table(header: str) -> str:
    return f"is not a table: write {header}"


def single_table(header: str) -> str:
    return f"is not a list of tables: write [[{header}]], with two brackets"


def none_given(header: str) -> str:
    return f"has no [[{header}]]: nothing to fly"


# Names


def not_unique(what: str, name: str, line: int | None, row: str = "") -> str:
    where = f", of {row}" if row else f", in line {line}" if line else ""
    return f"there is another {what} {quoted(name)}{where}: names must differ"


def unknown_name(what: str, name: str, names: Sequence[str], there_are: str) -> str:
    hint = near(name, names)
    return f"unknown {what} {quoted(name)}" + (hint or f"; {there_are}: {listed(names)}")


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


# Areas


def area_too_high(height: float, ceiling: float) -> str:
    return f"height, {number(height)} m, is above the ceiling, {number(ceiling)} m"


def item_in_area(action: str) -> str:
    return f"{action} takes an item, and an area has none: write [[mission.trip]]"


def too_many_places(spacing: float, most: int) -> str:
    return f"spacing {number(spacing)} m makes more than {most:,} trips of this area: widen it"


def too_many_in_all(most: int, areas: int) -> str:
    return (
        f"with this area the file makes more than {most:,} trips, or has more than {areas:,} areas:"
        " widen the spacing"
    )


def nothing_permitted() -> str:
    return "polygon covers nothing that may be flown over: it lies in no-fly areas, or off the map"


def makes_another(name: str, line: int | None) -> str:
    where = f", in line {line}" if line else ""
    return f"makes a trip {quoted(name)}, and there is another{where}: rename that, or the area"


def no_shapely() -> str:
    return (
        "an area needs shapely, the extra `areas` of pluto-fleet:"
        ' pip install "pluto-fleet[areas]", or "shapely>=2"'
    )


# The map


def no_such_name(what: str, word: str, words: Iterable[str]) -> str:
    return f"is no {what} of the map" + (near(word, words) or f"; there are: {listed(words)}")


def too_many(what: str, most: int) -> str:
    return f"{what} are more than {most:,}"


# Lists


def of_cells(cells: Sequence[Filled]) -> str:
    """Say from which columns a value comes; of several, from those that are no numbers, if any are not."""
    odd = [cell for cell in cells if not is_number(cell)] or cells
    columns = [*dict.fromkeys(column for cell in odd for column in cell.columns)]
    if not columns:
        return ""
    said = f"column{'s' * (len(columns) > 1)} {' and '.join(map(quoted, columns))}"
    if len(odd) == 1 < len(cells):
        said += f": {quoted(odd[0])}"
    comma = next(
        (cell for cell in odd if is_number(cell.replace(",", ".", 1)) and "," in cell), None
    )
    if comma is not None:
        said += f"; a number has a point: {comma.replace(',', '.')}"
    return f" ({said})"


def no_folder(name: str) -> str:
    return (
        f"each {quoted(name)} lies beside a missions file, and this one is in no folder: start with"
        " that file, --missions M.toml"
    )


def same_for_all(name: object, columns: Sequence[str]) -> str:
    such = quoted(f"{name} {{{columns[0]}}}")
    return f"name is the same for every row, and names must differ: put a column into it, such as {such}"


def unknown_column(key: str, column: str, columns: Sequence[str]) -> str:
    said = unknown_name("column", column, columns, "the list has")
    return f"{key} has an {said}" + ("" if "{" in column else "; a brace itself is written {{")


def brace_alone(key: str) -> str:
    return f"{key} has a brace that is not one of a pair: a brace itself is written {{{{ or }}}}"


def other_width(row: int, values: int, columns: int) -> str:
    given = "1 value" if values == 1 else f"{values} values"
    return f"has {given} in row {row}, and its first line names {columns}"


def too_many_rows(most: int) -> str:
    return f"has more than {most:,} rows"


def too_much(what: str, most: int, of: str) -> str:
    return f"{what}: all lists of a file make at most {most:,} {of}"


def too_many_columns(most: int) -> str:
    return f"has more than {most:,} columns"


# Fleet


def category_missing(categories: Sequence[str]) -> str:
    return f"has no category; this app has: {listed(categories)}"


def shared_uri(other: str, line: int | None) -> str:
    where = f", in line {line}" if line else ""
    return f"uri is that of {other}{where}: it would be one and the same drone"


def shared_camera(drones: Sequence[str], where: str) -> str:
    some = ", ".join(drones[:_NAMED]) + ("" if len(drones) <= _NAMED else ", …")
    return (
        f"{some} have one camera, {where}: the photos of all would be those of whichever AI-deck this"
        " computer reaches; have all decks join one WiFi, and give each drone its own address"
    )


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


def no_uri(drones: Sequence[tuple[str, int | None]]) -> str:
    named = [
        f"{quoted(drone)} (line {line})" if line else quoted(drone)
        for drone, line in drones[:_NAMED]
    ]
    more = len(drones) - len(named)
    *first, last = [*named, f"{more} more"] if more else named
    which = f"{', '.join(first)} and {last}" if first else last
    one = len(drones) == 1
    return (
        f"{'drone' if one else 'drones'} {which} {'has' if one else 'have'} no uri, where a real drone"
        f' is reached: add {"one" if one else "one to each"}, such as'
        ' uri = "radio://0/80/2M/E7E7E7E7E7"'
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
