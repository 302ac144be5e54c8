"""SIGTERM, SIGHUP, a closed terminal and a killed parent: every process and file is cleaned up."""

import fcntl
import json
import os
import pty
import signal
import subprocess
import sys
import termios
from contextlib import contextmanager, suppress
from functools import partial
from pathlib import Path

import pytest

from tests.support.firmware import build_firmware
from tests.support.waiting import DEADLINE_S, until

LONG = """\
title: Long
duration_s: 3000
sticks: [{at_s: 0, mode: FBW, arm: true, throttle: 0.5}]
expect: [{name: It flies, signal: truth.height_m, above: 50}]
"""
WITH_DAEMON = LONG.replace("Long", "Real") + "raspilot: {runs: real}\nphone: {}\nground: {}\n"
CATALOGUE = (
    "import pathlib, sys; from up_simulator.verbs import catalogue;"
    " catalogue.SHIPPED = pathlib.Path();"
    " from up_simulator.cli import main; sys.exit(main())"
)
ENDS = (signal.SIGTERM, signal.SIGHUP)


@pytest.fixture(autouse=True)
def in_a_folder(tmp_path, monkeypatch):
    """Everything that is written goes there, temporary files too."""
    build_firmware()
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("TMPDIR", str(tmp_path / "tmp"))
    (tmp_path / "tmp").mkdir()
    return tmp_path


def ours(folder):
    """Return the processes that work in the folder, or on something in it."""
    found = []
    for path in Path("/proc").glob("[0-9]*"):
        with suppress(OSError):
            is_zombie = (path / "stat").read_text().rpartition(")")[2].split()[0] == "Z"
            words = (path / "cmdline").read_bytes().decode("utf-8", "replace")
            is_there = (path / "cwd").readlink() == folder or str(folder) in words
            if is_there and not is_zombie and int(path.name) != os.getpid():
                found.append(int(path.name))
    return found


def words_of(pid):
    with suppress(OSError):
        return Path(f"/proc/{pid}/cmdline").read_bytes().decode().split("\0")
    return []


@contextmanager
def program(folder, *words, code=None, python=False, **options):
    """Run up-sim in its own session; remaining processes are ended."""
    program = [] if python else ["-c", code] if code else ["-m", "up_simulator.cli"]
    command = [sys.executable, *program, *words]
    options = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, **options}
    process = subprocess.Popen(command, start_new_session=True, **options)
    try:
        yield process
    finally:
        for pid in ours(folder):
            with suppress(ProcessLookupError):
                os.kill(pid, signal.SIGKILL)
        process.wait()
        if process.stdout is not None:
            process.stdout.close()


def is_flying(pid):
    """Return whether a flight has its aircraft, at least."""
    with suppress(OSError):
        return "jsbsim" in Path(f"/proc/{pid}/maps").read_text()
    return False


def wait_for_progress(own):
    shown = b""
    while b"x real time" not in shown:
        shown += os.read(own, 1000)


def ignores(pid, number):
    with suppress(OSError):
        status = Path(f"/proc/{pid}/status").read_text()
        return int(status.partition("SigIgn:")[2].split()[0], 16) >> (number - 1) & 1
    return False


def read_until(process, *words):
    output = b""
    while not any(word in output for word in words):
        line = process.stdout.readline()
        assert line, output
        output += line


def flights(folder):
    return [pid for pid in ours(folder) if "fly" in words_of(pid) and is_flying(pid)]


def left(folder):
    return [path.name for path in (folder / "tmp").iterdir()]


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_flight_ends_with_its_report_and_the_signals_status(in_a_folder, number):
    Path("long.yml").write_text(LONG)
    own, other = pty.openpty()
    words = ("fly", "long.yml", "--no-picture")
    with program(in_a_folder, *words, stderr=other) as process:
        os.close(other)
        wait_for_progress(own)
        process.send_signal(number)
        output = process.communicate(timeout=DEADLINE_S)[0].decode()
        os.close(own)
    assert process.returncode == 128 + number
    assert "Traceback" not in output
    folder = in_a_folder / "run/flights/long"
    summary = json.loads((folder / "summary.json").read_text())
    assert summary["interrupted"] and summary["expectations"][-1]["code"] == "cut_short"
    assert (folder / "log.csv").is_file()


@pytest.mark.parametrize("number", [signal.SIGHUP])
def test_real_programs_and_their_folder_end_with_the_flight(in_a_folder, number):
    Path("real.yml").write_text(WITH_DAEMON)
    with program(in_a_folder, "fly", "real.yml", "--no-picture") as process:
        until(lambda: len(ours(in_a_folder)) == 2 and left(in_a_folder), "the daemon")
        process.send_signal(number)
        # The terminal's end is reported twice: by the kernel and by the shell.
        process.send_signal(number)
        output = process.communicate(timeout=DEADLINE_S)[0].decode()
        assert ours(in_a_folder) == []
    assert process.returncode == 128 + number, output
    assert "Traceback" not in output
    assert left(in_a_folder) == []


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGKILL])
def test_all_ends_its_flights(in_a_folder, number):
    Path("one.yml").write_text(LONG)
    Path("two.yml").write_text(LONG)
    with program(in_a_folder, "all", code=CATALOGUE) as process:
        until(lambda: len(flights(in_a_folder)) == 2, "two flights")
        process.send_signal(number)
        process.wait(DEADLINE_S)
        until(lambda: not ours(in_a_folder), "the end of the flights")
    assert process.returncode == (-number if number == signal.SIGKILL else 128 + number)


def on_its_terminal(other):
    def take_terminal():
        fcntl.ioctl(other, termios.TIOCSCTTY, 0)

    return {"stdin": other, "stdout": other, "stderr": other, "preexec_fn": take_terminal}


def test_a_closed_terminal_ends_a_flight_with_its_report_in_the_file(in_a_folder):
    Path("one.yml").write_text(LONG)
    own, other = pty.openpty()
    words = ("fly", "one.yml", "--no-picture")
    with program(in_a_folder, *words, **on_its_terminal(other)) as process:
        os.close(other)
        wait_for_progress(own)
        os.close(own)
        assert process.wait(DEADLINE_S) == 128 + signal.SIGHUP
    assert "interrupted" in (in_a_folder / "run/flights/one/report.txt").read_text()


def test_a_frozen_daemon_ends_with_a_killed_flight(in_a_folder):
    Path("real.yml").write_text(WITH_DAEMON + "events: [{at_s: 0, raspilot: hung}]\n")

    def is_frozen(pid):
        try:
            stat = Path(f"/proc/{pid}/stat").read_text()
        except (FileNotFoundError, ProcessLookupError):
            return False
        return stat.rpartition(")")[2].split()[0] == "T"

    with program(in_a_folder, "fly", "real.yml", "--no-picture") as process:
        until(lambda: any(map(is_frozen, ours(in_a_folder))), "the frozen daemon")
        process.kill()
        until(lambda: not ours(in_a_folder), "its end")


def test_the_folder_of_a_killed_flight_is_removed_by_the_next(in_a_folder):
    Path("real.yml").write_text(WITH_DAEMON)
    Path("short.yml").write_text(WITH_DAEMON.replace("3000", "0.1").replace("real", "in process"))
    with program(in_a_folder, "fly", "real.yml", "--no-picture") as process:
        until(lambda: len(ours(in_a_folder)) == 2, "the daemon")
        process.kill()
        until(lambda: not ours(in_a_folder), "the end of the daemon")
        other = in_a_folder / "tmp" / "up-sim-of-another-user"
        other.mkdir()
        with program(in_a_folder, "fly", "short.yml", "--no-picture") as following:
            following.communicate(timeout=DEADLINE_S)
    assert left(in_a_folder) == [other.name]


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGKILL])
def test_tuning_ends_its_workers(in_a_folder, number):
    with program(in_a_folder, "tune", "--quick", "--axis", "roll") as process:
        # Itself, what watches its semaphores, and two workers.
        until(lambda: len(ours(in_a_folder)) == 4, "two workers")
        if number == signal.SIGKILL:
            # A worker whose parent is killed before it has started cannot be kept from complaining.
            interrupts = partial(ignores, number=signal.SIGINT)
            until(lambda: sum(map(interrupts, ours(in_a_folder))) == 3, "their handlers")
        process.send_signal(number)
        output = process.communicate(timeout=DEADLINE_S)[0].decode()
        until(lambda: not ours(in_a_folder), "the end of the workers")
    assert process.returncode == (-number if number == signal.SIGKILL else 128 + number)
    assert "Traceback" not in output
    assert left(in_a_folder) == []


def ignore_hangup():
    signal.signal(signal.SIGHUP, signal.SIG_IGN)


@pytest.mark.parametrize("module", ["up_simulator", "up_simulator.demo"])
def test_an_aircraft_started_with_nohup_ignores_the_hangup(in_a_folder, module):
    own = ["start", "--no-phone", "--board", "host"]
    if module != "up_simulator":
        own = ["--any-ports", "--no-watch", "--folder", str(in_a_folder)]
    words = ("-m", module, *own)
    with program(in_a_folder, *words, python=True, preexec_fn=ignore_hangup) as process:
        read_until(process, b"board on", b"It flies")
        assert ignores(process.pid, signal.SIGHUP)
        process.send_signal(signal.SIGTERM)
        assert process.wait(DEADLINE_S) == 0
        until(lambda: not ours(in_a_folder), "the end of all")
    assert left(in_a_folder) == []


def test_a_killed_demo_leaves_nothing(in_a_folder):
    words = ("--any-ports", "--no-watch", "--folder", str(in_a_folder))
    with program(in_a_folder, "-m", "up_simulator.demo", *words, python=True) as process:
        read_until(process, b"It flies")
        # Itself, aircraft, proxy, daemon and the page.
        assert len(ours(in_a_folder)) == 5
        process.kill()
        process.wait(DEADLINE_S)
        until(lambda: not ours(in_a_folder), "the end of all")
    assert left(in_a_folder) == []
    assert not (in_a_folder / "board").is_symlink() and not (in_a_folder / "radio").exists()


def test_a_flight_started_with_nohup_ignores_the_hangup(in_a_folder):
    Path("long.yml").write_text(LONG.replace("3000", "8"))
    words = ("fly", "long.yml", "--no-picture")
    with program(in_a_folder, *words, preexec_fn=ignore_hangup) as process:
        until(lambda: flights(in_a_folder), "a flight")
        process.send_signal(signal.SIGHUP)
        output = process.communicate(timeout=DEADLINE_S)[0].decode()
    assert process.returncode == 0, output
