"""What a wheel is built with: the pages of the station, minified; a checkout serves its sources.

Where there is no minifier to be had, a wheel has the sources, too: it does the same, and is larger.
"""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

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
        try:
            import minify
        except ImportError:
            self.app.display_warning("pages are not minified: tdewolff-minify is not installed")
            return
        self._made = TemporaryDirectory()
        root = Path(self.root)
        for source in sorted((root / PAGES).rglob("*")):
            if source.suffix in KINDS:
                where = source.relative_to(root).as_posix()
                small = minify.string(KINDS[source.suffix], source.read_text(encoding="utf-8"))
                build_data["force_include"][str(self._written(where, small))] = where

    def finalize(self, version: str, build_data: dict[str, Any], artifact_path: str) -> None:
        """Leave nothing behind."""
        if hasattr(self, "_made"):
            self._made.cleanup()

    def _written(self, where: str, text: str) -> Path:
        file = Path(self._made.name, where)
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")
        return file
