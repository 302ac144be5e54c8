"""``up keys``: the devices that may send protected Commands."""

import argparse
import json
import sys
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from up.cli.cli_error import CliError
from up.cli.option_parser import EXIT_OK
from up.cli.verbs import cog_files, system_of
from up.config.keys_file import KEYS, KeyConfig, add_key, find_key, revoke_key
from up.output import echo
from up.protocols.pairing import Pairing

MISSION_CONTROL = "mission_control.yml"


def add(values: argparse.Namespace) -> int:
    """Make a key for a device, and print what pairs the device."""
    folder = _folder(values)
    key_id, key = add_key(folder, values.name, values.role, values.not_after, _aircraft(values))
    text = f"{folder / KEYS.filename}: the key {key.name} ({key.role}) has the id {key_id}"
    echo(text, "key_added", key_id=key_id, name=key.name, role=key.role)
    _show(values, key_id, key)
    return EXIT_OK


def show(values: argparse.Namespace) -> int:
    """Print again what pairs a device."""
    key_id, key = find_key(_folder(values), values.name)
    if refusal := key.refusal(datetime.now(UTC).date()):
        raise CliError(f"the key {key.name} is {refusal}", code=f"key_{refusal}")
    _show(values, key_id, key)
    return EXIT_OK


def revoke(values: argparse.Namespace) -> int:
    """Refuse a device; a running program ends its sessions within half a second."""
    key_id = revoke_key(_folder(values), values.name)
    echo(f"the key {key_id} is revoked", "key_revoked", key_id=key_id)
    return EXIT_OK


def list_(values: argparse.Namespace) -> int:
    """List the keys without their secrets."""
    today = datetime.now(UTC).date()
    rows = [
        {
            "key_id": key_id,
            "name": key.name,
            "role": key.role,
            "aircraft": key.aircraft,
            "state": key.refusal(today) or "valid",
            "not_after": key.not_after,
        }
        for key_id, key in KEYS.load(_folder(values)).keys.items()
    ]
    if values.json:
        echo(json.dumps(rows, indent=1))
        return EXIT_OK
    for row in rows:
        until = f" until {row['not_after']}" if row["not_after"] else ""
        whose = row["aircraft"] or "every aircraft"
        echo(f"{row['key_id']}  {row['name']}  {row['role']}  {whose}  {row['state']}{until}")
    return EXIT_OK


def _folder(values: argparse.Namespace) -> Path:
    return system_of(values).context.config_folder


def _aircraft(values: argparse.Namespace) -> str:
    """Return the name that the program will have, by which the device knows it."""
    system = system_of(values)
    file = next(
        (each for each in cog_files(system.application) if each.filename == MISSION_CONTROL), None
    )
    named = "" if file is None else system.context.config(file).aircraft
    return str(values.aircraft or named or system.context.instance or "default")


def _show(values: argparse.Namespace, key_id: str, key: KeyConfig) -> None:
    """Print the pairing text and its QR code: to the user, never to a log."""
    aircraft = values.aircraft or key.aircraft or _aircraft(values)
    pairing = Pairing(aircraft, key_id, key.secret, key.role, key.name)
    text = pairing.encode()
    code = _qr_code(text, is_wanted=values.png is not None)
    sys.stdout.write(f"{text}\n")
    if code is None:
        echo("no QR code: pip install segno", "no_qr_code")
        return
    if sys.stdout.isatty():
        code.terminal(compact=True)
    if values.png is not None:
        values.png.touch(mode=0o600)
        code.save(str(values.png), kind="png", scale=6)


def _qr_code(text: str, *, is_wanted: bool) -> Any:
    try:
        import segno
    except ImportError:
        if is_wanted:
            raise CliError("a PNG needs segno: pip install segno", code="no_qr_code") from None
        return None
    return segno.make(text, micro=False)
