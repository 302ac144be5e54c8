"""A program of the phone's jars on its own JVM: JSON lines to it and from it."""

import json
import os
import signal
import subprocess
import threading
import time
from contextlib import suppress
from pathlib import Path

from tests.support.java import java_program
from tests.support.waiting import DEADLINE_S, until


class JavaProcess:
    """``events`` are all its events, each with the time (monotonic s) at which it arrived."""

    def __init__(self, main, *options, prefix=()):
        command = [*prefix, *java_program().command(*map(str, options), main=main)]
        self.process = subprocess.Popen(
            command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE
        )
        self.events = []
        self.complaints = b""
        self._lock = threading.Lock()
        self._threads = [
            threading.Thread(target=each, daemon=True) for each in (self._hear, self._complain)
        ]
        for each in self._threads:
            each.start()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.end()

    def say(self, **line):
        """Send a line; no effect after the program has ended."""
        data = json.dumps(line).encode() + b"\n"
        with self._lock, suppress(BrokenPipeError, ValueError):
            self.process.stdin.write(data)
            self.process.stdin.flush()

    def all(self, event, since_s=0.0):
        """Return every event of a name that came since a moment."""
        return [
            said for time_s, said in list(self.events)
            if said["event"] == event and time_s >= since_s
        ]  # fmt: skip

    def until(self, condition, what):
        """Wait for a condition and return its value; a dead program is reported immediately."""

        def is_so():
            assert self.process.poll() is None, self.complaints
            return condition()

        try:
            return until(is_so, what)
        except AssertionError as never:
            last = [said for _, said in self.events[-8:]]
            raise AssertionError(f"{never}; it said at last: {last}") from None

    def kill(self):
        """End it as a crash, or an empty battery, would."""
        self.process.send_signal(signal.SIGKILL)
        self.process.wait(DEADLINE_S)

    def end(self):
        """End its input, and so it; return its exit status."""
        with self._lock, suppress(BrokenPipeError):
            self.process.stdin.close()
        try:
            status = self.process.wait(DEADLINE_S)
        except subprocess.TimeoutExpired:
            self.kill()
            raise
        for each in self._threads:
            each.join(DEADLINE_S)
        for stream in (self.process.stdout, self.process.stderr):
            stream.close()
        return status

    def live_bytes(self):
        """Return how much of its heap is in use after a full collection."""
        told = subprocess.run(
            ["jcmd", str(self.process.pid), "GC.class_histogram"],
            capture_output=True, text=True, check=True, timeout=DEADLINE_S,
        ).stdout  # fmt: skip
        return int(told.strip().splitlines()[-1].split()[2])

    def _hear(self):
        with suppress(ValueError):
            for line in self.process.stdout:
                self._take(json.loads(line), time.monotonic())

    def _take(self, said, now_s):
        self.events.append((now_s, said))

    def _complain(self):
        with suppress(ValueError):
            for line in self.process.stderr:
                self.complaints += line


def resident_bytes(pid):
    """Return the memory of a process."""
    pages = Path(f"/proc/{pid}/statm").read_text(encoding="ascii").split()[1]
    return int(pages) * os.sysconf("SC_PAGE_SIZE")
