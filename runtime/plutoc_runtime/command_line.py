"""A reader of command lines that asks what was meant. No package has it: its commands are two."""

from __future__ import annotations

import re
import sys
from argparse import SUPPRESS, Action, ArgumentError, ArgumentParser
from collections.abc import Iterable, Sequence
from itertools import takewhile
from typing import Any

_OPTION = re.compile(r"--([A-Za-z][\w-]*)(?:=.*)?", re.DOTALL)


def did_you_mean(word: str, words: Iterable[str], before: str = "") -> str:
    """Return `; did you mean x?` if one of the words is near, else nothing."""
    from difflib import get_close_matches  # only for mistakes

    found = get_close_matches(word, sorted(words), n=1, cutoff=0.6)
    return f"; did you mean {before}{found[0]}?" if found else ""


class CommandLine(ArgumentParser):
    """An `ArgumentParser` that says of a misspelt command, option or choice which was meant."""

    def parse_known_args(self, args: Any = None, namespace: Any = None) -> Any:
        """Read the words; a misspelt option is told before all that is missing without it."""
        words = list(sys.argv[1:] if args is None else args)
        self._refuse_misspelt(words)
        return super().parse_known_args(words, namespace)

    def _refuse_misspelt(self, words: Sequence[str]) -> None:
        own = takewhile(lambda word: word != "--", words)
        if self._subparsers is not None:  # what stands behind a command is that command's
            own = takewhile(lambda word: word.startswith("-"), own)
        known = self._option_string_actions
        shown = {each.lstrip("-") for each in known if known[each].help is not SUPPRESS}
        for option in filter(None, map(_OPTION.fullmatch, own)):
            meant = "" if f"--{option[1]}" in known else did_you_mean(option[1], shown, "--")
            if meant:
                self.error(f"there is no option --{option[1]}{meant}")

    def _check_value(self, action: Action, value: Any) -> None:
        try:
            super()._check_value(action, value)
        except ArgumentError as error:
            meant = did_you_mean(str(value), map(str, action.choices or ()))
            raise ArgumentError(action, f"{error.message}{meant}") from None
