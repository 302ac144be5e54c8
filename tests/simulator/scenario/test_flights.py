"""Real flights of the compiled firmware and of the daemon, short ones."""

import os
import subprocess
import sys

import pytest

from tests.simulator.scenario.minimal import HEAD
from tests.support.firmware import build_firmware
from tests.support.waiting import HANG_S
from up_simulator.firmware.imu_errors import drawn_errors
from up_simulator.in_process.phone import InProcessPhone
from up_simulator.phone.address import NotFoundError
from up_simulator.scenario.build import build_flight
from up_simulator.scenario.file import parse_scenario
from up_simulator.scenario.result import Result, verdicts_of

LEVEL = "sticks: [{at_s: 0, mode: FBW, arm: true, throttle: 0.5}]\n"
HELD = "expect: [{name: It is held, signal: error.roll_deg, rms_below: 3}]\n"


@pytest.fixture(scope="module", autouse=True)
def firmware():
    build_firmware()


def fly(text):
    return build_flight(parse_scenario(text)).fly()


def not_held(record):
    return [verdict for verdict in verdicts_of(record) if not verdict.is_held]


def test_the_same_seed_gives_the_same_log_in_another_process(tmp_path):
    text = HEAD + (
        "raspilot: {runs: in process}\nground: {}\nphone: {orientation: udp}\n"
        "weather: {turbulence: light}\n"
        "link: {up: {delay_ms: 30, jitter_ms: 20, loss_percent: 5}}\n"
        "events:\n"
        "  - {at_s: 1, serial_noise: {for_s: 1, flipped_percent: 1, lost_percent: 1}}\n"
        "  - {at_s: 1.5, command: {name: up.telemetry.frequency, data: {frequency: 50}}}\n"
        "  - {at_s: 2, raspilot: killed}\n"
        "  - {at_s: 2.5, raspilot: started}\n"
    )
    here = fly(text + LEVEL + HELD)
    assert here.pending_commands[0].answer == ""
    assert max(here.log.numbers("ground.frames")) > 10
    told, true = (here.log.numbers(f"{each}.roll_deg")[95] for each in ("board", "truth"))
    assert here.log.numbers("ground.orientation.roll")[95] == pytest.approx(told, abs=3)
    assert told == pytest.approx(true, abs=3)
    (tmp_path / "same.yml").write_text(text + LEVEL + HELD)
    command = [sys.executable, "-m", "up_simulator.cli", "fly", tmp_path / "same.yml", "--quiet"]
    subprocess.run(
        [*command, "--no-picture", "--output", tmp_path],
        env=os.environ | {"PYTHONHASHSEED": "77"},
        timeout=HANG_S,
        check=False,
    )
    here.log.write(tmp_path / "here.csv")
    assert (tmp_path / "same" / "log.csv").read_text() == (tmp_path / "here.csv").read_text()


def test_a_row_is_logged_every_20_ms_and_events_at_their_times():
    record = fly(HEAD + LEVEL + "events: [{at_s: 1, mark: a}, {at_s: 3, mark: b}]\n" + HELD)
    assert record.log.events == [(1.0, "a"), (3.0, "b")]
    times_s = record.log.numbers("time_s")
    assert times_s == [round(at * 0.02, 6) for at in range(201)]
    assert record.log.column("board.mode")[0] == "FBW"
    assert record.log.numbers("board.armed")[0] == 1.0
    assert record.flown_s == 4.0 and record.notes == {}
    # Pulses come every 20 ms: between two rows an output grows nearly that old.
    stale_ms = record.log.numbers("servo.stale_ms")[1:]
    assert all(15.0 < each < 25.0 for each in stale_ms)


def test_held_back_telemetry_has_its_true_age():
    text = (
        HEAD.replace("duration_s: 4", "duration_s: 12")
        + LEVEL
        + (
            "raspilot: {runs: in process}\nground: {period_ms: 50}\n"
            "events:\n"
            "  - {at_s: 0.5, name: killed, raspilot: killed}\n"
            "  - {at_s: 0.6, name: started, raspilot: started}\n"
            "  - {at_s: 3, name: the stall, link: stall}\n"
            "  - {at_s: 3.2, name: the end, link: restore}\n"
            "  - {at_s: 4.6, name: slow, link_settings: {up: {delay_ms: 1300}}}\n"
            "expect:\n"
            "  - {name: a, signal: ground.latency_s, to_s: 3.18, below: 0.1}\n"
            "  - {name: b, signal: ground.latency_s, after: the end, becomes_above: 0.15,"
            " within_s: 0.1}\n"
            "  - {name: c, signal: ground.latency_s, from_s: 4.4, to_s: 4.6, below: 0.1}\n"
            "  - {name: d, signal: ground.latency_s, from_s: 10, between: [1.2, 2.4]}\n"
        )
    )
    assert not_held(fly(text)) == []


def test_a_crash_ends_the_flight_and_the_log():
    text = HEAD + "start: {height_m: 10, pitch_deg: -60, airspeed_m_s: 15}\n"
    record = fly(text + "sticks: [{at_s: 0, mode: ACRO}]\n" + HELD.replace("error", "truth"))
    assert record.crash and record.crash_s is not None and record.crash_s < 3.0
    assert [verdict.code for verdict in not_held(record)] == ["flight_ended", "crashed"]
    assert record.log.numbers("truth.crashed")[-1] == 1.0
    # The log ends with the flight.
    assert abs(record.log.numbers("time_s")[-1] - record.crash_s) < 0.021


def test_a_daemon_that_cannot_start_fails_the_flight():
    record = fly(
        HEAD
        + "raspilot:\n  runs: in process\n  config:\n    disabled_modules.yml:\n"
        + "      disabled modules: [serial_cog.modules.serial_provider.SerialProvider]\n"
        + LEVEL
        + HELD
    )
    assert record.failure_code == "participant_failed" and "SerialProvider" in record.failure
    assert record.flown_s == 0.0 and not Result(record, verdicts_of(record)).is_held


def test_a_daemon_that_ends_unexpectedly_fails_the_flight_with_its_newest_log_lines():
    flight = build_flight(parse_scenario(HEAD + "raspilot: {runs: in process}\n" + LEVEL + HELD))
    raspilot = flight.participants.raspilot

    def end_it(time_s):
        if time_s >= 1.0 and raspilot.is_running:
            raspilot.kill()

    record = flight.fly(end_it)
    assert record.failure_code == "daemon_ended"
    assert 1.0 <= record.flown_s < 1.1
    assert record.failure_log == list(raspilot.log)[-20:] != []
    assert not Result(record, verdicts_of(record)).is_held


def test_ctrl_c_ends_a_flight_with_a_partial_record():
    def interrupt(time_s):
        if time_s >= 1.0:
            raise KeyboardInterrupt

    record = build_flight(parse_scenario(HEAD + LEVEL + HELD)).fly(interrupt)
    assert record.is_interrupted and record.flown_s == 1.0
    assert not Result(record, verdicts_of(record)).is_held


def test_the_bias_is_drawn_by_the_seed_unless_the_scenario_sets_it():
    def bias(text):
        return build_flight(parse_scenario(HEAD + text + LEVEL + HELD))._board.imu.errors

    assert bias("").gyro_bias_deg_s == drawn_errors(1).gyro_bias_deg_s
    assert bias("seed: 2\n").gyro_bias_deg_s == drawn_errors(2).gyro_bias_deg_s
    assert bias("imu: {gyro_bias_deg_s: [0, 0, 0]}\n").gyro_bias_deg_s == (0, 0, 0)


def test_a_stick_reaches_the_board_after_the_receivers_delay():
    def moved_s(delay_ms):
        record = fly(
            HEAD.replace("4", "1.5")
            + f"board: direct\nreceiver: {{delay_ms: {delay_ms}}}\n"
            + "sticks: [{at_s: 1, ailerons: 0.5}]\n"
            + "expect: [{name: It moves, signal: servo.ailerons_us, below: 2000}]\n"
        )
        pulses = record.log.numbers("servo.ailerons_us")
        assert max(record.log.numbers("stick.ailerons_us")) == 1750
        return record.log.numbers("time_s")[next(at for at, us in enumerate(pulses) if us > 1700)]

    assert moved_s(200) - moved_s(0) == pytest.approx(0.2, abs=0.001)


def test_without_gps_the_position_becomes_stale_and_the_altitude_does_not():
    record = fly(
        HEAD + "raspilot: {runs: in process}\nground: {period_ms: 50}\nphone: {}\n"
        "events: [{at_s: 0.5, gps: lost}, {at_s: 3, gps: back}]\n" + LEVEL + HELD
    )
    ages_ms = record.log.numbers("ground.age_ms.location")
    assert ages_ms[145] > 2000 > max(record.log.numbers("ground.age_ms.altitude"))
    assert ages_ms[-1] < 1000


def test_a_flight_begins_only_when_the_phone_is_connected(monkeypatch):
    find = InProcessPhone.find
    attempts = []

    async def find_late(phone):
        attempts.append(phone)
        if len(attempts) < 6:
            raise NotFoundError("not yet")
        return await find(phone)

    monkeypatch.setattr(InProcessPhone, "find", find_late)
    record = fly(HEAD + "raspilot: {runs: in process}\nground: {}\nphone: {}\n" + LEVEL + HELD)
    assert len(attempts) == 6 and record.notes == {}
    assert record.log.numbers("ground.android.connected")[0] == 1.0
