"""The compiled firmware flies the glider of JSBSim: the pilot's actions, faults, and limits."""

import pytest

from tests.simulator.flying import ACRO, Flown
from up_simulator.aircraft import Start
from up_simulator.firmware.board import NEUTRAL_US, BoardCrashedError
from up_simulator.firmware.imu_errors import ImuErrors

FRAME_S = 0.02


def test_fbw_banks_as_the_stick_asks_and_levels_without_it():
    flown = Flown()
    flown.board.set_stick("ailerons", 1800)
    flown.fly(3)
    asked_deg = 0.6 * flown.airframe.profile.get("fly_by_wire", {}).get("roll_deg", 50)
    # The gains of this loop are proportional alone: a turn leaves an error.
    assert flown.world.state.roll_deg == pytest.approx(asked_deg, abs=8)
    flown.board.set_stick("ailerons", 1500)
    flown.fly(4)
    assert abs(flown.world.state.roll_deg) < 4


def test_the_surfaces_follow_the_pulses_that_were_measured():
    flown = Flown(aux1=ACRO)
    before = flown.dynamics.servos
    flown.board.set_stick("ailerons", 1650)
    flown.fly(2 * FRAME_S)
    ailerons_us, elevator_us, throttle_us, rudder_us = flown.board.pulses_us()
    assert ailerons_us == pytest.approx(1650, abs=1)
    assert max(flown.board.pulse_ages_us()) < 1.2e6 * FRAME_S
    flown.fly(0.3)
    assert before[0] == pytest.approx(1500, abs=1)
    assert flown.dynamics.servos == pytest.approx(flown.board.pulses_us(), abs=8)
    assert flown.dynamics.servos[0] == pytest.approx(1650, abs=9), "dead band and play"
    assert (elevator_us, throttle_us, rudder_us) == pytest.approx((1500, 1000, 1500), abs=1)
    assert max(each.roll_rate_deg_s for each in flown.states) > 20


def test_the_motor_turns_only_when_it_is_armed():
    for arms in (True, False):
        flown = Flown(arms=arms)
        flown.board.set_stick("throttle", 1600)
        flown.fly(1)
        assert flown.status().is_armed is arms
        assert (flown.board.pulses_us()[2] > 1500) is arms
        assert (flown.world.state.motor_rpm > 2000) is arms
        assert flown.board.imu.throttle == pytest.approx(0.6 if arms else 0.0, abs=0.01)


def test_a_flight_that_begins_in_a_bank_begins_with_a_board_that_knows_it():
    flown = Flown(start=Start(roll_deg=40, pitch_deg=10), boots=False)
    flown.world.boot()
    # The boot ends tilted and at rest: everything after it is the flight.
    assert flown.world.time_s == 0
    flown.listen()
    flown.fly(0.1)
    orientation, state = flown.tap.orientation, flown.world.state
    assert orientation.roll_deg == pytest.approx(state.roll_deg, abs=2)
    assert orientation.pitch_deg == pytest.approx(state.pitch_deg, abs=2)
    flown.fly(3)
    assert abs(flown.world.state.roll_deg) < 6


def test_a_bias_is_calibrated_away_on_the_ground_and_felt_when_it_comes_in_flight():
    biased = ImuErrors(gyro_bias_deg_s=(1.5, -1.0, 0.5))
    flown = Flown(errors=biased, boots=False)
    flown.board.run_us(2e6)
    flown.board.write(flown.tap.start_bytes())

    def felt():
        flown.board.run_us(1e5)
        flown.tap.feed(flown.board.read(), flown.board.now_us / 1e6)
        orientation = flown.tap.orientation
        return orientation.roll_rate_deg_s, orientation.pitch_rate_deg_s, orientation.yaw_rate_deg_s

    assert felt() == pytest.approx((0, 0, 0), abs=0.25)
    flown.board.imu.errors = ImuErrors()
    assert felt() == pytest.approx((-1.5, 1.0, -0.5), abs=0.25)


def test_an_aircraft_that_has_hit_the_ground_lies_still():
    flown = Flown(aux1=ACRO, start=Start(height_m=4, pitch_deg=-30))
    flown.fly(2)
    assert flown.dynamics.crash is not None
    orientation = flown.tap.orientation
    assert orientation.roll_rate_deg_s == pytest.approx(0, abs=1)
    assert orientation.pitch_rate_deg_s == pytest.approx(0, abs=1)


def test_a_crash_of_the_board_is_reported():
    flown = Flown(boots=False)
    flown.world.advance(0.1)
    # From the reset vector on, a jump to where no flash is.
    flown.board._rig.write_flash(0, bytes.fromhex("0c94ff7f") * 4096)
    flown.board.reset("button")
    with pytest.raises(BoardCrashedError) as crash:
        flown.world.advance(1)
    assert "went wild" in str(crash.value)
    assert "\n" not in str(crash.value)
    assert flown.board.pulses_us()[0] == NEUTRAL_US[0]
