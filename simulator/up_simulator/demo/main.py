"""``make run``: the whole system on one machine, in the air, stabilised, until Ctrl-C.

Starts the proxy, the virtual aircraft with its firmware and phone, Raspilot and the ground station
for browser and terminal, each as the process that a user would start, with configuration in its
own folder.
"""

from __future__ import annotations

import argparse
import fcntl
import signal
from collections.abc import Callable, Sequence
from pathlib import Path

from up.cli.option_parser import EXIT_USAGE as WRONG_INPUT
from up.cli.option_parser import OptionParser, bounded_number
from up.errors import UserError
from up.output import print_problems
from up_ground.web.listen_address import parse_listen
from up_simulator.aircraft import AirframeError, airframe_names
from up_simulator.aircraft.model import MODEL_HELP, MODELS
from up_simulator.demo.flight import DemoFlight
from up_simulator.harness.participants import ParticipantError
from up_simulator.harness.signal_handling import handle
from up_simulator.harness.start_options import (
    BOARD_HELP,
    BOARDS,
    TURBULENCE,
    new_file,
    wind_m_s,
)
from up_simulator.harness.uplink import read_link
from up_simulator.harness.user_log import print_line

ROOT = Path(__file__).resolve().parents[3]


class Stopped(Exception):  # noqa: N818 - a signal is not an error
    """A signal requests the end."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run everything; return 0 after Ctrl-C, 1 when a part failed, 2 for wrong input."""
    options = read_options(arguments)
    folder = (options.folder or ROOT / "run" / "demo").resolve()
    if not (ROOT / "main.py").is_file():
        text = "the demo runs from a clone of the project: make run"
        return _fail(text, WRONG_INPUT, "not_a_clone")
    try:
        folder.mkdir(parents=True, exist_ok=True)
        lock = (folder / "lock").open("w")
    except OSError as error:
        return _fail(f"--folder {folder}: {error.strerror}", WRONG_INPUT, "cannot_write")
    with lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            return _fail(
                f"another 'make run' flies with {folder}: end it, or give this one another folder:"
                " make run ARGS='--folder run/second'",
                1,
                "folder_in_use",
            )
        return _fly(options, folder)


def _fly(options: argparse.Namespace, folder: Path) -> int:
    # A shell starts background jobs with SIGINT ignored: one sent to this process is intended.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    for number in (signal.SIGTERM, signal.SIGHUP):
        handle(number, _raise_stopped)
    failure = ""
    flight: DemoFlight | None = None
    try:
        flight = DemoFlight(options, folder, ROOT, print_line)
        flight.start()
        flight.watch()
    except (KeyboardInterrupt, Stopped):
        pass
    except AirframeError as error:
        # Before anything was started.
        return _fail(f"make run: {error}", WRONG_INPUT, "airframe")
    except UserError as error:
        return _fail(f"make run: {error}", WRONG_INPUT, error.code)
    except (ParticipantError, OSError) as error:
        failure = str(error)
    finally:
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            signal.signal(number, signal.SIG_IGN)
        if flight is not None:
            flight.stop()
    if failure:
        # Only now: the ground station's screen would have erased it.
        print_line(f"\n{failure}")
    return 1 if failure else 0


def read_options(arguments: Sequence[str] | None) -> argparse.Namespace:
    """Return the options of the command line."""
    parser = OptionParser(
        prog="make run",
        allow_abbrev=False,
        description="Flies the virtual aircraft with the real firmware, daemon, proxy and ground"
        " station. From make: make run CONTROLLER=raspberry RADIO=keyboard ARGS='--wind 6'",
    )
    parser.add_argument(
        "--controller",
        choices=("arduino", "raspberry"),
        default="arduino",
        help="which holds the attitude: the firmware, or Raspilot on this machine; default arduino",
    )
    parser.add_argument("--airframe", default="glider", help=" or ".join(airframe_names()))
    parser.add_argument(
        "--wind",
        type=_text_of(wind_m_s),
        default="4",
        metavar="M_S",
        help="from the south, default 4",
    )
    parser.add_argument(
        "--turbulence", choices=TURBULENCE, default="moderate", help="default moderate"
    )
    parser.add_argument(
        "--radio",
        type=_radio,
        default="circle",
        metavar="RADIO",
        help="what moves the sticks: circle (default), keyboard, js0",
    )
    parser.add_argument("--model", choices=MODELS, default="auto", help=MODEL_HELP)
    parser.add_argument(
        "--board",
        choices=BOARDS,
        default="auto",
        help=BOARD_HELP,
    )
    parser.add_argument(
        "--link",
        type=_text_of(read_link),
        default="",
        help="a bad link from aircraft to proxy: 'delay=80 jitter=20 loss=1 rate=20000'",
    )
    parser.add_argument("--plain", action="store_true", help="fly without end-to-end keys")
    parser.add_argument(
        "--mavlink",
        action="store_true",
        help="let QGroundControl, MAVProxy and MAVSDK on this machine connect",
    )
    parser.add_argument("--folder", type=Path, help="for configuration and logs (run/demo)")
    parser.add_argument(
        "--seconds",
        type=bounded_number(0.001, 1e7, "s"),
        help="stop after this many seconds; default: at Ctrl-C",
    )
    parser.add_argument("--no-watch", action="store_true", help="do not show the telemetry")
    parser.add_argument("--no-page", action="store_true", help="no ground station for a browser")
    parser.add_argument(
        "--page",
        type=_text_of(parse_listen),
        metavar="ADDRESS:PORT",
        help="where the ground station for a browser listens; default 127.0.0.1:8080",
    )
    parser.add_argument("--state-log", type=new_file, help="write the true state there, as CSV")
    parser.add_argument("--any-ports", action="store_true", help="do not try the usual ports")
    options: argparse.Namespace = parser.parse_args(arguments)
    return options


def _text_of(read: Callable[[str], object]) -> Callable[[str], str]:
    """Return a parser that keeps a text unchanged, after a check by the aircraft's own parser."""

    def check(text: str) -> str:
        try:
            read(text)
        except ValueError as error:
            raise argparse.ArgumentTypeError(str(error)) from error
        return text

    return check


def _radio(text: str) -> str:
    if text not in ("circle", "keyboard") and not text.startswith(("js", "/")):
        raise argparse.ArgumentTypeError(f"{text!r} is not circle, keyboard or js0")
    return text


def _raise_stopped(number: int, frame: object) -> None:
    raise Stopped


def _fail(text: str, status: int, code: str) -> int:
    print_problems([UserError(text, code)])
    return status
