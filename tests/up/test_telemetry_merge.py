import json
import math

from hypothesis import given
from hypothesis import strategies as st

from up.protocols.general_message import encode
from up.telemetry_controller import MAX_DEPTH, MAX_LENGTH, merge


def merged(*contents):
    conflicts = []
    result = merge(
        [(name, content) for name, content in zip("ABCDEF", contents, strict=False)],
        lambda *conflict: conflicts.append(conflict),
    )
    return result, conflicts


def test_maps_are_merged_deeply():
    result, conflicts = merged({"a": {"x": 1, "y": {"p": 1}}}, {"a": {"y": {"q": 2}}, "b": None})
    assert result == {"a": {"x": 1, "y": {"p": 1, "q": 2}}, "b": None}
    assert not conflicts


def test_equal_values_do_not_conflict():
    assert merged({"a": 1, "l": [1, 2]}, {"a": 1.0, "l": (1, 2)})[1] == []


def test_only_the_later_key_is_dropped_and_both_are_named():
    result, conflicts = merged({"a": {"x": 1}}, {"a": {"x": 2, "y": 3}}, {"a": 5}, {"b": {}})
    assert result == {"a": {"x": 1, "y": 3}, "b": {}}
    assert conflicts == [("a.x", "A", "B"), ("a", "A", "C")]


def test_what_is_not_finite_becomes_null():
    result, _ = merged({"a": math.nan, "b": [math.inf, 1.0], "c": {"d": -math.inf}})
    assert result == {"a": None, "b": [None, 1.0], "c": {"d": None}}


class Failing(dict):
    """A map that fails while it is read."""

    def items(self):
        raise RuntimeError("no")


def test_what_json_does_not_have_is_dropped_alone():
    endless = {}
    endless["again"] = endless
    circle = []
    circle.append(circle)
    bad = {
        "set": {1},
        "bytes": b"x",
        "object": object(),
        "huge": 10**5000,
        "long": "x" * (MAX_LENGTH + 1),
        "many": list(range(MAX_LENGTH + 1)),
        "surrogate": "\ud800",
        "endless": endless,
        "circle": circle,
        "\ud800": 1,
        "nested": [[{"x": {1}}]],
        "good": 1,
    }
    result, conflicts = merged(bad, {"other": 2}, Failing(a=1), {"map": Failing(a=1), "z": 1})
    assert len(encode("t", result)) < 2000
    assert result.pop("endless")
    assert result == {"good": 1, "other": 2, "map": {}}
    assert {conflict[1:] for conflict in conflicts} == {("A", "A"), ("C", "C"), ("D", "D")}


def test_the_contents_are_not_shared_with_the_frame():
    inner = {"x": [1]}
    result, _ = merged({"a": inner})
    result["a"]["x"].append(2)
    result["a"]["y"] = 1
    assert inner == {"x": [1]}


ANYTHING = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text() | st.binary(max_size=3),
    lambda inner: (
        st.lists(inner, max_size=3)
        | st.tuples(inner)
        | st.dictionaries(st.text(max_size=2) | st.integers(0, 3), inner, max_size=4)
    ),
    max_leaves=20,
)
CONTENTS = st.dictionaries(st.sampled_from("abc"), ANYTHING)


@given(st.lists(CONTENTS, max_size=4))
def test_any_contents_make_json(contents):
    result, _ = merged(*contents)
    text = json.dumps(result, allow_nan=False)
    text.encode()
    assert json.loads(text) == result


@given(CONTENTS, CONTENTS)
def test_the_first_module_keeps_what_it_said(first, second):
    alone, _ = merged(first)
    both, _ = merged(first, second)

    def within(part, whole):
        if isinstance(part, dict):
            return all(key in whole and within(part[key], whole[key]) for key in part)
        return part == whole

    assert within(alone, both)


def test_nesting_is_bounded():
    content = {}
    inner = content
    for _ in range(1000):
        inner["x"] = {}
        inner = inner["x"]
    result, conflicts = merged(content)
    depth = 0
    while result:
        result, depth = result["x"], depth + 1
    assert depth == MAX_DEPTH
    assert conflicts
