"""The speed of the codecs, beside peers that are measured in the same run.

All figures are CPU time of this process for one frame, in alternating rounds of ours and the peers.
The garbage collector is off, as in the daemon.
"""

import gc
import random
import struct
import time
from collections.abc import Callable, Iterable
from importlib import import_module

from crsf_cog.frames import CHANNELS, CrsfDecoder, channels_us, frame

from bench.table import Row, compared, figure
from bench.timing import Limit, Spread
from up.protocols.checked_framing import CheckedDecoder, CheckedEncoder
from up.protocols.orientation_forward import OrientationDecoder

FRAMES = 6000
ROUNDS, QUICK_ROUNDS = 25, 3
READ_SIZE = 4096
TCP_READ_SIZE = 65536
TABLE_TARGET = 1.5
PYMAVLINK_TARGET = 7.0
ORIENTATION_TARGET, SINGLE_TARGET = 6.0, 1.0
CRSF_TARGET = 4.0

# The frames of an Arduino in each period: outputs, inputs, orientation.
SIZES = {ord("r"): 8, ord("i"): 13, ord("O"): 26}

Work = Callable[[], int]


def cpu_us(*works: Work, rounds: int = ROUNDS) -> list[list[float]]:
    """Return the CPU time in us that each work takes for one of its frames, in each round."""
    found: list[list[float]] = [[] for _ in works]
    gc.collect()
    gc.disable()
    try:
        for _ in range(rounds):
            for figures, work in zip(found, works, strict=True):
                began = time.process_time()
                frames = work()
                figures.append((time.process_time() - began) / frames * 1e6)
    finally:
        gc.enable()
    return found


def serial_payloads() -> list[tuple[int, bytes]]:
    draws = random.Random(1)
    payloads: list[tuple[int, bytes]] = []
    for number in range(FRAMES // 3):
        pulses = [draws.randint(1000, 2000) for _ in range(6)]
        angles = [draws.uniform(-90, 90) for _ in range(6)]
        payloads.append((ord("r"), struct.pack(">4H", *pulses[:4])))
        payloads.append((ord("i"), struct.pack(">6HB", *pulses, 0x3F)))
        payloads.append((ord("O"), struct.pack(">H6f", number, *angles)))
    return payloads


def cut(data: bytes, size: int) -> list[bytes]:
    return [data[start : start + size] for start in range(0, len(data), size)]


def checked_work(payloads: list[tuple[int, bytes]]) -> Work:
    """Return the parsing of checked frames, CRC and all."""
    encoder = CheckedEncoder()
    pieces = cut(b"".join(encoder.encode(*each) for each in payloads), READ_SIZE)

    def work() -> int:
        decoder = CheckedDecoder(SIZES)
        frames = sum(len(decoder.feed(piece)) for piece in pieces)
        if frames != len(payloads):
            raise AssertionError("our decoder lost frames")
        return frames

    return work


def table_work(payloads: list[tuple[int, bytes]]) -> Work:
    """Return the parsing of bare frames by a table of sizes: no check, no resynchronisation."""
    pieces = cut(b"".join(bytes((type_,)) + payload for type_, payload in payloads), READ_SIZE)

    def work() -> int:
        tail = b""
        count = 0
        for piece in pieces:
            buffer = tail + piece
            end = len(buffer)
            position = 0
            frames = []
            while position < end:
                following = position + 1 + SIZES[buffer[position]]
                if following > end:
                    break
                frames.append((buffer[position], buffer[position + 1 : following]))
                position = following
            tail = buffer[position:]
            count += len(frames)
        return count

    return work


def pymavlink_work() -> Work | None:
    """Return the parsing of MAVLink 2 ATTITUDE (28 bytes) by pymavlink; None if not installed."""
    try:
        common = import_module("pymavlink.dialects.v20.common")
    except ImportError:
        return None
    draws = random.Random(2)
    sender = common.MAVLink(None, srcSystem=1, srcComponent=1)
    messages = (
        common.MAVLink_attitude_message(number, *[draws.uniform(-1, 1) for _ in range(6)])
        for number in range(FRAMES // 3)
    )
    wire: list[bytes] = []
    for message in messages:
        wire.append(bytes(message.pack(sender)))
        sender.seq = (sender.seq + 1) % 256
    pieces = cut(b"".join(wire), READ_SIZE)

    def work() -> int:
        receiver = common.MAVLink(None)
        frames = sum(len(receiver.parse_buffer(piece) or ()) for piece in pieces)
        if frames != len(wire):
            raise AssertionError("pymavlink lost frames")
        return frames

    return work


def orientation_wire(count: int) -> bytes:
    draws = random.Random(3)
    return b"".join(
        struct.pack(">6f", *[draws.uniform(-180, 180) for _ in range(6)]) for _ in range(count)
    )


def orientation_work(pieces: list[bytes]) -> Work:
    """Return our decoding, limits checked."""

    def work() -> int:
        decoder = OrientationDecoder()
        count = 0
        # A loop like the prototype's: a generator costs a tenth of a frame.
        for piece in pieces:
            count += len(decoder.feed(piece))
        return count

    return work


def prototype_work(pieces: list[bytes]) -> Work:
    """Return the prototype's method: cut each frame off the front of the buffer, no checks."""

    def work() -> int:
        buffer = b""
        count = 0
        for piece in pieces:
            buffer += piece
            frames = []
            while len(buffer) >= 24:
                frames.append(struct.unpack("!ffffff", buffer[:24]))
                buffer = buffer[24:]
            count += len(frames)
        return count

    return work


def serial_rows(rounds: int) -> Iterable[Row]:
    payloads = serial_payloads()
    mavlink = pymavlink_work()
    works = [checked_work(payloads), table_work(payloads)] + ([mavlink] if mavlink else [])
    ours, table, *others = cpu_us(*works, rounds=rounds)
    what = "checked serial frame, parse"
    yield compared(what, "us", ours, "table parser, unchecked", table, Limit(TABLE_TARGET))
    theirs = others[0] if others else ()
    yield compared(what, "us", ours, "pymavlink", theirs, Limit(PYMAVLINK_TARGET, is_minimum=True))


def orientation_rows(rounds: int) -> Iterable[Row]:
    for what, size, limit in (
        (
            f"orientation over TCP, reads of {TCP_READ_SIZE // 1024} KiB",
            TCP_READ_SIZE,
            Limit(ORIENTATION_TARGET, is_minimum=True),
        ),
        ("orientation over TCP, a frame a read", 24, Limit(SINGLE_TARGET)),
    ):
        pieces = cut(orientation_wire(FRAMES if size == 24 else 4 * size // 24), size)
        ours, naive = cpu_us(orientation_work(pieces), prototype_work(pieces), rounds=rounds)
        yield compared(what, "us", ours, "the prototype's way", naive, limit)


def crsf_work(pieces: list[bytes]) -> Work:
    """Return our parsing of CRSF frames: address, length, CRC, the 16 channels."""

    def work() -> int:
        decoder = CrsfDecoder()
        return sum(
            len(channels_us(payload)) // 16
            for piece in pieces
            for _, payload in decoder.feed(piece)
        )

    return work


def bare_crsf_work(pieces: list[bytes]) -> Work:
    """Return the bare parsing: whole frames of the expected size, nothing checked."""
    shifts = range(0, 176, 11)

    def work() -> int:
        count = 0
        for piece in pieces:
            bits = int.from_bytes(piece[3:25], "little")
            count += len([bits >> shift & 0x7FF for shift in shifts]) // 16
        return count

    return work


def crsf_rows(rounds: int) -> Iterable[Row]:
    draws = random.Random(4)
    pieces = [frame(CHANNELS, draws.randbytes(22)) for _ in range(FRAMES)]
    ours, bare = cpu_us(crsf_work(pieces), bare_crsf_work(pieces), rounds=rounds)
    what = "CRSF frame of 16 channels, parse"
    yield compared(what, "us", ours, "bare parser, unchecked", bare, Limit(CRSF_TARGET))
    per_percent = 1e4 / Spread.of(ours).median
    yield Row("CRSF frames parsed for 1 % CPU", figure(per_percent, "1/s"))


def rows(quick: bool = False) -> Iterable[Row]:
    rounds = QUICK_ROUNDS if quick else ROUNDS
    yield from serial_rows(rounds)
    yield from orientation_rows(rounds)
    yield from crsf_rows(rounds)
