"""``up-ground pair``: stores the key that ``up keys add`` printed."""

from __future__ import annotations

import argparse
import getpass
import json
import os
import sys
from typing import Any

from up.cli.cli_error import UsageError
from up.cli.option_parser import EXIT_OK, add_json_option
from up.cli.verb import add_verb
from up.output import echo
from up.protocols.pairing import parse_pairing
from up_ground.key_store import KeyStore
from up_ground.token_store import state_folder

_EPILOG = """\
'up keys add' on the aircraft prints a pairing text and its QR code. Paste the
text here; it is read from the terminal or a pipe, never from the command line,
which other users of this machine can see.

examples
  up-ground pair
  up-ground pair --list
  up-ground pair --forget glider-1
"""


def add_pair(verbs: Any) -> None:
    """Add the verb."""
    text = "store a key for protected messages with an aircraft"
    pair = add_verb(verbs, "pair", "up_ground.pair:pair", text, epilog=_EPILOG)
    action = pair.add_mutually_exclusive_group()
    action.add_argument("--list", action="store_true", help="list the keys, without secrets")
    action.add_argument("--forget", metavar="AIRCRAFT", help="remove the key of this aircraft")
    add_json_option(pair)


def pair(options: argparse.Namespace) -> int:
    """Store, list or remove keys of this user."""
    store = KeyStore(state_folder(os.environ))
    if options.list:
        keys = store.all().values()
        if options.json:
            names = ("aircraft", "name", "role", "key_id")
            rows = [{name: getattr(each, name) for name in names} for each in keys]
            echo(json.dumps(rows, indent=1))
            return EXIT_OK
        for each in keys:
            echo(f"{each.aircraft}: key {each.name} ({each.role}), id {each.key_id}")
        return EXIT_OK
    if options.forget is not None:
        if not store.forget(options.forget):
            raise UsageError(f"no key for the aircraft {options.forget!r}", "key_unknown")
        echo(f"the key for {options.forget} is removed", "key_removed", aircraft=options.forget)
        return EXIT_OK
    is_terminal = sys.stdin is not None and sys.stdin.isatty()
    text = getpass.getpass("pairing text (not shown): ") if is_terminal else sys.stdin.readline()
    pairing = parse_pairing(text)
    if pairing is None:
        raise UsageError("this is not a pairing text of 'up keys add'", "pairing_invalid")
    store.put(pairing)
    words = f"paired with {pairing.aircraft} as {pairing.name} ({pairing.role})"
    echo(words, "paired", aircraft=pairing.aircraft, key=pairing.name, role=pairing.role)
    return EXIT_OK
