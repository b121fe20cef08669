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
from tests.paths import CASES, EXAMPLES

EVENTS = CASES / "pursue" / "app.pluto"
"""What no example has yet: events."""

ENOUGH = 0.98
"""The share of broken files of which exactly one thing is to be said."""

_TOKEN = re.compile(r"#.*|\w+|->|\"[^\"\n]*\"|[^\w\s]")
_CHARACTERS = "abcxyzAZ019 _-.,:;()[]{}<>=#\"'/\\%→é\t"
_INSERTED = [
    *("(", ")", "[", "]", "{", "}", '"', "'", "->", "=", ",", ":", ".", "when", "otherwise"),
    *("app", "use", "category", "action", "policy", "end", "start", "x", "5 min", "# "),
]
Pieces = list[str]


def _tokens(text: str) -> Pieces:
    """Return what stands between tokens and each token, in turn; comments belong to what is between."""
    pieces, at = [""], 0
    for match in _TOKEN.finditer(text):
        pieces[-1] += text[at : match.start()]
        at = match.end()
        if match[0].startswith("#"):
            pieces[-1] += match[0]
        else:
            pieces += [match[0], ""]
    pieces[-1] += text[at:]
    return pieces


def _lines(text: str) -> Pieces:
    return ["", *(part for line in text.splitlines(keepends=True) for part in (line, ""))]


def _characters(text: str) -> Pieces:
    return ["", *(part for character in text for part in (character, ""))]


def _delete(pieces: Pieces, at: int, dice: random.Random) -> None:
    pieces[at] = ""


def _duplicate(pieces: Pieces, at: int, dice: random.Random) -> None:
    pieces[at] += ("" if pieces[at].endswith("\n") else " ") + pieces[at]


def _swap(pieces: Pieces, at: int, dice: random.Random) -> None:
    other = min(at + 2, len(pieces) - 2)
    pieces[at], pieces[other] = pieces[other], pieces[at]


def _insert_token(pieces: Pieces, at: int, dice: random.Random) -> None:
    pieces[at + dice.choice((-1, 1))] += f" {dice.choice(_INSERTED)} "


def _insert_character(pieces: Pieces, at: int, dice: random.Random) -> None:
    pieces[at] += dice.choice(_CHARACTERS)


def _replace(pieces: Pieces, at: int, dice: random.Random) -> None:
    pieces[at] = dice.choice(_CHARACTERS)


def _change_case(pieces: Pieces, at: int, dice: random.Random) -> None:
    pieces[at] = dice.choice((pieces[at].swapcase(), pieces[at].capitalize()))


def _split(pieces: Pieces, at: int, dice: random.Random) -> None:
    pieces[at] += "\n"


def _join(pieces: Pieces, at: int, dice: random.Random) -> None:
    """Lead a line's end on to the next line."""
    pieces[at] = pieces[at].rstrip("\n") + " "
    if at + 2 < len(pieces):
        pieces[at + 2] = pieces[at + 2].lstrip(" ")


Mutation = tuple[Callable[[str], Pieces], Callable[[Pieces, int, random.Random], None]]
MUTATIONS: dict[str, Mutation] = {
    "insert a character": (_characters, _insert_character),
    "delete a character": (_characters, _delete),
    "replace a character": (_characters, _replace),
    "transpose two characters": (_characters, _swap),
    "delete a token": (_tokens, _delete),
    "duplicate a token": (_tokens, _duplicate),
    "swap two tokens": (_tokens, _swap),
    "insert a token": (_tokens, _insert_token),
    "change case": (_tokens, _change_case),
    "delete a line": (_lines, _delete),
    "duplicate a line": (_lines, _duplicate),
    "split a line": (_characters, _split),
    "join two lines": (_lines, _join),
}


def mutated(text: str, mutation: str, dice: random.Random) -> str:
    """Make one mistake somewhere in a text."""
    parted, change = MUTATIONS[mutation]
    pieces = parted(text)
    change(pieces, dice.randrange(1, len(pieces), 2), dice)
    return "".join(pieces)


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
        wrong = mutated(text, mutation, dice)
        if wrong != text:
            count -= 1
            yield Mutant(example=example, mutation=mutation, text=wrong, hooks=hooks_source)


def _examples() -> dict[str, tuple[str, Source | None]]:
    examples: dict[str, tuple[str, Source | None]] = {}
    for path in (*sorted(EXAMPLES.glob("*/app.pluto")), EVENTS):
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
    drawn = mutants(options.count, options.seed)
    outcomes = [came for _, came in campaign.each(outcome, drawn)]
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
