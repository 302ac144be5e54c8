import re
import struct
from pathlib import Path

import pytest

from up_flightlog.read import demand
from up_flightlog.read.demand import Demand, DemandModel
from up_simulator.scenario.flight import setpoint_of

CENTRED = {"ailerons": 1500.0, "elevator": 1500.0}
HEADER = Path(__file__).parents[3] / "arduino/raspilot/src/control/flight_controller.h"


def at(mode, profile=None, is_failsafe=False, **sticks):
    return DemandModel(profile or {}).at(mode, is_failsafe, {**CENTRED, **sticks})


def test_fly_by_wire_has_the_limits_of_the_profile():
    assert at("FBW", ailerons=2000.0, elevator=2000.0) == Demand(50.0, 20.0)
    assert at("FBW", ailerons=1000.0, elevator=1000.0) == Demand(-50.0, -25.0)
    profile = {"fly_by_wire": {"roll_deg": 30, "pitch_up_deg": 10, "pitch_down_deg": None}}
    assert at("FBW", profile, ailerons=1750.0, elevator=1250.0) == Demand(15.0, -12.5)
    assert at("FBW", profile, ailerons=2200.0) == Demand(30.0, 0.0)


def test_rate_demands_the_rates_of_the_firmware():
    full = at("RATE", ailerons=2000.0, elevator=1000.0)
    assert full == Demand(roll_rate_deg_s=180.0, pitch_rate_deg_s=-90.0)
    found = dict(re.findall(r"(\w+_STICK_DEG_S) = (\d+);", HEADER.read_text()))
    assert float(found["ROLL_STICK_DEG_S"]) == demand.ROLL_STICK_DEG_S
    assert float(found["PITCH_STICK_DEG_S"]) == demand.PITCH_STICK_DEG_S


def test_failsafe_demands_the_circle():
    assert at("FBW", is_failsafe=True, ailerons=2000.0) == Demand(20.0, -3.0)
    profile = {"receiver_lost": {"circle_bank_deg": -15, "glide_pitch_deg": -5}}
    assert at("ACRO", profile, is_failsafe=True) == Demand(-15.0, -5.0)


def test_a_set_point_is_that_of_the_raspberry_pi():
    model = DemandModel({})
    assert model.at("SETPOINT", False, CENTRED) == Demand()
    model.setpoint = setpoint_of(struct.pack(">hhhHH", 1250, -300, 0, 0, 250))
    assert model.at("SETPOINT", False, CENTRED) == Demand(12.5, -3.0)


def test_a_stick_without_a_pulse_demands_nothing():
    assert DemandModel().at("FBW", False, {"elevator": 1500.0}) == Demand(None, 0.0)


@pytest.mark.parametrize("mode", ["ACRO", "RTH", "None"])
def test_other_modes_demand_nothing(mode):
    assert at(mode, ailerons=2000.0) == Demand()
