import json

from raspilot.mission.borders import local_borders, margin_m
from tests.support.firmware import build_firmware
from tests.support.tools import need_tool
from up.flight_modes.navigation_state import LocalFrame, Point
from up.mission.items import Border, plan_id
from up_simulator.scenario.build import build_flight
from up_simulator.scenario.file import read_scenario

SCENARIO = {
    "title": "A polygon",
    "board": "host",
    "duration_s": 40,
    "weather": {"wind_m_s": 4, "wind_from_deg": 200},
    "raspilot": {"runs": "in process", "config": {"return.yml": {"height_m": 20}}},
    "phone": {},
    "ground": {"role": "operator", "period_ms": 100},
    "sticks": [{"at_s": 0, "mode": "AUTO", "arm": True, "throttle": 0.55}],
    "expect": [{"name": "It stays armed", "signal": "board.armed", "is": True}],
}
FRAME = LocalFrame(50.0, 14.5)
CORNERS = ((160, -300), (160, 300), (-300, 300), (-100, 0), (-300, -300))
FENCE = Border(corners=tuple(FRAME.degrees(Point(*each)) for each in CORNERS))
TURN_S = 6.0


def test_it_turns_home_before_the_border_of_a_polygon(tmp_path):
    need_tool("g++")
    build_firmware()
    path = tmp_path / "flight.yml"
    path.write_text(json.dumps(SCENARIO), encoding="utf-8")
    flight = build_flight(read_scenario(path))
    ground = flight.participants.ground
    borders = local_borders([FENCE], FRAME)
    margins_m = []

    def fly(duration_s):
        for _ in range(round(duration_s / 0.002)):
            flight.step()
        state = flight.state
        point = FRAME.point(state.latitude_deg, state.longitude_deg)
        margins_m.append(margin_m(borders, point))

    def acknowledge(name, **data):
        sent = ground.send(name, **data)
        fly(0.3)
        assert ground.answer(sent) == ""

    try:
        flight.boot()
        fly(3.0)
        plan = {"plan": "fence", "plan_id": plan_id([FENCE]), "count": 1}
        acknowledge("up.mission.part", **plan, first=1, items=[FENCE.data])
        acknowledge("up.mission.commit", **plan)
        acknowledge("up.flight_mode.set", mode="CRUISE")
        while ground.telemetry["flight_control"]["mode"] == "CRUISE":
            fly(0.2)
            assert min(margins_m) > 0
        fly(0.2)
        told = ground.telemetry
        assert (told["failsafe"]["cause"], told["flight_control"]["mode"]) == ("fence", "RETURN")
        assert abs(told["fence"]["margin"] - margins_m[-1]) < 20
        for _ in range(round(TURN_S / 0.5)):
            fly(0.5)
        assert min(margins_m) > 0
        assert margins_m[-1] > margins_m[-2], "it comes back"
    finally:
        flight.participants.stop()
