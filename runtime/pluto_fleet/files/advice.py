"""What to do about a plan file that is not TOML, by the line at which `tomllib` gave up."""

from __future__ import annotations

import re

USUAL = "texts, and numbers with a unit, stand in quotes, lists in [ ], and each key stands once"
_TEXT = re.compile(r"""("(?:[^"\\]|\\.)*"|'[^']*')""")
_COMMA = "a comma stands between two values"
_PAIR = re.compile(r"""\s*([\w.-]+|"[^"]*")\s*=\s*(.*?)\s*""")
_LONGEST = 200
"""In characters: of a longer line no rule is tried, and nothing repeated."""
_WORDS = {"yes": "true", "on": "true", "no": "false", "off": "false", "none": "", "null": ""}


def advice(text: str, row: int) -> str:
    """Say what to do about this row, from 1, of a text that is not TOML."""
    lines = text.replace("\r\n", "\n").split("\n")
    if len(lines[row - 1]) > _LONGEST:
        return USUAL
    line = _without_comment(lines[row - 1])
    return (
        _left_open(lines, row)
        or _of_any_line(line)
        or _of_a_header(lines, row, line.strip())
        or _of_a_pair(lines, row, line)
        or USUAL
    )


def _without_comment(line: str) -> str:
    """Return the line up to a `#` that stands in no text."""
    at = 0
    for part in _TEXT.split(line):
        if "#" in part and not _TEXT.fullmatch(part):
            return line[: at + part.index("#")]
        at += len(part)
    return line


def _left_open(lines: list[str], row: int) -> str | None:
    """Find a list that an earlier line begins and none ends, before the next key or table."""
    is_next = re.match(r"\s*(\[\[?[\w.]+\]*\s*$|[\w-]+\s*=)", lines[row - 1])
    is_last = not "".join(lines[row:]).strip()
    depth = 0
    for place in range(row - 1 if is_next else row, 0, -1):
        plain = _TEXT.sub("", _without_comment(lines[place - 1]))
        depth += plain.count("[") - plain.count("]")
        if depth > 0 and (place < row or "=" in plain):
            return _no_end(place) if is_next or is_last else _COMMA
        if re.match(r"\s*([\w-]+\s*=|\[\[?[\w.]+\])", plain):
            return None
    return None


def _no_end(row: int) -> str:
    return f"the list that begins in line {row} has no closing ]"


def _of_any_line(line: str) -> str | None:
    if any(quote in line for quote in "“”„‘’"):
        return 'quotes are straight: "text"'
    if "//" in _TEXT.sub("", line):
        return "a comment begins with #"
    if _TEXT.sub("", line).rstrip().endswith(";"):
        return "write no ; at the end of a line"
    if re.search(r'"[^"]*\\[^"]*"', line):
        return "in a text a backslash is written \\\\"
    return None


def _of_a_header(lines: list[str], row: int, line: str) -> str | None:
    if not line.startswith("["):
        return None
    name = line.strip("[] ")
    if not re.fullmatch(r"[\w.-]+", name):
        return None
    if not re.fullmatch(r"\[\[[^\[\]]*\]\]|\[[^\[\]]*\]", line):
        return f"write [[{name}]]" if "[[" in line or "]]" in line else f"write [{name}]"
    others = [n for n, one in enumerate(lines[: row - 1], 1) if one.strip("[] \t\r") == name]
    return f"write [[{name}]] here and in line {others[0]}" if others else None


def _of_a_pair(lines: list[str], row: int, line: str) -> str | None:
    swapped = re.fullmatch(r"\s*([\w-]+)\s*:\s*(.*?)\s*", line)
    if swapped:
        return f"write = instead of the colon: {swapped[1]} = {swapped[2]}"
    pair = _PAIR.fullmatch(line)
    if pair is None:
        return 'a line is a key and its value, such as name = "North"' if line.strip() else None
    key, value = pair[1], pair[2]
    if not value:
        return f"write a value behind {key} ="
    first = _given_before(lines, row, key)
    if first:
        return f"{key} is given in line {first} already"
    plain = _TEXT.sub("", value)
    if value[0] in "[{":
        if plain.count("{") > plain.count("}"):
            return "the { has no closing } in its line"
        return _no_end(row) if plain.count("[") > plain.count("]") else _COMMA
    if value[0] in "\"'":
        return _of_a_text(key, value)
    if value.lower() in ("true", "false") or _WORDS.get(value.lower()):
        return f"write {key} = {_WORDS.get(value.lower(), value.lower())}"
    if re.fullmatch(r"\d+,\d+", value):
        return f"a number has a point: {key} = {value.replace(',', '.')}"
    if re.fullmatch(r"0\d+", value):
        return f"write {key} = {int(value)}"
    is_number = re.fullmatch(r"[+-]?\d+(\.\d+)?", value)
    return None if is_number or '"' in value else f'write {key} = "{value}"'


def _of_a_text(key: str, value: str) -> str | None:
    if value.count('"') == 1:
        return f'the text has no closing quote: write {key} = {value}"'
    if value[0] == "'" and '"' not in value and value.count("'") > 2:
        return f'write {key} = "{value[1:-1]}"'
    return None


def _given_before(lines: list[str], row: int, key: str) -> int | None:
    """Return the line in the same table that has this key already."""
    same = re.compile(rf"\s*{re.escape(key)}\s*=")
    for place in range(row - 1, 0, -1):
        if same.match(lines[place - 1]):
            return place
        if lines[place - 1].lstrip().startswith("["):
            break
    return None
