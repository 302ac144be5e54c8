"""The program `up-fleet` as an operator starts it."""

import json
import subprocess
import sys
from pathlib import Path

from tests.support.waiting import HANG_S

UP_FLEET = Path(sys.executable).with_name("up-fleet")


class UpFleet:
    """Runs `up-fleet` with a `fleet.yml`; `text` has its keys besides the servers."""

    def __init__(self, folder, urls, text=""):
        self.folder = folder
        folder.mkdir(exist_ok=True)
        (folder / "fleet.yml").write_text(f"servers: {urls}\n{text}")

    def run(self, *words):
        command = [UP_FLEET, "--config", self.folder, *words]
        return subprocess.run(command, capture_output=True, text=True, timeout=HANG_S, check=False)

    def ask(self, *words):
        """Return the answer of a verb that must succeed."""
        done = self.run(*words, "--json")
        assert done.returncode == 0, done.stderr
        return json.loads(done.stdout)

    def refused(self, *words):
        """Return the exit status and the code of a verb that must fail."""
        command = [UP_FLEET, "--config", self.folder, *words]
        environ = {"UP_LOG_FORMAT": "json", "PATH": "/usr/bin:/bin"}
        done = subprocess.run(command, capture_output=True, text=True, timeout=HANG_S, env=environ)
        lines = [json.loads(line) for line in done.stderr.splitlines()]
        return done.returncode, [each["fields"]["code"] for each in lines]

    def member(self, kind, host=None):
        """Return the row of a member."""
        rows = self.ask("list")["members"]
        return next(r for r in rows if r["kind"] == kind and host in (None, r["host"]))
