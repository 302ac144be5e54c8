from tests.flightlog.flights import GROUND, FlightMaker
from tests.flightlog.flights import PIDTuningsCommand as Tunings
from up_flightlog.report.gains import gain_sets, requested_sets


def test_a_log_without_gains_is_not_decoded_for_them(tmp_path):
    maker = FlightMaker()
    maker.quiet_flight()
    log = maker.log(tmp_path)
    decoded = []
    log.on_decoded = decoded.append
    assert (gain_sets(log), requested_sets(log), decoded) == ([], [], [])


def test_a_request_is_no_requested_set(tmp_path):
    axes = {axis: {"p": 1.0, "i": 0.0, "d": 0.0} for axis in ("ailerons", "elevator", "rudder")}
    maker = FlightMaker()
    maker.put(0, Tunings(request=True), GROUND)
    maker.put(1, Tunings(pids={"ratePIDs": axes, "stabPIDs": axes}), GROUND)
    (requested,) = requested_sets(maker.log(tmp_path))
    assert requested.time_s == 1.0 and requested.values["rate", "roll", "p"] == 1.0
