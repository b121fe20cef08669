"""What changed in meaning, for people on a terminal, for pull requests, and for programs."""

from plutoc.report.changes.json import json
from plutoc.report.changes.markdown import markdown
from plutoc.report.changes.text import text

__all__ = ["json", "markdown", "text"]
