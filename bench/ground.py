"""Replaces the proxy: accepts the daemon's link and counts the telemetry."""

import socket
import threading
from contextlib import suppress
from types import TracebackType

WELCOME = b"UP1 ok aircraft=default seat=air token=0123456789abcdef0123456789abcdef\n"


class Ground:
    """Listens on a free port, answers the hello, reads lines in its own thread."""

    def __init__(self) -> None:
        self.frames = 0
        self.bytes = 0
        self._listener = socket.create_server(("127.0.0.1", 0))
        self.port = int(self._listener.getsockname()[1])
        self._peer: socket.socket | None = None
        self._thread = threading.Thread(target=self._serve, daemon=True)

    def __enter__(self) -> "Ground":
        self._thread.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        for each in (self._listener, self._peer):
            if each is not None:
                with suppress(OSError):  # the other side may have closed first
                    each.shutdown(socket.SHUT_RDWR)  # wakes the thread that waits on it
                each.close()
        self._thread.join(5.0)

    def _serve(self) -> None:
        try:
            self._peer, _ = self._listener.accept()
            self._peer.sendall(WELCOME)
            while data := self._peer.recv(65536):
                self.frames += data.count(b'"up.telemetry.update"')
                self.bytes += len(data)
        except OSError:
            return
