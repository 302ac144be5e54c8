"""What stands before the records of a chunk."""

from __future__ import annotations

from up.flight_log.mcap_format import CHUNK, U32, U64

_LONGEST_COMPRESSION = 64
LONGEST_HEAD = CHUNK.size + U32.size + _LONGEST_COMPRESSION + U64.size


def fault_of_chunk(head: bytes, length: int) -> tuple[str, int]:
    """Return what forbids to walk into a chunk, and where in its content the records begin."""
    damaged = "a chunk is damaged and passed over"
    at = CHUNK.size + U32.size
    if len(head) < at:
        return damaged, 0
    (size,) = U32.unpack_from(head, CHUNK.size)
    begin = at + size + U64.size
    if size > _LONGEST_COMPRESSION or len(head) < begin:
        return damaged, 0
    if size:
        method = head[at : at + size].decode("ascii", "replace")
        return f"what is compressed ({method!a}) is not read: uncompress it with mcap's tools", 0
    if begin + U64.unpack_from(head, at)[0] > length:
        return damaged, 0
    return "", begin
