import pytest

from tests.flightlog.flights import (
    BOARD,
    GROUND,
    PHONE,
    AltitudeCommand,
    AndroidBatteryCommand,
    FlightMaker,
    FlightStateCommand,
    LocationCommand,
    TelemetryCommand,
    status,
)
from tests.flightlog.logs import START_NS
from up.commands.board_schema import VETOES
from up.earth import distance_m
from up_flightlog.findings.flight_context import FlightContext
from up_flightlog.findings.summary import Mark, ModeSpan, summarise
from up_flightlog.read.spans import Span, duration_text, joined, spans_of
from up_flightlog.read.track_statistics import fixes, track_statistics
from up_flightlog.report.figures import figures_of
from up_flightlog.report.report_data import bands_of


def test_a_flight_on_one_page(tmp_path):
    maker = FlightMaker()
    flight = {"aircraft": "glider-1", "version": "0.1.0", "mode": "auto"}
    maker.writer.add_metadata("flight", {**flight, "flight_controller": "arduino"})
    maker.quiet_flight(20.0, armed=(5.0, 15.0))
    maker.every(0, 20, 1.0, lambda time_s: AltitudeCommand(300.0 + time_s), PHONE)
    maker.put(3, AltitudeCommand(900.0, "required"), GROUND)
    maker.put(1, AndroidBatteryCommand(80.0), PHONE)
    maker.put(11, AndroidBatteryCommand(71.0), PHONE)
    maker.put(2, status(vetoes=0b1), BOARD)
    for time_s, battery_mv in ((12, 11_140), (13, 9_870), (14, 0)):
        maker.put(time_s, status(battery_mv=battery_mv), BOARD)
    maker.put(2, TelemetryCommand({"vetoes": ["gains: unreadable"]}, 1))
    maker.add(7, "black_box.mark", text="thermal")
    maker.line(1, 3, "LoadGuard", "a warning")
    maker.line(2, 4, "Up", "an error")
    maker.line(3, 2, "Up", "an information")
    found = summarise(maker.log(tmp_path))
    assert found.start_unix_s == START_NS / 1e9
    assert found.length_s == pytest.approx(19.9)
    assert (found.aircraft, found.version, found.mode) == ("glider-1", "0.1.0", "auto")
    assert found.flight_controller == "arduino"
    (armed,) = found.armed
    assert (armed.begin_s, armed.end_s) == pytest.approx((5.0, 15.0), abs=0.21)
    assert found.armed_s == pytest.approx(10.0, abs=0.21)
    assert (found.highest_m, found.lowest_m) == (319.0, 300.0)
    assert found.lowest_battery_percent == 71.0
    assert found.lowest_flight_battery_v == 9.87
    assert ("lowest flight battery", "9.87 V") in figures_of(found)
    assert found.vetoes == ["gains: unreadable", f"arduino: {VETOES[0]}"]
    assert found.marks == [Mark(7.0, "thermal")]
    assert (found.warnings, found.errors) == (1, 1)
    assert found.failsafes == []
    assert found.is_complete
    assert found.gaps_s["orientation"] == pytest.approx(0.1)
    assert found.gaps_s["battery"] == pytest.approx(10.0)
    assert "heading" not in found.gaps_s


def test_while_the_board_follows_the_mode_of_the_raspberry_pi_counts(tmp_path):
    maker = FlightMaker()
    for time_s, mode in ((0, "FBW"), (2, "SETPOINT"), (8, "RETURN"), (9, "FBW"), (10, "FBW")):
        maker.put(time_s, FlightStateCommand(mode, True, mode != "FBW", mode == "RETURN"), BOARD)
    for time_s, mode in ((1.9, None), (2.1, "LOITER"), (4, None), (5, "RETURN"), (8.1, "RETURN")):
        maker.put(time_s, TelemetryCommand({"flight_control": {"mode": mode}}, 1))
    maker.put(9.1, TelemetryCommand({"flight_control": {"mode": "RETURN"}}, 1))
    context = FlightContext(maker.log(tmp_path))
    assert summarise(context.log, context).modes == [
        ModeSpan("FBW", 0.0, 2.0),
        ModeSpan("LOITER", 2.0, 5.0),
        ModeSpan("RETURN", 5.0, 9.0),
        ModeSpan("FBW", 9.0, 10.0),
    ]
    assert [(each.name, each.begin_s, each.end_s) for each in bands_of(context)] == [
        ("FBW", 0.0, 2.0),
        ("LOITER", 2.0, 5.0),
        ("RETURN", 5.0, 8.0),
        ("failsafe", 8.0, 9.0),
        ("FBW", 9.0, 10.0),
    ]


def test_modes_with_their_times(tmp_path):
    maker = FlightMaker()
    for time_s, mode in ((0, "ACRO"), (2, "FBW"), (3, "FBW"), (7, "ACRO"), (8, None), (9, "FBW")):
        maker.put(time_s, FlightStateCommand(mode, False, False, time_s == 7), BOARD)
    maker.put(10, FlightStateCommand("FBW", False, False, False), BOARD)
    found = summarise(maker.log(tmp_path))
    assert found.modes == [
        ModeSpan("ACRO", 0.0, 2.0),
        ModeSpan("FBW", 2.0, 7.0),
        ModeSpan("ACRO", 7.0, 8.0),
        ModeSpan("FBW", 9.0, 10.0),
    ]
    assert found.failsafes == [Span(7.0, 8.0)]


def test_the_state_from_telemetry_without_the_boards(tmp_path):
    maker = FlightMaker()
    for time_s in range(10):
        tree = {"armed": time_s > 4, "flight_mode": "FBW", "arduino": {"failsafe": time_s == 6}}
        maker.put(time_s, TelemetryCommand(tree, time_s))
    found = summarise(maker.log(tmp_path))
    assert found.armed == [Span(5.0, 9.0, is_open=True)]
    assert found.failsafes == [Span(6.0, 7.0)]
    assert found.modes == [ModeSpan("FBW", 0.0, 9.0)]


def test_an_empty_log(tmp_path):
    found = summarise(FlightMaker().log(tmp_path))
    assert found.highest_m is found.track_m is found.lowest_battery_percent is None
    assert found.lowest_flight_battery_v is None
    assert (found.armed, found.modes, found.gaps_s, found.messages) == ([], [], {}, 0)


def circle(maker, origin=PHONE, speed=True, offset=0.0):
    """Put 2 km straight to the north in 100 s and back, with the receiver's trembling."""
    for second in range(201):
        north_m = 20.0 * (second if second <= 100 else 200 - second)
        trembling = (-1) ** second * 1e-6
        maker.put(
            second + offset,
            LocationCommand(
                50.0 + north_m / 111_194.9 + trembling,
                14.0 + trembling,
                300.0 + second,
                speed_m_s=20.0 if speed else None,
            ),
            origin,
        )


@pytest.mark.parametrize("speed", [True, False])
def test_the_way_has_length_speed_and_distance(tmp_path, speed):
    maker = FlightMaker()
    circle(maker, speed=speed)
    way = track_statistics(maker.log(tmp_path))
    assert way.length_m == pytest.approx(4000, rel=0.01)
    assert way.farthest_m == pytest.approx(2000, rel=0.01)
    assert way.top_speed_m_s == pytest.approx(20, rel=0.02)
    assert (way.lowest_m, way.highest_m) == (300.0, 500.0)


def test_an_aircraft_that_stands_has_no_way(tmp_path):
    maker = FlightMaker()
    for second in range(600):
        north_m = (second * 7919 % 100) / 50 - 1
        maker.put(second, LocationCommand(50 + north_m / 111_000, 14.0), PHONE)
    assert track_statistics(maker.log(tmp_path)).length_m == 0.0


def test_jumps_of_the_receiver_do_not_count(tmp_path):
    maker = FlightMaker()
    circle(maker, speed=False)
    maker.put(50.5, LocationCommand(0.0, 0.0), PHONE)
    maker.put(120.5, LocationCommand(50.5, 14.0), PHONE)
    way = track_statistics(maker.log(tmp_path))
    assert way.length_m == pytest.approx(4000, rel=0.01)
    assert way.farthest_m == pytest.approx(2000, rel=0.01)
    assert way.top_speed_m_s == pytest.approx(20, rel=0.05)


def test_a_first_place_that_was_wrong_is_not_home(tmp_path):
    maker = FlightMaker()
    maker.put(0, LocationCommand(0.0, 0.0), PHONE)
    circle(maker, speed=False, offset=1.0)
    way = track_statistics(maker.log(tmp_path))
    assert way.length_m == pytest.approx(4000, rel=0.03)
    assert way.farthest_m == pytest.approx(2000, rel=0.03)


def test_one_receiver_is_followed_at_a_time(tmp_path):
    maker = FlightMaker()
    circle(maker, PHONE)
    for second in range(201):
        maker.put(second + 0.5, LocationCommand(50.001, 14.01), GROUND)
    found = list(fixes(maker.log(tmp_path)))
    assert {round(fix.longitude_deg, 3) for fix in found} == {14.0}
    assert len(found) == 201


def test_a_repeated_position_does_not_count(tmp_path):
    # A phone that gives its last known place again and again flies with no speed, then jumps.
    maker = FlightMaker()
    for tenth in range(100):
        maker.put(tenth / 10, LocationCommand(50.0, 14.0), PHONE)
    maker.put(10, LocationCommand(50.001, 14.0), PHONE)
    way = track_statistics(maker.log(tmp_path))
    assert way.top_speed_m_s == pytest.approx(distance_m(50, 14, 50.001, 14) / 10)


def test_spans_and_durations():
    states = [(0.0, False), (1.0, True), (2.0, True), (3.0, False), (5.0, True)]
    assert spans_of(states, 7.0) == [Span(1.0, 3.0), Span(5.0, 7.0, is_open=True)]
    assert joined(spans_of(states, 7.0), 2.0) == [Span(1.0, 7.0, is_open=True)]
    assert joined(spans_of(states, 7.0), 1.9) == spans_of(states, 7.0)
    assert joined([], 1.0) == []
    texts = {0.354: "0.35 s", 1.24: "1.2 s", 9.96: "10 s", 48.4: "48 s", 125: "2 min 05 s"}
    assert {s: duration_text(s) for s in texts} == texts
    assert duration_text(3725) == "1 h 02 min"
