"""``up-ground mavlink``: its options."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from up.cli.cli_error import UsageError
from up.cli.option_parser import whole_number
from up.cli.verb import add_verb
from up_ground.settings import Seat
from up_mavlink.address import Address, read_address
from up_mavlink.personas import ARDUPILOT, BY_NAME, PERSONAS

DEFAULT_URL = "udpout:127.0.0.1:14550"
_EPILOG = """\
URL is where ground stations that speak MAVLink connect:
  udpout:127.0.0.1:14550   QGroundControl on this computer (default)
  udpin:127.0.0.1:14551    waits for MAVProxy, MAVSDK or QGroundControl
  tcpin:127.0.0.1:5760     the same by TCP

The bridge requests control while heartbeats of a MAVLink ground station arrive
and control is free; the role is that of this ground's link or key. On an
address other than loopback it needs --signing-key or --watch-only.
"""


def add_mavlink(verbs: Any) -> None:
    """Add the verb."""
    text = "let QGroundControl, MAVProxy, MAVSDK and Mission Planner use this link"
    verb = add_verb(verbs, "mavlink", "up_ground.mavlink_verb:bridge", text, epilog=_EPILOG)
    verb.add_argument("url", nargs="?", default=DEFAULT_URL, type=_address, metavar="URL")
    verb.add_argument("--persona", choices=PERSONAS, default=ARDUPILOT, help="default %(default)s")
    verb.add_argument(
        "--signing-key",
        type=Path,
        metavar="FILE",
        help="passphrase of MAVLink 2 signatures; packets without one are dropped",
    )
    verb.add_argument(
        "--system-id", type=whole_number(1, 250), default=1, metavar="N", help="default 1"
    )
    verb.add_argument("--watch-only", action="store_true", help="carry out no command")


def bridge(options: argparse.Namespace) -> int:
    """Run the bridge until it is interrupted."""
    from up_ground.arguments import peer_of
    from up_ground.mavlink_bridge import MAVLinkBridge
    from up_ground.one_shot_task import run
    from up_mavlink.endpoint import Settings
    from up_mavlink.signing import read_key

    address, is_plain = options.url, options.signing_key is None
    if is_plain and not options.watch_only and not address.stays_here:
        text = f"anybody could send commands to {address}: use --signing-key or --watch-only"
        raise UsageError(text, "unsigned")
    key = None if is_plain else read_key(options.signing_key)
    persona = BY_NAME[options.persona]
    served = Settings(address, persona, options.system_id, key, None)
    peer = peer_of(options, Seat.LISTEN)
    return run(
        lambda reactor: MAVLinkBridge(reactor, *peer, served, is_watching=options.watch_only)
    )


def _address(text: str) -> Address:
    try:
        return read_address(text)
    except ValueError as error:
        raise argparse.ArgumentTypeError(str(error)) from error
