"""``make test-dist``: the release in dist/, installed as docs/install.md describes, and tried.

It installs from the package index and flies, so ``make test`` leaves it out.
"""

import json
import os
import signal
import socket
import subprocess
import sys
import urllib.request
from pathlib import Path

import pytest
import yaml

from tests.support.program_output import AS_JSON, fields_of
from tests.support.tools import need_browser
from up.version import VERSION

DIST = Path(__file__).parents[2] / "dist"
PROGRAMS = ("up", "up-sim", "up-ground", "up-proxy", "up-runner", "up-fleet")
LIMIT_S = 900


class Environment:
    """A virtual environment outside the tree, and a working folder."""

    def __init__(self, folder: Path) -> None:
        self.work = folder / "work"
        self.work.mkdir()
        self.bin = folder / "venv" / "bin"
        kept = {k: v for k, v in os.environ.items() if not k.startswith(("UP_", "PYTHON"))}
        self.environ = {
            **kept,
            "XDG_CACHE_HOME": str(folder / "cache"),
            "XDG_STATE_HOME": str(folder / "state"),
        }
        subprocess.run([sys.executable, "-m", "venv", str(folder / "venv")], check=True)
        lock = str(DIST / "constraints.txt")
        self.run("pip", "install", "--quiet", "--no-deps", "--require-hashes", "-r", lock)
        # The simulator's own requirements are not among those of servers.
        self.run("pip", "install", "--quiet", "jsbsim==1.3.3", "matplotlib>=3.8")
        ours = ["--no-index", "--find-links", str(DIST)]
        extras = f"raspilot[cogs,ground,keys,mavlink,metrics,sim,tls]=={VERSION}"
        self.run("pip", "install", "--quiet", *ours, extras, "up-flightlog")
        self.run("pip", "check")

    def run(self, program: str, *words: str, cwd: Path | None = None) -> str:
        done = subprocess.run(
            [self.bin / program, *words], cwd=cwd or self.work, env=self.environ,
            capture_output=True, text=True, timeout=LIMIT_S, check=False,
        )  # fmt: skip
        assert done.returncode == 0, f"{program} {words}:\n{done.stdout}{done.stderr}"
        return done.stdout

    def start(self, program: str, *words: str) -> subprocess.Popen[str]:
        return subprocess.Popen(
            [self.bin / program, *words], cwd=self.work, env=self.environ | AS_JSON,
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
        )  # fmt: skip


@pytest.fixture(scope="module")
def installed(tmp_path_factory):
    environment = Environment(tmp_path_factory.mktemp("release"))
    environment.run("up", "-f", "raspilot", "gather", "--no-install")
    return environment


def until(process, wanted):
    """Return the fields of the first line that the predicate accepts."""
    for line in process.stdout:
        for fields in fields_of(line):
            if wanted(fields):
                return fields
    raise AssertionError(f"it ended with {process.wait()}")


def end(process):
    process.send_signal(signal.SIGTERM)
    process.communicate(timeout=30)
    assert process.returncode == 0


def test_every_program_has_the_version(installed):
    for program in PROGRAMS:
        assert installed.run(program, "--version").split()[-1] == VERSION
    assert installed.run("python", "-m", "raspilot", "--version").split()[-1] == VERSION
    for name in ("up-proxy", "up"):
        assert f"complete -c {name}" in installed.run(name, "--print-completion", "fish")


def test_configuration_and_cogs(installed):
    config = str(installed.bin.parent / "share/raspilot/config")
    installed.run("up", "-f", "raspilot", "check", "--config", config)
    modules = json.loads(
        installed.run("up", "-f", "raspilot", "modules", "--json", "--config", config)
    )["modules"]
    assert {each["origin"] for each in modules} >= {"serial_cog", "arduino_cog", "black_box_cog"}


def test_a_flight_and_its_log(installed):
    installed.run("up-sim", "fly", "arming-refused")
    flight = installed.work / "run/flights/arming-refused"
    assert json.loads((flight / "summary.json").read_text())["held"] is True
    assert "Glider" in installed.run("up", "log", "info", str(flight / "flight.mcap"))


def test_a_new_application(installed):
    installed.run("up", "create", "new", "-n", "my_plane")
    plane = installed.work / "my_plane"
    installed.run("up", "create", "module", "-n", "Altimeter", cwd=plane)
    assert "no mistakes" in installed.run("up", "check", cwd=plane)


def test_the_page_has_map_charts_and_documentation(installed):
    server = installed.start("up-ground", "serve", "--listen", "127.0.0.1:0")
    address = until(server, lambda fields: fields.get("code") == "page_open")["url"].rstrip("/")
    for path in ("/", "/vendor/leaflet/leaflet-src.esm.js", "/vendor/uplot/uPlot.esm.js"):
        with urllib.request.urlopen(f"{address}{path}", timeout=30) as answer:
            assert answer.status == 200 and len(answer.read()) > 1000
    words = [need_browser(), Path(__file__).with_name("docs_page.mjs"), address]
    done = subprocess.run(words, capture_output=True, text=True, timeout=LIMIT_S)
    assert done.returncode == 0, done.stderr
    docs = json.loads(done.stdout)
    end(server)
    # The chosen colours are those of the next page, too.
    assert docs.pop("scheme") == "slate" and docs.pop("found") > 2
    nothing = {"errors": [], "violations": [], "outside": [], "opener": None}
    refused = dict.fromkeys(("cookie", "session", "page", "link"), "refused")
    assert docs == nothing | refused


def test_the_proxy(installed):
    proxy = installed.start("up-proxy", "--defaults", "--airborne-port", "0", "--ground-port", "0")
    port = until(proxy, lambda fields: fields.get("side") == "airborne")["port"]
    with socket.create_connection(("127.0.0.1", int(port)), 30) as aircraft:
        aircraft.sendall(b"UP1 aircraft=kite packed=1\n")
        until(proxy, lambda fields: fields.get("code") == "aircraft_online")
    end(proxy)


def test_the_runner_starts_the_installed_raspilot(installed):
    folder = installed.work / "runner"
    (folder / "blackbox").mkdir(parents=True)
    settings = {"port": 0, "address": "127.0.0.1", "run folder": str(installed.work / "instances"),
                "i_accept_root": True, "stop instances on exit": True, "start limit": 60}  # fmt: skip
    (folder / "runner.yml").write_text(yaml.safe_dump(settings))
    for path in (installed.bin.parent / "share/raspilot/config/blackbox").glob("*.yml"):
        (folder / "blackbox" / path.name).write_text(path.read_text())
    runner = installed.start("up-runner", "--config", str(folder))
    port = until(runner, lambda fields: fields.get("code") == "port_open")["port"]
    with socket.create_connection(("127.0.0.1", int(port)), 90) as client:
        client.sendall(b'{"aircraft": "glider-1"}\n')
        with client.makefile() as lines:
            answer = json.loads(lines.readline())
    assert answer["spawned"] is True and {"general", "orientation"} <= set(answer["ports"])
    end(runner)
