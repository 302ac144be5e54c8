import math
from dataclasses import FrozenInstanceError, replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from up.fields import Constraint, InvalidValueError, show

LATITUDE = Constraint(float, -90, 90, unit="deg")
ANYTHING = st.one_of(
    st.none(),
    st.booleans(),
    st.integers(),
    st.integers(min_value=10**300, max_value=10**320),
    st.floats(),
    st.text(st.characters(exclude_categories=())),
    st.lists(st.integers(), max_size=5),
    st.dictionaries(st.text(max_size=3), st.integers(), max_size=5),
    st.binary(max_size=5),
    st.builds(object),
)
CONSTRAINTS = [
    Constraint(bool),
    Constraint(int),
    Constraint(int, 0, 10, nullable=True),
    Constraint(float),
    LATITUDE,
    Constraint(float, minimum=0),
    Constraint(str, max_length=3),
    Constraint(str, choices=("off", "on"), ignore_case=True),
    Constraint(int, choices=(1, 2)),
    Constraint(dict, max_length=1),
    Constraint(list, max_length=1),
]


def refused(constraint, value):
    with pytest.raises(InvalidValueError) as caught:
        constraint.check(value)
    return caught.value


def refusal(constraint, value):
    return str(refused(constraint, value))


@pytest.mark.parametrize("value", [-90, 90, 0.5, -90.0, 10**1])
def test_a_number_within_its_bounds_comes_back_as_a_float(value):
    checked = LATITUDE.check(value)
    assert checked == value
    assert type(checked) is float


def test_a_refusal_is_one_sentence_with_range_unit_and_the_value():
    assert refusal(LATITUDE, "x") == 'must be a number between -90 and 90 deg, not "x"'
    assert refusal(Constraint(float, minimum=0.5), None) == (
        "must be a number of at least 0.5, not null"
    )
    assert refusal(Constraint(str, max_length=2), "abc") == (
        "must be text of at most 2 characters, not of 3"
    )


@pytest.mark.parametrize(
    ("constraint", "value", "code"),
    [
        (LATITUDE, 90.5, "out_of_range"),
        (Constraint(int, 1, 65535), 0, "out_of_range"),
        (Constraint(bool), 1, "wrong_type"),
        (Constraint(dict), [1], "wrong_type"),
        (Constraint(str, choices=("a", "b")), "c", "not_a_choice"),
        (Constraint(str, max_length=2), "abc", "too_long"),
        (Constraint(list, max_length=1), [1, 2], "too_long"),
        (Constraint(str), "a\ud800", "not_unicode"),
    ],
)
def test_a_refusal_has_a_code(constraint, value, code):
    assert refused(constraint, value).code == code


@pytest.mark.parametrize(
    ("constraint", "values"),
    [
        (Constraint(int), (True, False, 1.0, "1", None)),
        (Constraint(float), (True, False, "1", None)),
        (Constraint(int, choices=(0, 1)), (True, "1")),
        (Constraint(bool), (1, 0, "true", None)),
    ],
)
def test_a_value_of_another_type_is_refused(constraint, values):
    for value in values:
        refusal(constraint, value)


@pytest.mark.parametrize("constraint", [Constraint(float), LATITUDE, Constraint(float, minimum=0)])
@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
def test_what_is_not_finite_is_refused(constraint, value):
    assert refused(constraint, value).code == "not_finite"


@pytest.mark.parametrize("value", [10**400, -(10**400), 10**5000], ids=["+", "-", "longest"])
@pytest.mark.parametrize("constraint", [Constraint(float), Constraint(int), LATITUDE])
def test_huge_integers_are_refused_in_a_short_sentence(constraint, value):
    assert refused(constraint, value).code == "out_of_range"
    assert len(refusal(constraint, value)) < 80


def test_an_unbounded_int_holds_64_bits():
    assert Constraint(int).check(2**63 - 1) == 2**63 - 1
    assert Constraint(int).check(-(2**63)) == -(2**63)
    refusal(Constraint(int), 2**63)


def test_any_unicode_text_is_accepted():
    assert Constraint(str).check("žluťoučký 🛩") == "žluťoučký 🛩"


def test_null_only_where_it_is_allowed():
    assert Constraint(float, nullable=True).check(None) is None
    assert "or null" in refusal(Constraint(float, nullable=True), "x")
    refusal(Constraint(float), None)


def test_a_choice_in_another_case_is_told_as_it_is_spelled():
    light = Constraint(str, choices=("none", "light"))
    assert refusal(light, "Light").endswith(' "light"?')
    assert refusal(light, "lihgt").endswith(' "lihgt"')


def test_a_unit_that_begins_with_a_figure_stands_in_brackets():
    gain = Constraint(float, minimum=0, maximum=50, unit="1.25 us per deg/s")
    assert " (1.25 us per deg/s)" in refusal(gain, 99.0)


def test_choices_may_ignore_case_and_come_back_as_they_are_spelled():
    level = Constraint(str, choices=("debug", "info"), ignore_case=True)
    assert level.check("INFO") == "info"
    refusal(Constraint(str, choices=("debug", "info")), "INFO")


def test_a_tuple_passes_as_a_list():
    assert Constraint(list).check((1,)) == (1,)


@pytest.mark.parametrize(
    "arguments",
    [
        {"type_": bytes},
        {"type_": str, "minimum": 1},
        {"type_": float, "max_length": 1},
        {"type_": int, "minimum": 2, "maximum": 1},
        {"type_": list, "choices": (1,)},
        {"type_": str, "choices": (1,)},
    ],
)
def test_a_constraint_that_contradicts_itself_is_refused(arguments):
    with pytest.raises((TypeError, ValueError)):
        Constraint(**arguments)


def test_a_constraint_is_a_value():
    assert Constraint(float, -90, 90, unit="deg") == LATITUDE
    assert hash(Constraint(float, -90, 90, unit="deg")) == hash(LATITUDE)
    assert replace(LATITUDE, maximum=10).check(10) == 10
    refusal(replace(LATITUDE, maximum=10), 11)
    with pytest.raises(FrozenInstanceError):
        LATITUDE.minimum = 0


def test_json_schema():
    assert LATITUDE.json_schema() == {
        "type": "number",
        "minimum": -90,
        "maximum": 90,
        "x-unit": "deg",
    }
    assert Constraint(str, choices=("a",), nullable=True).json_schema() == {
        "type": ["string", "null"],
        "enum": ["a", None],
    }
    assert Constraint(list, max_length=3).json_schema() == {"type": "array", "maxItems": 3}


@pytest.mark.parametrize("constraint", CONSTRAINTS, ids=lambda c: c.describe())
@given(value=ANYTHING)
def test_any_value_is_accepted_again_or_refused_in_one_short_printable_sentence(constraint, value):
    try:
        checked = constraint.check(value)
    except InvalidValueError as error:
        assert error.code
        assert str(error).isprintable()
        assert len(str(error)) < 400
    else:
        assert constraint.check(checked) == checked
        if constraint.type_ is float:
            assert math.isfinite(checked)


def test_what_is_shown_is_short_and_cannot_steer_a_terminal():
    assert show("\x1b[2J\n") == '"\\x1b[2J\\n"'
    assert len(show("x" * 10_000)) < 60
    assert show(object()) == "a object"
