"""The keys of this device, one for each aircraft, in a file that only this user may read."""

from __future__ import annotations

import secrets
import sys
from pathlib import Path

from up.config.atomic_writer import write_atomically
from up.errors import UserError
from up.protocols.pairing import Pairing, parse_pairing

FILE = "keys.txt"
PAGE_FILE = "page.key"


class KeyStore:
    """One pairing text a line; methods raise UserError for a file that others may read."""

    def __init__(self, folder: Path) -> None:
        self._path = folder / FILE

    def get(self, aircraft: str) -> Pairing | None:
        """Return the key for an aircraft; None: its link stays plain."""
        return self.all().get(aircraft)

    def all(self) -> dict[str, Pairing]:
        try:
            lines = _read_secrets(self._path).splitlines()
        except FileNotFoundError:
            return {}
        found = [parse_pairing(line) for line in lines]
        if None in found:
            text = f"{self._path}: line {found.index(None) + 1} is not a pairing text; remove it"
            raise UserError(text, "pairing_invalid")
        return {each.aircraft: each for each in found if each is not None}

    def put(self, pairing: Pairing) -> None:
        self._write({**self.all(), pairing.aircraft: pairing})

    def forget(self, aircraft: str) -> bool:
        """Remove the key of an aircraft; return whether there was one."""
        known = self.all()
        if known.pop(aircraft, None) is None:
            return False
        self._write(known)
        return True

    def _write(self, known: dict[str, Pairing]) -> None:
        _write_secrets(self._path, "".join(f"{each.encode()}\n" for each in known.values()))


def page_key(folder: Path) -> tuple[str, str]:
    """Return the key of this user's pages, made at the first call, and where a user finds it.

    Raises UserError for a file that others may read, OSError for one that cannot be written.
    """
    path = folder / PAGE_FILE
    try:
        key = _read_secrets(path).strip()
    except FileNotFoundError:
        key = secrets.token_urlsafe(12)
        _write_secrets(path, f"{key}\n")
    if not key:
        raise UserError(f"{path}: the key is missing; remove the file", "page_key_missing")
    # A terminal keeps no log.
    return key, f"the key {key}" if sys.stdout.isatty() else f"the key in {path}"


def _read_secrets(path: Path) -> str:
    if path.stat().st_mode & 0o077:
        text = f"{path}: others may read these secrets: run 'chmod 600 {path}'"
        raise UserError(text, "secrets_readable")
    return path.read_text(encoding="ascii", errors="replace")


def _write_secrets(path: Path, text: str) -> None:
    path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
    write_atomically(path, text.encode("ascii"), 0o600)
