"""Files with merge conflicts: both sides, with conflict markers between them."""

from __future__ import annotations

from collections.abc import Collection
from hashlib import sha256

_OURS, _BASE, _THEIRS, _END = b"<<<<<<<", b"|||||||", b"=======", b">>>>>>>"
_NEXT = {
    b"": (_OURS,),
    _OURS: (_BASE, _THEIRS),
    _BASE: (_THEIRS,),
    _THEIRS: (_END,),
}
"""Which mark may come behind which: outside of a conflict one that begins it."""


def sides(data: bytes) -> tuple[bytes, bytes] | None:
    """Return both sides of a merge, each put together; None where there are no marks, or odd ones.

    What was there before both, which Git shows in the style diff3, belongs to neither.
    """
    if _OURS not in data:
        return None
    ours, theirs = list[bytes](), list[bytes]()
    within, found = b"", False
    for line in data.splitlines(keepends=True):
        mark = _mark(line)
        if mark in _NEXT[within]:
            within = b"" if mark == _END else mark
            found = True
        elif mark == _OURS or (mark in (_BASE, _END) and not within):
            return None
        else:
            if within in (b"", _OURS):
                ours.append(line)
            if within in (b"", _THEIRS):
                theirs.append(line)
    return (b"".join(ours), b"".join(theirs)) if found and not within else None


def _mark(line: bytes) -> bytes:
    """Return the mark that a line is, if it is one: seven signs, and behind most of them a name."""
    mark, rest = line[:7], line[7:].rstrip(b"\r\n")
    if mark == _THEIRS:
        return b"" if rest else mark
    is_one = mark in (_OURS, _BASE, _END) and (not rest or rest.startswith(b" "))
    return mark if is_one else b""


def was_written(data: bytes, digests: Collection[str]) -> bool:
    """Return whether a text is one of those that were written, by the SHA-256 of these."""
    return sha256(data).hexdigest() in digests


def was_merged(data: bytes, digests: Collection[str]) -> bool:
    """Return whether a text has the marks of a merge, and each of its sides was written."""
    both = sides(data)
    return both is not None and all(was_written(side, digests) for side in both)
