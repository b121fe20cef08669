"""Makes one random mistake in an example: the compiler says one thing of it.

    python -m tests.mutations --count 4000 --seed 1

Prints how many broken files give exactly one diagnostic, and which give more.
"""

from __future__ import annotations

import random
import re
import sys
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass

from plutoc.compile import analyse, check_hooks
from plutoc.diagnostic import Diagnostic, Rejected, Severity
from plutoc.source import Source
from plutoc.syntax.parse import read
from plutoc.syntax.tree import File
from tests.kit.campaign import Campaign
from tests.paths import EXAMPLES

ENOUGH = 0.98
"""The share of broken files of which exactly one thing is to be said."""

_TOKEN = re.compile(r"\w+|->|\"[^\"\n]*\"|[^\w\s]")
_CHARACTERS = "abcxyzAZ019 _-.,:;()[]{}<>=#\"'/\\%→é\t"
_INSERTED = [
    *("(", ")", "[", "]", "{", "}", '"', "'", "->", "=", ",", ":", ".", "when", "otherwise"),
    *("app", "use", "category", "action", "policy", "end", "start", "x", "5 min", "# "),
]


def _insert_character(text: str, dice: random.Random) -> str:
    at = dice.randrange(len(text) + 1)
    return text[:at] + dice.choice(_CHARACTERS) + text[at:]


def _delete_character(text: str, dice: random.Random) -> str:
    at = dice.randrange(len(text))
    return text[:at] + text[at + 1 :]


def _replace_character(text: str, dice: random.Random) -> str:
    at = dice.randrange(len(text))
    return text[:at] + dice.choice(_CHARACTERS) + text[at + 1 :]


def _transpose_characters(text: str, dice: random.Random) -> str:
    at = dice.randrange(len(text) - 1)
    return text[:at] + text[at + 1] + text[at] + text[at + 2 :]


def _places(text: str) -> list[tuple[int, int]]:
    """Return where tokens are, outside of comments."""
    return [
        (match.start() + offset, match.end() + offset)
        for offset, line in _lines(text)
        for match in _TOKEN.finditer(re.sub(r"#.*", "", line))
    ]


def _lines(text: str) -> Iterator[tuple[int, str]]:
    offset = 0
    for line in text.splitlines(keepends=True):
        yield offset, line
        offset += len(line)


def _delete_token(text: str, dice: random.Random) -> str:
    start, end = dice.choice(_places(text))
    return text[:start] + text[end:]


def _duplicate_token(text: str, dice: random.Random) -> str:
    start, end = dice.choice(_places(text))
    return text[:end] + " " + text[start:end] + text[end:]


def _swap_tokens(text: str, dice: random.Random) -> str:
    places = _places(text)
    i = dice.randrange(len(places) - 1)
    (a, b), (c, d) = places[i], places[i + 1]
    return text[:a] + text[c:d] + text[b:c] + text[a:b] + text[d:]


def _insert_token(text: str, dice: random.Random) -> str:
    at = dice.choice(_places(text))[dice.randrange(2)]
    return f"{text[:at]} {dice.choice(_INSERTED)} {text[at:]}"


def _change_case(text: str, dice: random.Random) -> str:
    start, end = dice.choice([(a, b) for a, b in _places(text) if text[a:b].isidentifier()])
    word = text[start:end]
    return text[:start] + dice.choice((word.swapcase(), word.capitalize())) + text[end:]


def _delete_line(text: str, dice: random.Random) -> str:
    lines = text.splitlines(keepends=True)
    del lines[dice.randrange(len(lines))]
    return "".join(lines)


def _duplicate_line(text: str, dice: random.Random) -> str:
    lines = text.splitlines(keepends=True)
    at = dice.randrange(len(lines))
    return "".join([*lines[: at + 1], *lines[at:]])


def _split_line(text: str, dice: random.Random) -> str:
    at = dice.randrange(len(text) + 1)
    return text[:at] + "\n" + text[at:]


def _join_lines(text: str, dice: random.Random) -> str:
    at = dice.choice([i for i, char in enumerate(text) if char == "\n"])
    return text[:at] + " " + text[at + 1 :].lstrip(" ")


MUTATIONS: dict[str, Callable[[str, random.Random], str]] = {
    "insert a character": _insert_character,
    "delete a character": _delete_character,
    "replace a character": _replace_character,
    "transpose two characters": _transpose_characters,
    "delete a token": _delete_token,
    "duplicate a token": _duplicate_token,
    "swap two tokens": _swap_tokens,
    "insert a token": _insert_token,
    "change case": _change_case,
    "delete a line": _delete_line,
    "duplicate a line": _duplicate_line,
    "split a line": _split_line,
    "join two lines": _join_lines,
}


@dataclass(frozen=True, slots=True, kw_only=True)
class Mutant:
    """An example with one mistake."""

    example: str
    mutation: str
    text: str
    hooks: Source | None


@dataclass(frozen=True, slots=True, kw_only=True)
class Outcome:
    """What the compiler says of a mutant."""

    mutant: Mutant
    found: tuple[Diagnostic, ...]

    @property
    def broken(self) -> bool:
        """Whether it is refused."""
        return bool(self.errors)

    @property
    def errors(self) -> list[Diagnostic]:
        """What is found, but the warnings."""
        return [d for d in self.found if d.severity is Severity.ERROR]


def mutants(count: int, seed: int, text: str | None = None) -> Iterator[Mutant]:
    """Make mutants of all examples, or of one text, the same for a seed."""
    dice = random.Random(seed)
    examples = _examples() if text is None else {"one": (text, None)}
    while count:
        example = dice.choice(list(examples))
        mutation = dice.choice(list(MUTATIONS))
        text, hooks_source = examples[example]
        mutated = MUTATIONS[mutation](text, dice)
        if mutated != text:
            count -= 1
            yield Mutant(example=example, mutation=mutation, text=mutated, hooks=hooks_source)


def _examples() -> dict[str, tuple[str, Source | None]]:
    examples: dict[str, tuple[str, Source | None]] = {}
    for path in sorted(EXAMPLES.glob("*/app.pluto")):
        hooks = path.with_name("hooks.py")
        text = hooks.read_text(encoding="utf-8") if hooks.exists() else None
        examples[path.parent.name] = (
            path.read_text(encoding="utf-8"),
            Source("hooks.py", text) if text is not None else None,
        )
    return examples


def outcome(mutant: Mutant) -> Outcome:
    """Check a mutant, as `plutoc check` does."""
    source = Source("app.pluto", mutant.text)
    file, _ = read(source)
    assert isinstance(file, File)
    try:
        checked, warnings = analyse(source)
        found = warnings + check_hooks(checked, mutant.hooks)
    except Rejected as rejected:
        found = rejected.diagnostics
    return Outcome(mutant=mutant, found=found)


def share(outcomes: list[Outcome], only_errors: bool = False) -> float:
    """Return the share of the broken files that give exactly one diagnostic."""
    broken = [each for each in outcomes if each.broken]
    single = [each for each in broken if len(each.errors if only_errors else each.found) == 1]
    return len(single) / len(broken)


def main() -> int:
    """Print the figures, and the worst."""
    campaign = Campaign("tests.mutations", __doc__)
    campaign.option("--count", type=int, default=4000, help="how many files")
    campaign.option("--seed", type=int, default=1)
    campaign.option("--show", type=int, default=10, help="how many of the worst to print")
    options = campaign.parse()
    mutated = mutants(options.count, options.seed)
    outcomes = [came for _, came in campaign.each(outcome, mutated)]
    several = [each for each in outcomes if each.broken and len(each.found) > 1]
    several.sort(key=lambda each: (all(d.code >= "P2" for d in each.found), -len(each.found)))
    for each in several[: options.show]:
        print(f"{each.mutant.example}: {each.mutant.mutation}")
        for d in each.found:
            line, column = d.source.position(d.span.start)
            print(f"{d.code} {line}:{column} {d.message}\n      {d.source.line(line)}")
    return campaign.over(
        *_figures(outcomes, several),
        fails=["those are too few"] if share(outcomes) < ENOUGH else [],
    )


def _figures(outcomes: list[Outcome], several: list[Outcome]) -> Iterator[str]:
    for mutation in MUTATIONS:
        these = [each for each in outcomes if each.mutant.mutation == mutation]
        count = sum(each.broken for each in these)
        if count:
            yield f"  {share(these):7.2%} of {count:4} {mutation}"
    kinds = Counter(" ".join(d.code for d in each.found) for each in several)
    yield from (f"{count:4} × {codes}" for codes, count in kinds.most_common(25))
    yield f"exactly one diagnostic: {share(outcomes):.2%} of the broken"
    yield f"exactly one error:      {share(outcomes, only_errors=True):.2%} of the broken"


if __name__ == "__main__":
    sys.exit(main())
