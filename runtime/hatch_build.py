"""What a wheel is built with: the pages of the station, minified; a checkout serves its sources."""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import minify
from hatchling.builders.hooks.plugin.interface import BuildHookInterface

PAGES = "pluto_fleet/station/pages"
KINDS = {".js": "text/javascript", ".css": "text/css"}
"""What is minified: the vendored libraries (.mjs) are so already, and anything else is small."""


class PagesHook(BuildHookInterface[Any]):
    """Puts minified scripts and styles into a wheel, in place of those that lie in the checkout."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Minify for all wheels but those of an editable install."""
        if self.target_name != "wheel" or version == "editable":
            return
        self._made = TemporaryDirectory()
        root = Path(self.root)
        for source in sorted((root / PAGES).rglob("*")):
            if source.suffix in KINDS:
                where = source.relative_to(root).as_posix()
                build_data["force_include"][str(self._minified(source, where))] = where

    def finalize(self, version: str, build_data: dict[str, Any], artifact_path: str) -> None:
        """Leave nothing behind."""
        if hasattr(self, "_made"):
            self._made.cleanup()

    def _minified(self, source: Path, where: str) -> Path:
        into = Path(self._made.name, where)
        into.parent.mkdir(parents=True, exist_ok=True)
        small = minify.string(KINDS[source.suffix], source.read_text(encoding="utf-8"))
        into.write_text(small, encoding="utf-8")
        return into
