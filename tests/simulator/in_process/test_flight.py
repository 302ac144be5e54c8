"""The firmware, the daemon, the phone and the ground station fly together in one process."""

import pytest

from tests.simulator.in_process.flying import ACRO_US, AUTO_US, CELLULAR, Flying
from up_simulator.aircraft.dynamics import Start
from up_simulator.scenario.event import SerialNoise

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


def test_the_ground_sees_the_attitude_that_the_firmware_has_and_the_aircraft_too(fly):
    flying = fly(start=Start(roll_deg=25), link=CELLULAR)
    flying.start()
    flying.board.set_stick("ailerons", 1600)
    errors_deg, delays_s = [], []

    def look():
        seen, felt = flying.ground.telemetry, flying.board.tap.orientation
        if seen.get("source", {}).get("orientation") == "arduino":
            errors_deg.append(abs(seen["orientation"]["roll"] - felt.roll_deg))
            delays_s.append(flying.now_s - flying.ground.newest_s)

    flying.fly(4.0, look)
    assert flying.state.roll_deg > 8
    assert flying.board.tap.orientation.roll_deg == pytest.approx(flying.state.roll_deg, abs=2.5)
    # As old as a period of telemetry and the link: the bank changes by up to 40 deg/s.
    assert max(errors_deg[-500:]) < 4
    assert max(delays_s) < 0.15
    assert flying.ground.lost_frames == 0


def test_gains_sent_from_the_ground_fly_on_the_board_and_are_read_back(fly):
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
    told = [each for each in flying.board.tap.take_answers() if each.type == "G"]
    assert told[-1].payload[:4].hex() == "3fa00000"
    assert told[-1].payload[36:40].hex() == "40600000"
    assert flying.ask("arduino.pids.tunings", request=True) == ""
    flying.fly(0.5)
    values = flying.ground.others["arduino.pids.values"]
    assert values["ratePIDs"] == wanted["ratePIDs"]
    assert values["stabPIDs"] == wanted["stabPIDs"]


def test_gains_that_nobody_may_fly_are_refused_with_a_reason(fly):
    flying = fly()
    flying.start(phone=False)
    gain = {"p": 51.0, "i": 0.0, "d": 0.0}
    loop = {"ailerons": gain, "elevator": gain}
    answer = flying.ask("arduino.pids.tunings", pids={"ratePIDs": loop, "stabPIDs": loop})
    assert "50" in answer


def test_the_flight_controller_on_the_raspberry_flies_in_output_mode(fly):
    flying = fly(OF_THE_PI, arms=True, start=Start(roll_deg=20))
    flying.start()
    flying.board.set_stick("aux1", AUTO_US)
    flying.until(lambda: flying.status.mode == "u", 3.0)
    flying.fly(1.0)
    modes, rolls_deg = set(), []

    def look():
        modes.add(flying.status.mode)
        rolls_deg.append(flying.state.roll_deg)

    flying.fly(4.0, look)
    assert modes == {"u"}
    assert abs(rolls_deg[-1]) < 3
    assert flying.ground.telemetry["flight_control"]["mode"] == "FBW"
    assert flying.ground.telemetry["counters"]["flight_control"]["outputs"] > 150


def test_a_killed_daemon_leaves_level_flight_to_the_board_within_250_ms(fly):
    flying = fly(OF_THE_PI, arms=True, start=Start(roll_deg=20))
    flying.start()
    flying.board.set_stick("aux1", AUTO_US)
    flying.until(lambda: flying.status.mode == "u", 3.0)
    flying.fly(1.5)
    assert mode_of(flying) and flying.status.mode == "u"
    flying.raspilot.kill()
    took_s = flying.until(lambda: mode_of(flying) == "f", 1.0)
    assert took_s <= 0.25
    stale_us = []
    flying.fly(2.0, lambda: stale_us.append(max(flying.board.pulse_ages_us())))
    assert max(stale_us) < 25_000, "the servos never wait"
    assert abs(flying.state.roll_deg) < 6
    # Back, it takes the aircraft again without anybody's help.
    flying.raspilot.start()
    assert flying.until(lambda: flying.status.mode == "u", 3.0) < 2.0


def test_a_frozen_daemon_loses_the_aircraft_and_takes_it_again(fly):
    flying = fly(OF_THE_PI, arms=True, link=CELLULAR)
    flying.start()
    flying.board.set_stick("aux1", AUTO_US)
    flying.until(lambda: flying.status.mode == "u", 3.0)
    flying.fly(1.5)
    flying.raspilot.freeze()
    assert flying.until(lambda: mode_of(flying) == "f", 1.0) <= 0.25
    flying.fly(3.0)
    assert flying.now_s - flying.ground.newest_s > 2.9
    flying.raspilot.thaw()
    frames, ages_s = flying.ground.frames, []

    def look():
        nonlocal frames
        if flying.ground.frames != frames:
            frames = flying.ground.frames
            ages_s.append(flying.raspilot.up.beacons.age_s(flying.ground.beacon))

    flying.fly(2.0, look)
    assert flying.status.mode == "u"
    assert len(ages_s) > 10
    assert max(ages_s) < 0.3


def test_leaving_auto_takes_the_aircraft_from_the_daemon_at_once(fly):
    flying = fly(OF_THE_PI, arms=True)
    flying.start()
    flying.board.set_stick("aux1", AUTO_US)
    flying.until(lambda: flying.status.mode == "u", 3.0)
    flying.board.set_stick("aux1", ACRO_US)
    assert flying.until(lambda: mode_of(flying) == "a", 1.0) <= 0.06


def test_readings_of_an_unplugged_phone_are_stale_within_their_time(fly):
    flying = fly(orientation="udp")
    flying.start()
    flying.fly(1.5)
    names = ("UpAltitudeProvider", "UpHeadingProvider", "UpLocationProvider")
    providers = [flying.raspilot.module(name) for name in names]
    assert all(each.usable(each.MAX_AGE_S) is not None for each in providers)
    flying.phone.unplug()
    took_s = flying.until(lambda: all(each.usable(1.5) is None for each in providers), 3.0)
    assert took_s <= 1.5
    began_s = flying.now_s - took_s
    flying.fly(1.5)
    ages_ms = flying.ground.telemetry["age_ms"]
    assert (
        min(ages_ms[name] for name in ("altitude", "heading", "location"))
        >= (flying.ground.newest_s - began_s) * 1000 - 10
    )
    assert flying.ground.telemetry["system"]["providers"] == ["battery", "orientation", "rx"]
    flying.until(lambda: not flying.ground.telemetry["android"]["connected"], 3.0)
    flying.phone.plug()
    flying.until(lambda: all(each.usable(1.5) is not None for each in providers), 5.0)


def test_a_cable_that_tells_ends_the_phones_links_at_once(fly):
    flying = fly()
    flying.start()
    flying.fly(0.5)
    flying.phone.unplug(resets_links=True)
    flying.until(lambda: not flying.ground.telemetry["android"]["connected"], 0.3)


def test_the_phones_battery_is_what_was_set_and_told_at_once(fly):
    flying = fly()
    flying.start()
    flying.phone.set_battery(12)
    flying.until(lambda: flying.ground.telemetry["android"]["batteryLevel"] == 12, 0.5)
    assert any("battery is low: 12 percent" in line for line in flying.raspilot.log)


def test_the_phones_orientation_steps_in_for_a_board_that_is_gone(fly):
    flying = fly()
    flying.start()
    flying.fly(1.5)
    assert flying.ground.telemetry["source"]["orientation"] == "arduino"
    flying.board.wires.is_plugged = False
    flying.until(lambda: flying.ground.telemetry["source"]["orientation"] == "android", 1.0)
    assert flying.ground.telemetry["orientation"]["roll"] == pytest.approx(
        flying.state.roll_deg, abs=2
    )


def test_after_a_blackout_no_old_frame_arrives_and_a_fresh_one_soon(fly):
    flying = fly(link=CELLULAR)
    flying.start()
    flying.fly(1.0)
    flying.up.black_out()
    flying.down.black_out()
    flying.fly(0.2)
    frames = flying.ground.frames
    flying.fly(29.8)
    assert flying.ground.frames == frames
    restored_s = flying.now_s
    flying.up.restore()
    flying.down.restore()
    late_s, ages_s = [], []

    def look():
        nonlocal frames
        if flying.ground.frames != frames:
            frames = flying.ground.frames
            late_s.append(flying.now_s - restored_s)
            ages_s.append(flying.raspilot.up.beacons.age_s(flying.ground.beacon))

    flying.fly(4.0, look)
    assert late_s[0] <= 3.0
    assert max(ages_s) < 0.3, "every frame was made after the end of the blackout"
    assert flying.ask("up.telemetry.frequency", frequency=50) == ""


def test_noise_on_the_serial_line_is_dropped_and_counted_and_the_flight_goes_on(fly):
    flying = fly(OF_THE_PI, arms=True, start=Start(roll_deg=10))
    flying.start()
    flying.board.set_stick("aux1", AUTO_US)
    flying.until(lambda: flying.status.mode == "u", 3.0)
    noise = SerialNoise(60, flipped_percent=0.2, inserted_percent=0.05, lost_percent=0.05)
    flying.board.wires.set_noise(noise, flying.board.now_s)
    flying.fly(4.0)
    assert flying.board.wires.corrupted > 20
    counters = flying.ground.telemetry["counters"]["serial"]
    assert counters["crc_errors"] + counters["format_errors"] > 5
    assert not any("CRITICAL" in line for line in flying.raspilot.log)
    assert abs(flying.state.roll_deg) < 6
