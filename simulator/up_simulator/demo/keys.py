"""The end-to-end keys of a run: the aircraft's keys.yml, and the store of its ground station."""

from __future__ import annotations

from pathlib import Path

from up.config.keys_file import KEYS, add_key, find_key
from up.protocols.pairing import Pairing
from up_ground.key_store import KeyStore
from up_ground.settings import DEFAULT_AIRCRAFT

NAME = "ground"
"""Name of the ground station's key."""


def pair_ground(config: Path, state: Path) -> Pairing:
    """Return the key of the ground station, made at the first run; later runs keep every key.

    ``state`` is the ground station's folder. Raises UserError for faulty files of keys.
    """
    known = KEYS.load(config).keys.values()
    if all(each.revoked for each in known if each.name == NAME):
        add_key(config, NAME, "pilot")
    key_id, key = find_key(config, NAME)
    pairing = Pairing(DEFAULT_AIRCRAFT, key_id, key.secret, key.role, key.name)
    KeyStore(state).put(pairing)
    return pairing


def unpair_ground(state: Path) -> None:
    """Let the ground station take plain lines; the aircraft keeps its keys. Raises UserError."""
    KeyStore(state).forget(DEFAULT_AIRCRAFT)
