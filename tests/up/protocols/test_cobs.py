import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.up.protocols.golden import vectors
from up.protocols import cobs
from up.protocols.crc16 import crc16


@pytest.mark.parametrize("vector", vectors("cobs.json"), ids=lambda v: v["plain"][:16])
def test_cobs_is_as_the_vectors_say(vector):
    plain, encoded = bytes.fromhex(vector["plain"]), bytes.fromhex(vector["encoded"])
    assert cobs.encode(plain) == encoded
    assert cobs.decode(encoded) == plain


@pytest.mark.parametrize("vector", vectors("crc16.json"), ids=lambda v: v["bytes"][:16])
def test_crc_is_as_the_vectors_say(vector):
    assert crc16(bytes.fromhex(vector["bytes"])) == int(vector["crc"], 16)


@given(st.binary(max_size=600))
def test_what_is_encoded_holds_no_zero_and_comes_back(plain):
    encoded = cobs.encode(plain)
    assert 0 not in encoded
    assert len(encoded) <= len(plain) + 1 + len(plain) // 254
    assert cobs.decode(encoded) == plain


@given(st.binary(max_size=300))
def test_any_bytes_decode_or_are_refused_by_name(data):
    try:
        plain = cobs.decode(data)
    except cobs.CobsError:
        return
    assert cobs.decode(cobs.encode(plain)) == plain


@pytest.mark.parametrize("encoded", ["05", "0300", "00", "0200", "ff01"])
def test_broken_cobs_is_refused(encoded):
    with pytest.raises(cobs.CobsError):
        cobs.decode(bytes.fromhex(encoded))


@given(st.binary(max_size=110))
def test_a_message_followed_by_its_crc_has_the_crc_zero(message):
    assert crc16(message + crc16(message).to_bytes(2, "big")) == 0
