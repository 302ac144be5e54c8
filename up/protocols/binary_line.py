"""Lines that are not JSON: a type byte and binary data, on a link whose messages end with LF.

Packed telemetry, protected messages and handshakes travel so. In the line LF and ESC are two
bytes, ESC and the byte with bit 6 inverted; a relay sees whole lines. A message of JSON is a line
as it is.
"""

PACKED, PROTECTED, HANDSHAKE, SHORT = 0x01, 0x02, 0x03, 0x04
"""The first byte of such a line."""
TYPES = frozenset({PACKED, PROTECTED, HANDSHAKE, SHORT})
_ESC, _LF, _FLIP = b"\x1b", b"\n", 0x40
_ESC_CODED, _LF_CODED = _ESC + bytes((_ESC[0] ^ _FLIP,)), _ESC + bytes((_LF[0] ^ _FLIP,))


def to_line(body: bytes) -> bytes:
    """Return the line of a body, with its LF: JSON as it is, binary data escaped."""
    if body[:1] and body[0] in TYPES:
        body = body.replace(_ESC, _ESC_CODED).replace(_LF, _LF_CODED)
    return body + _LF


def to_body(line: bytes) -> bytes:
    """Return the body of a line without its LF; raises ValueError for a wrong escape."""
    if not line or line[0] not in TYPES or _ESC not in line:
        return line
    first, *rest = line.split(_ESC)
    parts = [first]
    for each in rest:
        code = _ESC + each[:1]
        if code not in (_ESC_CODED, _LF_CODED):
            raise ValueError("an escape of a binary line is wrong")
        parts.append(bytes((code[1] ^ _FLIP,)) + each[1:])
    return b"".join(parts)
