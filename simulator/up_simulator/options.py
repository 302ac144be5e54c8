"""What the user may ask of the simulator."""

from __future__ import annotations

import argparse
from pathlib import Path

from up_simulator.aircraft import (
    DEFAULT_AIRFRAME,
    TURBULENCE,
    Airframe,
    AirframeError,
    airframe_names,
    load_airframe,
)
from up_simulator.receiver import StickMove, SticksError, read_sticks

DESCRIPTION = """\
A virtual aircraft for Raspilot: a real flight dynamics model (JSBSim) in wind and turbulence,
behind a stand-in for the Arduino on a pty and a stand-in for the airborne phone on sockets."""

EPILOG = """\
The board (protocols 2) has an RC receiver and servos, but no stabilisation of its own: with the
switch at AUTO it follows the Outputs of the Raspberry Pi; in every other case, and 250 ms after
the last Output, the sticks pass through. It streams once it got a Start Command.

The pilot's sticks follow a script. By default AUX1 is high (AUTO), and AUX2 goes high after 1 s
(which arms); an aircraft with a motor gets throttle after 3 s. --sticks adds to this:
  t=SECONDS            when, since the start; holds for the words after it
  aileron=1600         also elevator, throttle, rudder, aux1, aux2: a pulse in us
  receiver=off         the receiver is lost (receiver=on: it is back)

examples:
  python -m up_simulator --pty-link /tmp/board
      fly, and wait for Raspilot on /tmp/board (arduino.yml: port: /tmp/board) and port 50001
  python -m up_simulator --pty-link /tmp/board --sticks "t=10 aux1=1000 aileron=1700 t=12 aux1=2000"
      after 10 s the pilot takes over, banks right for 2 s and gives the aircraft back
  python -m up_simulator --no-board --orientation tcp
      a phone alone, as in Black Box Mode
  python -m up_simulator --state-log truth.csv
      write the true state 50 times a second; --replay truth.csv flies it again

Ctrl-C stops everything."""


def read_options(arguments: list[str] | None = None) -> argparse.Namespace:
    """Return the options; a wrong one ends the program with status 2 and one sentence."""
    parser = argparse.ArgumentParser(
        prog="python -m up_simulator",
        description=DESCRIPTION,
        epilog=EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    _add_flight(parser.add_argument_group("flight"))
    _add_board(parser.add_argument_group("board"))
    _add_phone(parser.add_argument_group("phone"))
    options = parser.parse_args(arguments)
    if options.no_board and options.no_phone:
        parser.error("--no-board and --no-phone leave nothing to do")
    if options.discover and options.runner:
        parser.error("--discover and --runner are two ways of finding the same: choose one")
    return options


def _add_flight(group: argparse._ArgumentGroup) -> None:
    group.add_argument(
        "--aircraft",
        type=_airframe,
        default=DEFAULT_AIRFRAME,
        metavar="NAME",
        help=f"{', '.join(airframe_names())}, or a folder with an airframe.yml; default glider",
    )
    group.add_argument(
        "--wind", type=_wind_m_s, default=3.0, metavar="M_S", help="from the south, default 3"
    )
    group.add_argument(
        "--turbulence", choices=TURBULENCE, default="light", help="default %(default)s"
    )
    group.add_argument("--seed", type=int, default=1, metavar="N", help="of wind and all noise")
    group.add_argument(
        "--replay", type=Path, metavar="FILE", help="fly a recorded flight (a state log) in a loop"
    )
    group.add_argument(
        "--state-log", type=Path, metavar="FILE", help="write the true state there, as CSV"
    )


def _add_board(group: argparse._ArgumentGroup) -> None:
    group.add_argument("--no-board", action="store_true", help="no stand-in for the Arduino")
    group.add_argument(
        "--pty-link", type=Path, metavar="PATH", help="symbolic link to the pty, removed at exit"
    )
    group.add_argument(
        "--framing",
        choices=("checked", "thesis"),
        default="checked",
        help="checked: this project's firmware (default); thesis: an old one",
    )
    group.add_argument(
        "--sticks",
        type=_sticks,
        default=[],
        metavar="SCRIPT",
        help="what the pilot does, see below",
    )
    group.add_argument(
        "--old-confirms", action="store_true", help="thesis: the old firmware echoes Commands"
    )
    group.add_argument(
        "--boot-text", default="", metavar="TEXT", help="thesis: text that it prints at boot"
    )


def _add_phone(group: argparse._ArgumentGroup) -> None:
    group.add_argument("--no-phone", action="store_true", help="no stand-in for the phone")
    group.add_argument("--phone-host", default="127.0.0.1", metavar="HOST", help="Raspilot's host")
    group.add_argument("--general-port", type=_port, default=50001, metavar="N", help="50001")
    group.add_argument("--orientation-port", type=_port, default=50000, metavar="N", help="50000")
    group.add_argument(
        "--orientation",
        choices=("off", "tcp", "udp"),
        default="off",
        help="send the phone's orientation at 50 Hz (Black Box Mode needs it; default off)",
    )
    group.add_argument(
        "--discover",
        type=_place,
        nargs="?",
        const=("127.0.0.1", 3001),
        metavar="HOST:PORT",
        help="find Raspilot's host by Discovery (default 127.0.0.1:3001)",
    )
    group.add_argument(
        "--runner", type=_place, metavar="HOST:PORT", help="ask this runner to spawn Raspilot first"
    )
    group.add_argument(
        "--aircraft-name", default="default", metavar="NAME", help="what to ask the runner for"
    )


def _airframe(text: str) -> Airframe:
    try:
        return load_airframe(text)
    except AirframeError as error:
        raise argparse.ArgumentTypeError(str(error)) from error


def _wind_m_s(text: str) -> float:
    try:
        speed_m_s = float(text)
    except ValueError:
        speed_m_s = -1.0
    if not 0.0 <= speed_m_s <= 25.0:
        raise argparse.ArgumentTypeError(f"{text!r}: wind is 0 to 25 m/s")
    return speed_m_s


def _port(text: str) -> int:
    if not (text.isascii() and text.isdigit()) or not 1 <= int(text[:9]) <= 65535:
        raise argparse.ArgumentTypeError(f"{text!r}: a port is 1 to 65535")
    return int(text)


def _place(text: str) -> tuple[str, int]:
    host, colon, port = text.rpartition(":")
    if not colon or not host:
        raise argparse.ArgumentTypeError(f"{text!r} is not HOST:PORT")
    return host, _port(port)


def _sticks(text: str) -> list[StickMove]:
    try:
        return read_sticks(text)
    except SticksError as error:
        raise argparse.ArgumentTypeError(str(error)) from error
