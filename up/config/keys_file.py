"""keys.yml: the paired devices that may open protected sessions (docs/security.md)."""

import os
import re
import secrets
from collections.abc import Iterator
from dataclasses import replace
from datetime import date
from pathlib import Path
from typing import Literal

from up.config.atomic_writer import write_atomically
from up.config.file import ConfigFile
from up.config.schema import key, mapping
from up.errors import UserError
from up.fields import Constraint
from up.quick_dataclass import dataclass
from up.system.aircraft_name import AIRCRAFT_NAME, AIRCRAFT_NAME_RULE

MAX_KEYS = 64
KEY_ID = re.compile(r"[0-9a-f]{16}")
SECRET = re.compile(r"[0-9a-f]{64}")
KeyRole = Literal["observer", "operator", "pilot", "admin"]


@dataclass(frozen=True, slots=True)
class KeyConfig:
    """One paired device."""

    secret: str = key("", "32 bytes in hexadecimal digits.", is_secret=True)
    role: KeyRole = key("observer", "Permissions of the device.")
    name: str = key("", "Name of the device, for logs and screens.", max_length=32)
    not_after: str = key("", "Last day of the key, YYYY-MM-DD (UTC). Empty: no end.", max_length=10)
    revoked: bool = key(False, "Whether the device is refused.")
    aircraft: str = key(
        "", "Aircraft that the key is for. Empty: every one that reads this file.", max_length=32
    )

    def problems(self) -> Iterator[tuple[str, str]]:
        if not SECRET.fullmatch(self.secret):
            yield (
                "secret",
                "must be 64 hexadecimal digits: pair the device again with 'up keys add'",
            )
        for attribute, name in (("name", self.name), ("aircraft", self.aircraft or self.name)):
            if not AIRCRAFT_NAME.fullmatch(name):
                yield attribute, f"must be {AIRCRAFT_NAME_RULE}"
        if self.not_after and _day(self.not_after) is None:
            yield "not_after", f"must be a day such as 2027-12-31, not {self.not_after}"

    def refusal(self, today: date) -> str:
        """Return the code why the device is refused; empty for a valid key."""
        if self.revoked:
            return "revoked"
        last = _day(self.not_after)
        return "expired" if last is not None and today > last else ""


def _day(text: str) -> date | None:
    try:
        return date.fromisoformat(text)
    except ValueError:
        return None


@dataclass(frozen=True, slots=True)
class KeysConfig:
    """The paired devices. 'up keys' writes this file; its mode must be 600."""

    keys: dict[str, KeyConfig] = mapping(
        Constraint(str, max_length=16), KeyConfig, "Devices by key id.", max_length=MAX_KEYS
    )

    def problems(self) -> Iterator[tuple[str, str]]:
        if not all(KEY_ID.fullmatch(each) for each in self.keys):
            yield "keys", "a key id must be 16 hexadecimal digits"


KEYS = ConfigFile("keys.yml", KeysConfig, is_secret=True)


def save_keys(folder: Path, keys: dict[str, KeyConfig]) -> None:
    """Write keys.yml, which only its owner, that of the folder, may read; raises OSError."""
    path = Path(folder) / KEYS.filename
    write_atomically(path, KEYS.render(KeysConfig(keys)).encode(), 0o600)
    if os.geteuid() == 0:
        # The program does not run as root.
        owner = path.parent.stat()
        os.chown(path, owner.st_uid, owner.st_gid)


def add_key(
    folder: Path, name: str, role: KeyRole, not_after: str = "", aircraft: str = ""
) -> tuple[str, KeyConfig]:
    """Make a key with a fresh secret, and return it with its id; raises UserError."""
    known = dict(KEYS.load(folder).keys)
    if any(each.name == name and not each.revoked for each in known.values()):
        raise UserError(f"a key with the name {name} exists: revoke it first", "key_exists")
    if len(known) >= MAX_KEYS:
        raise UserError(f"{KEYS.filename}: at most {MAX_KEYS} keys", "too_many_keys")
    made = KeyConfig(secrets.token_hex(32), role, name, not_after, aircraft=aircraft)
    for attribute, problem in made.problems():
        raise UserError(f"{attribute}: {problem}", "key_invalid")
    key_id = secrets.token_hex(8)
    known[key_id] = made
    save_keys(folder, known)
    return key_id, made


def find_key(folder: Path, wanted: str) -> tuple[str, KeyConfig]:
    """Return the key with this id or name, a valid one first; raises UserError."""
    found = [
        (key_id, each)
        for key_id, each in KEYS.load(folder).keys.items()
        if wanted in (key_id, each.name)
    ]
    if not found:
        raise UserError(f"{folder / KEYS.filename}: no key {wanted!r}", "key_unknown")
    return min(found, key=lambda pair: pair[1].revoked)


def revoke_key(folder: Path, wanted: str) -> str:
    """Refuse a device from now on, and return its key id; raises UserError.

    Its secret stays, so that the aircraft can prove to the device that it is revoked.
    """
    key_id, found = find_key(folder, wanted)
    known = dict(KEYS.load(folder).keys)
    save_keys(folder, {**known, key_id: replace(found, revoked=True)})
    return key_id
