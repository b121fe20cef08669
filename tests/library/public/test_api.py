"""What cannot be done from Python is refused with a sentence, too."""

from __future__ import annotations

import pytest

from pluto_fleet import api


@pytest.mark.parametrize("package", ["no_such_app", "json"])
def test_what_is_no_app_is_refused(package: str) -> None:
    with pytest.raises(api.BadInput, match=f"^{package} is no app that can be imported here: "):
        api.load_app(package)
