"""Envelope and handshake: golden vectors, order, and mutated bodies that are all refused."""

import json
import random
from pathlib import Path

import pytest

from up.protocols import handshake
from up.protocols.aircraft_sessions import IDLE_MS, SESSIONS_PER_KEY, AircraftSessions, Key, Session
from up.protocols.binary_line import to_body, to_line
from up.protocols.envelope import HEADER_BYTES, MAC_BYTES, EnvelopeError, Stream, expand, extract
from up.protocols.ground_session import GroundSession
from up.protocols.handshake import Answer, Refusal
from up.protocols.line_decoder import LineDecoder

VECTORS = json.loads(Path("tests/vectors/envelope.json").read_text(encoding="utf-8"))
ATTITUDE = bytes.fromhex("01031d8107120503 01f4ff85002d0e0ffe")
KEY = Key(bytes(range(8)), bytes(range(32)), "tablet", "pilot")


class Drawn:
    """Random bytes that a test knows: 0x10, 0x11, ... repeated."""

    def __init__(self, first):
        self._next = first

    def __call__(self, size):
        self._next += 1
        return bytes([self._next]) * size


def pair(key=KEY, aircraft="glider-1"):
    air = AircraftSessions(aircraft, lambda: 123456, Drawn(0x20))
    air.replace_keys({key.id: key})
    ground = GroundSession(aircraft, key.id, key.secret, Drawn(0x10))
    return air, ground


def opened(**more):
    air, ground = pair(**more)
    session, reply = air.answer(ground.hello())
    ground.on_handshake(reply)
    return air, ground, session


def test_the_golden_vectors():
    """Every byte of a session, as tests/vectors/README.md describes it."""
    air, ground = pair()
    hello = ground.hello()
    session, answer = air.answer(hello)
    said = ground.on_handshake(answer)
    command = ground.seal(b'{"name":"up.arm"}')
    found = {
        "hello": hello,
        "answer": answer,
        "command": command,
        "ack": session.answers.seal(b'{"name":"up.ack"}'),
        "telemetry": air.seal_frame(b'{"name":"up.telemetry.update"}'),
        "attitude": air.seal_frame(ATTITUDE),
        "message": air.seal_message(b'{"name":"up.system.state"}'),
        "refusal": air.replace_keys({})[0][1][1],
        "line": to_line(command),
    }
    assert isinstance(said, Answer)
    assert {name: body.hex() for name, body in found.items()} == VECTORS["session"]
    assert ground.open(found["telemetry"]) == b'{"name":"up.telemetry.update"}'
    assert ground.open(found["attitude"]) == ATTITUDE


def test_hkdf_is_that_of_rfc_5869():
    """Test case 1 of the RFC, as far as one block goes."""
    root = extract(bytes(range(13)), b"\x0b" * 22)
    assert root.hex() == "077709362c2e32df0ddc3f0dc47bba6390b6c73bb50f9c3122ec844ad7c2b3e5"
    assert expand(root).hex() == VECTORS["expand_of_nothing"]


def test_both_ends_agree_and_the_header_has_28_bytes():
    air, ground, session = opened()
    body = ground.seal(b"{}")
    assert len(body) == 1 + HEADER_BYTES + 2
    assert HEADER_BYTES == 28
    assert air.open(body) == (session, b"{}")
    for payload in (b'{"a":1}', b"\x01packed\r"):
        (line,) = LineDecoder().feed(to_line(air.seal_frame(payload)))
        assert ground.open(to_body(line)) == payload
    assert ground.open(air.seal_message(b"{}")) == b"{}"
    assert ground.open(session.answers.seal(b"{}")) == b"{}"


def test_a_short_body_is_taken_once_in_order_and_unchanged():
    air, ground, _ = opened()
    first, second = (air.seal_frame(ATTITUDE) for _ in range(2))
    assert len(first) == 2 + MAC_BYTES + len(ATTITUDE)
    changed = bytes([*second[:-1], second[-1] ^ 1])
    for bad, code in ((changed, "forged"), (second[:17], "malformed"), (second[:1], "malformed")):
        with pytest.raises(EnvelopeError, match=code):
            ground.open(bad)
    assert ground.open(second) == ATTITUDE
    for old in (first, second):
        with pytest.raises(EnvelopeError, match="forged"):
            ground.open(old)
    # Without a session it asks for one, as any message to all grounds does.
    with pytest.raises(EnvelopeError, match="unknown_stream"):
        pair()[1].open(first)


@pytest.mark.parametrize(("lost", "is_read"), [(255, True), (256, False)])
def test_short_bodies_survive_the_loss_of_255(lost, is_read):
    air, ground, _ = opened()
    for _ in range(lost):
        air.seal_frame(ATTITUDE)
    body = air.seal_frame(ATTITUDE)
    if is_read:
        assert ground.open(body) == ATTITUDE
        return
    with pytest.raises(EnvelopeError, match="forged"):
        ground.open(body)
    # A whole frame brings the counter.
    assert ground.open(air.seal_frame(b"{}")) == b"{}"
    assert ground.open(air.seal_frame(ATTITUDE)) == ATTITUDE


def test_a_message_of_another_ground_is_no_error():
    air, ground, _ = opened()
    other = GroundSession("glider-1", KEY.id, KEY.secret)
    theirs, reply = air.answer(other.hello())
    assert ground.on_handshake(reply) is None
    assert ground.open(theirs.answers.seal(b"{}")) is None


def test_answers_on_the_session_before_are_still_accepted():
    air, ground, before = opened()
    _, reply = air.answer(ground.hello())
    late = before.answers.seal(b'{"name":"up.ack"}')
    ground.on_handshake(reply)
    assert ground.open(late) == b'{"name":"up.ack"}'


def test_frames_taken_before_a_new_session_are_not_taken_again():
    """The relay delays the answer, with its counter, until newer frames have arrived."""
    air, ground, _ = opened()
    air.seal_frame(b"0")
    _, reply = air.answer(ground.hello())
    later = air.seal_frame(b"1")
    assert ground.open(later) == b"1"
    ground.on_handshake(reply)
    with pytest.raises(EnvelopeError, match="replayed"):
        ground.open(later)


def test_frames_of_before_the_hello_are_not_live():
    air, ground = pair()
    old = air.seal_frame(b"{}")
    ground.on_handshake(air.answer(ground.hello())[1])
    with pytest.raises(EnvelopeError, match="replayed"):
        ground.open(old)


def test_a_revoked_key_ends_its_sessions_and_changes_the_streams():
    air, ground, _ = opened()
    other = Key(b"other id", bytes(32), "phone", "observer")
    air.replace_keys({KEY.id: KEY, other.id: other})
    bystander = GroundSession("glider-1", other.id, other.secret)
    bystander.on_handshake(air.answer(bystander.hello())[1])
    revoked = Key(KEY.id, KEY.secret, KEY.name, KEY.role, "revoked")
    ((ended, (_, refusal)),) = air.replace_keys({KEY.id: revoked, other.id: other})
    assert ended.key == KEY
    assert ground.on_handshake(refusal).code == "revoked"
    assert not ground.is_open
    with pytest.raises(EnvelopeError, match="unknown_stream"):
        bystander.open(air.seal_frame(b"{}"))
    bystander.on_handshake(air.answer(bystander.hello())[1])
    assert bystander.open(air.seal_frame(b"{}")) == b"{}"
    assert air.answer(ground.hello())[0].code == "revoked"


def test_only_the_aircraft_itself_ends_an_open_session():
    air, ground, session = opened()
    fake = Refusal(KEY.id, session.hello.nonce, 0).encode(b"glider-1", bytes(32))
    with pytest.raises(EnvelopeError, match="forged"):
        ground.on_handshake(fake)
    assert ground.is_open
    assert air.replace_keys({})[0][1][0].code == "unknown_key"


def test_an_unknown_key_is_refused_and_the_ground_learns_it():
    air, ground = pair()
    air.replace_keys({})
    refusal, reply = air.answer(ground.hello())
    assert refusal.code == "unknown_key"
    assert ground.on_handshake(reply).code == "unknown_key"


def test_an_answer_to_an_earlier_hello_is_void():
    air, ground = pair()
    _, late = air.answer(ground.hello())
    ground.forget_hello()
    assert ground.on_handshake(late) is None
    ground.hello()
    assert ground.on_handshake(late) is None
    assert not ground.is_open


def test_repeated_hellos_do_not_end_the_session_that_is_used():
    air, ground, session = opened()
    air.open(ground.seal(b"{}"))
    hello = ground.hello()
    others = {air.answer(hello)[0].number for _ in range(3 * SESSIONS_PER_KEY)}
    assert len(others) == 3 * SESSIONS_PER_KEY
    assert len(air) == 1 + SESSIONS_PER_KEY
    assert air.open(ground.seal(b"{}"))[0] is session


def opened_beside(air, *, confirms):
    """Return the ground of another program with the same key."""
    ground = GroundSession("glider-1", KEY.id, KEY.secret)
    ground.on_handshake(air.answer(ground.hello())[1])
    if confirms:
        air.open(ground.seal(b"{}"))
    return ground


def test_another_program_with_the_key_does_not_end_a_session_before_its_first_command():
    air, _, _ = opened()
    for _ in range(2 * SESSIONS_PER_KEY):
        opened_beside(air, confirms=True)
    fresh = opened_beside(air, confirms=False)
    opened_beside(air, confirms=False)
    assert air.open(fresh.seal(b"{}"))[1] == b"{}"


def test_of_the_confirmed_sessions_the_one_that_was_not_used_for_longest_ends():
    times_ms = [0]
    air = AircraftSessions("glider-1", lambda: times_ms[0])
    air.replace_keys({KEY.id: KEY})
    used, idle = (opened_beside(air, confirms=True) for _ in range(2))
    for _ in range(2 * SESSIONS_PER_KEY):
        times_ms[0] += 1
        opened_beside(air, confirms=True)
        times_ms[0] += 1
        air.open(used.seal(b"{}"))
    assert len(air) == SESSIONS_PER_KEY
    with pytest.raises(EnvelopeError) as refused:
        air.open(idle.seal(b"{}"))
    assert refused.value.code == "unknown_session"


def test_a_session_that_is_not_used_ends():
    times_ms = [0]
    air = AircraftSessions("a", lambda: times_ms[0])
    air.replace_keys({KEY.id: KEY})
    grounds = [GroundSession("a", KEY.id, KEY.secret) for _ in range(2)]
    for ground in grounds:
        ground.on_handshake(air.answer(ground.hello())[1])
    times_ms[0] = IDLE_MS
    air.open(grounds[0].seal(b"{}"))
    times_ms[0] += 1
    air.end_idle()
    assert len(air) == 1
    air.open(grounds[0].seal(b"{}"))


def test_two_sessions_never_have_the_same_number(monkeypatch):
    numbers = iter([5, 5, 5, 6])
    air = AircraftSessions("a", lambda: 0)
    air.replace_keys({KEY.id: KEY})
    real = air._random
    air._random = lambda size: next(numbers).to_bytes(4, "big") if size == 4 else real(size)
    ground = GroundSession("a", KEY.id, KEY.secret)
    first, second = (air.answer(ground.hello())[0] for _ in range(2))
    assert isinstance(first, Session)
    assert first.number != second.number


def test_a_pad_is_used_once():
    """The same key of the streams looks different in every session."""
    air, ground = pair()
    seen = {handshake.decode(air.answer(ground.hello())[1]).wrapped for _ in range(8)}
    assert len(seen) == 8


def mutated(body, rng):
    """Return another body: bytes changed, cut, repeated, spliced."""
    data = bytearray(body)
    for _ in range(rng.randint(1, 3)):
        kind = rng.randrange(4)
        at = rng.randrange(len(data)) if data else 0
        if kind == 0 and data:
            data[at] ^= 1 << rng.randrange(8)
        elif kind == 1:
            del data[at:]
        elif kind == 2:
            data[at:at] = rng.randbytes(rng.randint(1, 4))
        else:
            data[at : at + 4] = data[:4]
    return bytes(data)


def attack(count, seed=1):
    """Return how many mutated bodies either end accepted; other errors are raised."""
    rng = random.Random(seed)
    air, ground, session = opened()
    bodies = [ground.seal(b'{"name":"up.arm","id":"%d"}' % number) for number in range(8)]
    bodies += [ground.hello(), air.seal_frame(b"{}"), session.answers.seal(b"{}")]
    bodies.append(air.seal_frame(ATTITUDE))
    bodies.append(air.answer(ground.hello())[1])
    accepted = 0
    for number in range(count):
        whole = bodies[number % len(bodies)]
        body = mutated(whole, rng)
        if body == whole:
            continue
        for take in (air.open, air.answer, ground.open, ground.on_handshake):
            try:
                said = take(body)
            except EnvelopeError:
                continue
            is_refusal = isinstance(said, tuple) and isinstance(said[0], Refusal)
            accepted += said is not None and not is_refusal
    return accepted


def test_no_mutated_body_is_accepted_and_every_refusal_has_a_code():
    assert attack(5000) == 0


@pytest.mark.parametrize("part", ["aircraft", "key_id", "direction"])
def test_a_message_for_somebody_else_is_refused(part):
    names = {"direction": b"command", "aircraft": b"a", "key_id": b"k"}
    sealed = Stream(bytes(32), *names.values(), 7).seal(b"{}")
    Stream(bytes(32), *names.values(), 7).open(sealed)
    names[part] = b"x"
    with pytest.raises(EnvelopeError, match="forged"):
        Stream(bytes(32), *names.values(), 7).open(sealed)
