import gzip
import math
from dataclasses import replace
from itertools import pairwise

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from tests.simulator.program import Line, Program
from up_simulator.aircraft.flight import NEUTRAL, FlightState, FlightUnavailableError
from up_simulator.aircraft.recorded_flight import COLUMNS, RecordedFlight, StateLog, read_recording

STILL = FlightState(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 50.0, 14.5, 650.0, 400.0, 9.0, 0.0, 9.0)


def turning(duration_s=20.0):
    """A flight that banks to and fro, turns through north and moves north."""
    return [
        replace(
            STILL,
            time_s=time_s,
            roll_deg=20.0 * math.sin(time_s / 3),
            yaw_deg=(350.0 + 5.0 * time_s) % 360.0,
            latitude_deg=50.0 + 1e-5 * time_s,
        )
        for time_s in (100.0 + tick * 0.02 for tick in range(int(duration_s * 50)))
    ]


def written(path, states):
    log = StateLog(path)
    for state in states:
        log.record(state, NEUTRAL)
    log.close()
    return path


def angle(a, b):
    return abs((a - b + 180.0) % 360.0 - 180.0)


def test_a_state_log_is_flown_again(tmp_path):
    states = turning()
    flight = read_recording(written(tmp_path / "log.csv", states))
    flight.advance(5.0)
    expected = states[250]
    assert flight.state.roll_deg == pytest.approx(expected.roll_deg, abs=0.01)
    assert angle(flight.state.yaw_deg, expected.yaw_deg) < 0.01
    assert flight.state.latitude_deg == pytest.approx(expected.latitude_deg, abs=1e-7)
    assert flight.state.time_s == 5.0


def test_a_log_has_a_line_for_every_20_ms(tmp_path):
    states = [replace(STILL, time_s=tick * 0.005) for tick in range(400)]
    text = written(tmp_path / "log.csv", states).read_text()
    lines = text.splitlines()
    assert lines[0] == ",".join(COLUMNS) + ",ailerons_us,elevator_us,throttle_us,rudder_us"
    assert len(lines) == 101


def test_it_loops_without_a_jump_and_goes_on_where_it_was():
    flight = RecordedFlight(turning())
    states = [flight.state]
    for _ in range(4000):
        flight.advance(0.02)
        states.append(flight.state)
    for before, after in pairwise(states):
        assert angle(before.roll_deg, after.roll_deg) < 0.5
        assert angle(before.yaw_deg, after.yaw_deg) < 1.5
        assert 0.0 <= after.latitude_deg - before.latitude_deg < 4e-7
        assert after.time_s > before.time_s
    assert states[-1].latitude_deg > 50.0 + 70e-5


def test_servos_have_no_effect():
    flown, steered = RecordedFlight(turning()), RecordedFlight(turning())
    steered.set_servos((2000, 2000, 2000, 2000))
    for each in (flown, steered):
        each.advance(3.0)
    assert flown.state == steered.state
    assert steered.servos == (2000, 2000, 2000, 2000)


def test_the_shipped_flight_is_a_real_one():
    flight = read_recording(None)
    rolls, sinks = [], []
    for _ in range(50 * 90):
        before = flight.state
        flight.advance(0.02)
        assert angle(before.roll_deg, flight.state.roll_deg) < 5.0
        rolls.append(flight.state.roll_deg)
        sinks.append(flight.state.height_m)
    assert max(rolls) > 15.0
    assert min(rolls) < -15.0
    assert all(300.0 < height_m < 500.0 for height_m in sinks)


def test_the_shipped_flight_is_small():
    from importlib import resources

    data = resources.files("up_simulator.aircraft").joinpath("recorded_flight.csv.gz").read_bytes()
    assert len(data) < 300_000
    assert len(gzip.decompress(data).splitlines()) > 60 * 50


HEADER = ",".join(COLUMNS) + "\n"


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("", ":1: "),
        ("time,roll\n", ":1: "),
        (HEADER, "log.csv: "),
        (HEADER + "0" + ",1" * 12 + "\n", ":2: "),
        (HEADER + "0" + ",1" * 12 + ",nan\n", ":2: "),
        (HEADER + "0" + ",1" * 12 + ",x\n", ":2: "),
        (HEADER + ("1" + ",1" * 13 + "\n") * 2, ":3: "),
        (HEADER + "".join(f"{each}" + ",1" * 13 + "\n" for each in (0, 1)), "8 s"),
    ],
)
def test_a_file_that_is_no_flight_is_refused_with_its_line(tmp_path, text, line):
    path = tmp_path / "log.csv"
    path.write_text(text)
    with pytest.raises(FlightUnavailableError, match=line) as error:
        read_recording(path)
    assert "\n" not in str(error.value)


@given(st.binary(max_size=200))
@example(b"\r\x00")
def test_any_file_is_refused_in_one_sentence(tmp_path_factory, data):
    path = tmp_path_factory.mktemp("any") / "log.csv"
    path.write_bytes(data)
    with pytest.raises(FlightUnavailableError):
        read_recording(path)


def test_a_cut_gzip_file_is_refused(tmp_path):
    path = tmp_path / "log.csv.gz"
    path.write_bytes(gzip.compress(HEADER.encode() * 100)[:-20])
    with pytest.raises(FlightUnavailableError, match="cannot read"):
        read_recording(path)


def test_the_program_replays_a_file(tmp_path):
    path = written(tmp_path / "log.csv", turning())
    with Program("--no-phone", "--pty-link", tmp_path / "board", "--replay", path) as program:
        program.wait_for("flight_selected", source="recording")
        program.wait_for("board_ready")
        with Line(tmp_path / "board") as line:
            line.send("s")
            line.wait_for_type("O")
        assert program.end()[0] == 0


def test_without_jsbsim_the_shipped_flight_is_flown_and_the_reason_logged(tmp_path):
    """A module named jsbsim that cannot be imported stands before the real one."""
    (tmp_path / "jsbsim.py").write_text("raise ImportError('no-wheel')\n")
    with Program("--no-phone", environment={"PYTHONPATH": str(tmp_path)}) as program:
        line = program.wait_for("flight_selected", source="recording")
        program.wait_for("board_ready")
        assert program.end()[0] == 0
    assert "no-wheel" in line.fields["reason"]
