"""A link for datagrams that loses some of them."""

import random
import socket
import threading


class LossyRelay:
    """Passes datagrams on to a port of this machine; each is lost with a chance."""

    def __init__(self, port, loss, seed):
        self.passed = self.lost = 0
        self._target = ("127.0.0.1", port)
        self._loss = loss
        self._random = random.Random(seed)
        self._socket = socket.socket(type=socket.SOCK_DGRAM)
        self._socket.bind(("127.0.0.1", 0))
        self._socket.settimeout(0.05)
        self.port = self._socket.getsockname()[1]
        self._is_ended = threading.Event()
        self._thread = threading.Thread(target=self._run, daemon=True)

    def __enter__(self):
        self._thread.start()
        return self

    def __exit__(self, *_):
        self._is_ended.set()
        self._thread.join()
        self._socket.close()

    def _run(self):
        while not self._is_ended.is_set():
            try:
                datagram = self._socket.recv(2048)
            except TimeoutError:
                continue
            if self._random.random() < self._loss:
                self.lost += 1
            else:
                self._socket.sendto(datagram, self._target)
                self.passed += 1
