"""All that goes wrong in a page, or leaves the machine, is a test's failure."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from urllib.parse import urlsplit

from playwright.sync_api import BrowserContext, ConsoleMessage, Error, Page
from playwright.sync_api import Request as PageRequest

HERE = ("127.0.0.1", "localhost")
NO_NETWORK = ("data", "blob", "about", "chrome-error")


@dataclass  # without slots: playwright keeps something in its listeners
class Watch:
    """What pages have complained of, and whom they have asked."""

    complaints: list[str] = field(default_factory=list)
    asked: list[str] = field(default_factory=list)
    expected: list[str] = field(default_factory=list)
    """Parts of complaints that a test brings about: a server that it has killed."""

    def over(self, context: BrowserContext) -> None:
        """Watch all pages of a context."""
        context.on("page", self._page)
        context.on("request", self._request)

    def _page(self, page: Page) -> None:
        page.on("console", self._console)
        page.on("pageerror", self._error)

    def _console(self, message: ConsoleMessage) -> None:
        if message.type in ("error", "warning"):
            where = message.location
            self.complaints.append(f"{message.type}: {message.text} ({where.get('url', '')})")

    def _error(self, error: Error) -> None:
        self.complaints.append(f"uncaught: {error}")

    def _request(self, request: PageRequest) -> None:
        self.asked.append(request.url)

    def abroad(self) -> list[str]:
        """Return the addresses that are not on this machine."""
        return [url for url in self.asked if not _is_here(url)]

    def unexpected(self) -> list[str]:
        """Return the complaints that the test has not brought about itself."""
        return [one for one in self.complaints if not _any_in(self.expected, one)]


def _is_here(url: str) -> bool:
    parts = urlsplit(url)
    return parts.scheme in NO_NETWORK or parts.hostname in HERE


def _any_in(expected: Iterable[str], complaint: str) -> bool:
    return any(part in complaint for part in expected)
