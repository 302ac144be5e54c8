"""`make run` for tests: started as a user starts it, watched from outside, ended."""

from __future__ import annotations

import csv
import json
import os
import re
import signal
import subprocess
import sys
from pathlib import Path

from tests.support.program_output import fields_of
from tests.support.waiting import DEADLINE_S, until


class Showcase:
    """`make run` on any free ports, without the picture; ``end_all`` ends leftovers of a test.

    ``started`` names every one of this process, for `end_all`.
    """

    started = []

    def __init__(self, folder, *options, path=None, **environment):
        self.folder = folder
        self.log = folder / "showcase.log"
        self.state = {
            "XDG_STATE_HOME": str(folder / "state"), "UP_GROUND_STATE": str(folder / "ground"),
        }  # fmt: skip
        with self.log.open("wb") as output:
            self.process = subprocess.Popen(
                [sys.executable, "-m", "up_simulator.demo", "--folder", str(folder),
                 "--any-ports", "--no-watch", "--state-log", str(folder / "truth.csv"), *options],
                stdout=output, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL, cwd=folder,
                env={**os.environ, **self.state, "PATH": path or os.environ["PATH"],
                     **environment},
            )  # fmt: skip
        self.started.append(self)

    @classmethod
    def end_all(cls, since):
        """End those that were started after the first `since`: older ones belong to a module."""
        while len(cls.started) > since:
            showcase = cls.started.pop()
            try:
                showcase.stop(signal.SIGTERM)
            except subprocess.TimeoutExpired:
                showcase.process.kill()
                showcase.process.wait()

    def ready(self):
        until(lambda: "Ctrl-C stops" in self.said() or self.process.poll() is not None, "start")
        assert self.process.poll() is None, self.said()
        return self

    def said(self):
        return self.log.read_text(encoding="utf-8")

    def events(self, part, code):
        """Return the fields of a part's log events with a code."""
        found = fields_of((self.folder / f"{part}.log").read_text(encoding="utf-8"))
        return [fields for fields in found if fields.get("code") == code]

    @property
    def ground_port(self):
        lines = (self.folder / "config" / "proxy.yml").read_text(encoding="utf-8").splitlines()
        return next(line.split()[-1] for line in lines if line.startswith("ground port"))

    def ground(self, *arguments, timeout=DEADLINE_S):
        return subprocess.run(
            [sys.executable, "-m", "up_ground.main", "--port", self.ground_port, *arguments],
            capture_output=True, text=True, timeout=timeout,
            env={**os.environ, **self.state}, check=False,
        )  # fmt: skip

    def telemetry(self, count):
        result = self.ground("watch", "--json", "--count", str(count))
        assert result.returncode == 0, result.stderr
        messages = [json.loads(line) for line in result.stdout.splitlines()]
        return [message["data"] for message in messages]

    def gains(self):
        asked = self.ground("send", "arduino.pids.tunings", "request=true").stdout
        return json.loads(asked.split("arduino.pids.values ", 1)[1].splitlines()[0])

    @property
    def page(self):
        """Where a browser finds the ground station."""
        return re.search(r"  page       (http://127\.0\.0\.1:\d+/)  ", self.said())[1]

    def truth(self):
        """Return the rows that are whole: the last one may be half written."""
        written, _, _ = (self.folder / "truth.csv").read_text("utf-8").rpartition("\n")
        return list(csv.DictReader(written.splitlines()))

    def daemon_pid(self):
        return child_with(self.process.pid, "main.py")

    def stop(self, number=signal.SIGINT):
        if self.process.poll() is None:
            self.process.send_signal(number)
        return self.process.wait(20)


def child_with(pid, word):
    children = Path(f"/proc/{pid}/task/{pid}/children").read_text(encoding="ascii").split()
    for child in children:
        command = Path(f"/proc/{child}/cmdline").read_bytes().decode()
        if word in command:
            return int(child)
    raise AssertionError(f"no child {word}")


def steepest(frames):
    attitudes = [frame["orientation"] for frame in frames]
    return max(max(abs(each["roll"]), abs(each["pitch"])) for each in attitudes)
