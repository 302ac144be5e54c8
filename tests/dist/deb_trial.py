"""``make test-deb``: the Debian packages in dist/ under systemd, as docs/install.md describes.

It needs root and a container of Debian 12, so ``make test`` leaves it out. The tests run in order.
"""

import hashlib
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.dist.container import Container
from tests.support.tools import unavailable
from tests.test_service_units import MAX_EXPOSURE
from up.version import VERSION

ROOT = Path(__file__).parents[2]
DIST = ROOT / "dist"
ARCH = subprocess.run(
    ["dpkg", "--print-architecture"], capture_output=True, text=True
).stdout.strip()
COMMON = "raspilot-common"
SERVICES = ("up-proxy", "up-runner", "up-ground", "raspilot")
PACKAGES = (COMMON, *SERVICES)
PORTS = {"up-proxy": 3003, "up-runner": 3002, "up-ground": 8080, "raspilot": 50001}
HANG_SEEN_S, BACK_S = 5.0, 3.0
"""Of docs/failure-modes.md: a hang is detected, a killed program runs again."""
BUSY_FACTOR = 5
"""A machine under load takes longer by this at most."""
REQUEST = """
import json, socket
with socket.create_connection(("127.0.0.1", 3002), 60) as line:
    line.sendall(b'{"aircraft": "glider-1"}\\n')
    print(json.loads(line.makefile().readline())["pid"])
"""


def file_of(package, revision=1):
    arch = ARCH if package == COMMON else "all"
    return f"{package}_{VERSION}-{revision}_{arch}.deb"


def digest(path):
    return hashlib.sha256(path.read_bytes()).hexdigest()


@pytest.fixture(scope="module")
def container(tmp_path_factory):
    if os.geteuid() != 0:
        unavailable("make test-deb needs root")
    machine = Container(tmp_path_factory.mktemp("deb"))
    try:
        machine.boot()
        for package in PACKAGES:
            shutil.copy(DIST / file_of(package), machine.root / "var/tmp")
        machine.before = machine.files()
        yield machine
    finally:
        machine.stop()


def install(machine, revision, *options):
    files = [f"/var/tmp/{file_of(each, revision)}" for each in PACKAGES]
    machine.output("apt-get", "install", "-y", "--no-install-recommends", *options, *files)


def main_pid(machine, unit):
    return int(machine.show(unit, "MainPID"))


def kill(machine, name, unit):
    """Send a signal to the main process; return its number."""
    pid = main_pid(machine, unit)
    assert pid > 0, f"{unit} does not run"
    machine.output("kill", f"-{name}", str(pid))
    return pid


def restarted(machine, unit, before):
    """Return the seconds from the end of a process to the readiness of the next one.

    The first are measured; the second are those of an idle machine: the unit's pause and the
    processor's time, which other load on this machine does not lengthen.
    """
    machine.until(
        lambda: (
            main_pid(machine, unit) not in (0, before)
            and machine.show(unit, "ActiveState") == "active"
        )
    )
    used_s = int(machine.show(unit, "CPUUsageNSec")) / 1e9
    pause_s = float(re.sub("(ms|s)$", "", text := machine.show(unit, "RestartUSec")))
    ready_us = int(machine.show(unit, "ActiveEnterTimestampMonotonic"))
    measured_s = (ready_us - int(machine.show(unit, "InactiveEnterTimestampMonotonic"))) / 1e6
    return measured_s, used_s + (pause_s / 1000 if text.endswith("ms") else pause_s)


def check_back(unit, measured_s, idle_s):
    print(f"{unit}: back after {measured_s:.2f} s, on an idle machine {idle_s:.2f} s")
    assert min(measured_s, idle_s) <= BACK_S
    assert measured_s <= BUSY_FACTOR * BACK_S


def answers(machine, port):
    code = f"import socket; socket.create_connection(('127.0.0.1', {port}), 5)"
    machine.output("python3.11", "-c", code)


def test_the_same_bytes_again(tmp_path):
    again = tmp_path / "dist"
    shutil.copytree(DIST, again, ignore=shutil.ignore_patterns("*.deb"))
    subprocess.run([sys.executable, "-m", "tools.deb", "--dist", again], cwd=ROOT, check=True)
    for package in PACKAGES:
        assert digest(again / file_of(package)) == digest(DIST / file_of(package)), package


def test_installed_they_run_and_are_ready(container):
    install(container, 1)
    for unit in SERVICES:
        container.until(lambda unit=unit: container.show(unit, "ActiveState") == "active")
        assert container.show(unit, "Type") == "notify"
        assert container.show(unit, "UnitFileState") == "enabled"
        print(f"{unit}: {container.show(unit, 'StatusText')}")
        answers(container, PORTS[unit])
    owners = container.output("ps", "-eo", "user:20,args")
    assert re.search(r"^raspilot .*-m raspilot", owners, re.MULTILINE)
    assert re.search(r"^up-proxy .*up-proxy", owners, re.MULTILINE)


def test_the_programs_and_their_libraries_are_complete(container):
    for program in ("up", "up-proxy", "up-runner", "up-ground"):
        assert container.output(program, "--version").split()[-1] == VERSION
        assert program in container.output("man", "--warnings", program)
        completion = container.output("bash", "-c", f"{program} --print-completion bash")
        assert completion == container.output(
            "cat", f"/usr/share/bash-completion/completions/{program}"
        )
    linked = container.output(
        "find", "/usr/lib/raspilot", "-name", "*.so*", "-exec", "ldd", "{}", "+"
    )
    assert "not found" not in linked and "libc.so.6" in linked
    container.output("up", "-f", "raspilot", "check", "--config", "/etc/raspilot")
    # Run by root, a program would have compiled the files that have no bytecode of this Python.
    newer = ["-type", "f", "-newer", "/usr/lib/raspilot/pyvenv.cfg"]
    assert container.output("find", "/usr/lib/raspilot", *newer) == ""


def test_the_exposure_is_low(container):
    for path, limit in MAX_EXPOSURE.items():
        shown = container.output("systemd-analyze", "security", "--no-pager", Path(path).name)
        exposure = float(re.search(r"exposure level for \S+: ([\d.]+)", shown)[1])
        print(f"{Path(path).name}: exposure {exposure}")
        assert exposure <= limit


@pytest.mark.parametrize("unit", SERVICES)
def test_a_killed_program_is_back(container, unit):
    before = kill(container, "KILL", unit)
    check_back(unit, *restarted(container, unit, before))
    answers(container, PORTS[unit])


@pytest.mark.parametrize("unit", SERVICES)
def test_a_program_that_hangs_is_seen_and_restarted(container, unit):
    stopped_s = float(Path("/proc/uptime").read_text().split()[0])
    before = kill(container, "STOP", unit)
    times_s = restarted(container, unit, before)
    ended_s = int(container.show(unit, "InactiveEnterTimestampMonotonic")) / 1e6
    print(f"{unit}: hang seen after {ended_s - stopped_s:.2f} s")
    assert "watchdog" in container.output("journalctl", "--unit", unit, "--no-pager")
    assert ended_s - stopped_s <= HANG_SEEN_S + 0.5
    check_back(unit, *times_s)


def test_an_upgrade_keeps_changed_configuration_and_instances_and_restarts(container, tmp_path):
    changed = container.root / "etc/up-proxy/proxy.yml"
    changed.write_text(changed.read_text().replace("aircraft: 1000", "aircraft: 999"))
    runner = container.root / "etc/up-runner/runner.yml"
    runner.write_text(runner.read_text().replace("lost: true", "lost: false"))
    container.output("systemctl", "restart", "up-runner")
    container.output("systemctl", "disable", "--now", "up-ground")
    instance = container.output("python3.11", "-c", REQUEST)
    for package in PACKAGES:
        folder = tmp_path / package
        subprocess.run(["dpkg-deb", "-R", DIST / file_of(package), folder], check=True)
        control = folder / "DEBIAN/control"
        control.write_text(control.read_text().replace(f"{VERSION}-1", f"{VERSION}-2"))
        if package == "up-proxy":
            template = folder / "etc/up-proxy/proxy.yml"
            template.write_text("# New.\n" + template.read_text())
        target = container.root / "var/tmp" / file_of(package, 2)
        subprocess.run(["dpkg-deb", "-Znone", "--build", folder, target], check=True)
    before = {unit: main_pid(container, unit) for unit in SERVICES}
    install(container, 2, "--option=Dpkg::Options::=--force-confold")
    for unit in ("up-proxy", "up-runner", "raspilot"):
        container.until(lambda unit=unit: container.show(unit, "ActiveState") == "active")
        assert main_pid(container, unit) not in (0, before[unit])
    assert container.show("up-ground", "ActiveState") == "inactive"
    assert container.show("up-ground", "UnitFileState") == "disabled"
    assert "aircraft: 999" in changed.read_text() and "lost: false" in runner.read_text()
    assert container.output("python3.11", "-c", REQUEST) == instance


def test_removed_nothing_runs_and_purged_nothing_is_left(container):
    container.output("apt-get", "remove", "-y", *PACKAGES)
    assert not re.search(
        r"raspilot|up-(proxy|runner|ground)", container.output("ps", "-eo", "args")
    )
    assert (container.root / "etc/up-proxy/proxy.yml").exists()
    container.output("apt-get", "purge", "-y", *PACKAGES)
    assert container.files() - container.before == set()
    users = container.output("getent", "passwd")
    assert not re.search(r"^(raspilot|up-)", users, re.MULTILINE)
