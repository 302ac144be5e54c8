"""Requests: one line in, a Request or one sentence out."""

import json
import string

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from up_runner.request import MAX_LINE, NAME, MalformedRequest, Request, parse

names = st.text(string.ascii_letters + string.digits + "_.-", min_size=1, max_size=32).filter(
    lambda name: not name.startswith(".")
)
words = st.text(min_size=1, max_size=64)
scalars = st.one_of(
    st.booleans(),
    st.integers(-(2**63), 2**63 - 1),
    st.floats(allow_nan=False, allow_infinity=False),
    st.text(string.ascii_letters + " _.:-", max_size=256),
)
configurations = st.dictionaries(words, st.dictionaries(words, scalars, max_size=4), max_size=4)


def test_nothing_named_is_the_default_instance():
    assert parse(b"{}") == Request("default", None, {}, "spawn")


@given(names, st.none() | names, configurations, st.sampled_from(["spawn", "status"]))
def test_every_request_reads_as_it_was_meant(aircraft, profile, configuration, action):
    line = json.dumps(
        {
            "aircraft": aircraft,
            "profile": profile,
            "configuration": configuration,
            "action": action,
            "something new": [1, {}],
        }
    ).encode()
    expected = Request(aircraft, profile, configuration, action)
    assert parse(line) == parse(line + b"\r\n") == expected


@given(st.binary(max_size=200) | st.text(max_size=200).map(lambda text: text.encode("utf-8")))
@example(b"[" * MAX_LINE)
@example(b'{"a":' * 10_000)
@example(b"1" * 5000)
@example(b'{"aircraft": "a", "aircraft": "b"}')
@example(b'{"aircraft": "\\ud800"}')
@example(b'{"configuration": {"a.yml": {"k": 1e999}}}')
@example(b'{"configuration": {"a.yml": {"k": NaN}}}')
@example(b'{"configuration": {"a.yml": {"k": "\\u0000"}}}')
@example(b'{"configuration": {"a.yml": {"k": 99999999999999999999}}}')
@example(b'{"configuration": {"a.yml": {"k": null}}}')
@example(b'{"configuration": {"": {"k": 1}}}')
@example(b'{"configuration": {"a.yml": {"k": {"deeper": 1}}}}')
def test_anything_else_is_one_short_sentence(line):
    try:
        request = parse(line)
    except MalformedRequest as error:
        sentence = str(error)
        assert 0 < len(sentence) < 400 and sentence.isprintable() and sentence.isascii()
    else:
        assert NAME.fullmatch(request.aircraft)


json_values = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text(), inner, max_size=4),
)


@given(
    st.dictionaries(
        st.sampled_from(["aircraft", "profile", "configuration", "action"]), json_values
    )
)
@example({"configuration": {"\U00010000" * 64: None}})
@example({"configuration": {"\U00010000" * 64: {"\U00010000" * 64: None}}})
@example({"configuration": {"\U00010000" * 64: {"\U00010000" * 64: "/"}}})
def test_wrong_types_are_one_short_sentence(found):
    try:
        request = parse(json.dumps(found).encode())
    except MalformedRequest as error:
        assert len(str(error)) < 400 and str(error).isprintable()
    else:
        for settings_ in request.configuration.values():
            for value in settings_.values():
                assert isinstance(value, bool | int | float | str)
                assert "/" not in str(value)


@pytest.mark.parametrize(
    "name", ["", ".", "..", ".hidden", "a/b", "a\\b", "a b", "x" * 33, "é", "a\n", "a\0"]
)
def test_names_that_could_lead_elsewhere_are_refused(name):
    for key in ("aircraft", "profile"):
        with pytest.raises(MalformedRequest, match=key):
            parse(json.dumps({key: name}).encode())


def test_a_long_line_is_refused():
    line = json.dumps({"comment": "x" * MAX_LINE}).encode()
    with pytest.raises(MalformedRequest, match="longer than 65536 bytes"):
        parse(line)


def test_only_another_configuration_is_another():
    plain = Request("a")
    assert not plain.wants_configuration
    assert Request("a", "cub").wants_configuration
    assert Request("a", "cub").same_configuration(Request("b", "cub"))
    assert not Request("a", "cub").same_configuration(plain)
    assert not Request("a", None, {"f.yml": {"k": 1}}).same_configuration(plain)


@pytest.mark.parametrize("body", [None, "", " ", "zz", "3", 3, ["03"]])
def test_a_protected_line_has_a_body_and_is_no_nameless_request(body):
    with pytest.raises(MalformedRequest):
        parse(json.dumps({"action": "protected", "body": body}).encode())
