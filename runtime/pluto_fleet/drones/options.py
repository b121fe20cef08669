"""The options of a drone's navigation, read from the fleet file."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import TypeVar

from msgspec import ValidationError, convert

from ..shared.domain.errors import BadInput
from ..shared.domain.text import quoted

T = TypeVar("T")


def read_options(
    given: Mapping[str, object], kind: type[T], wanted: Mapping[str, str], whose: str
) -> T:
    """Return the options; raise `BadInput` with the key that is unknown or invalid.

    `wanted` says for people what each must be, `whose` whose they are: "a Crazyflie".
    """
    for key in given:
        if key not in wanted:
            raise BadInput(f"{whose} has no option {quoted(key)}; it has {', '.join(wanted)}")
    try:
        return convert(dict(given), kind)
    except ValidationError as error:
        key = re.split(r"[`.\[]", str(error).rpartition("`$.")[2])[0]
        raise bad_option(key, wanted[key]) from error


def bad_option(key: str, wanted: str) -> BadInput:
    """Return the error about an option that is invalid."""
    return BadInput(f"its option {key} must be {wanted}")
