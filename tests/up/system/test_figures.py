from math import inf, nan

from hypothesis import given
from hypothesis import strategies as st
from prometheus_client.parser import text_string_to_metric_families as families

from up.system.figures import Figure, numbers, text_of


@given(st.text(st.characters(exclude_categories=("Cs",))), st.floats(allow_nan=False))
def test_any_label_and_value_is_read_back(label, value):
    (family,) = families(text_of([Figure("up_it", "Help.", value, {"name": label})]))
    (sample,) = family.samples
    assert (sample.labels, sample.value, family.type) == ({"name": label}, value, "gauge")


def test_figures_of_one_name_are_one_family():
    made = [Figure("up_x", "Help.", n, {"part": str(n)}, "counter") for n in (1, 2)]
    (family,) = families(text_of(made))
    samples = [(each.name, each.value) for each in family.samples]
    assert samples == [("up_x_total", 1), ("up_x_total", 2)]
    assert family.type == "counter"


def test_numbers_and_flags_of_nested_maps():
    tree = {"a": {"b": 1, "c": None, "d": [3], "e": "4"}, "f": True, "g": nan, "h": -inf}
    assert list(numbers(tree)) == [("a.b", 1.0), ("f", 1.0)]
