"""The simulator as a process, and its board's line, for the tests."""

import os
import select
import signal
import subprocess
import sys
import time
from pathlib import Path

from tests.simulator.pi import Listener, frame
from up_simulator.harness.user_log import JSON_ENVIRONMENT, read_line

DEADLINE_S = 30.0


class Program:
    """``python -m up_simulator start`` with its output kept; ended at the end of the ``with``."""

    def __init__(self, *arguments, environment=None):
        self.process = subprocess.Popen(
            [sys.executable, "-W", "error", "-m", "up_simulator", "start", *map(str, arguments)],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            env=os.environ | JSON_ENVIRONMENT | (environment or {}),
        )
        os.set_blocking(self.process.stdout.fileno(), False)
        self.unread = b""
        self.lines = []

    def __enter__(self):
        return self

    def __exit__(self, *exception):
        if self.process.poll() is None:
            self.process.kill()
        self.process.wait()
        self.process.stdout.close()
        self.process.stderr.close()

    def wait_for(self, code, **fields):
        """Wait until the program has logged a line with this code and fields; return it."""
        deadline = time.monotonic() + DEADLINE_S
        while not (found := [line for line in self.lines if line.has(code, **fields)]):
            select.select([self.process.stdout], [], [], 0.1)
            chunk = self.process.stdout.read()
            *lines, self.unread = (self.unread + (chunk or b"")).split(b"\n")
            self.lines += [read_line(line.decode()) for line in lines]
            is_over = chunk == b"" and self.process.poll() is not None and not lines
            assert not is_over, f"ended without {code}: {self.lines} {self.error()}"
            assert time.monotonic() < deadline, f"never {code} {fields}: {self.lines}"
        return found[0]

    def end(self, number=signal.SIGTERM):
        started = time.monotonic()
        self.process.send_signal(number)
        status = self.process.wait(DEADLINE_S)
        return status, time.monotonic() - started, self.error()

    def error(self):
        return self.process.stderr.read().decode()


class Line:
    """The Raspberry Pi's serial port: plain system calls on the pty."""

    def __init__(self, path):
        self.file = os.open(Path(path), os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
        self.listener = Listener()
        self.sequence = 0

    def __enter__(self):
        return self

    def __exit__(self, *exception):
        os.close(self.file)

    def send(self, letter, payload=b""):
        os.write(self.file, frame(self.sequence, letter, payload))
        self.sequence = (self.sequence + 1) % 256

    def read(self, timeout_s=0.1):
        select.select([self.file], [], [], timeout_s)
        try:
            return os.read(self.file, 65536)
        except BlockingIOError:
            return b""

    def wait_for(self, condition):
        """Read messages until one fulfils the condition, and return it."""
        deadline = time.monotonic() + DEADLINE_S
        while time.monotonic() < deadline:
            self.listener.feed(self.read())
            while self.listener.messages:
                message = self.listener.messages.pop(0)
                if condition(message):
                    return message
        raise AssertionError(f"no message fulfils {condition}")

    def wait_for_type(self, letter):
        return self.wait_for(lambda message: message.type == letter)
