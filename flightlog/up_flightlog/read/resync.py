"""Finds the next record after a damaged position in a file: a bad block of a memory card."""

from __future__ import annotations

import re

from up.flight_log.mcap_format import MESSAGE, RECORD, Opcode

CONFIRMATION_RECORDS = 3
"""This many whole records must follow each other: text never looks like that."""
MAX_LENGTH = 64 * 1024
"""Maximum length of a record accepted here; the records of a flight are far shorter."""
MAX_RECORD = 16 * 1024 * 1024
"""Longer records (except chunks, which are walked) are skipped."""
_LIKELY = re.compile(rb"\x05[\s\S]{3}\0{5}")
LAST = int(max(Opcode))


def find_messages(buffer: bytes, begin: int) -> int:
    """Return where, from ``begin`` on, a message and its followers begin; -1 if not found.

    All of them must lie in the buffer.
    """
    for likely in _LIKELY.finditer(buffer, begin):
        if _is_run(buffer, likely.start()):
            return likely.start()
    return -1


def may_follow(head: bytes, left: int) -> bool:
    """Return whether a record can begin with these bytes where ``left`` bytes are left."""
    if len(head) < RECORD.size:
        return True
    opcode: int
    length: int
    opcode, length = RECORD.unpack_from(head)
    # A truncated record no longer fits, but its length is plausible.
    return opcode != 0 and length <= max(left, MAX_RECORD)


def _is_run(buffer: bytes, at: int) -> bool:
    for _ in range(CONFIRMATION_RECORDS):
        if at + RECORD.size > len(buffer):
            return False
        opcode, length = RECORD.unpack_from(buffer, at)
        if not 1 <= opcode <= LAST or length > MAX_LENGTH:
            return False
        if opcode == Opcode.MESSAGE and length < MESSAGE.size:
            return False
        at += RECORD.size + length
    return at <= len(buffer)
