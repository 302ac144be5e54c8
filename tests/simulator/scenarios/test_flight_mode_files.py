"""Flight modes of other authors, each a file in a copy of the application, fly in the simulator."""

import csv
import json
import os
import subprocess
import sys

import pytest

from tests.docs.flying import copy_of_the_tree
from tests.support.firmware import build_firmware

LIMIT_S = 200
HEAD = """
from up.flight_modes.demand import AttitudeDemand, Circle, PathDemand
from up.flight_modes.flight_mode import FlightMode
from up.flight_modes.navigation_state import Point
"""
ORBIT = """
class Orbit(FlightMode):
    NAME = "ORBIT"
    NEEDS = {"navigation": 3.0, "orientation": 1.0}
    FALLBACK = "CIRCLE"

    def enter(self, situation):
        self.circle = Circle(situation.navigation.position, 50.0, is_clockwise=False)
        self.altitude_m = situation.navigation.altitude_m

    def step(self, situation, dt_s):
        return PathDemand(self.circle, self.altitude_m)
"""
BAD = """
class {name}(FlightMode):
    NAME = "{name}"
    FALLBACK = "LOITER"

    def step(self, situation, dt_s):
        {body}
"""
FAULTS = {
    "RAISES": ("return 1 / 0", "mode_failed"),
    "EXITS": ("raise SystemExit", "mode_failed"),
    "BLOCKS": ("__import__('time').sleep(0.05); return AttitudeDemand(0.0, 0.0)", "mode_overrun"),
    "NOTHING": ("return None", "demand_invalid"),
    "UNKNOWN": ("return AttitudeDemand(float('nan'), 0.0)", "demand_invalid"),
    "INSIDE": ("return PathDemand(Circle(Point(0.0, 0.0), -50.0), 400.0)", "demand_invalid"),
}
"""By the mode's name: the body of its step, and the reason of its fallback."""
WILD = "return AttitudeDemand(300.0, -500.0, 7.0)"
BROKEN = {
    "syntax": "def (",
    "absent": "import not_installed_anywhere",
    "clash": HEAD + BAD.format(name="LOITER", body="return None"),
    "fallback": HEAD + BAD.format(name="LOST", body="return None").replace("LOITER", "NOWHERE"),
    "small": HEAD + BAD.format(name="Small", body="return None"),
}
FLIGHT = {
    "title": "Flight modes of other authors",
    "board": "host",
    "raspilot": {"runs": "in process"},
    "phone": {},
    "ground": {"role": "operator", "period_ms": 100},
    "sticks": [{"at_s": 0, "mode": "AUTO", "arm": True, "throttle": 0.55}],
}
"""A scenario; JSON is YAML."""


@pytest.fixture(scope="module")
def tree(tmp_path_factory):
    build_firmware()
    return copy_of_the_tree(tmp_path_factory.mktemp("modes") / "tree")


def fly(tree, modes, scenario):
    """Fly with these flight modes in the application; return verdicts and the log's rows."""
    folder = tree / "raspilot" / "flight_modes"
    before = set(folder.iterdir())
    for name, text in modes.items():
        (folder / f"{name}.py").write_text(text, encoding="utf-8")
    (tree / "flown.yml").write_text(json.dumps({**FLIGHT, **scenario}), encoding="utf-8")
    command = [sys.executable, "-m", "up_simulator.cli", "fly", "flown.yml", "--no-picture"]
    done = subprocess.run(
        [*command, "--output", str(tree / "flights")],
        cwd=tree,
        env={**os.environ, "PYTHONPATH": os.pathsep.join([str(tree), str(tree / "simulator")])},
        capture_output=True,
        text=True,
        timeout=LIMIT_S,
    )
    for path in set(folder.iterdir()) - before:
        if path.is_file():
            path.unlink()
    assert done.returncode in (0, 1), done.stdout + done.stderr
    flown = tree / "flights" / "flown"
    summary = json.loads((flown / "summary.json").read_text(encoding="utf-8"))
    assert summary["failure"] is None, done.stdout + done.stderr
    with (flown / "log.csv").open(encoding="utf-8") as file:
        return summary, list(csv.DictReader(file))


def selects(at_s, mode):
    command = {"name": "up.flight_mode.set", "data": {"mode": mode}, "answer": "ack"}
    return {"at_s": at_s, "name": mode, "command": command}


def expects(name, signal, **limits):
    return {"name": name, "signal": signal, **limits}


@pytest.mark.parametrize("controller", ["arduino", "raspberry"])
def test_one_file_is_a_mode_and_a_bad_one_is_replaced_by_its_fallback(tree, controller):
    events, expect, at_s = [], [], 4
    for mode, (_, reason) in FAULTS.items():
        window = {"from_s": at_s + 0.6, "to_s": at_s + 2}
        events.append(selects(at_s, mode))
        reported, acts = f"{mode} is reported", f"LOITER acts for {mode}"
        expect.append(expects(reported, "ground.flight_control.fallback", is_=reason, **window))
        expect.append(expects(acts, "ground.flight_control.mode", is_="LOITER", **window))
        at_s += 2
    events.append(selects(at_s, "WILD"))
    expect += [
        expects("WILD", "ground.flight_control.mode", is_="WILD", from_s=at_s + 0.6, to_s=at_s + 1),
        expects("The bank is limited", "truth.roll_deg", between=[-65, 65]),
        expects("The pitch is limited", "truth.pitch_deg", between=[-45, 45]),
    ]
    at_s += 1
    events.append(selects(at_s, "ORBIT"))
    expect += [
        expects("ORBIT", "ground.flight_control.mode", is_="ORBIT", from_s=at_s + 0.6),
        expects("It turns left", "truth.roll_deg", mean_between=[-40, -5], from_s=at_s + 5),
        expects("The outputs never stop", "servo.stale_ms", below=30),
    ]
    if controller == "raspberry":
        expect.append(
            expects("It circles", "distance.target_m", between=[40, 60], from_s=at_s + 25)
        )
    modes = {name: HEAD + BAD.format(name=name, body=body) for name, (body, _) in FAULTS.items()}
    modes |= {"WILD": HEAD + BAD.format(name="WILD", body=WILD), "orbit": HEAD + ORBIT}
    scenario = {
        "start": {"height_m": 200},
        "weather": {"wind_m_s": 4, "turbulence": "light"},
        "raspilot": {
            "runs": "in process",
            "config": {"config.yml": {"flight controller": controller}},
        },
        "duration_s": at_s + (40 if controller == "raspberry" else 10),
        "events": events,
        "expect": [{key.rstrip("_"): value for key, value in each.items()} for each in expect],
    }
    summary, _ = fly(tree, modes, scenario)
    failed = [each for each in summary["expectations"] if not each["held"]]
    assert failed == []


def test_a_broken_file_is_a_veto_and_all_other_modes_are_there(tree):
    scenario = {
        "duration_s": 4,
        "expect": [expects("It is not armed", "board.armed", **{"is": False})],
        "may_crash": True,
    }
    summary, rows = fly(tree, BROKEN, scenario)
    assert all(each["held"] for each in summary["expectations"])
    vetoes = rows[-1]["ground.vetoes"]
    for name in BROKEN:
        assert f"flight_modes.{name}" in vetoes, vetoes
