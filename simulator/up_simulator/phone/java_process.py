"""The virtual phone's JVM: JSON lines to it and from it."""

from __future__ import annotations

import json
import os
import select
import signal
import time
from collections.abc import Mapping
from typing import Any

from up_simulator.harness.child import Child
from up_simulator.phone.java_program import JavaProgram
from up_simulator.scenario.workspace import Workspace

ANSWER_S = 30.0
"""Limit of a step, for a very busy machine."""
END_S = 2.0
CHUNK = 65_536
MOST_UNREAD = 1 << 20


class JavaPhoneProcess:
    """One JVM, started by the constructor, ended with us; its error output goes to a folder.

    ``ask`` and ``answer`` are for one that answers every line, ``say`` and ``hear`` for one that
    runs freely. Once it has ended, all of them do nothing, and ``last_words`` has the reason.
    """

    def __init__(self, program: JavaProgram, *options: str) -> None:
        self._workspace = Workspace()
        command = program.command(*options)
        folder = self._workspace.path
        self._child = Child("phone", command, folder, talks=True, wish=signal.SIGKILL)
        self._unread = b""
        self._unwritten = b""
        self._is_heard = True
        self._is_ended = False
        self.last_words = ""
        self.dropped = 0
        os.set_blocking(self._child.output.fileno(), False)
        self._poll = select.poll()
        self._poll.register(self._child.output.fileno(), select.POLLIN)

    @property
    def pid(self) -> int:
        """Return its process number."""
        return self._child.pid

    @property
    def is_running(self) -> bool:
        """Return whether it can still be spoken with."""
        return self._is_heard

    def step(self, line: Mapping[str, Any]) -> tuple[list[dict[str, Any]], dict[str, Any]]:
        """Send a line and wait for its answer."""
        self.ask(line)
        return self.answer()

    def ask(self, line: Mapping[str, Any]) -> None:
        """Send a line; its answer must be taken before the next one."""
        if self._is_heard:
            self._write(line)

    def answer(self) -> tuple[list[dict[str, Any]], dict[str, Any]]:
        """Wait for the answer to a line: the events before it, and the answer itself.

        An empty answer: it has ended.
        """
        deadline_s = time.monotonic() + ANSWER_S
        events: list[dict[str, Any]] = []
        while self._is_heard:
            left_s = deadline_s - time.monotonic()
            if left_s <= 0 or not self._poll.poll(left_s * 1000):
                self._give_up(f"it has not answered for {ANSWER_S:g} s")
                break
            for found in self._read_lines():
                if "due" in found:
                    return events, found
                events.append(found)
        return events, {}

    def say(self, line: Mapping[str, Any]) -> None:
        """Send a line; one that the JVM does not take now is dropped and counted.

        A line partly sent is never dropped: its rest goes before the next.
        """
        if self._is_heard:
            os.set_blocking(self._child.input.fileno(), False)
            self._write(line)

    def hear(self) -> list[dict[str, Any]]:
        """Return the events since the last call."""
        return list(self._read_lines()) if self._is_heard else []

    def end(self) -> None:
        """End it by closing its input."""
        self._is_heard = False
        if self._is_ended:
            return
        self._is_ended = True
        for stream in (self._child.input, self._child.output):
            try:
                stream.close()
            except OSError:
                continue
        self._child.wait(END_S)
        self._workspace.close()

    def _write(self, line: Mapping[str, Any]) -> None:
        data = json.dumps(line, allow_nan=False).encode("ascii") + b"\n"
        try:
            self._unwritten = self._push(self._unwritten)
            if self._unwritten:
                self.dropped += 1
                return
            rest = self._push(data)
        except OSError:
            # It has ended: its earlier output is read first.
            return
        if rest == data:
            self.dropped += 1
        else:
            self._unwritten = rest

    def _push(self, data: bytes) -> bytes:
        """Write straight to the pipe; return the bytes that it does not take now.

        A buffer would try its content again at the end.
        """
        try:
            while data:
                data = data[os.write(self._child.input.fileno(), data) :]
        except BlockingIOError:
            return data
        return data

    def _read_lines(self) -> list[dict[str, Any]]:
        try:
            data = os.read(self._child.output.fileno(), CHUNK)
        except BlockingIOError:
            data = None
        if data == b"":
            self._note_end()
        *lines, self._unread = (self._unread + (data or b"")).split(b"\n")
        if len(self._unread) > MOST_UNREAD:
            self._give_up("it says a line without an end")
        return [_read(line) for line in lines]

    def _note_end(self) -> None:
        self._is_heard = False
        self.last_words = self._child.last_words(self._child.wait(END_S))

    def _give_up(self, why: str) -> None:
        self._child.signal(signal.SIGKILL)
        self._note_end()
        self.last_words = f"the phone's JVM was ended: {why}"


def _read(line: bytes) -> dict[str, Any]:
    """Return a line's object; other output of a JVM is a notice."""
    try:
        found = json.loads(line)
    except ValueError:
        found = None
    if isinstance(found, dict):
        return found
    return {"event": "notice", "text": line[:200].decode("utf-8", "replace")}
