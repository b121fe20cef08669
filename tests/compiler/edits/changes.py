"""What an edit changes in a generated package, as its reviewer sees it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from difflib import unified_diff

from plutoc.compile import analyse, compile_source
from plutoc.hooks.add import with_stubs
from plutoc.source import Source
from tests.compiler.edits.edits import HOOKS, Edit


@dataclass(frozen=True, slots=True, kw_only=True)
class Changes:
    """The lines that went and came, and the modules of the runtime that did."""

    lines: Mapping[str, tuple[str, ...]]
    """By path, without the lock and the runtime; each line with its sign."""
    modules: tuple[str, ...]
    """Those that joined or left."""

    @property
    def count(self) -> int:
        """How many lines there are to read; a module that joins or leaves is one."""
        return sum(map(len, self.lines.values())) + len(self.modules)

    def __str__(self) -> str:
        shown = [f"{path}\n  " + "\n  ".join(lines) for path, lines in self.lines.items()]
        return "\n".join([*shown, *self.modules])


def changes_of(edit: Edit, hooks: str = HOOKS) -> Changes:
    """Compile both sources, with stubs in the developer's hooks.py for new hooks."""
    before, after = files(edit.before, hooks), files(edit.after, hooks)
    lines: dict[str, tuple[str, ...]] = {}
    modules: list[str] = []
    for path in sorted({*before, *after}):
        old, new = before.get(path), after.get(path)
        if old == new or path == "pluto.lock":
            continue
        if "/_runtime/" not in path:
            lines[path] = _difference(old or "", new or "")
        else:
            assert old is None or new is None, f"{path} is not copied byte for byte"
            modules.append(path)
    return Changes(lines=lines, modules=tuple(modules))


def _difference(old: str, new: str) -> tuple[str, ...]:
    compared = unified_diff(old.splitlines(), new.splitlines(), n=0, lineterm="")
    return tuple(line for line in list(compared)[2:] if not line.startswith(""))


def files(text: str, hooks: str) -> dict[str, str]:
    """Return the files of a package whose developer has written hooks, and tests of them."""
    source = Source("app.pluto", text)
    checked, _ = analyse(source)
    written = with_stubs(checked, Source("hooks.py", hooks))
    compiled = compile_source(
        source, source_name="app.pluto", find_hooks=lambda _: Source("hooks.py", written)
    )
    return {**compiled.package.owned, f"src/{compiled.package.name}/hooks.py": written}
