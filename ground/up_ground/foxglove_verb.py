"""``up-ground foxglove``: its options."""

from __future__ import annotations

import argparse
from importlib.util import find_spec
from typing import Any

from up.cli.cli_error import UsageError
from up.cli.verb import add_verb
from up_ground.settings import Seat

DEFAULT_LISTEN = "127.0.0.1:8765"
_EPILOG = """\
In Foxglove: Open connection, Foxglove WebSocket, ws://localhost:8765. The
topics and their fields are those of the flight log. Clients only watch: what
they publish is refused, and this ground never requests control.

Everybody who reaches the port reads the telemetry, the position included.
"""


def add_foxglove(verbs: Any) -> None:
    """Add the verb."""
    text = "show live telemetry in Foxglove"
    verb = add_verb(verbs, "foxglove", "up_ground.foxglove_verb:serve", text, epilog=_EPILOG)
    verb.add_argument(
        "--listen", default=DEFAULT_LISTEN, metavar="ADDRESS:PORT", help="default %(default)s"
    )


def serve(options: argparse.Namespace) -> int:
    """Serve until it is interrupted."""
    if find_spec("foxglove") is None:
        text = "this needs the Python package foxglove-sdk: pip install 'raspilot[foxglove]'"
        raise UsageError(text, "package_missing")
    from up_ground.arguments import peer_of
    from up_ground.foxglove_server import FoxgloveServer
    from up_ground.one_shot_task import run
    from up_ground.web.listen_address import parse_listen

    try:
        listen = parse_listen(options.listen)
    except ValueError as error:
        raise UsageError(str(error), "invalid_listen") from None
    peer = peer_of(options, Seat.LISTEN)
    return run(lambda reactor: FoxgloveServer(reactor, *peer, listen))
