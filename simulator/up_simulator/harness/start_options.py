"""The options of ``up-sim start``."""

from __future__ import annotations

import argparse
import os
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

from up.cli.option_parser import bounded_number, port_number
from up_ground.key_store import KeyStore
from up_ground.token_store import state_folder
from up_rig.sticks import SticksError, read_sticks
from up_simulator.aircraft.model import MODEL_HELP, MODELS
from up_simulator.harness.uplink import UplinkError, read_link
from up_simulator.radio.axis_map import read_axis_map
from up_simulator.radio.sticks import RadioError
from up_simulator.verbs.catalogue import verb_parser

DESCRIPTION = """\
A virtual aircraft in real time, until Ctrl-C: a flight dynamics model in wind and
turbulence, the real firmware on a simulated chip with its serial line on a pty, and the airborne
phone on sockets."""

EPILOG = """\
The firmware is the one in arduino/, compiled for the Arduino and run instruction by instruction;
without the AVR tools the same sources run built for this computer, which is logged.

What moves the sticks (--radio):
  circle    a pilot who circles around the launch in FBW, switch at AUTO (default)
  script    --sticks alone: AUX1 is high (AUTO), AUX2 goes high after 1 s (which arms)
  keyboard  this terminal: arrows, w s, a d, 1 2 3, space; ? for help
  js0       a game controller, or a transmitter by USB (/dev/input/js0), see --controller

--sticks SCRIPT moves the sticks of 'circle' and 'script':
  t=SECONDS            when, since the start; holds for the words after it
  aileron=1600         also elevator, throttle, rudder, aux1, aux2: a pulse in us, from then on
  receiver=off         the receiver is lost (receiver=on: it is back)

--controller MAP is 'transmitter' (default), 'gamepad', or names axes and buttons:
  "ailerons=0 elevator=1- throttle=2 rudder=3 aux1=b5 aux2=b4 dead=0.05"
  1- reverses axis 1; b5 is a button; ailerons=0:-30000..120..31000 calibrates; dead is the part
  around the centre without effect. 'gamepad elevator=4-' changes a preset.

examples:
  up-sim start --pty-link /tmp/board
      fly, and wait for Raspilot on /tmp/board (arduino.yml: port: /tmp/board) and port 50001
  up-sim start --pty-link /tmp/board --sticks "t=10 aux1=1000 aileron=1700 t=12 aux1=2000"
      after 10 s the pilot switches to ACRO, banks right for 2 s and switches back
  up-sim start --radio keyboard --wind 6 --turbulence moderate
  up-sim start --no-board --orientation tcp
      a phone alone, as in Black Box Mode
  up-sim start --state-log truth.csv
      write the true state 50 times a second

  up-sim start --pty-link /tmp/board --link "delay=150 jitter=50 loss=3"
      Raspilot reaches its proxy (127.0.0.1:3003) through port 3005, as over the mobile network

Ctrl-C stops everything."""
BOARDS = ("auto", "firmware", "host")
BOARD_HELP = (
    "firmware: on its simulated chip (needs the AVR tools and simavr); host: the same sources built"
    " for this computer (needs g++), four times faster; auto (default): the first of these that"
    " works here"
)
TURBULENCE = ("none", "light", "moderate", "severe")
T = TypeVar("T")
wind_m_s = bounded_number(0, 25, "m/s")


def read_options(arguments: list[str] | None = None) -> argparse.Namespace:
    """Return the options; a wrong one ends the program with status 2 and one sentence."""
    parser = verb_parser("start", DESCRIPTION, EPILOG)
    _add_flight(parser.add_argument_group("flight"))
    _add_board(parser.add_argument_group("board"))
    _add_pilot(parser.add_argument_group("pilot"))
    _add_phone(parser.add_argument_group("phone"))
    _add_link(parser.add_argument_group("link to the proxy"))
    options: argparse.Namespace = parser.parse_args(arguments)
    if options.no_board and options.no_phone:
        parser.error("--no-board and --no-phone leave nothing to do")
    if options.discover and options.runner:
        parser.error("--discover and --runner are two ways of finding the same: choose one")
    options.pairing = None
    if options.signed:
        options.pairing = KeyStore(state_folder(os.environ)).get(options.aircraft_name)
        if options.pairing is None:
            parser.error(f"--signed: no key of {options.aircraft_name}; run 'up-ground pair'")
    return options


def _add_flight(group: argparse._ArgumentGroup) -> None:
    group.add_argument(
        "--airframe", default="glider", metavar="NAME", help="glider (default), wing, or your own"
    )
    group.add_argument("--model", choices=MODELS, default="auto", help=MODEL_HELP)
    group.add_argument(
        "--wind", type=wind_m_s, default=3.0, metavar="M_S", help="from the south, default 3"
    )
    group.add_argument(
        "--turbulence", choices=TURBULENCE, default="light", help="default %(default)s"
    )
    group.add_argument("--seed", type=int, default=1, metavar="N", help="of wind and all noise")
    group.add_argument(
        "--state-log", type=new_file, metavar="FILE", help="write the true state there, as CSV"
    )


def _add_board(group: argparse._ArgumentGroup) -> None:
    group.add_argument("--no-board", action="store_true", help="no Arduino aboard")
    group.add_argument(
        "--board",
        choices=BOARDS,
        default="auto",
        help=BOARD_HELP,
    )
    group.add_argument(
        "--autopilot",
        choices=("arduino", "betaflight"),
        default="arduino",
        help="arduino (default): our firmware; betaflight: the program --sitl, at"
        " tcp:127.0.0.1:5761 (msp.yml: port)",
    )
    group.add_argument(
        "--sitl",
        default="betaflight_SITL",
        metavar="FILE",
        help="Betaflight built for this computer, default %(default)s on the search path",
    )
    group.add_argument("--elf", type=_file, metavar="FILE", help="a built firmware")
    group.add_argument(
        "--gains", type=_file, metavar="FILE", help="pids.yml that the Arduino's EEPROM holds"
    )
    group.add_argument(
        "--gps-link",
        type=Path,
        metavar="PATH",
        help="symbolic link to the pty of a u-blox receiver aboard (gps.yml: port), none otherwise",
    )
    group.add_argument(
        "--pty-link", type=Path, metavar="PATH", help="symbolic link to the pty, removed at exit"
    )


def _add_pilot(group: argparse._ArgumentGroup) -> None:
    group.add_argument(
        "--radio",
        type=_radio,
        default="circle",
        metavar="WHO",
        help="circle, script, keyboard or js0",
    )
    group.add_argument(
        "--sticks",
        type=option_of(read_sticks),
        default=[],
        metavar="SCRIPT",
        help="a script of stick moves",
    )
    group.add_argument(
        "--controller",
        type=option_of(read_axis_map),
        default="transmitter",
        metavar="MAP",
        help="axes and buttons of a game controller",
    )
    group.add_argument(
        "--radio-socket",
        type=Path,
        metavar="PATH",
        help="let 'up-sim radio' take the sticks over through this socket",
    )


def _add_phone(group: argparse._ArgumentGroup) -> None:
    group.add_argument("--no-phone", action="store_true", help="no phone aboard")
    group.add_argument(
        "--phone-host",
        default="127.0.0.1",
        metavar="HOST",
        help="where Raspilot is, default %(default)s",
    )
    group.add_argument(
        "--general-port", type=port_number, default=50001, metavar="N", help="default 50001"
    )
    group.add_argument(
        "--orientation-port", type=port_number, default=50000, metavar="N", help="default 50000"
    )
    group.add_argument(
        "--orientation",
        choices=("off", "tcp", "udp"),
        default="off",
        help="send the phone's orientation at 50 Hz (Black Box Mode needs it; default off)",
    )
    group.add_argument(
        "--truth",
        action="store_true",
        help="record the true state in the flight's log, 20 times a second",
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
        "--runner", type=_place, metavar="HOST:PORT", help="request Raspilot from this runner first"
    )
    group.add_argument(
        "--signed",
        action="store_true",
        help="sign the request to the runner by the key that 'up-ground pair' has stored",
    )
    group.add_argument(
        "--aircraft-name", default="default", metavar="NAME", help="the name that the runner gets"
    )


def _add_link(group: argparse._ArgumentGroup) -> None:
    group.add_argument(
        "--link",
        type=option_of(read_link),
        metavar="LINK",
        help='a bad one: "delay=80 jitter=20 loss=1 rate=20000" (ms, ms, percent, bytes/s)',
    )
    group.add_argument(
        "--link-port",
        type=port_number,
        default=3005,
        metavar="N",
        help="where Raspilot enters it, default 3005",
    )
    group.add_argument(
        "--link-to",
        type=_place,
        default=("127.0.0.1", 3003),
        metavar="HOST:PORT",
        help="the proxy's side for aircraft, 127.0.0.1:3003",
    )


def new_file(text: str) -> Path:
    """Return the path of a file that can be written; raises ``ArgumentTypeError``."""
    path = Path(text)
    if not path.parent.is_dir():
        raise argparse.ArgumentTypeError(f"cannot write {text!r}: there is no folder {path.parent}")
    if path.is_dir() or not os.access(path if path.exists() else path.parent, os.W_OK):
        raise argparse.ArgumentTypeError(f"cannot write {text!r}")
    return path


def _file(text: str) -> Path:
    if not Path(text).is_file():
        raise argparse.ArgumentTypeError(f"no file {text!r}")
    return Path(text)


def _place(text: str) -> tuple[str, int]:
    host, colon, port = text.rpartition(":")
    if not colon or not host:
        raise argparse.ArgumentTypeError(f"{text!r} is not HOST:PORT")
    return host, port_number(port)


def _radio(text: str) -> str:
    is_device = text.startswith(("js", "/"))
    if text not in ("circle", "script", "keyboard") and not is_device:
        raise argparse.ArgumentTypeError(f"{text!r} is not circle, script, keyboard or js0")
    return text


def option_of(read: Callable[[str], T]) -> Callable[[str], T]:
    """Return the type of an option that shows the reader's own sentence."""

    def parse(text: str) -> T:
        try:
            return read(text)
        except (SticksError, RadioError, UplinkError) as error:
            raise argparse.ArgumentTypeError(str(error)) from error

    return parse
