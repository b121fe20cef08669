"""How the sentences of this phase are put together."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from plutoc.diagnostic import Related
from plutoc.graph.names import near
from plutoc.source import Source, Span
from plutoc_runtime.quantities import Type


def meant(name: str, options: Iterable[str]) -> str | None:
    return alternatives(near(name, options), "did you mean ", "?")


def alternatives(names: Sequence[str], before: str, after: str) -> str | None:
    return f"{before}{either(names)}{after}" if names else None


def there_are(names: Sequence[str], what: str) -> str | None:
    return f"{what} are {all_of(names)}" if names else None


def either(names: Sequence[str]) -> str:
    return _joined(names, " or ")


def all_of(names: Sequence[str]) -> str:
    return _joined(names, " and ")


def _joined(names: Sequence[str], last: str) -> str:
    quoted = [f"`{name}`" for name in names]
    return last.join([", ".join(quoted[:-1]), quoted[-1]] if len(quoted) > 1 else quoted)


def a_kind(kind: Type) -> str:
    return article(kind.value)


def article(word: str) -> str:
    return f"{'an' if word[0] in 'aeiou' else 'a'} {word}"


def related(source: Source, span: Span, label: str) -> Related:
    return Related(source=source, span=span, label=label)
