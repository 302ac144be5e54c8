"""The parts of ``make run``: started in order, watched, ended together."""

from __future__ import annotations

import argparse
import select
import sys
import termios
import time
from contextlib import suppress
from pathlib import Path
from typing import Any

from up_ground.token_store import STATE_VARIABLE
from up_simulator.aircraft import load_airframe
from up_simulator.demo.config import FLIGHTS, write_config
from up_simulator.demo.hints import hints, log_hints, recordings
from up_simulator.demo.keys import pair_ground, unpair_ground
from up_simulator.demo.page import Page
from up_simulator.harness.child import Child
from up_simulator.harness.participants import ParticipantError
from up_simulator.harness.ports import Ports, choose_ports
from up_simulator.harness.user_log import Log, LogLine

START_LIMIT_S = 60.0
BUILD_LIMIT_S = 900.0
READING_TIME_S = 8
POLL_PERIOD_S = 0.1
UNPRINTED = ("board_ready", "board_mode", "late")
"""Codes of the aircraft's start that are not printed."""
NEWS = ("crashed", "landed", "relaunched", "battery_changed", "phone_lost", "late")
"""Codes of the aircraft's lines that are printed immediately in flight."""
RESTORE_SCREEN = "\x1b[0m\x1b[?25h\x1b[?1049l"
"""Leaves the alternate screen and shows the cursor, for a screen that could not do so itself."""

DESCRIPTIONS = {
    "arduino": "The Arduino holds the attitude (FBW); a pilot's sticks circle around the launch.",
    "raspberry": "Raspilot's controller on the Raspberry Pi holds the attitude (OUTPUT); a pilot's"
    " sticks circle around the launch.",
}


class DemoFlight:
    """One run: ``start`` prints the components, ``watch`` watches them, ``stop`` ends all of them.

    Raises ``AirframeError``, ``UserError`` for faulty files of keys, and ``ParticipantError`` with
    the last log lines of a part that failed.
    """

    def __init__(self, options: argparse.Namespace, folder: Path, root: Path, log: Log) -> None:
        self._options = options
        self._folder = folder
        self._state = folder / "ground"
        self._root = root
        self._log = log
        self._children: list[Child] = []
        self._daemon: Child | None = None
        self._page: Page | None = None
        self._pending_lines: list[str] = []
        self._airframe = load_airframe(options.airframe)
        self._earlier = recordings(folder / FLIGHTS)
        self._ports = Ports()

    def start(self) -> None:
        log, options, folder = self._log, self._options, self._folder
        log("Raspilot's virtual aircraft: the real firmware, daemon, proxy and ground station,")
        log(f"all on this machine. Configuration and logs: {folder}")
        self._ports = ports = choose_ports(options.any_ports)
        self._write_config()
        keys = self._pair()
        aircraft = self._start_aircraft()
        proxy = self._add("proxy", "-m", "up_proxy.main", "--config", folder / "config")
        proxy.wait_for("port_open", START_LIMIT_S, side="ground")
        log(f"  proxy      aircraft on port {ports.airborne}, ground on port {ports.ground}")
        log(f"  keys       {keys}")
        if options.link:
            log(f"  link       from the aircraft to the proxy: {options.link}")
        if not options.no_page:
            # The parts that fly do not wait for it.
            self._page = Page(folder, ports, self._state, options.page)
            self._children.append(self._page.child)
        aircraft.wait_for("board_selected", BUILD_LIMIT_S, on_line=self._log_part)
        daemon = self._daemon = self._start_daemon()
        aircraft.wait_for("board_ready", START_LIMIT_S)
        daemon.wait_for("started", START_LIMIT_S)
        log(f"  raspilot   the daemon; the phone on ports {ports.general}, {ports.orientation}")
        if options.mavlink:
            log("  mavlink    QGroundControl on this machine connects by itself (UDP 14550);")
            log(f"             others: TCP 127.0.0.1:{ports.mavlink}, ArduPilot, may arm")
        if options.controller == "raspberry":
            daemon.wait_for("control_changed", START_LIMIT_S, flies=True)
        else:
            daemon.wait_for("source_selected", START_LIMIT_S, reading="orientation")
        address = None if self._page is None else self._show_page(self._page)
        log(f"It flies. {DESCRIPTIONS[options.controller]}")
        for line in hints(ports, folder, self._state, address):
            log(line)

    def watch(self) -> None:
        options = self._options
        end_s = None if options.seconds is None else time.monotonic() + options.seconds
        screen: Child | None = None
        wants_screen = not options.no_watch
        terminal = _terminal_settings()
        if wants_screen and sys.stdin.isatty():
            self._log(
                f"The {self._screen} opens in {READING_TIME_S} s, or with Enter; q closes it."
            )
            if select.select([sys.stdin], [], [], READING_TIME_S)[0]:
                sys.stdin.readline()
        while end_s is None or time.monotonic() < end_s:
            if wants_screen and screen is None:
                screen = self._open_screen()
            for child in list(self._children):
                status = child.poll()
                if status is not None and child is screen:
                    self._children.remove(child)
                    screen, wants_screen = None, False
                    self._on_screen_end(status, terminal)
                elif status is not None and self._page is not None and child is self._page.child:
                    self._on_page_end(self._page)
                elif status is not None and status < 0 and child is self._daemon:
                    self._children.remove(child)
                    self._pending_lines.append(
                        f"{child.name} ended with signal {-status}. It is started again."
                    )
                    self._daemon = self._start_daemon(resumes=True)
                elif status is not None:
                    raise ParticipantError(child.exit_report(status))
            if screen is None:
                while self._pending_lines:
                    self._log(self._pending_lines.pop(0))
                self._log_news(self._children[0])
                wants_screen = _enter_was_pressed()
            time.sleep(POLL_PERIOD_S)

    def stop(self) -> None:
        for child in reversed(self._children):
            child.terminate()
        for child in reversed(self._children):
            child.wait()
        # A killed aircraft leaves a link to a pty that another program may get.
        (self._folder / "board").unlink(missing_ok=True)
        if self._children:
            self._log("Everything is stopped.")
            for line in log_hints(self._folder / FLIGHTS, self._earlier):
                self._log(line)
        self._children.clear()

    def _show_page(self, page: Page) -> str | None:
        """Print the address of the ground station for a browser; the flight runs without it."""
        address = page.wait_for_address()
        if address is not None:
            self._log(f"  page       {address}  the ground station in a browser")
            for note in page.notes:
                self._log(f"             {note}")
        else:
            page.child.terminate()
            self._children.remove(page.child)
            self._log(f"  page       no ground station for a browser: {page.reason}")
        return address

    def _on_page_end(self, page: Page) -> None:
        self._children.remove(page.child)
        # The screen on this terminal would erase the line.
        self._pending_lines.append(
            f"The ground station for a browser has ended: {page.reason}."
            f" The flight continues; this starts it again: {page.command}"
        )

    def _log_part(self, line: LogLine) -> None:
        if line.code not in UNPRINTED and not line.code.startswith("phone"):
            self._log(f"  aircraft   {line.text}")

    def _write_config(self) -> None:
        folder = self._folder
        write_config(
            folder / "config",
            folder / "board",
            self._ports,
            controller=self._options.controller,
            airframe=self._airframe,
            uplink_port=self._ports.uplink if self._options.link else 0,
            is_plain=self._options.plain,
            has_mavlink=self._options.mavlink,
        )

    def _pair(self) -> str:
        """Give the ground station its key, or none; return how the link is protected."""
        if self._options.plain:
            unpair_ground(self._state)
            return "none (--plain): everyone who reaches the proxy may command the aircraft"
        key = pair_ground(self._folder / "config", self._state)
        return (
            f"the link is protected end to end; this ground station's key: {key.name} ({key.role})."
            "\n             No TLS: all parts are on this machine. ARGS=--plain flies without keys"
        )

    def _start_daemon(self, *, resumes: bool = False) -> Child:
        return self._add(
            "raspilot", self._root / "main.py", "--config", self._folder / "config", resumes=resumes
        )

    def _start_aircraft(self) -> Child:
        options, ports, folder = self._options, self._ports, self._folder
        radio = options.radio if options.radio.startswith(("js", "/")) else "circle"
        words: list[str | Path] = [
            "-m", "up_simulator", "start",
            "--airframe", options.airframe, "--model", options.model, "--wind", options.wind,
            "--turbulence", options.turbulence, "--board", options.board, "--radio", radio,
            "--radio-socket", folder / "radio", "--gains", folder / "config" / "pids.yml",
            "--pty-link", folder / "board", "--general-port", str(ports.general),
            "--orientation-port", str(ports.orientation), "--truth",
        ]  # fmt: skip
        if options.link:
            words += ["--link", options.link, "--link-port", str(ports.uplink)]
            words += ["--link-to", f"127.0.0.1:{ports.airborne}"]
        if options.state_log:
            words += ["--state-log", options.state_log]
        return self._add("aircraft", *words)

    def _add(self, name: str, *words: str | Path, resumes: bool = False) -> Child:
        if not resumes:
            (self._folder / f"{name}.log").unlink(missing_ok=True)
        child = Child(name, [sys.executable, *map(str, words)], self._folder)
        self._children.append(child)
        return child

    @property
    def _screen(self) -> str:
        return "keyboard radio" if self._options.radio == "keyboard" else "ground station"

    def _open_screen(self) -> Child:
        port = str(self._ports.ground)
        words = ["-m", "up_ground.main", "watch", "--port", port]
        if self._options.radio == "keyboard":
            words = ["-m", "up_simulator", "radio", "keyboard", "--socket"]
            words.append(str(self._folder / "radio"))
        child = Child(
            "ground",
            [sys.executable, *words],
            self._folder,
            in_foreground=True,
            environment={STATE_VARIABLE: str(self._state)},
        )
        self._children.append(child)
        return child

    def _on_screen_end(self, status: int, terminal: Any) -> None:
        """Restore the terminal if the screen did not, and report that all else continues."""
        why = ""
        if status:
            if status < 0:
                _restore_terminal(terminal)
            how = f"signal {-status}" if status < 0 else f"status {status}"
            why = f"The {self._screen} ended unexpectedly with {how}. "
        self._log(f"{why}The flight continues. Enter: the {self._screen} again; Ctrl-C: stop all.")

    def _log_news(self, aircraft: Child) -> None:
        for line in aircraft.new_lines():
            if line.code in NEWS:
                self._log(f"aircraft: {line.text}")


def _enter_was_pressed() -> bool:
    if not sys.stdin.isatty() or not select.select([sys.stdin], [], [], 0)[0]:
        return False
    return bool(sys.stdin.readline())


def _terminal_settings() -> Any:
    try:
        return termios.tcgetattr(sys.stdin)
    except (OSError, ValueError, termios.error):
        return None


def _restore_terminal(settings: Any) -> None:
    if settings is None or not sys.stdout.isatty():
        return
    sys.stdout.write(RESTORE_SCREEN)
    sys.stdout.flush()
    with suppress(termios.error):
        # Keys typed for the screen are not for us.
        termios.tcsetattr(sys.stdin, termios.TCSAFLUSH, settings)
