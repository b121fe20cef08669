"""The network between a browser and a station: it can be cut, and go silent.

To the station it is as if the browser had asked itself: the address in what is sent is exchanged.
"""

from __future__ import annotations

import socket
from collections.abc import Callable
from contextlib import suppress
from threading import Event, Thread


class Cable:
    """Leads from a port of its own to a station's; both ports have five digits."""

    def __init__(self, port: int) -> None:
        self._far = port
        self._listener = socket.create_server(("127.0.0.1", 0))
        self.port: int = self._listener.getsockname()[1]
        self._lines: list[socket.socket] = []
        self._through = Event()
        self._through.set()
        self._cut = False
        self._threads: list[Thread] = []
        self._run(self._accept)

    def _run(self, work: Callable[..., None], *args: object) -> None:
        thread = Thread(target=work, args=args, daemon=True)
        self._threads.append(thread)
        thread.start()

    def cut(self) -> None:
        """Break every connection, and let none through."""
        self._cut = True
        for line in self._lines:
            with suppress(OSError):
                line.shutdown(socket.SHUT_RDWR)

    def hush(self) -> None:
        """Let nothing through, and say nothing: as where a cable is pulled out."""
        self._through.clear()

    def mend(self) -> None:
        """Let everything through again; what is old is gone."""
        self.cut()
        self._through.set()
        self._cut = False

    def close(self) -> None:
        """Take it away."""
        self._through.set()
        with suppress(OSError):
            self._listener.shutdown(socket.SHUT_RDWR)  # or it would wait for the next one for ever
        self._threads[0].join()
        self._listener.close()
        self.cut()
        for thread in self._threads:
            thread.join()
        for line in self._lines:
            line.close()

    def _accept(self) -> None:
        with suppress(OSError):
            while True:
                near, _ = self._listener.accept()
                if self._cut:
                    near.close()
                    continue
                try:
                    far = socket.create_connection(("127.0.0.1", self._far))
                except OSError:
                    near.close()
                    continue
                self._lines += [near, far]
                here, there = str(self.port).encode(), str(self._far).encode()
                self._run(self._pump, near, far, here, there)
                self._run(self._pump, far, near, b"", b"")

    def _pump(self, out_of: socket.socket, into: socket.socket, old: bytes, new: bytes) -> None:
        with suppress(OSError):
            while data := out_of.recv(65_536):
                self._through.wait()
                if old:
                    data = data.replace(b"127.0.0.1:" + old, b"127.0.0.1:" + new)
                into.sendall(data)
        for end in (out_of, into):
            with suppress(OSError):
                end.shutdown(socket.SHUT_RDWR)
