"""The command line of ``up-ground``."""

from __future__ import annotations

import argparse
import math
from collections.abc import Mapping, Sequence

from up.system.aircraft_name import AIRCRAFT_NAME, AIRCRAFT_NAME_RULE
from up.version import VERSION
from up_ground.page_options import add_page_options
from up_ground.replay.verb import EPILOG, add_arguments
from up_ground.settings import DEFAULT_AIRCRAFT, DEFAULT_HOST, DEFAULT_PORT, Seat, Settings

_MAX_S = 1e7

_EPILOG = """\
examples
  up-ground watch                                      live picture; q quits
  up-ground --aircraft glider-1 watch --once           one picture, then exit
  up-ground watch --json --count 10                    ten telemetry messages for a script
  up-ground commands                                   Commands that can be sent
  up-ground send up.flight_mode.set mode=FBW
  up-ground send arduino.pids.tunings request=true     prints the active gains
  up-ground serve                                      the page for browsers, on this machine
  up-ground replay last                                a recorded flight in that page
  up-ground control request                            requests control of its owner

environment
  UP_GROUND_HOST, UP_GROUND_PORT, UP_GROUND_AIRCRAFT, UP_GROUND_DIRECT=1 stand for the options
"""
_WATCH_EPILOG = """\
On a terminal: a picture of the aircraft, at most ten times a second. Stale numbers are dim,
with their age beside them; when the aircraft is silent everything is dim. '--' is unknown.
Keys: q quits, c requests control, g hands it to the listener that requests it, r releases it.
Elsewhere (a pipe, a file): one line a second.
"""
_SEND_EPILOG = """\
A value is parsed as JSON if possible (2, true, null, "2"), otherwise as text; dots open an object.
The newest beacon is echoed, so that a Command delayed by a bad link is refused.

examples
  up-ground send up.telemetry.frequency frequency=200
  up-ground send up.arm

exit status
  0 carried out; 1 refused, with the reason; 2 error in the command line, nothing was sent;
  3 no connection, no aircraft or no answer
"""


_SERVE_EPILOG = """\
The page shows everything that 'watch' shows, and a map, charts, events and gains; a page that has
control sends Commands. One page controls an aircraft, the others watch. The page selects one of
several aircraft. An unreachable proxy is retried without end.

On an address other than loopback only a page opened with the key, which is printed as part of the
address, can control; without the key it only watches.

examples
  up-ground serve                                        the aircraft 'default' of a proxy here
  up-ground --host proxy.example serve --aircraft glider-1 --aircraft glider-2
  up-ground serve --aircraft glider-1@192.168.1.5:50002/direct
  up-ground serve --listen 0.0.0.0:8080                  for the phones on this network
  up-ground serve --listen 0.0.0.0:8080 --watch-only     for spectators
"""


class _Parser(argparse.ArgumentParser):
    def __init__(self, *args: object, **more: object) -> None:
        more.setdefault("formatter_class", argparse.RawDescriptionHelpFormatter)
        super().__init__(*args, **more)  # type: ignore[arg-type]


def make_parser(environ: Mapping[str, str]) -> argparse.ArgumentParser:
    """Return the parser; the environment's values become defaults."""
    parser = _Parser(
        prog="up-ground",
        description="The terminal ground station: watches an aircraft and sends it Commands.",
        epilog=_EPILOG,
    )
    _add_connection(
        parser,
        environ.get("UP_GROUND_HOST") or DEFAULT_HOST,
        environ.get("UP_GROUND_PORT") or DEFAULT_PORT,
        environ.get("UP_GROUND_DIRECT", "") not in ("", "0"),
        environ.get("UP_GROUND_AIRCRAFT") or DEFAULT_AIRCRAFT,
    )
    parser.add_argument("--version", action="version", version=f"up-ground {VERSION}")
    verbs = parser.add_subparsers(dest="verb", metavar="VERB", parser_class=_Parser)
    _add_watch(verbs)
    _add_send(verbs)
    _add_control(verbs)
    for verb in dict.fromkeys(verbs.choices.values()):
        # People write them behind the verb as well; there an absent one must change nothing.
        _add_connection(verb, *(argparse.SUPPRESS,) * 4)
    _add_serve(verbs)
    _add_replay(verbs)
    commands = verbs.add_parser("commands", help="list the Commands that a ground may send")
    commands.add_argument("name", nargs="?", help="only this one")
    return parser


def _add_connection(
    parser: argparse.ArgumentParser,
    host: object,
    port: object,
    direct: object,
    aircraft: object = None,
) -> None:
    """Add the options for the peer's address and the names, with their defaults."""
    now = "" if host is argparse.SUPPRESS else " (default %(default)s)"
    group = parser.add_argument_group("peer")
    group.add_argument(
        "--host",
        default=host,
        help=f"the Ground Station Proxy, or the aircraft itself{now}",
    )
    group.add_argument(
        "--port",
        type=_port,
        default=port,
        metavar="N",
        help=f"its port: 3004 of a proxy, 50002 of an aircraft{now}",
    )
    if aircraft is not None:
        group.add_argument(
            "--aircraft",
            type=_aircraft,
            default=aircraft,
            metavar="NAME",
            help=f"which aircraft of the proxy{now}",
        )
    group.add_argument(
        "--direct",
        action="store_true",
        default=direct,
        help="send no hello: for a legacy proxy or an old aircraft on the same LAN",
    )


def settings_of(options: argparse.Namespace, seat: Seat) -> Settings:
    """Return the settings of the peer to connect to."""
    return Settings(options.host, options.port, options.aircraft, seat, options.direct)


def parse_arguments(
    arguments: Sequence[str] | None, environ: Mapping[str, str]
) -> tuple[argparse.ArgumentParser, argparse.Namespace]:
    """Return the parser and the arguments; prints one sentence and exits with 2 on a mistake."""
    parser = make_parser(environ)
    return parser, parser.parse_args(arguments)


def _add_watch(verbs: argparse._SubParsersAction[_Parser]) -> None:
    watch = verbs.add_parser(
        "watch",
        help="show live telemetry",
        description="Show live telemetry, the age of every reading and the state of the link.",
        epilog=_WATCH_EPILOG,
    )
    form = watch.add_mutually_exclusive_group()
    form.add_argument("--once", action="store_true", help="print one picture and exit")
    form.add_argument("--json", action="store_true", help="print the telemetry messages")
    form.add_argument("--plain", action="store_true", help="one line a second, on a terminal too")
    watch.add_argument("--count", type=_count, metavar="N", help="stop after N lines")
    watch.add_argument(
        "--for", type=_seconds, dest="for_s", metavar="SECONDS", help="stop after this time"
    )
    watch.add_argument(
        "--seat",
        choices=("command", "listen"),
        default="listen",
        help="command: hold control as long as this runs (default %(default)s)",
    )


def _add_send(verbs: argparse._SubParsersAction[_Parser]) -> None:
    send = verbs.add_parser(
        "send",
        help="send one Command and show its answer",
        description="Send one Command to the aircraft and show its answer.",
        epilog=_SEND_EPILOG,
    )
    send.add_argument("name", metavar="NAME", help="see 'up-ground commands'")
    fields = send.add_argument(
        "fields", nargs="*", metavar="key=value", default=[], help="the Command's fields"
    )
    # Otherwise argparse reports missing fields where only the name is missing.
    fields.required = False
    send.add_argument(
        "--force", action="store_true", help="send it unchecked, even with an unknown name"
    )


def _add_control(verbs: argparse._SubParsersAction[_Parser]) -> None:
    control = verbs.add_parser(
        "control",
        aliases=["seat"],
        help="request, hand over or release control",
        description="One ground has control of an aircraft, the others listen. This requests"
        " control, hands it to the listener with a number, or releases it.",
    )
    actions = control.add_subparsers(dest="action", metavar="ACTION", required=True)
    request = actions.add_parser("request", help="request control of its owner; free: granted")
    request.add_argument(
        "--wait",
        type=_seconds,
        default=30.0,
        metavar="SECONDS",
        help="how long to request (default %(default)g)",
    )
    give = actions.add_parser("give", help="hand control to a listener")
    give.add_argument("to", type=_count, metavar="N", help="the listener's number")
    actions.add_parser("release", help="release control")


def _add_serve(verbs: argparse._SubParsersAction[_Parser]) -> None:
    serve = verbs.add_parser(
        "serve",
        help="serve the ground station as a page for browsers",
        description="Serve the ground station as a page for browsers.",
        epilog=_SERVE_EPILOG,
    )
    serve.add_argument(
        "--aircraft",
        action="append",
        dest="fleet",
        metavar="NAME[@HOST:PORT[/direct]]",
        help="an aircraft, of the proxy that --host and --port name or at the given address;"
        " again for each one",
    )
    _add_connection(serve, *(argparse.SUPPRESS,) * 3)
    add_page_options(serve)


def _add_replay(verbs: argparse._SubParsersAction[_Parser]) -> None:
    add_arguments(
        verbs.add_parser(
            "replay",
            help="play a recorded flight in the page",
            description="Play a recorded flight in the page of the ground station.",
            epilog=EPILOG,
        )
    )


def _port(text: str) -> int:
    port = int(text) if text.isascii() and text.isdigit() and len(text) < 6 else 0
    if not 1 <= port <= 65535:
        raise argparse.ArgumentTypeError(f"a port is a number from 1 to 65535, not {text!r}")
    return port


def _aircraft(text: str) -> str:
    if not AIRCRAFT_NAME.fullmatch(text):
        raise argparse.ArgumentTypeError(
            f"an aircraft's name must be {AIRCRAFT_NAME_RULE}: {text!r}"
        )
    return text


def _count(text: str) -> int:
    count = int(text) if text.isascii() and text.isdigit() and len(text) < 10 else 0
    if count < 1:
        raise argparse.ArgumentTypeError(f"must be a whole number of at least 1, not {text!r}")
    return count


def _seconds(text: str) -> float:
    try:
        seconds = float(text)
    except ValueError:
        seconds = math.nan
    if not 0 < seconds <= _MAX_S:
        raise argparse.ArgumentTypeError(f"must be a number of seconds above 0, not {text!r}")
    return seconds
