"""CPU of protected messages beside the same frames in plain, and mutated bodies.

A frame holds every field of schema/telemetry.yml. Encoding and decoding are parts of both sides of
a ratio: a link does them anyway.
"""

import random
from collections.abc import Iterable
from typing import Any

from bench.codecs import QUICK_ROUNDS, ROUNDS, Work, cpu_us
from bench.table import Row, compared, figure
from bench.timing import Limit
from up.commands.telemetry_schema import PROPERTIES
from up.protocols.aircraft_sessions import AircraftSessions, Key
from up.protocols.binary_line import to_body, to_line
from up.protocols.envelope import EnvelopeError, Stream
from up.protocols.general_message import decode, encode
from up.protocols.ground_session import GroundSession

FRAMES = 400
RATIO, MAC_US = 1.5, 6.0
MUTATED, QUICK_MUTATED = 1_000_000, 20_000
NAME = "up.telemetry.update"
KEY = Key(bytes(range(8)), bytes(range(32)), "tablet", "pilot")


def content(properties: dict[str, Any], draws: random.Random) -> dict[str, Any]:
    """Return a frame with every field of the schema."""
    values: dict[str, Any] = {
        "number": lambda: round(draws.uniform(-500, 500), 3),
        "boolean": lambda: draws.random() < 0.5,
        "string": lambda: "arduino",
        "array": lambda: ["no position"],
    }
    return {
        name: content(each["properties"], draws)
        if each["type"] == "object"
        else values[each["type"]]()
        for name, each in properties.items()
    }


def pair(secrecy: bool = False) -> tuple[AircraftSessions, GroundSession]:
    """Return both ends of a session."""
    air = AircraftSessions("glider-1", lambda: 0, secrecy=secrecy)
    air.replace_keys({KEY.id: KEY})
    ground = GroundSession("glider-1", KEY.id, KEY.secret)
    ground.secrecy = secrecy
    ground.on_handshake(air.answer(ground.hello())[1])
    return air, ground


def works(secrecy: bool = False) -> list[Work]:
    """Return encode plain and protected, decode plain and protected, the MAC alone, handshakes."""
    draws = random.Random(1)
    frames = [content(PROPERTIES, draws) for _ in range(20)] * (FRAMES // 20)
    air, ground = pair(secrecy)
    lines = [encode(NAME, each, None, 1) for each in frames]
    payload = lines[0][:-1]
    stream = Stream(bytes(32), b"telemetry", b"glider-1", b"", 1)

    def encode_plain() -> int:
        return len([encode(NAME, each, None, 1) for each in frames])

    def encode_protected() -> int:
        return len([to_line(air.seal_frame(encode(NAME, each, None, 1)[:-1])) for each in frames])

    def decode_plain() -> int:
        return len([decode(line[:-1]) for line in lines])

    sealed: list[bytes] = []

    def decode_protected() -> int:
        return len([decode(ground.open(to_body(line[:-1])) or b"") for line in sealed])

    def prepared() -> int:
        sealed[:] = [to_line(air.seal_frame(line[:-1])) for line in lines]
        return FRAMES

    def mac() -> int:
        for _ in range(FRAMES):
            stream.seal(payload)
        return FRAMES

    def handshakes() -> int:
        for _ in range(20):
            ground.on_handshake(air.answer(ground.hello())[1])
        return 20

    return [
        encode_plain, encode_protected, decode_plain, prepared, decode_protected, mac, handshakes
    ]  # fmt: skip


def accepted(count: int) -> int:
    """Return how many mutated bodies were accepted; any error but EnvelopeError is raised."""
    draws = random.Random(2)
    air, ground = pair()
    _, answer = air.answer(ground.hello())
    bodies = [ground.seal(b'{"name":"up.arm","id":"%d"}' % number) for number in range(8)]
    bodies += [ground.hello(), answer, air.seal_frame(b"{}"), air.seal_message(b"{}")]
    bodies.append(air.seal_frame(b"\x01key\x07"))
    found = 0
    for number in range(count):
        body = bytearray(bodies[number % len(bodies)])
        at = draws.randrange(len(body))
        if number % 3:
            body[at] ^= draws.randint(1, 255)
        else:
            del body[at:]
        for take in (air.open, ground.open, ground.on_handshake):
            try:
                found += take(bytes(body)) is not None
            except EnvelopeError:
                continue
    return found


def rows(quick: bool) -> Iterable[Row]:
    """Yield the figures."""
    rounds = QUICK_ROUNDS if quick else ROUNDS
    plain, encrypted, read, _, opened, *_ = cpu_us(*works(secrecy=True), rounds=rounds)
    limit = Limit(RATIO)
    yield compared("frame encoded and encrypted, CPU", "us", encrypted, "plain", plain, limit)
    yield compared("frame decrypted and decoded, CPU", "us", opened, "plain", read, limit)
    found = cpu_us(*works(), rounds=rounds)
    plain, protected, read, _, opened, mac, handshakes = found
    yield compared("frame encoded and protected, CPU", "us", protected, "plain", plain, limit)
    yield compared("frame opened and decoded, CPU", "us", opened, "plain", read, limit)
    yield compared("of that the MAC, CPU", "us", mac, limit=Limit(MAC_US))
    yield compared("handshake, both ends, CPU", "us", handshakes)
    count = QUICK_MUTATED if quick else MUTATED
    wrong = accepted(count)
    yield Row(f"accepted of {count} mutated bodies", figure(wrong), target="0", met=wrong == 0)
