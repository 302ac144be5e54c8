"""Finds the next record after a damaged position in a file: a bad block of a memory card."""

from __future__ import annotations

import re

from up.flight_log.mcap_format import CHUNK, MESSAGE, RECORD, U32, U64, Opcode

CONFIRMATION_RECORDS = 3
"""This many whole records must follow each other: text never looks like that."""
MAX_LENGTH = 64 * 1024
"""Maximum length of a record accepted here; the records of a flight are far shorter."""
MAX_RECORD = 16 * 1024 * 1024
"""Longer records (except chunks, which are walked) are skipped."""
_LIKELY = re.compile(rb"[\x03-\x06\x09\x0c][\s\S]{3}\0{5}")
"""Schemas, channels, messages, chunks, attachments, metadata."""
LAST = int(max(Opcode))
_LEAST = {Opcode.MESSAGE: MESSAGE.size, Opcode.CHUNK: CHUNK.size + U32.size + U64.size}


def find_records(buffer: bytes, begin: int) -> int:
    """Return where, from ``begin`` on, a record and its followers begin; -1: nowhere.

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
        limit = MAX_RECORD if opcode == Opcode.CHUNK else MAX_LENGTH
        if not 1 <= opcode <= LAST or not _LEAST.get(opcode, 0) <= length <= limit:
            return False
        at += RECORD.size + length
    return at <= len(buffer)
