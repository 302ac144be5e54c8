"""A TCP link that takes its time, and can be cut at any byte."""

import queue
import socket
import struct
import threading
import time
from contextlib import suppress

CHUNK = 4096


class SlowRelay:
    """Carries connections to a port of this machine; each way takes ``delay_s``.

    ``cut(count)`` passes that many more bytes to the target and then resets both ends.
    """

    def __init__(self, port, delay_s=0.0):
        self.delay_s = delay_s
        self.connections = 0
        self.cuts = 0
        self._port = port
        self._left = None
        self._lock = threading.Lock()
        self._pairs = []
        self._listener = socket.create_server(("127.0.0.1", 0))
        self.port = self._listener.getsockname()[1]
        self._thread = threading.Thread(target=self._accept, daemon=True)

    def __enter__(self):
        self._thread.start()
        return self

    def __exit__(self, *_):
        # Closing alone would not wake a thread in accept.
        with suppress(OSError):
            self._listener.shutdown(socket.SHUT_RDWR)
        self._listener.close()
        self._thread.join()
        for pair in self._pairs:
            _reset(*pair)

    def cut(self, count):
        """Reset every connection after that many more bytes to the target."""
        with self._lock:
            self._left = count

    def _accept(self):
        with suppress(OSError):
            while True:
                near, _ = self._listener.accept()
                try:
                    far = socket.create_connection(("127.0.0.1", self._port))
                except OSError:
                    _reset(near)
                    continue
                self.connections += 1
                self._pairs.append((near, far))
                for each in (near, far):
                    each.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
                self._carry(near, far, self._measured)
                self._carry(far, near, lambda data: (data, False))

    def _carry(self, source, target, measure):
        on_way = queue.SimpleQueue()

        def read():
            data = b"?"
            while data:
                try:
                    data = source.recv(CHUNK)
                except OSError:
                    data = b""
                on_way.put((time.monotonic() + self.delay_s, data))

        def write():
            while True:
                due_s, data = on_way.get()
                time.sleep(max(0.0, due_s - time.monotonic()))
                passed, is_cut = measure(data)
                try:
                    target.sendall(passed)
                except OSError:
                    data = b""
                if is_cut:
                    # The passed bytes have to be read before the reset discards them.
                    with suppress(OSError):
                        target.shutdown(socket.SHUT_WR)
                    _reset(source)
                    return
                if not data:
                    _reset(source, target)
                    return

        for each in (read, write):
            threading.Thread(target=each, daemon=True).start()

    def _measured(self, data):
        with self._lock:
            if self._left is None or not data:
                return data, False
            passed = data[: self._left]
            self._left -= len(passed)
            if self._left:
                return data, False
            self._left = None
            self.cuts += 1
            return passed, True


def _reset(*sockets):
    for each in sockets:
        with suppress(OSError):
            each.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
            each.shutdown(socket.SHUT_RDWR)
        with suppress(OSError):
            each.close()
