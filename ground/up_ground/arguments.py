"""The command line of ``up-ground``."""

from __future__ import annotations

import argparse
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from up.cli.option_parser import (
    OptionParser,
    add_json_option,
    bounded_number,
    port_number,
    whole_number,
)
from up.cli.verb import add_verb
from up.system.aircraft_name import AIRCRAFT_NAME, AIRCRAFT_NAME_RULE
from up.version import VERSION
from up_ground.foxglove_verb import add_foxglove
from up_ground.key_store import KeyStore
from up_ground.mavlink_verb import add_mavlink
from up_ground.mission_verb import add_mission
from up_ground.page_options import add_page_options
from up_ground.pair import add_pair
from up_ground.replay.verb import add_replay
from up_ground.settings import DEFAULT_AIRCRAFT, DEFAULT_HOST, DEFAULT_PORT, Seat, Settings
from up_ground.token_store import TokenStore, state_folder

_COUNT, _SECONDS = whole_number(1, 999_999_999), bounded_number(0.001, 1e7, "s")

_EPILOG = """\
examples
  up-ground watch                                   live picture; q quits
  up-ground --aircraft glider-1 watch --once        one picture, then exit
  up-ground watch --json --count 10                 ten messages for a script
  up-ground commands                                Commands that can be sent
  up-ground send up.flight_mode.set mode=RETURN
  up-ground send arduino.pids.tunings request=true  prints the active gains
  up-ground mission upload field.plan               then: mission start
  up-ground mavlink                                 QGroundControl uses this link
  up-ground serve                                   the page for browsers
  up-ground replay last                             a recorded flight, there
  up-ground control request                         requests it of its owner

environment
  UP_GROUND_HOST, UP_GROUND_PORT, UP_GROUND_AIRCRAFT, UP_GROUND_DIRECT=1 and
  UP_GROUND_TLS stand for the options
"""
_WATCH_EPILOG = """\
On a terminal: a picture of the aircraft, at most ten times a second. Stale
numbers are dim, with their age beside them; when the aircraft is silent
everything is dim. '--' is unknown.
Keys: q quits, c requests control, g hands it to the listener that requests it,
r releases it.
Elsewhere (a pipe, a file): one line a second.
"""
_SEND_EPILOG = """\
A value is parsed as JSON if possible (2, true, null, "2"), otherwise as text;
dots open an object. The newest beacon is echoed, so that a Command delayed by a
bad link is refused.

examples
  up-ground send up.flight_mode.set mode=LOITER
  up-ground send up.navigation.target latitude=50.1 longitude=8.6 height=80
  up-ground send up.flight_mode.set mode=GUIDED     then flies there
  up-ground send up.home.set                        home is where it is now
  up-ground send up.telemetry.frequency frequency=200
  up-ground send up.arm

exit status
  0 carried out; 1 refused, with the reason; 2 error in the command line,
  nothing was sent; 3 no connection, no aircraft or no answer
"""
_CONTROL_EPILOG = """\
One ground has control of an aircraft, the others listen. This requests control,
hands it to the listener with a number, or releases it.
"""
_SERVE_EPILOG = """\
The page shows everything that 'watch' shows, and a map, charts, events and
gains; a page that has control sends Commands. One page controls an aircraft,
the others watch. The page selects one of several aircraft. An unreachable proxy is
retried without end.

On an address other than loopback a page only watches until its user signs in
with the key, which is printed, or kept in the file whose name is printed.

examples
  up-ground serve                              the aircraft 'default' of a proxy
  up-ground --host proxy.example serve --aircraft glider-1 --aircraft glider-2
  up-ground serve --aircraft glider-1@192.168.1.5:50002/direct
  up-ground serve --listen 0.0.0.0:8080        for the phones on this network
  up-ground serve --listen 0.0.0.0:8080 --watch-only  for spectators
"""


def make_parser(environ: Mapping[str, str]) -> OptionParser:
    """Return the parser; the environment's values become defaults."""
    parser = OptionParser(
        prog="up-ground",
        description="The terminal ground station: watches an aircraft and sends it Commands.",
        epilog=_EPILOG,
    )
    _add_connection(parser, environ)
    parser.add_argument("--version", action="version", version=f"up-ground {VERSION}")
    verbs = parser.add_subparsers(title="verbs", metavar="VERB")
    _add_watch(verbs)
    _add_send(verbs)
    _add_control(verbs)
    add_mission(verbs)
    add_mavlink(verbs)
    add_foxglove(verbs)
    for verb in dict.fromkeys(verbs.choices.values()):
        _add_connection(verb)
    _add_serve(verbs)
    add_replay(verbs)
    add_pair(verbs)
    text = "list the Commands that a ground may send"
    commands = add_verb(verbs, "commands", "up_ground.main:commands", text)
    commands.add_argument("name", nargs="?", help="only this one")
    add_json_option(commands)
    return parser


def _add_connection(
    parser: argparse.ArgumentParser,
    environ: Mapping[str, str] | None = None,
    *,
    aircraft: bool = True,
) -> None:
    """Add the options for the peer's address and the names.

    Without ``environ`` it is the parser of a verb: an absent option changes nothing there.
    """
    group = parser.add_argument_group("peer")

    def add(option: str, text: str, default: object, **more: Any) -> None:
        if environ is None:
            default = argparse.SUPPRESS
        elif "action" not in more:
            text += " (default %(default)s)"
        group.add_argument(option, help=text, default=default, **more)

    given = environ or {}
    host = given.get("UP_GROUND_HOST") or DEFAULT_HOST
    add("--host", "the Ground Station Proxy, or the aircraft itself", host, type=_host)
    port = given.get("UP_GROUND_PORT") or DEFAULT_PORT
    text = "its port: 3004 of a proxy, 50002 of an aircraft"
    add("--port", text, port, type=port_number, metavar="N")
    if aircraft:
        name = given.get("UP_GROUND_AIRCRAFT") or DEFAULT_AIRCRAFT
        add("--aircraft", "which aircraft of the proxy", name, type=_aircraft, metavar="NAME")
    direct = given.get("UP_GROUND_DIRECT", "") not in ("", "0")
    text = "send no hello: for a legacy proxy or an old aircraft on the same LAN"
    add("--direct", text, direct, action="store_true")
    text = "folder with this ground's certificate: the link speaks TLS alone (port 3014 of a proxy)"
    tls = given.get("UP_GROUND_TLS")
    add("--tls", text, Path(tls) if tls else None, type=Path, metavar="DIR")


def peer_of(options: argparse.Namespace, seat: Seat) -> tuple[Settings, TokenStore]:
    """Return the peer to connect to, and the tokens for it; raises UserError for faulty keys."""
    folder = state_folder(os.environ)
    key = KeyStore(folder).get(options.aircraft)
    settings = Settings(
        options.host, options.port, options.aircraft, seat, options.direct, options.tls, key
    )
    return settings, TokenStore(folder, settings)


def _add_watch(verbs: Any) -> None:
    text = "show live telemetry, the age of every reading and the state of the link"
    watch = add_verb(verbs, "watch", "up_ground.main:watch", text, epilog=_WATCH_EPILOG)
    form = watch.add_mutually_exclusive_group()
    form.add_argument("--once", action="store_true", help="print one picture and exit")
    form.add_argument("--json", action="store_true", help="print the telemetry messages")
    form.add_argument("--plain", action="store_true", help="one line a second, on a terminal too")
    watch.add_argument("--count", type=_COUNT, metavar="N", help="stop after N lines")
    watch.add_argument(
        "--for", type=_SECONDS, dest="for_s", metavar="SECONDS", help="stop after this time"
    )
    watch.add_argument(
        "--seat",
        choices=("command", "listen"),
        default="listen",
        help="command: hold control as long as this runs (default %(default)s)",
    )


def _add_send(verbs: Any) -> None:
    text = "send one Command and show its answer"
    send = add_verb(verbs, "send", "up_ground.main:send", text, epilog=_SEND_EPILOG)
    send.add_argument("name", metavar="NAME", help="see 'up-ground commands'")
    fields = send.add_argument(
        "fields", nargs="*", metavar="key=value", default=[], help="the Command's fields"
    )
    # Otherwise argparse reports missing fields where only the name is missing.
    fields.required = False
    send.add_argument(
        "--force", action="store_true", help="send it unchecked, even with an unknown name"
    )


def _add_control(verbs: Any) -> None:
    text = "request, hand over or release control"
    control = add_verb(
        verbs, "control", "up_ground.main:control", text, aliases=("seat",), epilog=_CONTROL_EPILOG
    )
    actions = control.add_subparsers(dest="action", metavar="ACTION", required=True)
    request = actions.add_parser("request", help="request control of its owner; free: granted")
    request.add_argument(
        "--wait",
        type=_SECONDS,
        default=30.0,
        metavar="SECONDS",
        help="how long to request (default %(default)g)",
    )
    give = actions.add_parser("give", help="hand control to a listener")
    give.add_argument("to", type=_COUNT, metavar="N", help="the listener's number")
    actions.add_parser("release", help="release control")
    for name, action in actions.choices.items():
        action.set_defaults(parser=action, action=name)


def _add_serve(verbs: Any) -> None:
    text = "serve the ground station as a page for browsers"
    serve = add_verb(verbs, "serve", "up_ground.main:serve", text, epilog=_SERVE_EPILOG)
    serve.add_argument(
        "--aircraft",
        action="append",
        dest="fleet",
        metavar="NAME[@HOST:PORT[/direct]]",
        help="an aircraft, of the proxy that --host and --port name or at the given address;"
        " again for each one",
    )
    serve.add_argument(
        "--paired",
        action="store_true",
        help="every aircraft of the proxy for which this user has a key, see 'up-ground pair'",
    )
    _add_connection(serve, aircraft=False)
    serve.add_argument(
        "--metrics",
        type=whole_number(0, 65535),
        metavar="PORT",
        help="port on 127.0.0.1 of a page for Prometheus; 0: any free port (default: none)",
    )
    add_page_options(serve)


def _aircraft(text: str) -> str:
    if not AIRCRAFT_NAME.fullmatch(text):
        raise argparse.ArgumentTypeError(
            f"an aircraft's name must be {AIRCRAFT_NAME_RULE}: {text!r}"
        )
    return text


def _host(text: str) -> str:
    if not text.isprintable() or not text or " " in text or len(text) > 253:
        raise argparse.ArgumentTypeError(f"{text[:60]!r} cannot be a host")
    return text
