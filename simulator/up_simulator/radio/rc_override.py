"""``up-sim radio``: take the sticks of an aircraft that flies in another terminal."""

from __future__ import annotations

import argparse
import signal
import socket
import sys
import time
from collections.abc import Callable
from pathlib import Path

from up_simulator.harness.option_parser import OptionParser
from up_simulator.radio.axis_map import read_axis_map
from up_simulator.radio.game_controller import GameController, controller_device
from up_simulator.radio.keyboard_radio import KeyboardRadio, status_line
from up_simulator.radio.remote_words import LONGEST, Seen, read_seen, write_sticks
from up_simulator.radio.sticks import Radio, RadioError

PERIOD_S = 0.02
SILENT_S = 2.0
SHOWN_S = 1.0
DEFAULT_SOCKET = Path("run/demo/radio")
OTHERS = "another radio has the sticks: q there gives them back"
DESCRIPTION = """\
Takes the sticks of the aircraft that 'make run' (or 'up-sim start --radio-socket PATH') flies, and
gives them back at the end. The mode switch stays where it was: FBW by itself, or 3 for AUTO."""


def main(arguments: list[str] | None = None) -> int:
    """Hold the sticks until the pilot leaves; return the exit status."""
    options = _options(arguments)
    signal.signal(signal.SIGTERM, _interrupt)
    signal.signal(signal.SIGHUP, _interrupt)
    try:
        link = RadioLink(options.socket)
        return _hold(link, options)
    except RadioError as error:
        sys.stderr.write(f"up-sim radio: {error}\n")
        return 1


class RadioLink:
    """The radio's end of the socket. Raises ``RadioError`` when no aircraft answers there, or
    another radio has the sticks.
    """

    def __init__(self, path: Path, clock: Callable[[], float] = time.monotonic) -> None:
        self._path = path
        self._clock = clock
        self._socket = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
        # Linux finds a name for it, which leaves no file behind.
        self._socket.bind("")
        self._socket.settimeout(SILENT_S)
        try:
            self._send(write_sticks(None))
            self.seen = read_seen(self._socket.recv(LONGEST))
        except (OSError, ValueError, RadioError):
            self._socket.close()
            raise self._nobody() from None
        self._socket.setblocking(False)
        if self.seen.is_others:
            self._socket.close()
            raise RadioError(OTHERS)
        self._heard_s = clock()

    def exchange(self, datagram: bytes) -> Seen:
        """Send sticks and return the newest state."""
        self._send(datagram)
        while True:
            try:
                self.seen = read_seen(self._socket.recv(LONGEST))
            except BlockingIOError:
                break
            except ValueError:
                continue
            self._heard_s = self._clock()
        if self.seen.is_others:
            raise RadioError(OTHERS)
        if self._clock() - self._heard_s > SILENT_S:
            raise RadioError("the aircraft does not answer any more")
        return self.seen

    def close(self) -> None:
        """Give the sticks back."""
        try:
            self._send(write_sticks(None))
        except RadioError:
            pass
        finally:
            self._socket.close()

    def _send(self, datagram: bytes) -> None:
        try:
            self._socket.sendto(datagram, str(self._path))
        except BlockingIOError:
            # It is busy; the next ones are newer anyway.
            return
        except OSError:
            raise self._nobody() from None

    def _nobody(self) -> RadioError:
        return RadioError(f"no aircraft listens to a radio at {self._path} (does 'make run' fly?)")


def _hold(link: RadioLink, options: argparse.Namespace) -> int:
    has_left: list[bool] = []
    radio: Radio | None = None
    try:
        radio = _radio(link, options, lambda: has_left.append(True))
        started_s = shown_s = time.monotonic()
        while not has_left:
            now_s = time.monotonic()
            sticks = radio.sticks(now_s - started_s, link.seen.state)
            link.exchange(write_sticks(sticks))
            if options.who != "keyboard" and now_s - shown_s >= SHOWN_S:
                shown_s = now_s
                _say(status_line(sticks, link.seen.state, link.seen.mode))
            time.sleep(PERIOD_S)
    except KeyboardInterrupt:
        pass
    finally:
        if radio is not None:
            radio.close()
        link.close()
    return 0


def _radio(link: RadioLink, options: argparse.Namespace, on_leave: Callable[[], None]) -> Radio:
    if options.who == "keyboard":
        start = link.seen.sticks
        return KeyboardRadio(on_leave, start=start, mode=lambda: link.seen.mode)
    return GameController(controller_device(options.who), read_axis_map(options.controller), _say)


def _options(arguments: list[str] | None) -> argparse.Namespace:
    parser = OptionParser(prog="up-sim radio", description=DESCRIPTION, allow_abbrev=False)
    parser.add_argument("who", nargs="?", default="keyboard", help="keyboard (default), js0, ...")
    parser.add_argument("--socket", type=Path, default=DEFAULT_SOCKET, help="default %(default)s")
    parser.add_argument(
        "--controller",
        default="transmitter",
        metavar="MAP",
        help="axes and buttons, as in 'up-sim start --help'",
    )
    return parser.parse_args(arguments)


def _interrupt(_number: int, _frame: object) -> None:
    raise KeyboardInterrupt


def _say(text: str) -> None:
    sys.stdout.write(f"{text}\n")
    sys.stdout.flush()
