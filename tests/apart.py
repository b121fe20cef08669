"""What runs at one time on one machine, and must not meet: the tests of two checkouts, two campaigns.

Real drones are locked once a user, so that no two processes command one. Tests command simulated ones
by the addresses that other tests' have, and a port that one has left may be another's next.
"""

from __future__ import annotations

import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest


@contextmanager
def apart() -> Iterator[Path]:
    """Keep the locks and sockets of this process, and of all that it starts, in a folder of its own.

    Its name is short: so must be the address of a socket.
    """
    folder = Path(tempfile.mkdtemp(prefix="pluto-tests-"))
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("XDG_RUNTIME_DIR", str(folder))
        try:
            yield folder
        finally:
            shutil.rmtree(folder, ignore_errors=True)
