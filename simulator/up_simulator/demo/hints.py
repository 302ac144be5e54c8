"""The commands that ``make run`` suggests for another terminal."""

from __future__ import annotations

import os
import shlex
import sys
from pathlib import Path

from up_ground.token_store import STATE_VARIABLE
from up_simulator.harness.ports import Ports

LAST_HINT = "Ctrl-C stops everything."
"""The last line of the start-up."""


def hints(ports: Ports, folder: Path, state: Path, page: str | None) -> list[str]:
    """Return the suggestions; ``page`` is the address of the ground station for a browser.

    ``state`` is the folder with the ground station's key.
    """
    ground, sim = program("up-ground"), program("up-sim")
    port = "" if ports.ground == 3004 else f" --port {ports.ground}"
    socket = "" if folder == Path.cwd() / "run/demo" else f" --socket {folder / 'radio'}"
    in_browser = [
        f"Open {page} in a browser: the flight, live. 'Request control' there,",
        "then choose modes and change gains in flight, which this aircraft allows.",
    ]
    return [
        *(in_browser if page is not None else []),
        "Try, in another terminal:",
        f"  export {state_setting(state)}     the key of this run",
        f"  {ground} watch{port}",
        f"  {ground} send{port} up.telemetry.frequency frequency=200",
        f"  {ground} send{port} arduino.pids.tunings request=true   the gains; see the guide",
        f"  {ground} send{port} up.flight_mode.set mode=RATE        and mode=FBW",
        f"  {ground} send{port} up.flight_mode.set mode=RETURN      flies home; mode=AUTO ends it",
        f"  {ground} mission --help          missions: draw one in the page, or upload a file",
        f"  {ground} send{port} android.speak text=hello",
        f"  {sim} radio{socket}          the sticks on your keyboard; q releases them",
        f"  {sim} fly save       a scenario: the pilot takes over",
        LAST_HINT,
    ]


def state_setting(state: Path) -> str:
    """Return the shell's assignment that lets up-ground use the keys in a folder."""
    here = os.path.relpath(state) if state.is_relative_to(Path.cwd()) else str(state)
    return f"{STATE_VARIABLE}={shlex.quote(here)}"


def recordings(flights: Path) -> set[Path]:
    """Return the files of all flights that the black box recorded in a folder."""
    return set(flights.glob("*.mcap"))


def log_hints(flights: Path, earlier: set[Path]) -> list[str]:
    """Return the commands that read the newest recording, unless all are ``earlier`` ones."""
    if recordings(flights) <= earlier:
        return ["It ended before the black box recorded anything: this flight has no log."]
    folder = os.path.relpath(flights) if flights.is_relative_to(Path.cwd()) else str(flights)
    last = f"last --folder {shlex.quote(folder)}"
    return [
        f"The flight's log: {program('up')} log report {last}",
        f"The same again in a browser: {program('up-ground')} replay {last}",
    ]


def program(name: str) -> str:
    """Return the shell command of a program of the project."""
    return os.path.relpath(Path(sys.executable).parent / name)
