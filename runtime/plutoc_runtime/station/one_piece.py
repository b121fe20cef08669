"""The pages' modules as one script, so that a browser asks once for what it needs at once.

In the package they are as they were written. Each becomes a function of its own, which runs when
it is first imported, as modules do; comments and indentation stay behind. Only the forms of
`import` and `export` that the pages use are known: where there is another, everything is handed
out as it is, and works all the same.
"""

from __future__ import annotations

import re
from collections.abc import Mapping

_COMMENT = re.compile(r"^[ \t]*(?://.*|/\*.*\*/[ \t]*)\n", re.MULTILINE)
_IMPORT = re.compile(
    r'^import (?:(\{[^{}]*\})|\* as (\w+)) from "\./([a-z0-9_-]+\.js)";$', re.MULTILINE
)
_LATER = re.compile(r'\bimport\("\./([a-z0-9_-]+\.js)"\)')
_EXPORT = re.compile(r"^export ((?:async )?function|const) (\w+)", re.MULTILINE)
_UNKNOWN = re.compile(r"^(?:import|export)\b|\bimport[(.]", re.MULTILINE)

_FRAME = """\
const $made={},$how={};
const $get=(name)=>$made[name]??=$how[name]();
const $later=async(name)=>$get(name);
"""


def in_one_piece(modules: Mapping[str, str], first: str) -> str | None:
    """Return modules, by their names, as one script that begins with one; None: they cannot be."""
    parts = [_FRAME]
    for name in _reached(modules, first):
        part = _as_function(name, modules)
        if part is None:
            return None
        parts.append(part)
    return "".join([*parts, f'$get("{first}");\n'])


def _reached(modules: Mapping[str, str], first: str) -> list[str]:
    """Return the names of what a module imports, and what that imports, itself first."""
    found = [first]
    for name in found:  # it grows meanwhile
        text = modules.get(name, "")
        imported = [match[3] for match in _IMPORT.finditer(text)] + _LATER.findall(text)
        found += [other for other in dict.fromkeys(imported) if other not in found]
    return found


def _as_function(name: str, modules: Mapping[str, str]) -> str | None:
    text = modules.get(name)
    if text is None:
        return None
    exported = [match[2] for match in _EXPORT.finditer(text)]
    text = _COMMENT.sub("", text)
    text = _IMPORT.sub(_taken, text)
    text = _LATER.sub(r'$later("\1")', text)
    text = _EXPORT.sub(r"\1 \2", text)
    # a text in backquotes over two lines would lose its spaces
    if _UNKNOWN.search(text) or any(line.count("`") % 2 for line in text.splitlines()):
        return None
    lean = "\n".join(line.lstrip() for line in text.splitlines() if line.strip())
    return f'$how["{name}"]=()=>{{\n{lean}\nreturn{{{",".join(exported)}}};}};\n'


def _taken(match: re.Match[str]) -> str:
    names = match[2] or match[1].replace(" as ", ": ")
    return f'const {names} = $get("{match[3]}");'
