from hypothesis import given, settings
from hypothesis import strategies as st
from mission_control_cog.thinning import SLOW_S, Thinning


def content(roll=1.0, **more):
    return {
        "orientation": {"roll": roll, "pitch": -2.5},
        "location": {"latitude": 50.12345678, "altitude": 310.26},
        "rx": {"ailerons": 1501},
        "armed": False,
        "arduino": {"failsafe": False, "loop_us": 2000},
        "counters": {"bus": {}, "serial": {"frames": 7, "lost": 0}},
        "age_ms": {"orientation": 12, "location": 340, "battery": None},
        "source": {"location": "android"},
        **more,
    }


def test_numbers_have_the_resolution_of_the_schema():
    thin = Thinning().apply(content(roll=3.819999), 0.0)
    assert thin["orientation"]["roll"] == 3.8
    assert thin["location"] == {"latitude": 50.123457, "altitude": 310.3}
    assert thin["rx"] == {"ailerons": 1500}
    assert thin["counters"] == {"serial": {"frames": 7}}
    assert thin["age_ms"] == {"orientation": 0, "location": 317, "battery": None}


def test_counters_and_load_change_once_a_second():
    thinning = Thinning()
    seen = [
        thinning.apply(content(counters={"a": {"b": number + 1}}), number / 10)["counters"]["a"][
            "b"
        ]
        for number in range(25)
    ]
    assert seen == [1] * 10 + [11] * 10 + [21] * 5
    assert SLOW_S == 1.0


def test_with_little_data_attitude_alarms_and_events_are_always_new():
    thinning = Thinning()
    thinning.apply(content(), 0.0, 2.0)
    news = content(
        roll=9.0,
        armed=True,
        arduino={"failsafe": True, "loop_us": 2400},
        location={"latitude": 51.0},
        source={"location": "arduino"},
        age_ms={"orientation": 0, "location": 100, "battery": None},
    )
    thin = thinning.apply(news, 1.5, 2.0)
    assert thin["orientation"]["roll"] == 9.0
    assert thin["armed"] is True
    assert thin["arduino"]["failsafe"] is True
    assert thin["source"] == {"location": "arduino"}
    assert thin["location"]["latitude"] == 50.123457
    # 340 ms then, 1.5 s ago.
    assert 1700 <= thin["age_ms"]["location"] <= 2000
    assert thinning.apply(news, 2.0, 2.0)["location"] == {"latitude": 51.0}


def test_what_came_or_went_is_shown():
    thinning = Thinning()
    thinning.apply({"armed": True, "load": {"cpu": 1.0}}, 0.0, 5.0)
    assert thinning.apply({"load": {"panic": True}}, 0.5, 5.0) == {
        "load": {"cpu": 1, "panic": True}
    }


JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats(-1e6, 1e6) | st.text(max_size=3),
    lambda below: st.lists(below, max_size=2) | st.dictionaries(st.text(max_size=3), below),
    max_leaves=5,
)
KEYS = ("orientation", "age_ms", "counters", "rx", "load", "arduino", "navigation", "system")


@settings(max_examples=40)
@given(
    st.lists(st.dictionaries(st.sampled_from(KEYS), JSON), max_size=4), st.sampled_from([0.0, 1.0])
)
def test_any_content_passes(contents, hold_s):
    thinning = Thinning()
    for number, each in enumerate(contents):
        thin = thinning.apply(each, number * 0.6, hold_s)
        assert hold_s or set(thin) >= set(each) - {"counters"}
