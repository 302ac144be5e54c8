"""A real runner in its own process, and ways to talk to it and to its instances."""

import contextlib
import itertools
import json
import os
import shutil
import signal
import socket
import subprocess
import sys
import threading
from pathlib import Path

import yaml

from tests.support.waiting import DEADLINE_S as LIMIT_S
from tests.support.waiting import until as wait_until

APPLICATION = Path(__file__).parents[1] / "fixtures" / "runner" / "application.py"
_NUMBERS = itertools.count(2)


def same_instance(answer, first):
    """Return whether an answer is that of the running instance, which it did not start."""
    return answer == first | {"spawned": False, "message": answer["message"]}


def is_alive(pid):
    try:
        text = Path(f"/proc/{pid}/stat").read_text()
    except OSError:
        return False
    return text[text.rindex(")") + 2] not in "ZX"


def can_connect(port):
    try:
        socket.create_connection(("127.0.0.1", port), 5).close()
    except OSError:
        return False
    return True


class Talk:
    """One connection that speaks lines."""

    def __init__(self, port, source="", host="127.0.0.1"):
        self.socket = socket.create_connection((host, port), LIMIT_S, source_address=(source, 0))
        self.lines = self.socket.makefile("rb")

    def say(self, line):
        data = line if isinstance(line, bytes) else json.dumps(line).encode() + b"\n"
        self.socket.sendall(data)

    def hear(self):
        line = self.lines.readline()
        assert line.endswith(b"\n"), f"the connection ended: {line!r}"
        return json.loads(line)

    def ask(self, line):
        self.say(line)
        return self.hear()

    def order(self, text):
        """Make the fixture application do something and return its answer."""
        self.socket.sendall(text.encode() + b"\n")
        return self.lines.readline().decode().strip()

    def ended(self):
        """Wait for the other side to end the connection; what still comes is thrown away."""
        with contextlib.suppress(ConnectionResetError):
            while self.socket.recv(65536):
                pass
        return True

    def close(self):
        self.lines.close()
        self.socket.close()


class RunnerProcess:
    """`up-runner` with its own configuration; everything it started ends with `clean`."""

    def __init__(self, folder, **config):
        self.folder = folder
        self.config_folder = folder / "config"
        self.run_folder = folder / "run"
        self.logs_folder = folder / "logs"
        (self.config_folder / "blackbox").mkdir(parents=True)
        self.settings = {
            "port": 0,
            "script path": str(APPLICATION),
            "i_accept_root": True,
            "run folder": str(self.run_folder),
            "logs folder": str(self.logs_folder),
            **config,
        }
        self.environ = {}
        self.prefix = []
        self.process = None
        self.host, self.port = "127.0.0.1", None
        self._since = 0
        self.name = "glider-1"
        """The aircraft of requests that name none."""
        self._talks = []

    def write(self, name, settings):
        """Write a file below the configuration folder."""
        path = self.config_folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(yaml.safe_dump(settings))

    def close_gate(self):
        """Let every instance wait, before it binds its ports, for the file that is returned."""
        gate = self.folder / "gate"
        gate.unlink(missing_ok=True)
        self.write("blackbox/behaviour.yml", {"waits for": str(gate)})
        return gate

    def launch(self, *options, under_systemd=True):
        """Start the program and return immediately."""
        self.write("runner.yml", self.settings)
        environ = {
            name: value
            for name, value in os.environ.items()
            if name not in ("NOTIFY_SOCKET", "INVOCATION_ID", "UPSTART_JOB", "WATCHDOG_USEC")
        }
        environ["UP_LOG_FORMAT"] = "json"
        if under_systemd:
            environ["INVOCATION_ID"] = "0" * 32
        self.process = subprocess.Popen(
            [
                *self.prefix,
                *(sys.executable, "-m", "up_runner.main"),
                *("--config", str(self.config_folder)),
                *options,
            ],
            env=environ | self.environ,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            text=True,
        )
        self.printed = ""
        self._since = 0
        self._reader = threading.Thread(target=self._read, args=(self.process.stderr,), daemon=True)
        self._reader.start()
        return self

    def start(self, *options, under_systemd=True):
        """Start the program and wait until it listens."""
        self.launch(*options, under_systemd=under_systemd)
        self.port = self.logs("port_open")["port"]
        return self

    def _read(self, stream):
        # A full pipe would block the program.
        for line in stream:
            self.printed += line

    def events(self):
        """Return the fields of each log line since the start, or since `reset`."""
        lines = self.printed.splitlines(keepends=True)
        parsed = [json.loads(line) for line in lines if line[0] == "{" and line[-1] == "\n"]
        return [line.get("fields", {}) for line in parsed][self._since :]

    def logs(self, code, **fields):
        """Wait until the program has logged a line with this code and these fields; return all."""
        wanted = {"code": code, **fields}.items()
        find = lambda: next((each for each in self.events() if wanted <= each.items()), None)  # noqa: E731
        return wait_until(find, lambda: f"the runner logs {code}: {self.printed}")

    def talk(self, port=None, source="127.0.0.1"):
        talk = Talk(port or self.port, source)
        self._talks.append(talk)
        return talk

    def ask(self, **request):
        """Send a request on its own connection."""
        talk = Talk(self.port, host=self.host)
        try:
            return talk.ask({"aircraft": self.name, **request})
        finally:
            talk.close()

    def spawn(self, aircraft=None, **request):
        """Ask for an instance that must come to run."""
        response = self.ask(aircraft=aircraft or self.name, **request)
        assert response["running"], response
        return response

    def status(self, aircraft=None):
        return self.ask(aircraft=aircraft or self.name, action="status")

    def kill(self):
        """End the runner as a crash would."""
        self.process.kill()
        self._finish()

    def terminate(self):
        """Stop the runner as a service manager would; return the exit status."""
        self.process.terminate()
        return self._finish()

    def wait(self):
        """Wait until a runner exits; return the exit status."""
        return self._finish()

    def _finish(self):
        status = self.process.wait(LIMIT_S)
        self._reader.join(LIMIT_S)
        self.process.stderr.close()
        self.process = None
        return status

    def log(self):
        return (self.logs_folder / f"{self.name}.log").read_text()

    def config(self, file):
        """Return a file of the instance's configuration."""
        return yaml.safe_load((self.run_folder / self.name / "config" / file).read_text())

    def instances(self):
        """Return the processes that carry this run folder in their environment."""
        wanted = f"NOTIFY_SOCKET={self.run_folder}/".encode()
        found = []
        for entry in Path("/proc").iterdir():
            if entry.name.isdigit():
                with contextlib.suppress(OSError):
                    environ = (entry / "environ").read_bytes().split(b"\0")
                    if any(word.startswith(wanted) for word in environ):
                        found.append(int(entry.name))
        return [pid for pid in found if is_alive(pid)]

    def reset(self):
        """End all instances and remove their base configuration; the next ones have new names."""
        for talk in self._talks:
            talk.close()
        del self._talks[:]
        for pid in self.instances():
            os.kill(pid, signal.SIGTERM)
        wait_until(lambda: not self.instances(), "all instances ended")
        for folder in ("blackbox", "profiles"):
            shutil.rmtree(self.config_folder / folder, ignore_errors=True)
        self._since += len(self.events())
        self.name = f"glider-{next(_NUMBERS)}"

    def clean(self):
        for talk in self._talks:
            talk.close()
        if self.process is not None:
            self.kill()
        for pid in self.instances():
            with contextlib.suppress(ProcessLookupError):
                os.kill(pid, signal.SIGKILL)
        wait_until(lambda: not self.instances(), "all instances ended")
