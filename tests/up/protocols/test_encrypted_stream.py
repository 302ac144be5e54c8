"""Secrecy: encrypted sessions, their golden vectors, and what a relay can do to their handshake."""

import json
import random
import sys
from pathlib import Path

import pytest
from cryptography.hazmat.primitives.ciphers.aead import AESGCM

from tests.up.protocols.test_envelope import KEY, Drawn, mutated
from up.protocols import encrypted_stream, handshake
from up.protocols.aircraft_sessions import AircraftSessions, Key
from up.protocols.encrypted_stream import EncryptedStream, is_available
from up.protocols.envelope import HEADER_BYTES, EnvelopeError, Stream, expand, prefixed
from up.protocols.ground_session import GroundSession

VECTORS = json.loads(Path("tests/vectors/secrecy.json").read_text(encoding="utf-8"))
TEXT = b'{"name":"up.arm"}'


def pair(secrecy=True, draw=Drawn):
    air = AircraftSessions("glider-1", lambda: 123456, draw(0x20), secrecy)
    air.replace_keys({KEY.id: KEY})
    ground = GroundSession("glider-1", KEY.id, KEY.secret, draw(0x10))
    ground.secrecy = secrecy
    return air, ground


def opened(**more):
    air, ground = pair(**more)
    session, reply = air.answer(ground.hello())
    ground.on_handshake(reply)
    return air, ground, session


def test_the_golden_vectors():
    air, ground = pair()
    ground.secrecy = False
    hello = ground.hello()
    _, refusal = air.answer(hello)
    assert ground.on_handshake(refusal).code == "secrecy_required"
    ground.secrecy = True
    secrecy_hello = ground.hello()
    session, answer = air.answer(secrecy_hello)
    ground.on_handshake(answer)
    found = {
        "hello": hello,
        "refusal": refusal,
        "secrecy_hello": secrecy_hello,
        "secrecy_answer": answer,
        "command": ground.seal(TEXT),
        "ack": session.answers.seal(b'{"name":"up.ack"}'),
        "telemetry": air.seal_frame(b'{"name":"up.telemetry.update"}'),
        "message": air.seal_message(b'{"name":"up.system.state"}'),
    }
    assert {name: body.hex() for name, body in found.items()} == VECTORS["session"]


def test_an_encrypted_message_is_what_the_page_describes():
    """AES-256-GCM with the key, nonce and context of docs/security.md."""
    names = (b"command", b"glider-1", KEY.id)
    body = EncryptedStream(bytes(32), *names, 7).seal(TEXT)
    key = expand(bytes(32), b"secrecy", *names, b"\0\0\0\7")
    place, tag, secret = body[1:13], body[13:29], body[29:]
    assert place == bytes.fromhex("000000070000000000000001")
    assert AESGCM(key).decrypt(place, secret + tag, prefixed(*names)) == TEXT


def test_both_ends_agree_and_the_header_has_28_bytes():
    air, ground, session = opened()
    body = ground.seal(TEXT)
    assert len(body) == 1 + HEADER_BYTES + len(TEXT)
    assert air.open(body) == (session, TEXT)
    for sealed in (air.seal_frame(TEXT), air.seal_message(TEXT), session.answers.seal(TEXT)):
        assert TEXT not in sealed
        assert ground.open(sealed) == TEXT


def test_counters_rise():
    air, ground, _ = opened()
    first, second = air.seal_frame(b"1"), air.seal_frame(b"2")
    assert ground.open(second) == b"2"
    for old in (first, second):
        with pytest.raises(EnvelopeError, match="replayed"):
            ground.open(old)


def test_a_ground_that_asks_an_aircraft_without_secrecy_learns_that_it_changed():
    air, ground = pair(secrecy=False)
    ground.secrecy = True
    assert ground.on_handshake(air.answer(ground.hello())[1]).code == "changed"


def test_no_relay_turns_one_kind_of_handshake_into_the_other():
    air, ground = pair()
    hello = bytearray(ground.hello())
    assert hello[1] == handshake.SecrecyHello.KIND
    hello[1] = handshake.Hello.KIND
    with pytest.raises(EnvelopeError, match="forged"):
        air.answer(bytes(hello))
    answer = bytearray(air.answer(ground.hello())[1])
    answer[1] = handshake.Answer.KIND
    with pytest.raises(EnvelopeError, match="forged"):
        ground.on_handshake(bytes(answer))
    assert not ground.is_open


def test_a_ground_that_asks_for_secrecy_takes_no_session_without():
    """Not even of the aircraft itself, which never offers one to such a hello."""
    air, ground = pair(secrecy=False)
    plain = air.answer(ground.hello())[1]
    ground.secrecy = True
    with pytest.raises(EnvelopeError, match="malformed"):
        ground.on_handshake(plain)
    assert not ground.is_open


def test_a_plain_protected_message_is_refused_in_an_encrypted_session():
    names = (b"command", b"a", b"k", 7)
    sealed = Stream(bytes(32), *names).seal(TEXT)
    with pytest.raises(EnvelopeError, match="forged"):
        EncryptedStream(bytes(32), *names).open(sealed)


@pytest.mark.parametrize("part", ["aircraft", "key_id", "direction"])
def test_a_message_for_somebody_else_is_refused(part):
    names = {"direction": b"command", "aircraft": b"a", "key_id": b"k"}
    sealed = EncryptedStream(bytes(32), *names.values(), 7).seal(TEXT)
    names[part] = b"x"
    with pytest.raises(EnvelopeError, match="forged"):
        EncryptedStream(bytes(32), *names.values(), 7).open(sealed)


def test_no_mutated_body_is_accepted():
    rng = random.Random(1)
    air, ground, session = opened()
    bodies = [ground.seal(TEXT), air.seal_frame(TEXT), session.answers.seal(TEXT)]
    bodies += [ground.hello(), air.answer(ground.hello())[1]]
    for number in range(2000):
        whole = bodies[number % len(bodies)]
        body = mutated(whole, rng)
        if body == whole:
            continue
        for take in (air.open, ground.open, ground.on_handshake):
            try:
                said = take(body)
            except EnvelopeError:
                continue
            assert said is None or isinstance(said, handshake.Refusal)


def test_no_key_meets_a_nonce_twice(monkeypatch):
    """In sessions of several devices, after a revocation, and in the next life of each side."""
    used = []
    real = encrypted_stream._cipher

    class Cipher:
        def __init__(self, key):
            self.key, self.encrypt = key, self._encrypt
            self.real = real(key)

        def _encrypt(self, nonce, *more):
            used.append((self.key, nonce))
            return self.real.encrypt(nonce, *more)

    monkeypatch.setattr(encrypted_stream, "_cipher", Cipher)
    other = Key(b"other id", bytes(32), "phone", "pilot")
    for _ in range(2):
        air = AircraftSessions("a", lambda: 0, secrecy=True)
        grounds = [GroundSession("a", key.id, key.secret) for key in (KEY, other)]
        for keys in ((KEY, other), (KEY,)):
            air.replace_keys({key.id: key for key in keys})
            for ground in grounds[: len(keys)]:
                ground.secrecy = True
                session, reply = air.answer(ground.hello())
                assert isinstance(ground.on_handshake(reply), handshake.SecrecyAnswer)
                for seal in (ground.seal, session.answers.seal, air.seal_frame, air.seal_message):
                    seal(TEXT)
    assert len(used) == 2 * 3 * 4
    assert len(set(used)) == len(used)


def test_without_the_package_nothing_is_encrypted(monkeypatch):
    assert is_available()
    monkeypatch.setitem(sys.modules, "cryptography.hazmat.primitives.ciphers.aead", None)
    assert not is_available()
    with pytest.raises(ImportError):
        AircraftSessions("a", lambda: 0, secrecy=True)
