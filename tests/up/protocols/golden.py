"""The golden vectors and the types that each end expects, for these tests."""

import json
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from hypothesis import strategies as st

FOLDER = Path(__file__).parents[2] / "vectors"

# docs/protocols.md 2.4, by hand.
FROM_ARDUINO = {
    ord(letter): size
    for letter, size in {
        "r": 8, "i": 13, "o": 12, "O": 26, "x": 23, "K": 2, "!": 3, "m": 1, "T": 48, "G": 72,
        "C": 54, "s": 0, "a": 0, "d": 0, "h": 2, "b": 2, "B": 2, "l": 8, "p": 3, "t": 48,
    }.items()
}  # fmt: skip
# docs/protocols.md 2.3, by hand.
TO_ARDUINO = {
    ord(letter): size
    for letter, size in {
        "s": 0, "a": 0, "d": 0, "M": 1, "m": 0, "p": 3, "t": 48, "T": 0, "g": 72, "G": 0, "h": 2,
        "b": 2, "B": 2, "l": 8, "u": 10, "S": 10, "R": 10, "v": 1, "C": 54, "c": 0, "e": 1,
        "V": 2, "A": 2,
    }.items()
}  # fmt: skip
SIZES = {"from_arduino": FROM_ARDUINO, "to_arduino": TO_ARDUINO}


def load(name: str) -> dict[str, Any]:
    return json.loads((FOLDER / name).read_text())


def vectors(name: str) -> list[dict[str, Any]]:
    return load(name)["vectors"]


def cut(data: bytes, cuts: Iterable[int]) -> list[bytes]:
    """Return `data` in pieces, cut at the given places."""
    places = sorted({place % (len(data) + 1) for place in cuts})
    return [data[start:end] for start, end in zip([0, *places], [*places, len(data)], strict=True)]


places = st.lists(st.integers(0, 100_000), max_size=12)
