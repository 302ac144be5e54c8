"""The whole system as a user starts it: aircraft, phone, daemon, proxy and ground stations."""

import json
import signal
import subprocess
import sys
import urllib.request
from pathlib import Path

import pytest

from tests.support.firmware import build_firmware
from tests.support.showcase import Showcase, steepest
from tests.support.waiting import DEADLINE_S, until

ROOT = Path(__file__).parents[1]


@pytest.fixture(scope="module")
def flight(tmp_path_factory):
    build_firmware()
    showcase = Showcase(tmp_path_factory.mktemp("showcase"))
    try:
        yield showcase.ready()
    finally:
        showcase.stop(signal.SIGTERM)


def test_it_prints_aircraft_board_and_controller(flight):
    said = flight.said()
    (model,) = flight.events("aircraft", "flight_selected")
    (board,) = flight.events("aircraft", "board_selected")
    assert model["source"] == "jsbsim" and "ATmega328P" in board["board"]
    for part in ("motor glider", "JSBSim", "4 m/s", board["board"], "Arduino", "(FBW)"):
        assert part in said
    assert "Traceback" not in said


def test_the_attitude_on_the_ground_is_the_attitude_of_the_model(flight):
    """The firmware's attitude from its IMU's bytes, in turbulence, within its own error."""
    frames = flight.telemetry(20)
    truth = [(float(row["roll_deg"]), float(row["pitch_deg"])) for row in flight.truth()]
    for frame in frames:
        shown = frame["orientation"]["roll"], frame["orientation"]["pitch"]
        nearest = min(max(abs(shown[0] - roll), abs(shown[1] - pitch)) for roll, pitch in truth)
        assert nearest < 2.0, (shown, nearest)


def test_the_firmware_holds_the_attitude(flight):
    frames = flight.telemetry(60)
    assert all(frame["flight_mode"] == "FBW" for frame in frames)
    assert all(frame["armed"] for frame in frames)
    assert steepest(frames) < 45
    outputs = {frame["servo"]["ailerons"] for frame in frames}
    assert len(outputs) > 5, "the servos move against the gusts"
    assert all(float(row["height_m"]) > 80 for row in flight.truth())


def test_the_page_serves_a_browser_and_forbids_other_content(flight):
    with urllib.request.urlopen(flight.page, timeout=DEADLINE_S) as answer:
        assert answer.status == 200
        policy = answer.headers["content-security-policy"]
        assert b"<html" in answer.read()
    assert "default-src 'none'" in policy and "script-src 'self'" in policy
    assert flight.said().count(flight.page) > 1


def test_gains_may_be_changed_from_the_page_in_flight(flight):
    mission = (flight.folder / "config" / "mission_control.yml").read_text(encoding="utf-8")
    assert "security: require" in mission and "tune_in_flight: true" in mission


def test_only_a_ground_station_with_the_key_of_the_run_sees_the_aircraft(flight, monkeypatch):
    assert "ground (pilot)" in flight.said()
    assert "end to end: ground (pilot)" in flight.ground("watch", "--once").stdout
    monkeypatch.setitem(flight.state, "UP_GROUND_STATE", str(flight.folder / "none"))
    assert flight.ground("watch", "--json", "--for", "1").stdout == ""


def test_telemetry_has_every_reading_with_source_and_age(flight):
    frame = flight.telemetry(1)[0]
    assert frame["source"]["orientation"] == frame["source"]["rx"] == "arduino"
    assert frame["source"]["location"] == frame["source"]["heading"] == "android"
    assert frame["age_ms"]["orientation"] < 500
    assert frame["mode"] == "flight controller"
    assert frame["flight_controller"] == "arduino"
    assert frame["android"]["connected"] and frame["android"]["batteryLevel"] > 0
    assert frame["arduino"]["connected"] and frame["arduino"]["framing"] == "checked"
    assert set(frame["rx"]) == {"ailerons", "elevator", "throttle", "rudder", "aux1", "aux2"}
    assert "orientation" in frame["system"]["providers"]
    assert len(frame["vetoes"]) == 1 and "throttle" in frame["vetoes"][0], "in flight not low"
    assert frame["home"]["distance"] is not None


@pytest.mark.parametrize(
    "command",
    [
        ["up.telemetry.frequency", "frequency=200"],
        ["android.speak", "text=hello"],
        ["up.flight_mode.set", "mode=RATE"],
        ["up.flight_mode.set", "mode=FBW"],
    ],
    ids=lambda command: command[0],
)
def test_a_ground_command_is_carried_out_and_acked(flight, command):
    result = flight.ground("send", *command)
    assert result.returncode == 0, result.stdout + result.stderr
    assert "ack" in result.stdout


@pytest.mark.parametrize("quantity", ["heading", "altitude"])
def test_what_the_flight_mode_does_not_follow_is_refused(flight, quantity):
    sent = flight.ground("send", f"up.{quantity}.change", f"{quantity}=90", "mode=required")
    assert sent.returncode != 0
    assert "(refused)" in sent.stderr


def test_the_phone_received_its_commands(flight):
    assert flight.ground("send", "android.speak", "text=trees!").returncode == 0
    log = flight.folder / "aircraft.log"
    until(lambda: "trees!" in log.read_text(encoding="utf-8"), "the phone speaks")


def test_gains_set_from_the_ground_fly_in_the_firmware_and_are_saved(flight):
    def loop(p):
        return {axis: {"p": p, "i": 0.5, "d": 0.0} for axis in ("ailerons", "elevator")}

    rudder = flight.gains()["ratePIDs"]["rudder"]
    gains = {"ratePIDs": loop(1.123456), "stabPIDs": loop(3.0)}
    set_them = flight.ground("send", "arduino.pids.tunings", f"pids={json.dumps(gains)}")
    assert set_them.returncode == 0, set_them.stdout + set_them.stderr
    # The answer is the Arduino's, which holds them as 32-bit numbers.
    values = flight.gains()
    assert values["ratePIDs"]["ailerons"]["p"] == pytest.approx(1.123456, rel=1e-6)
    assert values["stabPIDs"]["elevator"] == {"p": 3.0, "i": 0.5, "d": 0.0}
    assert values["ratePIDs"]["rudder"] == rudder, "the two-axis form leaves the rudder"
    assert "1.12345" in (flight.folder / "config" / "pids.yml").read_text(encoding="utf-8")


def test_half_a_set_of_gains_is_refused_whole(flight):
    before = flight.gains()
    half = {"ratePIDs": {"ailerons": {"p": 1, "i": 0, "d": 0}}, "stabPIDs": {}}
    result = flight.ground("send", "--force", "arduino.pids.tunings", f"pids={json.dumps(half)}")
    assert result.returncode == 1
    assert "elevator" in result.stdout + result.stderr
    assert flight.gains() == before


def test_the_ground_cannot_stop_the_program(flight):
    result = flight.ground("send", "--force", "up.system.stop")
    assert result.returncode == 1
    assert "forbidden" in result.stdout + result.stderr
    assert flight.telemetry(1)


def test_an_unknown_command_is_refused_by_name(flight):
    result = flight.ground("send", "--force", "up.loop.the.loop")
    assert result.returncode == 1
    assert "unknown" in result.stdout + result.stderr


def test_a_second_instance_says_which_port_is_taken(flight):
    result = subprocess.run(
        [sys.executable, str(ROOT / "main.py"), "--config", str(flight.folder / "config")],
        capture_output=True, text=True, timeout=DEADLINE_S, check=False,
    )  # fmt: skip
    assert result.returncode == 1
    assert "port" in result.stderr and "in use" in result.stderr
    assert "Traceback" not in result.stderr
    assert flight.telemetry(1), "the first instance flies on"
