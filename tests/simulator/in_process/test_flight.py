"""The firmware, the daemon, the phone and the ground station fly together in one process."""

import pytest

from tests.simulator.in_process.flying import ACRO_US, AUTO_US, CELLULAR, Flying
from up_simulator.aircraft.dynamics import Start

OF_THE_PI = {"config.yml": {"flight controller": "raspberry"}}
TUNING = {"mission_control.yml": {"tune_in_flight": True}}


@pytest.fixture
def fly(tmp_path):
    flown = []

    def begin(files=None, **options):
        flown.append(Flying(tmp_path, files, **options))
        return flown[-1]

    yield begin
    for flying in flown:
        flying.raspilot.kill()


def mode_of(flying):
    """Request the board's mode, past the daemon: its status is too infrequent to measure by."""
    tap = flying.board.tap
    flying.board.write(tap.command_bytes("m"))
    return tap.mode


def test_the_ground_shows_the_attitude_of_firmware_and_aircraft(fly):
    flying = fly(start=Start(roll_deg=25), link=CELLULAR)
    flying.start()
    flying.board.set_stick("ailerons", 1600)
    errors_deg, delays_s = [], []

    def sample():
        received, measured = flying.ground.telemetry, flying.board.tap.orientation
        if received.get("source", {}).get("orientation") == "arduino":
            errors_deg.append(abs(received["orientation"]["roll"] - measured.roll_deg))
            delays_s.append(flying.now_s - flying.ground.newest_s)

    flying.fly(4.0, sample)
    assert flying.state.roll_deg > 8
    assert flying.board.tap.orientation.roll_deg == pytest.approx(flying.state.roll_deg, abs=2.5)
    # As old as a period of telemetry and the link: the bank changes by up to 40 deg/s.
    assert max(errors_deg[-500:]) < 4
    assert max(delays_s) < 0.15
    assert flying.ground.lost_frames == 0


def test_gains_from_the_ground_reach_the_board_and_are_read_back(fly):
    flying = fly(TUNING)
    flying.start(phone=False)
    wanted = {
        "ratePIDs": {
            "ailerons": {"p": 1.25, "i": 0.0, "d": 0.0},
            "elevator": {"p": 0.75, "i": 0.0, "d": 0.0},
            "rudder": {"p": 0.5, "i": 0.0, "d": 0.0},
        },
        "stabPIDs": {
            "ailerons": {"p": 3.5, "i": 0.0, "d": 0.0},
            "elevator": {"p": 4.5, "i": 0.0, "d": 0.0},
            "rudder": {"p": 0.0, "i": 0.0, "d": 0.0},
        },
    }
    assert flying.ask("arduino.pids.tunings", pids=wanted) == ""
    # From the board itself, past the daemon.
    flying.board.tap.take_answers()
    flying.board.write(flying.board.tap.command_bytes("G"))
    flying.fly(0.1)
    answers = [each for each in flying.board.tap.take_answers() if each.type == "G"]
    assert answers[-1].payload[:4].hex() == "3fa00000"
    assert answers[-1].payload[36:40].hex() == "40600000"
    assert flying.ask("arduino.pids.tunings", request=True) == ""
    flying.fly(0.5)
    values = flying.ground.others["arduino.pids.values"]
    assert values["ratePIDs"] == wanted["ratePIDs"]
    assert values["stabPIDs"] == wanted["stabPIDs"]


def test_a_killed_daemon_leaves_level_flight_to_the_board_within_250_ms(fly):
    flying = fly(OF_THE_PI, arms=True, start=Start(roll_deg=20))
    flying.start()
    flying.board.set_stick("aux1", AUTO_US)
    flying.until(lambda: flying.status.mode_letter == "u", 3.0)
    flying.fly(1.5)
    assert mode_of(flying) and flying.status.mode_letter == "u"
    flying.raspilot.kill()
    took_s = flying.until(lambda: mode_of(flying) == "f", 1.0)
    assert took_s <= 0.25
    stale_us = []
    flying.fly(2.0, lambda: stale_us.append(max(flying.board.pulse_ages_us())))
    assert max(stale_us) < 25_000, "the servos never wait"
    assert abs(flying.state.roll_deg) < 6
    # Back, it takes the aircraft again without anybody's help.
    flying.raspilot.start()
    assert flying.until(lambda: flying.status.mode_letter == "u", 3.0) < 2.0


def test_leaving_auto_takes_control_from_the_daemon_within_one_frame(fly):
    flying = fly(OF_THE_PI, arms=True)
    flying.start()
    flying.board.set_stick("aux1", AUTO_US)
    flying.until(lambda: flying.status.mode_letter == "u", 3.0)
    flying.board.set_stick("aux1", ACRO_US)
    assert flying.until(lambda: mode_of(flying) == "a", 1.0) <= 0.06
