import json
import math
import time

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.up.protocols.golden import vectors
from up.protocols.general_message import (
    MAX_KEYS,
    GeneralMessage,
    MalformedMessage,
    _is_too_deep,
    _unique_object,
    decode,
    decode_object,
    encode,
)


def refused(line):
    with pytest.raises(MalformedMessage) as caught:
        decode(line)
    return caught.value


@pytest.mark.parametrize("vector", vectors("general_message.json"), ids=lambda v: v["name"])
def test_messages_are_written_and_read_as_the_vectors_say(vector):
    message = decode(vector["line"].encode())
    assert message == GeneralMessage(vector["name"], vector["data"], vector["id"], vector["beacon"])
    assert encode(message.name, message.data, message.id, message.beacon) == vector["line"].encode()


@pytest.mark.parametrize(
    "vector", vectors("general_message_read.json"), ids=lambda v: v["line"][:60]
)
def test_messages_are_read_or_refused_as_the_vectors_say(vector):
    line = vector["line"].encode()
    if "malformed" in vector:
        assert refused(line).reason
    else:
        expected = GeneralMessage(vector["name"], vector["data"], vector["id"], vector["beacon"])
        assert decode(line) == expected


@pytest.mark.parametrize(
    ("rest", "reason"),
    [
        (b'"data": {"x": NaN}', "NaN"),
        (b'"data": {"x": -Infinity}', "-Infinity"),
        (b'"data": {"x": 1e999}', "1e999"),
        (b'"data": {"x": ' + b"9" * 400 + b".0}", "too large"),
        (b'"data": {"x": ' + b"9" * 5000 + b"}", "more than 20"),
        (b'"data": {"x": 1, "x": 2}', "'x' is repeated"),
        (b'"data": {"x": "\\uD800"}', "surrogate"),
        (b'"data": {"\\udfff": 1}', "surrogate"),
        (b'"data": {"x": ' + b"[" * 40 + b"]" * 40 + b"}", "nested"),
        (b'"data": [1]', "data"),
        (b'"beacon": "1"', "beacon"),
        (b'"beacon": true', "beacon"),
        (b'"beacon": 1.5', "beacon"),
    ],
)
def test_what_is_refused_still_gives_its_id_for_the_nack(rest, reason):
    fault = refused(b'{"name": "up.arm", "id": "i-7", ' + rest + b"}")
    assert reason in fault.reason
    assert fault.id == "i-7"


class CountedKey(str):
    """A key that counts how often it is compared."""

    __slots__ = ()
    compared = 0

    def __eq__(self, other):
        CountedKey.compared += 1
        return super().__eq__(other)

    __hash__ = str.__hash__


def comparisons(keys):
    CountedKey.compared = 0
    with pytest.raises(ValueError, match=r"repeated|more than"):
        _unique_object([(CountedKey(key), 0) for key in keys])
    return CountedKey.compared


def test_a_repeated_key_is_found_in_linear_time():
    keys = [f"k{number}" for number in range(MAX_KEYS - 1)]
    assert comparisons([*keys, keys[-1]]) <= 2 * MAX_KEYS
    assert comparisons(keys * 100) == 0


def test_as_many_keys_as_64_kib_hold_are_refused():
    keys = b",".join(b'"%x":0' % number for number in range(7000))
    with pytest.raises(MalformedMessage, match=str(MAX_KEYS)):
        decode_object(b"{" + keys + b"}", 65536)


def test_an_id_that_cannot_be_told_is_not_guessed():
    assert refused(b'{"name": "a", "id": "1", "id": "2"}').id is None
    assert refused(b'{"name": "a", "id": "\\ud800"}').id is None
    assert refused(b'{"name": "a", "id": true, "data": NaN}').id is None
    assert refused(b'{"name": "", "id": "' + b"x" * 65 + b'"}').id is None
    assert refused(b'{"name": "a", "id": "1"').id is None


@pytest.mark.parametrize("bad", [b"true", b"{}", b"[]", b'""', b'"' + b"x" * 65 + b'"'])
def test_an_id_is_text_or_a_number(bad):
    assert "id" in refused(b'{"name": "a", "id": ' + bad + b"}").reason


def test_a_number_is_taken_as_the_ids_text():
    assert decode(b'{"name": "a", "id": 7}').id == "7"
    assert decode(b'{"name": "a", "id": 7.5}').id == "7.5"
    assert decode(b'{"name": "a", "id": "' + b"x" * 64 + b'"}').id == "x" * 64


def test_names_have_1_to_128_characters():
    assert decode(b'{"name": "' + b"n" * 128 + b'"}').name == "n" * 128
    refused(b'{"name": "' + b"n" * 129 + b'"}')


def test_16_kib_with_the_lf_and_no_more():
    empty = len(b'{"name": "a", "data": {"x": ""}, "id": null}\n')
    line = encode("a", {"x": "y" * (16384 - empty)})
    assert len(line) == 16384
    assert decode(line).name == "a"
    with pytest.raises(ValueError, match="16385 bytes"):
        encode("a", {"x": "y" * (16385 - empty)})
    assert "longer than" in refused(b" " + line).reason


def nested(depth):
    return b'{"name": "a", "data": {"x": ' + b"[" * (depth - 2) + b"]" * (depth - 2) + b"}}"


def test_32_levels_are_read_and_33_are_not():
    assert decode(nested(32))
    assert "nested" in refused(nested(33)).reason


@pytest.mark.parametrize("opening", [b"[", b'{"a":', b'[{"a":', b'["\\"",'])
def test_hostile_nesting_is_refused_without_a_recursion_error(opening):
    head = b'{"name": "a", "data": '
    fault = refused(head + opening * ((16000 - len(head)) // len(opening)))
    assert "nested" in fault.reason


def test_brackets_in_text_are_no_nesting():
    text = "[{" * 500 + '"\\'
    assert decode(encode("a", {"x": text})).data == {"x": text}


def test_quotes_without_end_do_not_take_quadratic_time():
    # Milliseconds; with a pattern that looks back it is more than a minute.
    began = time.process_time()
    assert not _is_too_deep(b"[]" * 40 + b'"' + b'\\"' * 64_000)
    assert time.process_time() - began < 10


@pytest.mark.parametrize(
    ("line", "reason"),
    [
        (b"\xff\xfe{}", "UTF-8"),
        ('{"name": "a"}'.encode("utf-16"), "UTF-8"),
        (b"\xef\xbb\xbf" + b'{"name": "a"}', "JSON"),
        (b'{"name": "\xed\xa0\x80"}', "UTF-8"),
        (b'{"name": "a\x01"}', "JSON"),
        (b"{'name': 'a'}", "JSON"),
        (b"", "JSON"),
        (b"null", "object"),
        (b'"text"', "object"),
    ],
)
def test_what_is_no_general_message(line, reason):
    assert reason in refused(line).reason


@pytest.mark.parametrize(
    ("data", "path"),
    [
        ({"orientation": {"roll": math.nan}}, "data.orientation.roll is nan"),
        ({"gains": [1.0, math.inf]}, r"data.gains\[1\] is inf"),
        ({"a": (1, {"b": -math.inf})}, r"data.a\[1\].b is -inf"),
        ({"a": {"b": b"bytes"}}, "data.a.b is a bytes"),
        ({"a": "\ud800"}, "surrogate"),
    ],
)
def test_what_may_not_leave_is_refused_by_its_key(data, path):
    with pytest.raises(ValueError, match=path):
        encode("up.telemetry.update", data)


def test_data_that_holds_itself_is_refused():
    data = {}
    data["again"] = data
    with pytest.raises(ValueError, match="nested"):
        encode("a", data)


json_values = st.recursive(
    st.none()
    | st.booleans()
    | st.integers(-(2**63), 2**63)
    | st.floats(allow_nan=False, allow_infinity=False)
    | st.text(max_size=20),
    lambda inner: (
        st.lists(inner, max_size=4) | st.dictionaries(st.text(max_size=8), inner, max_size=4)
    ),
    max_leaves=12,
)


@given(
    st.text(min_size=1, max_size=128),
    st.dictionaries(st.text(max_size=10), json_values, max_size=5),
    st.none() | st.text(min_size=1, max_size=64),
    st.none() | st.integers(0, 2**63),
)
def test_what_is_written_is_read_back(name, data, id_, beacon):
    line = encode(name, data, id_, beacon)
    assert line.endswith(b"\n")
    assert line.isascii()
    assert decode(line) == GeneralMessage(name, data, id_, beacon)


@given(st.binary(max_size=200) | st.text(max_size=100).map(str.encode))
def test_any_bytes_are_read_or_refused_by_name(line):
    try:
        message = decode(line)
    except MalformedMessage as fault:
        assert fault.reason
    else:
        assert json.loads(line)["name"] == message.name
