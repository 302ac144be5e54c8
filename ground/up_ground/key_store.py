"""The keys of this device, one for each aircraft, in a file that only this user may read."""

from __future__ import annotations

from pathlib import Path

from up.config.atomic_writer import write_atomically
from up.errors import UserError
from up.protocols.pairing import Pairing, parse_pairing

FILE = "keys.txt"


class KeyStore:
    """One pairing text a line; methods raise UserError for a file that others may read."""

    def __init__(self, folder: Path) -> None:
        self._path = folder / FILE

    def get(self, aircraft: str) -> Pairing | None:
        """Return the key for an aircraft; None: its link stays plain."""
        return self.all().get(aircraft)

    def all(self) -> dict[str, Pairing]:
        """Return all keys by aircraft."""
        try:
            if self._path.stat().st_mode & 0o077:
                text = f"{self._path}: others may read these secrets: run 'chmod 600 {self._path}'"
                raise UserError(text, "secrets_readable")
            lines = self._path.read_text(encoding="ascii", errors="replace").splitlines()
        except FileNotFoundError:
            return {}
        found = [parse_pairing(line) for line in lines]
        if None in found:
            text = f"{self._path}: line {found.index(None) + 1} is not a pairing text; remove it"
            raise UserError(text, "pairing_invalid")
        return {each.aircraft: each for each in found if each is not None}

    def put(self, pairing: Pairing) -> None:
        """Keep a key, in place of an older one of that aircraft."""
        self._write({**self.all(), pairing.aircraft: pairing})

    def forget(self, aircraft: str) -> bool:
        """Remove the key of an aircraft; return whether there was one."""
        known = self.all()
        if known.pop(aircraft, None) is None:
            return False
        self._write(known)
        return True

    def _write(self, known: dict[str, Pairing]) -> None:
        self._path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        text = "".join(f"{each.encode()}\n" for each in known.values())
        write_atomically(self._path, text.encode("ascii"), 0o600)
