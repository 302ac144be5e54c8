"""``up-sim radio``: take the sticks of an aircraft that flies in another terminal."""

from __future__ import annotations

import argparse
import socket
import sys
import time
from collections.abc import Callable
from pathlib import Path

from up.output import program_error
from up_simulator.harness.user_log import print_line
from up_simulator.radio.axis_map import read_axis_map
from up_simulator.radio.game_controller import GameController, controller_device
from up_simulator.radio.keyboard_radio import KeyboardRadio, status_line
from up_simulator.radio.remote_messages import MAX_DATAGRAM, Snapshot, read_snapshot, write_sticks
from up_simulator.radio.sticks import Radio, RadioError
from up_simulator.verbs.catalogue import verb_parser

PERIOD_S = 0.02
TIMEOUT_S = 2.0
SHOWN_S = 1.0
DEFAULT_SOCKET = Path("run/demo/radio")
TAKEN = "another radio has the sticks; q there releases them"
DESCRIPTION = """\
Takes the sticks of the aircraft that 'make run' (or 'up-sim start --radio-socket PATH') flies, and
gives them back at the end. The mode switch stays where it was; 2 selects FBW, 3 AUTO."""


def main(arguments: list[str] | None = None) -> int:
    """Send sticks until the pilot leaves; return the exit status."""
    options = _options(arguments)
    try:
        link = RadioLink(options.socket)
        return _override(link, options)
    except RadioError as error:
        sys.stderr.write(f"{program_error('up-sim radio', str(error), 'radio_failed')}\n")
        return 1


class RadioLink:
    """The radio's end of the socket. Raises ``RadioError`` when no aircraft answers there, or
    another radio has the sticks.
    """

    def __init__(self, path: Path) -> None:
        self._path = path
        self._socket = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
        # Linux chooses a name, which leaves no file behind.
        self._socket.bind("")
        self._socket.settimeout(TIMEOUT_S)
        try:
            self._send(write_sticks(None))
            self.snapshot = read_snapshot(self._socket.recv(MAX_DATAGRAM))
        except (OSError, ValueError, RadioError):
            self._socket.close()
            raise self._no_aircraft() from None
        self._socket.setblocking(False)
        if self.snapshot.is_taken_by_other:
            self._socket.close()
            raise RadioError(TAKEN, "sticks_taken")
        self._last_rx_s = time.monotonic()

    def exchange(self, datagram: bytes) -> Snapshot:
        self._send(datagram)
        while True:
            try:
                self.snapshot = read_snapshot(self._socket.recv(MAX_DATAGRAM))
            except BlockingIOError:
                break
            except ValueError:
                continue
            self._last_rx_s = time.monotonic()
        if self.snapshot.is_taken_by_other:
            raise RadioError(TAKEN, "sticks_taken")
        if time.monotonic() - self._last_rx_s > TIMEOUT_S:
            raise RadioError("the aircraft no longer answers", "aircraft_silent")
        return self.snapshot

    def close(self) -> None:
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
            # The socket is full; the next sticks are newer.
            return
        except OSError:
            raise self._no_aircraft() from None

    def _no_aircraft(self) -> RadioError:
        text = f"no aircraft answers at {self._path}; is 'make run' running?"
        return RadioError(text, "no_aircraft")


def _override(link: RadioLink, options: argparse.Namespace) -> int:
    is_over: list[bool] = []
    radio: Radio | None = None
    try:
        radio = _radio(link, options, lambda: is_over.append(True))
        started_s = shown_s = time.monotonic()
        while not is_over:
            now_s = time.monotonic()
            sticks = radio.sticks(now_s - started_s, link.snapshot.state)
            link.exchange(write_sticks(sticks))
            if options.who != "keyboard" and now_s - shown_s >= SHOWN_S:
                shown_s = now_s
                print_line(status_line(sticks, link.snapshot.state, link.snapshot.mode))
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
        start = link.snapshot.sticks
        return KeyboardRadio(on_leave, start=start, mode=lambda: link.snapshot.mode)
    return GameController(
        controller_device(options.who), read_axis_map(options.controller), print_line
    )


def _options(arguments: list[str] | None) -> argparse.Namespace:
    parser = verb_parser("radio", DESCRIPTION)
    parser.add_argument("who", nargs="?", default="keyboard", help="keyboard (default), js0, ...")
    parser.add_argument("--socket", type=Path, default=DEFAULT_SOCKET, help="default %(default)s")
    parser.add_argument(
        "--controller",
        default="transmitter",
        metavar="MAP",
        help="axes and buttons, as in 'up-sim start --help'",
    )
    options: argparse.Namespace = parser.parse_args(arguments)
    return options
