"""``make run``: the whole system on one machine, in the air, stabilised, until Ctrl-C.

Starts the proxy, the virtual aircraft with its phone, Raspilot and a ground station, each as the
process that a user would start, with configuration written into a folder of its own.
"""

from __future__ import annotations

import argparse
import contextlib
import fcntl
import os
import select
import signal
import sys
import time
from collections.abc import Sequence
from pathlib import Path

from up_simulator.children import Child, ChildFailedError
from up_simulator.showcase_config import Ports, choose_ports, write_config

ROOT = Path(__file__).resolve().parents[2]
START_LIMIT_S = 30.0
READING_S = 5


class Stopped(Exception):  # noqa: N818 - a signal is no error
    """A signal asks for the end."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run everything; return 0 after Ctrl-C, 1 when a part failed."""
    options = _options(arguments)
    folder = (options.folder or ROOT / "run" / "showcase").resolve()
    if not (ROOT / "main.py").is_file():
        print("the showcase runs from a clone of the project: make run", file=sys.stderr)  # noqa: T201
        return 2
    folder.mkdir(parents=True, exist_ok=True)
    lock = (folder / "lock").open("w")
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        lock.close()
        print(f"another showcase runs in {folder}: stop it, or use --folder", file=sys.stderr)  # noqa: T201
        return 1
    for number in (signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, _raise_stopped)
    children: list[Child] = []
    last_words = ""
    try:
        _start_all(options, folder, children)
        _stay(options, children)
    except (KeyboardInterrupt, Stopped):
        pass
    except ChildFailedError as error:
        last_words = str(error)
    finally:
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            signal.signal(number, signal.SIG_IGN)
        _stop_all(children)
        # A simulator that was killed leaves a link to a pty that will be another program's.
        (folder / "board").unlink(missing_ok=True)
    if last_words:
        # Only now: the picture of the ground station would have wiped it away.
        _say(f"\n{last_words}")
    return 1 if last_words else 0


def _options(arguments: Sequence[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="make run",
        description="Flies the virtual aircraft with the real daemon, proxy and ground station.",
    )
    parser.add_argument("--folder", type=Path, help="for configuration and logs (run/showcase)")
    parser.add_argument("--seconds", type=float, help="end after so long; default: Ctrl-C")
    parser.add_argument("--no-watch", action="store_true", help="do not show the telemetry")
    parser.add_argument("--replay", type=Path, help="fly a recorded flight, not the model")
    parser.add_argument("--any-ports", action="store_true", help="do not try the usual ports")
    return parser.parse_args(arguments)


def _start_all(options: argparse.Namespace, folder: Path, children: list[Child]) -> None:
    ports = choose_ports(options.any_ports)
    config = folder / "config"
    write_config(config, folder / "board", ports)
    python = sys.executable
    _say("Raspilot's virtual aircraft: the real daemon, proxy and ground station on this machine;")
    _say("stand-ins for Arduino and phone around a flight model (JSBSim), with wind.")
    _say(f"configuration and logs: {folder}")
    children.append(
        Child("proxy", [python, "-m", "up_proxy.main", "--config", str(config)], folder)
    )
    _say(f"  proxy          aircraft on port {ports.airborne}, ground on port {ports.ground}")
    simulator = [python, "-m", "up_simulator", "--pty-link", str(folder / "board"),
                 "--general-port", str(ports.general), "--orientation-port", str(ports.orientation),
                 "--state-log", str(folder / "truth.csv")]  # fmt: skip
    if options.replay:
        simulator += ["--replay", str(options.replay)]
    aircraft = Child("aircraft", simulator, folder)
    children.append(aircraft)
    aircraft.wait_for_line("board on", START_LIMIT_S)
    for line in aircraft.lines():
        if "JSBSim" in line:
            _say(f"  {line}")
    _say(f"  aircraft       Arduino stand-in on {folder / 'board'}, phone stand-in")
    daemon = Child("raspilot", [python, str(ROOT / "main.py"), "--config", str(config)], folder)
    children.append(daemon)
    daemon.wait_for_line("modules run", START_LIMIT_S)
    _say(f"  raspilot       phone's ports {ports.general} and {ports.orientation}")
    daemon.wait_for_line("Controller: flies", START_LIMIT_S)
    _say("It flies: the attitude is held by Raspilot's controller on this machine.")
    _hints(ports)


def _hints(ports: Ports) -> None:
    ground = "" if ports.ground == 3004 else f" --port {ports.ground}"
    program = Path(sys.executable).with_name("up-ground")
    shown = os.path.relpath(program)
    _say("Try, in another terminal:")
    _say(f"  {shown} watch{ground}")
    _say(f"  {shown} send{ground} up.telemetry.frequency frequency=50")
    _say(f"  {shown} send{ground} arduino.pids.tunings request=true")
    _say(f"  {shown} send{ground} android.speak text=hello")
    _say(f"  {shown} commands")
    _say("Ctrl-C stops everything.")


def _stay(options: argparse.Namespace, children: list[Child]) -> None:
    end_s = None if options.seconds is None else time.monotonic() + options.seconds
    watch: Child | None = None
    wants_watch = not options.no_watch
    if wants_watch and sys.stdin.isatty():
        _say(f"The ground station opens in {READING_S} s; q leaves it.")
        time.sleep(READING_S)
    while end_s is None or time.monotonic() < end_s:
        if wants_watch and watch is None:
            watch = _open_watch(children[0].folder)
            children.append(watch)
        for child in children:
            status = child.poll()
            if status == 0 and child is watch:
                children.remove(child)
                watch, wants_watch = None, False
                _say("It flies on. Enter: the ground station again; Ctrl-C: stop everything.")
            elif status is not None:
                raise ChildFailedError(child.last_words(status))
        if watch is None and _enter_was_pressed():
            wants_watch = True
        time.sleep(0.1)


def _open_watch(folder: Path) -> Child:
    port = _ground_port(folder / "config")
    command = [sys.executable, "-m", "up_ground.main", "watch", "--port", port]
    return Child.in_foreground("ground", command, folder)


def _enter_was_pressed() -> bool:
    if not sys.stdin.isatty() or not select.select([sys.stdin], [], [], 0)[0]:
        return False
    return bool(sys.stdin.readline())


def _ground_port(config: Path) -> str:
    for line in (config / "proxy.yml").read_text(encoding="utf-8").splitlines():
        if line.startswith("ground port:"):
            return line.split(":")[1].strip()
    raise AssertionError("proxy.yml names no ground port")


def _stop_all(children: list[Child]) -> None:
    for child in reversed(children):
        child.terminate()
    for child in reversed(children):
        child.wait()
    if children:
        _say("Everything is stopped.")


def _raise_stopped(number: int, frame: object) -> None:
    raise Stopped


def _say(text: str) -> None:
    # The terminal may be gone by now.
    with contextlib.suppress(OSError):
        print(text, flush=True)  # noqa: T201


if __name__ == "__main__":
    sys.exit(main())
