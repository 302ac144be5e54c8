"""The picture: pure, so every moment can be looked at."""

import re

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.ground.aircraft import frame
from up.protocols.general_message import GeneralMessage
from up_ground.link_status import LinkState, LinkStatus
from up_ground.panels import bar
from up_ground.screen import State, draw, draw_horizon, render
from up_ground.screen_buffer import MAX_COLUMNS, MAX_ROWS, ScreenBuffer, Style
from up_ground.settings import Seat, Settings
from up_ground.status_text import age_text, number_text, plain_line
from up_ground.telemetry import NAME, Telemetry

SGR = re.compile(r"\x1b\[[0-9;]*m")
OURS = {f"\x1b[0;{style.value}m" for style in Style} | {"\x1b[0m"}


def state(data=None, now_s=100.0, **status):
    known = LinkStatus(LinkState.OPEN, now_s, is_aircraft_online=True, **status)
    telemetry = Telemetry()
    if data is not None:
        telemetry.update(GeneralMessage(NAME, data, None, 1), now_s)
    return State(Settings(), known, telemetry)


def text_of(state, now_s=100.0, size=(80, 24)):
    return draw(state, now_s, size).plain()


def style_at(picture, text):
    """Return the SGR that is in force where a text begins."""
    row = next(each for each in picture.split("\n") if text in SGR.sub("", each))
    place, seen, current = SGR.sub("", row).index(text), 0, ""
    for part in re.split(r"(\x1b\[[0-9;]*m)", row):
        if part.startswith("\x1b"):
            current = part
        elif seen + len(part) > place:
            return current
        else:
            seen += len(part)
    raise AssertionError(text)


@pytest.mark.parametrize(
    ("low", "critical", "is_bad"),
    [(None, None, False), (False, False, False), (True, False, True), (None, True, True)],
)
def test_the_flight_battery_is_beside_the_phones_and_styled_by_its_limits(low, critical, is_bad):
    arduino = {"flight_battery_v": 11.14, "flight_battery_low": low}
    flying = state(frame(arduino={**arduino, "flight_battery_critical": critical}))
    assert "flight battery 11.1 V phone 83 %" in text_of(flying)
    style = style_at(render(flying, 100.0, (80, 24)), "flight battery")
    assert (style == f"\x1b[0;{Style.BAD.value}m") is is_bad


def test_everything_that_is_known_is_there():
    picture = text_of(state(frame(vetoes=["gyro is warm", "AUX2 low"], armed=True)))
    for text in (
        "roll    +12.5 deg    +1.0 deg/s",
        "pitch    -3.2 deg",
        "yaw     271.0 deg",
        "ATTITUDE arduino 0.01 s",
        "flight controller (arduino)",
        "flight mode FBW  switch AUTO",
        "ARMED",
        "against arming again: gyro is warm;",
        "LOCATION android 0.60 s",
        "50.075500   14.437800 deg",
        "home 1204 m, bearing 271 deg",
        "altitude    311.4 m",
        "heading 88 deg",
        "battery 83 % phone connected",
        "load 12 % memory 31 %",
        "ailerons  1511",
        "elevator  1200",
        "Arduino connected, checked",
        "aircraft online",
    ):
        assert text in picture, text


def test_what_the_link_costs_is_shown():
    uplink = {"mb_per_hour": 9.04, "mb": 3.2, "mb_in_an_hour": 12.2, "budget_mb_per_hour": None}
    limited = {**uplink, "budget_mb_per_hour": 11.0}
    shown = state(frame(uplink=limited))
    assert "load 12 % memory 31 % 9.0 MB/h" in text_of(shown)
    line = plain_line(shown.status, shown.telemetry, 100.0)
    assert line.endswith(" | data 9.0 of 11 MB/h, 3.2 MB, in an hour 12.2 MB")
    shown = state(frame(uplink=uplink))
    assert "9.0 MB/h, 3.2 MB" in plain_line(shown.status, shown.telemetry, 100.0)


def test_what_is_not_known_is_two_dashes():
    picture = text_of(state({}))
    for text in ("roll       -- deg", "altitude       -- m", "battery -- %", "flight mode --"):
        assert text in picture
    assert "vetoes --" in picture
    assert "None" not in picture
    assert "null" not in picture


def test_fresh_numbers_are_plain_and_old_ones_dim_with_their_age():
    dim = "\x1b[0;2m"
    dead = state(frame(age_ms={"orientation": 1200, "altitude": 10}))
    picture = render(dead, 100.0, (80, 24))
    assert style_at(picture, "roll  ") == dim
    assert "ATTITUDE arduino 1.20 s" in SGR.sub("", picture)
    assert style_at(picture, "altitude  ") != dim


def test_a_silent_aircraft_greys_all_within_a_second():
    alive = state(frame(armed=True))
    texts = ("roll  ", "flight mode FBW", "ARMED", "home 1204", "battery 83", "ailerons  1511")
    fresh, silent = render(alive, 100.1, (80, 24)), render(alive, 100.95, (80, 24))
    for text in texts:
        assert style_at(fresh, text) != "\x1b[0;2m", text
        assert style_at(silent, text) == "\x1b[0;2m", text
    assert "SILENT age 0.95 s" in SGR.sub("", silent)
    assert not re.search(r"\x1b\[0;(37;44|30;43|32|33)m", silent)


def test_failsafe_and_a_lost_aircraft_are_loud_and_a_busy_raspberry_pi_is_told():
    load = {"cpu": 99.4, "ram": 31.0, "panic": True, "delay_ms": 150}
    data = frame(load=load, arduino={"failsafe": True, "switch": "LOW"})
    loud = state(data)
    loud.status.is_aircraft_online = False
    picture = render(loud, 100.0, (80, 24))
    for text in ("FAILSAFE", "aircraft offline"):
        assert style_at(picture, text) == "\x1b[0;1;31m", text
    assert "busy (99 %): telemetry every 150 ms" in render(loud, 100.0, (120, 30))


@pytest.mark.parametrize(
    ("flags", "word"),
    [
        ({"imu_valid": True, "restored": False, "bias_stored": False}, ""),
        ({"imu_valid": True, "restored": False, "bias_stored": True}, "old bias"),
        ({"imu_valid": True, "restored": True, "bias_stored": True}, "was reset"),
        ({"imu_valid": False, "restored": True, "bias_stored": True}, "NO IMU"),
    ],
)
def test_the_worst_of_the_board_stands_beside_its_loop(flags, word):
    data = frame()
    data["arduino"] = {**data["arduino"], **flags}
    line = next(each for each in text_of(state(data)).splitlines() if " loop " in each)
    assert line.split(" us")[-1].strip() == word


def test_a_second_phone_that_is_refused_is_shown():
    competed = state(frame(android={"connected": True, "competitor": "192.0.2.7"}))
    assert style_at(render(competed, 100.0, (80, 24)), "2nd phone refused") == "\x1b[0;33m"
    line = plain_line(competed.status, competed.telemetry, 100.0)
    assert "192.0.2.7" in line
    for android in ({"connected": True}, {"connected": True, "competitor": None}):
        single = state(frame(android=android))
        assert "phone connected" in text_of(single)
        assert "192.0.2.7" not in plain_line(single.status, single.telemetry, 100.0)


def test_a_broken_link_says_why_and_since_when():
    broken = state(frame())
    broken.status.failures = 3
    broken.status.disconnected(LinkState.WAITING, 100.0, "unreachable: proxy:1")
    picture = text_of(broken, 107.0)
    assert "down for 7.00 s, attempt 4" in picture
    assert "unreachable: proxy:1" in picture.splitlines()[-1]


def test_the_seat_and_who_asks_for_it():
    holder = state(frame(), seat=Seat.COMMAND, holder=1, is_holder_known=True, asked_by=3)
    assert "control ours" in text_of(holder)
    assert "ground 3 requests control: press g" in text_of(holder)
    listener = state(frame(), seat=Seat.LISTEN, holder=2, is_holder_known=True)
    assert "control ground 2" in text_of(listener)


@pytest.mark.parametrize(
    "size", [(80, 24), (200, 60), (60, 40), (20, 5), (1, 1), (0, 0), (9999, 9999)]
)
def test_every_size_is_kept(size):
    rows = text_of(state(frame()), size=size).split("\n")
    assert len(rows) == max(1, min(size[1], MAX_ROWS))
    assert max(map(len, rows)) <= max(1, min(size[0], MAX_COLUMNS))


HOSTILE = st.recursive(
    st.none()
    | st.booleans()
    | st.integers()
    | st.floats()
    | st.text(st.characters(codec="utf-8"), max_size=60)
    | st.sampled_from(["\x1b[2J\x1b[?1049l", "\x9b5n", "\n\r\x07\x08", "\u202e", "\u0301" * 9]),
    lambda inner: st.lists(inner, max_size=4),
    max_leaves=4,
)
SHAPE = frame(load={"cpu": 1, "ram": 1, "panic": 1, "delay_ms": 1})


@st.composite
def hostile_frames(draw):
    def spoil(value):
        if isinstance(value, dict):
            return {key: spoil(each) for key, each in value.items()}
        return draw(HOSTILE)

    return draw(HOSTILE) if draw(st.integers(0, 20)) == 0 else spoil(SHAPE)


@settings(max_examples=60)
@given(hostile_frames(), st.tuples(st.integers(0, 130), st.integers(0, 50)), st.text(max_size=80))
def test_nothing_from_the_air_reaches_the_terminal_raw(data, size, notice):
    spoilt = state(data if isinstance(data, dict) else {"mode": data})
    spoilt.notice = notice
    picture = render(spoilt, 100.2, size)
    assert set(SGR.findall(picture)) <= OURS
    for row in SGR.sub("", picture).split("\n"):
        assert row.isprintable()
        assert len(row) <= max(1, size[0])
    line = plain_line(spoilt.status, spoilt.telemetry, 100.2)
    assert line.isprintable()


def horizon(roll_deg, pitch_deg):
    screen = ScreenBuffer(37, 9)
    draw_horizon(screen, 0, 0, (37, 9), (roll_deg, pitch_deg), False)
    return screen.plain().split("\n")


def earth(rows, columns):
    return sum(row[columns].count(":") for row in (each.ljust(37) for each in rows))


def test_a_right_bank_raises_the_earth_on_the_right():
    left, right = slice(0, 18), slice(19, 37)
    rows = horizon(30, 0)
    assert earth(rows, right) > earth(rows, left) + 20
    rows = horizon(-30, 0)
    assert earth(rows, left) > earth(rows, right) + 20


def test_nose_up_shows_sky_and_nose_down_earth_in_any_bank():
    everywhere = slice(0, 37)
    for roll in (0, 45, 90, 180):
        assert earth(horizon(roll, 20), everywhere) < earth(horizon(roll, -20), everywhere) - 50
    assert earth(horizon(0, 80), everywhere) == 0


def test_no_attitude_no_horizon():
    assert "--" in "\n".join(horizon(None, 1.0))
    assert "=" not in "\n".join(horizon(1.0, None))


def test_bars():
    assert bar(1500, 5) == "[  #  ]"
    assert bar(2000, 5) == "[  ###]"
    assert bar(1000, 5) == "[###  ]"
    assert bar(2200, 5) == "[  ##>]"
    assert bar(0, 5) == "[<##  ]"
    assert bar(None, 5) == "[  |  ]"


def test_numbers_and_ages():
    assert number_text(None, 1, 6) == "    --"
    assert number_text(-0.04, 1) == "0.0"
    assert number_text(-0.04, 1, sign=True) == "+0.0"
    assert number_text(123456.0, 1, 5) == "*****"
    assert [age_text(each) for each in (None, -1, 0.5, 12.34, 120, 7200, 1e9)] == [
        "--",
        "0.00 s",
        "0.50 s",
        "12.3 s",
        "2 min",
        "2 h",
        "days",
    ]


def test_vetoes_warn_only_where_it_is_not_armed():
    on_ground = text_of(state(frame(vetoes=["AUX2 is low"], armed=False)))
    assert "vetoes AUX2 is low" in on_ground
    in_flight = text_of(state(frame(vetoes=["the throttle is not low"], armed=True)))
    assert "vetoes" not in in_flight


NAVIGATION = {
    "latitude": 50.0781, "longitude": 14.4422, "altitude": 401.6, "height": 89.6, "speed": 13.4,
    "climb": 0.2, "airspeed": 14.9, "wind": {"speed": 4.2, "from": 255.0}, "sd": {"position": 3.1},
}  # fmt: skip


def navigating(cause=None, **flight_control):
    data = frame(flight_mode="SETPOINT", navigation=NAVIGATION, failsafe={"cause": cause})
    data["home"] |= {"time_s": 65.0}
    data["location"]["satellites"] = 9
    data["age_ms"] |= {"navigation": 700}
    data["flight_control"] = {"mode": "RETURN", "selected": "RETURN", "fallback": None}
    data["flight_control"] |= flight_control
    return state(data)


@pytest.mark.parametrize("size", [(80, 24), (60, 50)])
def test_navigation_stands_beside_the_rest_where_the_aircraft_has_it(size):
    picture = text_of(navigating(), size=size)
    for text in (
        "flight mode RETURN",
        "50.075500   14.437800 deg 9 sat",
        "home 1204 m, bearing 271 deg, 1:05",
        "NAVIGATION 0.70 s",
        "89.6 m above home, climb +0.2 m/s",
        "ground 13.4 m/s, air 14.9 m/s",
        "wind 4.2 m/s from 255 deg, +-6 m",
        "Arduino connected, checked",
    ):
        assert text in picture, text
    assert "NAVIGATION" not in text_of(state(frame()), size=size)


def test_a_failsafe_is_told_with_its_cause():
    flown = navigating("uplink_lost")
    assert "failsafe: the uplink is lost" in plain_line(flown.status, flown.telemetry, 100.0)
    assert "flight mode RETURN by uplink_lost" in text_of(flown)
    assert "failsafe" not in plain_line(navigating().status, navigating().telemetry, 100.0)


@pytest.mark.parametrize(
    ("mission", "told"),
    [
        ({"count": 12, "item": 3, "distance": 339.6}, "mission item 3 of 12, 340 m"),
        ({"count": 12, "item": 12, "is_finished": True}, "mission finished, 12 items"),
        ({"count": 0, "item": None}, None),
        (7, None),
    ],
)
def test_progress_of_the_mission(mission, told):
    flown = state(frame(mission=mission, armed=True))
    line = plain_line(flown.status, flown.telemetry, 100.0)
    assert ((told or "mission") in line) == (told is not None)
    assert (f"ARMED {told or 'mission'}" in text_of(flown)) == (told is not None)


def test_a_fallback_is_told_with_its_reason():
    fallen = navigating(mode="CIRCLE", fallback="navigation")
    assert "flight mode CIRCLE instead of RETURN" in text_of(fallen)
    line = plain_line(fallen.status, fallen.telemetry, 100.0)
    assert "flight mode CIRCLE" in line
    assert "replaces RETURN: navigation missing or too old" in line
    assert "wind 4.2 m/s from 255 deg" in line
    assert "replaces" not in plain_line(navigating().status, navigating().telemetry, 100.0)


def test_how_the_link_is_protected_fits_into_eighty_columns():
    shown = state(frame())
    status = shown.status
    status.is_keyed, status.key_name, status.key_role = True, "tablet", "observer"
    first = text_of(shown, size=(80, 24)).splitlines()[0]
    assert "  plain  " in first and "  end to end: tablet (observer)" in first
