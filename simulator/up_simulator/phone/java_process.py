"""The virtual phone's JVM: JSON lines to it and from it."""

from __future__ import annotations

import json
import os
import signal
from collections.abc import Mapping
from typing import Any

from up_simulator.harness.child import Child
from up_simulator.phone.java_program import JavaProgram
from up_simulator.scenario.workspace import Workspace

END_S = 2.0
MAX_READ = 65_536
MAX_UNREAD = 1 << 20


class JavaPhoneProcess:
    """One JVM, started by the constructor, ended with us; its error output goes to a folder.

    Once it has ended, ``send`` and ``receive`` do nothing, and ``exit_reason`` has the reason.
    """

    def __init__(self, program: JavaProgram, *options: str) -> None:
        self._workspace = Workspace()
        command = program.command(*options)
        folder = self._workspace.path
        self._child = Child("phone", command, folder, is_piped=True, death_signal=signal.SIGKILL)
        self._unread = b""
        self._unwritten = b""
        self._is_open = True
        self._is_ended = False
        self.exit_reason = ""
        self.dropped = 0
        os.set_blocking(self._child.input.fileno(), False)
        os.set_blocking(self._child.output.fileno(), False)

    @property
    def pid(self) -> int:
        return self._child.pid

    @property
    def is_running(self) -> bool:
        return self._is_open

    def send(self, line: Mapping[str, Any]) -> None:
        """Send a line; one that the JVM does not take now is dropped and counted.

        A line partly sent is never dropped: its rest goes before the next.
        """
        if self._is_open:
            self._write(line)

    def receive(self) -> list[dict[str, Any]]:
        return list(self._read_lines()) if self._is_open else []

    def end(self) -> None:
        self._is_open = False
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
            data = os.read(self._child.output.fileno(), MAX_READ)
        except BlockingIOError:
            data = None
        if data == b"":
            self._on_end()
        *lines, self._unread = (self._unread + (data or b"")).split(b"\n")
        if len(self._unread) > MAX_UNREAD:
            self._give_up(f"a line of more than {MAX_UNREAD} bytes")
        return [_read(line) for line in lines]

    def _on_end(self) -> None:
        self._is_open = False
        self.exit_reason = self._child.exit_report(self._child.wait(END_S))

    def _give_up(self, why: str) -> None:
        self._child.signal(signal.SIGKILL)
        self._on_end()
        self.exit_reason = f"the phone's JVM was killed: {why}"


def _read(line: bytes) -> dict[str, Any]:
    """Return a line's object; other output of a JVM is a notice."""
    try:
        found = json.loads(line)
    except ValueError:
        found = None
    if isinstance(found, dict):
        return found
    return {"event": "notice", "text": line[:200].decode("utf-8", "replace")}
