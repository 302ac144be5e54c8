from hypothesis import given, settings
from hypothesis import strategies as st

from up.flight_log.gain_changes import changes_text, gains_of


def test_changes_in_the_terms_of_the_page():
    before = {"ratePIDs": {"ailerons": {"p": 3, "i": 0.5, "d": 0}}, "stabPIDs": {}}
    after = {
        "ratePIDs": {"ailerons": {"p": 2.4, "i": 0.5, "d": 0}},
        "stabPIDs": {"elevator": {"p": 4.5}},
        "navPIDs": {"rudder": {"d": 1}},
    }
    changes = "rate roll P 3 to 2.4, stabilize pitch P 4.5, navigation yaw D 1"
    assert changes_text(before, after) == changes
    assert changes_text(before, after, 1) == "rate roll P 3 to 2.4 and 2 more"
    assert changes_text(before, before) == ""
    assert changes_text(None, {"ratePIDs": {"rudder": {"i": 2}}}) == "rate yaw I 2"


_JSON = st.recursive(
    st.none() | st.booleans() | st.floats() | st.integers() | st.text(),
    lambda each: (
        st.lists(each) | st.dictionaries(st.sampled_from(("ratePIDs", "rudder", "p")), each)
    ),
)


@settings(max_examples=40, deadline=None)
@given(_JSON, _JSON)
def test_any_data(before, after):
    assert isinstance(changes_text(before, after), str)
    assert all(isinstance(value, float) for value in gains_of(after).values())
