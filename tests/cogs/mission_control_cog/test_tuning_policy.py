import pytest
from mission_control_cog.tuning_policy import KEY, TuningPolicy

from up.commands.arming_commands import DisarmCommand
from up.commands.flight_state_command import FlightStateCommand
from up.commands.pid_tunings_commands import PIDTuningsCommand

LOOP = {axis: {"p": 1.0, "i": 0.0, "d": 0.0} for axis in ("ailerons", "elevator")}
SET = PIDTuningsCommand(pids={"ratePIDs": LOOP, "stabPIDs": LOOP})
ARMED = FlightStateCommand("FBW", True, False, False, True)
AT_AUTO = FlightStateCommand("OUTPUT", False, True, False, False)
GLIDER = FlightStateCommand("FBW", False, False, False, True)
NOT_KNOWN = FlightStateCommand(None, False, False, False)
ON_GROUND = FlightStateCommand("FBW", False, False, False, False)


@pytest.mark.parametrize("state", [ARMED, AT_AUTO, GLIDER, NOT_KNOWN])
def test_gains_are_refused_in_flight_and_the_key_is_named(state):
    policy = TuningPolicy(tunes_in_flight=False)
    policy.on_flight_state(state)
    assert KEY in policy(SET)
    policy.on_flight_state(ON_GROUND)
    assert policy(SET) is None


def test_the_configuration_accepts_tuning_in_flight():
    policy = TuningPolicy(tunes_in_flight=True)
    policy.on_flight_state(ARMED)
    assert policy(SET) is None


def test_nothing_else_is_refused():
    policy = TuningPolicy(tunes_in_flight=False)
    policy.on_flight_state(ARMED)
    assert policy(PIDTuningsCommand(request=True)) is None
    assert policy(DisarmCommand()) is None
