"""Names of at most 16 characters for the keys of configuration files."""

from __future__ import annotations

import re
from collections.abc import Iterable

MAX_NAME = 16


def names_of(keys: Iterable[tuple[str, str]]) -> dict[str, tuple[str, str]]:
    """Return file and key by a name: their words, the longest ones cut until it fits.

    A name depends on its key alone, unless another key has the same one: then the later one, in the
    order of the alphabet, ends with a number.
    """
    found: dict[str, tuple[str, str]] = {}
    for file, key in sorted(keys):
        words = re.split(r"[^A-Za-z0-9]+", f"{file.removesuffix('.yml')} {key}".upper())
        while len("_".join(words)) > MAX_NAME and max(map(len, words)) > 1:
            place = max(range(len(words)), key=lambda each: len(words[each]))
            words[place] = words[place][:-1]
        first = name = "_".join(words)[:MAX_NAME]
        number = 1
        while name in found:
            number += 1
            name = f"{first[: MAX_NAME - len(str(number))]}{number}"
        found[name] = (file, key)
    return found
