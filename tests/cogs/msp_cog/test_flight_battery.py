"""The voltage that the board measures, from its message to all that show it or act by it."""

import pytest
from crsf_cog.frames import BATTERY, CrsfDecoder
from crsf_cog.transmitter import telemetry_frames
from msp_cog import messages
from msp_cog.osd_texts import OsdTexts

from raspilot.flight_controller.flight_mode_manager import FlightModeManager
from raspilot.flight_modes.circle import CircleMode
from raspilot.modules.failsafes import Failsafes
from raspilot.modules.flight_battery import FlightBattery
from tests.cogs.msp_cog.recorded import ANGLE, ARMED, OVERRIDE, status
from tests.cogs.msp_cog.rig import Rig
from up.commands.telemetry_schema import SILENT_S
from up.telemetry_frame import Frame

MODULES = (FlightBattery, Failsafes, FlightModeManager, CircleMode)
LIMITS = "low_v: 11\ncritical_v: 10.2\n"
ACTION = "flight_battery_critical: {action: CIRCLE, delay_s: 1}\n"


@pytest.fixture
def rig(tmp_path):
    made = Rig(tmp_path, MODULES, flight_battery=LIMITS, failsafe=ACTION)
    measure(made, 11.46)
    yield made
    made.stop()


def measure(rig, voltage_v):
    """Answer as Betaflight does: volts in tenths, mAh, RSSI, A, and volts in hundredths."""
    answer = bytes((round(voltage_v * 10),)) + bytes(6)
    rig.answers[messages.ANALOG] = answer + round(voltage_v * 100).to_bytes(2, "little")
    rig.advance(1.0)


def shown(rig):
    return rig.up.telemetry_controller.collect()


def test_it_is_in_telemetry_fresh_and_on_the_transmitter_and_the_goggles(rig):
    content = shown(rig)
    arduino = content["arduino"]
    assert (arduino["flight_battery_v"], arduino["flight_battery_low"]) == (11.46, False)
    # By this age page and overlay decide whether they show it as live.
    assert content["age_ms"]["flight"] < SILENT_S * 1000 / 2
    frame = Frame(content)
    (payload,) = (
        each for type_, each in CrsfDecoder().feed(telemetry_frames(frame)) if type_ == BATTERY
    )
    assert int.from_bytes(payload[:2], "big") == 115
    goggles = OsdTexts()
    goggles.update(frame, 0.0)
    assert goggles.text("battery", 0.1) == "BAT 11.5V"
    # A board without a measurement answers 0.
    measure(rig, 0.0)
    rig.advance(2.0)
    assert shown(rig)["arduino"]["flight_battery_v"] is None


def test_a_critical_voltage_in_flight_makes_the_failsafe_fly_the_board(rig):
    rig.answers[messages.STATUS] = status(ARMED | ANGLE | OVERRIDE)
    rig.advance(3.0)
    assert rig.take(messages.SET_RAW_RC) == []
    measure(rig, 10.1)
    rig.advance(2.0)
    content = shown(rig)
    assert content["arduino"]["flight_battery_critical"] is True
    assert content["failsafe"] == {
        "active": ["flight_battery_critical"], "cause": "flight_battery_critical",
    }  # fmt: skip
    sticks = rig.take(messages.SET_RAW_RC)
    assert len(sticks) > 20 and int.from_bytes(sticks[-1][:2], "little") != 1500
    # With the switch elsewhere the pilot flies.
    rig.answers[messages.STATUS] = status(ARMED | ANGLE)
    rig.advance(0.5)
    rig.take(messages.SET_RAW_RC)
    rig.advance(2.0)
    assert rig.take(messages.SET_RAW_RC) == []
