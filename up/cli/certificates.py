"""``up certificates``: a private CA, and the certificates of relays, aircraft and grounds."""

from __future__ import annotations

import argparse
import datetime as dt
import json
from typing import TYPE_CHECKING

from up.cli.cli_error import CliError
from up.cli.option_parser import EXIT_OK
from up.output import echo

if TYPE_CHECKING:
    from up.tls.authority import Authority, Issued

SOON_DAYS = 90
"""`renew` without names renews what expires within this time."""


def init(values: argparse.Namespace) -> int:
    """Make the CA."""
    authority = _authority(values)
    authority.create(values.name)
    echo(f"{authority.folder}/ca-key.pem signs certificates: keep it secret, off the devices")
    echo(f"made a CA in {authority.folder}", "ca_made", folder=str(authority.folder))
    return EXIT_OK


def device(values: argparse.Namespace) -> int:
    """Make the key and the certificate of a device."""
    folder = _authority(values).issue(values.name, values.host or (), values.days)
    echo(
        f"copy the folder {folder} to the device, over a channel that nobody else reads",
        "device_made",
        name=values.name,
        folder=str(folder),
    )
    return EXIT_OK


def show(values: argparse.Namespace) -> int:
    """List every certificate ever issued."""
    found = _authority(values).issued()
    if values.json:
        echo(json.dumps([_fields(each) for each in found], indent=1))
        return EXIT_OK
    for each in found:
        state = "revoked" if each.is_revoked else f"{_days_left(each)} days left"
        echo(f"{each.name:<32} {state:<16} {' '.join(each.hosts) or 'client'}")
    return EXIT_OK


def revoke(values: argparse.Namespace) -> int:
    """Revoke the certificates of a device."""
    authority = _authority(values)
    count = authority.revoke(values.name)
    text = f"revoked {count} of {values.name}: copy {authority.folder}/revoked.pem to every server"
    echo(text, "revoked", name=values.name, count=count)
    return EXIT_OK


def renew(values: argparse.Namespace) -> int:
    """Make new certificates for devices, or for all whose certificates expire soon."""
    authority = _authority(values)
    newest = {each.name: each for each in authority.issued() if not each.is_revoked}
    soon = [name for name, each in newest.items() if _days_left(each) <= SOON_DAYS]
    for name in values.names or soon:
        folder = authority.renew(name, values.days)
        echo(f"copy the folder {folder} to the device", "renewed", name=name, folder=str(folder))
    if not values.names and not soon:
        echo(f"no certificate expires within {SOON_DAYS} days", "nothing_to_renew")
    return EXIT_OK


def _authority(values: argparse.Namespace) -> Authority:
    try:
        from up.tls.authority import Authority
    except ModuleNotFoundError as error:
        raise CliError(
            f"certificates need the Python package {error.name}, which is not installed:"
            " pip install 'raspilot[tls]', or apt install python3-cryptography",
            code="import_missing",
            module=error.name,
        ) from None
    return Authority(values.folder)


def _days_left(each: Issued) -> int:
    return (each.not_after - dt.datetime.now(dt.UTC)).days


def _fields(each: Issued) -> dict[str, object]:
    return {
        "name": each.name,
        "serial": f"{each.serial:x}",
        "not_after": each.not_after.isoformat(),
        "hosts": each.hosts,
        "revoked": each.is_revoked,
    }
