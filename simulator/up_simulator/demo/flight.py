"""The parts of ``make run``: started in order, watched, ended together."""

from __future__ import annotations

import argparse
import select
import sys
import termios
import time
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any

from up_simulator.aircraft import load_airframe
from up_simulator.demo.config import FLIGHTS, write_config
from up_simulator.demo.hints import hints, log_hints
from up_simulator.demo.news import News
from up_simulator.demo.page import Page
from up_simulator.harness.child import Child
from up_simulator.harness.participants import CrewError
from up_simulator.harness.ports import Ports, choose_ports

START_LIMIT_S = 60.0
BUILD_LIMIT_S = 900.0
READING_S = 8
LOOK_S = 0.1
AS_BEFORE = "\x1b[0m\x1b[?25h\x1b[?1049l"
"""Leaves the alternate screen and shows the cursor, for a picture that could not do so itself."""

WHO_HOLDS = {
    "arduino": "The Arduino holds the attitude (FBW); a pilot's sticks circle around the launch.",
    "raspberry": "Raspilot's controller on the Raspberry Pi holds the attitude (OUTPUT); a pilot's"
    " sticks circle around the launch.",
}


class ShowcaseFlight:
    """One run: ``start`` prints the components, ``stay`` watches them, ``stop`` ends all of them.

    ``say`` takes one line for the user. Raises ``AirframeError``, and ``CrewError`` with the last
    log lines of a part that failed.
    """

    def __init__(
        self, options: argparse.Namespace, folder: Path, root: Path, say: Callable[[str], None]
    ) -> None:
        self._options = options
        self._folder = folder
        self._root = root
        self._say = say
        self._children: list[Child] = []
        self._told = 0
        self._page: Page | None = None
        self._untold: list[str] = []
        self._news = News(time.monotonic)
        self._airframe = load_airframe(options.airframe)
        self._ports = Ports()

    def start(self) -> None:
        """Start all components and launch the aircraft."""
        say, options, folder = self._say, self._options, self._folder
        say("Raspilot's virtual aircraft: the real firmware, daemon, proxy and ground station,")
        say(f"all on this machine. Configuration and logs: {folder}")
        self._ports = ports = choose_ports(options.any_ports)
        self._write_config()
        aircraft = self._start_aircraft()
        proxy = self._add("proxy", "-m", "up_proxy.main", "--config", folder / "config")
        proxy.wait_for_line("ground side listens", START_LIMIT_S)
        say(f"  proxy      aircraft on port {ports.airborne}, ground on port {ports.ground}")
        if options.link:
            say(f"  link       from the aircraft to the proxy: {options.link}")
        if not options.no_page:
            # It is not awaited before the parts that fly are up.
            self._page = Page(folder, ports, options.page)
            self._children.append(self._page.child)
        aircraft.wait_for(self._has_board, "board", BUILD_LIMIT_S)
        daemon = self._add("raspilot", self._root / "main.py", "--config", folder / "config")
        aircraft.wait_for_line("board on", START_LIMIT_S)
        daemon.wait_for_line("modules run", START_LIMIT_S)
        say(f"  raspilot   the daemon; the phone on ports {ports.general}, {ports.orientation}")
        ready = (
            "Controller: flies" if options.controller == "raspberry" else "orientation comes from"
        )
        daemon.wait_for_line(ready, START_LIMIT_S)
        address = None if self._page is None else self._show_page(self._page)
        say(f"It flies. {WHO_HOLDS[options.controller]}")
        for line in hints(ports, folder, address):
            say(line)

    def stay(self) -> None:
        """Show the ground station and report events, until the time is over."""
        options = self._options
        end_s = None if options.seconds is None else time.monotonic() + options.seconds
        watch: Child | None = None
        wants_watch = not options.no_watch
        terminal = _terminal_settings()
        if wants_watch and sys.stdin.isatty():
            self._say(f"The {self._picture} opens in {READING_S} s, or with Enter; q leaves it.")
            if select.select([sys.stdin], [], [], READING_S)[0]:
                sys.stdin.readline()
        while end_s is None or time.monotonic() < end_s:
            if wants_watch and watch is None:
                watch = self._open_watch()
            for child in list(self._children):
                status = child.poll()
                if status is not None and child is watch:
                    self._children.remove(child)
                    watch, wants_watch = None, False
                    self._leave_watch(status, terminal)
                elif status is not None and self._page is not None and child is self._page.child:
                    self._leave_page(self._page)
                elif status is not None:
                    raise CrewError(child.last_words(status))
            if watch is None:
                while self._untold:
                    self._say(self._untold.pop(0))
                self._tell_news(self._children[0])
                wants_watch = _enter_was_pressed()
            time.sleep(LOOK_S)

    def stop(self) -> None:
        """End every part, the newest first."""
        for child in reversed(self._children):
            child.terminate()
        for child in reversed(self._children):
            child.wait()
        # An aircraft that was killed leaves a link to a pty that will be another program's.
        (self._folder / "board").unlink(missing_ok=True)
        if self._children:
            self._say("Everything is stopped.")
            for line in log_hints(self._folder / FLIGHTS):
                self._say(line)
        self._children.clear()

    def _show_page(self, page: Page) -> str | None:
        """Print the address of the ground station for a browser; the flight runs without it."""
        address = page.wait_for_address()
        if address is not None:
            self._say(f"  page       {address}  the ground station in a browser")
        else:
            page.child.terminate()
            self._children.remove(page.child)
            self._say(f"  page       no ground station for a browser: {page.why_not}")
        return address

    def _leave_page(self, page: Page) -> None:
        self._children.remove(page.child)
        # A picture on this terminal would wipe it away.
        self._untold.append(
            f"The ground station for a browser is gone: {page.why_not}. It flies on; this brings"
            f" the page back: {page.command}"
        )

    def _has_board(self, lines: list[str]) -> bool:
        """Print the aircraft's new lines, and return whether its board is chosen."""
        for line in lines[self._told :]:
            if not line.startswith(("phone:", "board")):
                self._say(f"  aircraft   {line}")
        self._told = len(lines)
        return any(line.startswith(("aboard", "board on")) for line in lines)

    def _write_config(self) -> None:
        folder = self._folder
        write_config(
            folder / "config",
            folder / "board",
            self._ports,
            controller=self._options.controller,
            airframe=self._airframe,
            uplink_port=self._ports.uplink if self._options.link else 0,
        )

    def _start_aircraft(self) -> Child:
        options, ports, folder = self._options, self._ports, self._folder
        who = options.radio if options.radio.startswith(("js", "/")) else "circle"
        words: list[str | Path] = [
            "-m", "up_simulator", "start",
            "--airframe", options.airframe, "--wind", options.wind,
            "--turbulence", options.turbulence, "--board", options.board, "--radio", who,
            "--radio-socket", folder / "radio", "--gains", folder / "config" / "pids.yml",
            "--pty-link", folder / "board", "--general-port", str(ports.general),
            "--orientation-port", str(ports.orientation), "--phone", options.phone, "--truth",
        ]  # fmt: skip
        if options.link:
            words += ["--link", options.link, "--link-port", str(ports.uplink)]
            words += ["--link-to", f"127.0.0.1:{ports.airborne}"]
        if options.replay:
            words += ["--replay", options.replay]
        if options.state_log:
            words += ["--state-log", options.state_log]
        return self._add("aircraft", *words)

    def _add(self, name: str, *words: str | Path) -> Child:
        (self._folder / f"{name}.log").unlink(missing_ok=True)
        child = Child(name, [sys.executable, *map(str, words)], self._folder)
        self._children.append(child)
        return child

    @property
    def _picture(self) -> str:
        """Return the purpose of this terminal."""
        return "keyboard radio" if self._options.radio == "keyboard" else "ground station"

    def _open_watch(self) -> Child:
        port = str(self._ports.ground)
        words = ["-m", "up_ground.main", "watch", "--port", port]
        if self._options.radio == "keyboard":
            words = ["-m", "up_simulator", "radio", "keyboard", "--socket"]
            words.append(str(self._folder / "radio"))
        child = Child("ground", [sys.executable, *words], self._folder, in_foreground=True)
        self._children.append(child)
        return child

    def _leave_watch(self, status: int, terminal: Any) -> None:
        """Restore the terminal if the screen did not, and report that all else continues."""
        why = ""
        if status:
            if status < 0:
                _restore_terminal(terminal)
            how = f"signal {-status}" if status < 0 else f"status {status}"
            why = f"The {self._picture} ended by itself with {how}. "
        self._say(f"{why}It flies on. Enter: the {self._picture} again; Ctrl-C: stop all.")

    def _tell_news(self, aircraft: Child) -> None:
        """Print the aircraft's new lines that matter to the user."""
        for line in self._news.of(aircraft.new_lines()):
            self._say(f"aircraft: {line}")


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
    sys.stdout.write(AS_BEFORE)
    sys.stdout.flush()
    with suppress(termios.error):
        # Keys typed for the screen are not for us.
        termios.tcsetattr(sys.stdin, termios.TCSAFLUSH, settings)
