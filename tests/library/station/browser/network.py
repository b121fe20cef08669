"""The network between a page and its station: it can be cut, and go silent, as where a cable is pulled out."""

from __future__ import annotations

from playwright.sync_api import Page, Route, WebSocketRoute


class Network:
    """What a page asks and is told goes through here, from before it is opened."""

    def __init__(self) -> None:
        self._is_cut = self._is_silent = False
        self._lines: list[WebSocketRoute] = []
        self._waiting: list[Route] = []

    def over(self, page: Page) -> None:
        """Lie between a page and all addresses of its station."""
        page.route("**/api/**", self._asked)
        page.route_web_socket("**/api/live", self._opened)

    def cut(self) -> None:
        """Break every connection, and let none through."""
        self._is_cut = True
        for line in self._lines:
            line.close()
        for route in self._waiting:
            route.abort()
        self._lines, self._waiting = [], []

    def hush(self) -> None:
        """Let nothing through, and say nothing."""
        self._is_silent = True

    def mend(self) -> None:
        """Let everything through again; what is old is gone."""
        self.cut()
        self._is_cut = self._is_silent = False

    def _asked(self, route: Route) -> None:
        if self._is_cut:
            route.abort()
        elif self._is_silent:
            self._waiting.append(route)
        else:
            route.fallback()

    def _opened(self, page: WebSocketRoute) -> None:
        if self._is_cut:
            page.close()
            return
        self._lines.append(page)
        station = page.connect_to_server()
        page.on_message(lambda said: None if self._is_silent else station.send(said))
        station.on_message(lambda said: None if self._is_silent else page.send(said))
