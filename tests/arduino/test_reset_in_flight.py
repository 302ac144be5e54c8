"""Resets in flight: what recovers after the watchdog's, and what must never recover automatically.

The loop is stopped from outside, in the flown binary: the instruction that ends a slot, ``wdr``,
becomes a jump to itself, as if a cell of the flash had failed, and is restored after the watchdog's
reset.
"""

import itertools
import math

import pytest

from tests.arduino.flight import BIAS_FROM_EEPROM, IMU, LOW, MIDDLE, Flight
from tests.support.tools import unavailable
from up_rig import Reset, RigUnavailableError, build_optiboot
from up_rig.imu import GRAVITY_M_S2, Motion, motion_at

WDR, RJMP_SELF, CLI = b"\xa8\x95", b"\xff\xcf", b"\xf8\x94"
RESTORED = 0x80
THROTTLE_US = 1425
CALIBRATING = 32


@pytest.fixture(scope="module", params=[False, True], ids=["bare", "optiboot"])
def bootloader(request):
    """Return None, or optiboot above the firmware."""
    if not request.param:
        return None
    try:
        return build_optiboot()
    except RigUnavailableError as error:
        unavailable(str(error))


def aloft(bootloader=None, aux1=MIDDLE):
    """Return an armed aircraft that banks 25 degrees at some throttle; its gyro has a bias."""
    flight = Flight(bootloader=bootloader, aux1=aux1, boots=False)
    flight.rig.imu.bias_deg_s = (3.0, -2.0, 1.5)
    flight.run_ms(3200)
    flight.may_be_cut = True
    flight.arm()
    flight.sticks(throttle=THROTTLE_US)
    flight.tilt(25, seconds=0.3)
    flight.run_ms(200)
    return flight


def hang(flight, code=RJMP_SELF):
    """Stop the loop with ``code`` until the watchdog has bitten; the flash is whole again then."""
    ((base, program),) = flight.rig.firmware.flash[:1]
    # The other one is start-up's, which lies before all functions.
    functions = flight.rig.firmware.symbols["__bad_interrupt"].address
    places = [
        base + at
        for at in range(0, len(program) - 1, 2)
        if program[at : at + 2] == WDR and base + at > functions
    ]
    assert len(places) == 1, "the loop feeds the watchdog at one place"
    at = places[0]
    whole = program[at - base : at - base + len(code)]
    resets = flight.rig.measures().resets[3]
    flight.rig.write_flash(at, code)
    while flight.rig.measures().resets[3] == resets:
        flight.run(1_000)
    flight.rig.write_flash(at, whole)


def hang_deaf(flight):
    """Stop the loop with interrupts off: the firmware can leave no mark that it stands still."""
    hang(flight, CLI + RJMP_SELF)


def longest_gap_ms(flight, channel, since):
    """Return the longest time without a pulse's rise between a cycle and now."""
    rises = [
        each.rise_cycle for each in flight.rig.servo.pulses(channel) if each.rise_cycle > since
    ]
    edges = [since, *rises, flight.rig.cycle]
    return max(after - before for before, after in itertools.pairwise(edges)) / 16_000


def assert_flies_on(flight, since):
    """Assert all that must be there one second after the reset."""
    for channel in ("ailerons", "elevator", "throttle", "rudder"):
        assert longest_gap_ms(flight, channel, since) <= 300, channel
        pulses = flight.rig.servo.pulses(channel)
        assert all(999 <= each.width_us <= 2001 for each in pulses[1:]), channel
    assert flight.servo_us("ailerons", 40) < 1400
    assert flight.servo_us("throttle", 40) == pytest.approx(THROTTLE_US, abs=1)
    status = flight.status()
    assert status.is_armed
    assert status.mode_letter == "f"
    assert status.flags & IMU
    assert status.reset_cause == Reset.WATCHDOG | RESTORED
    roll, pitch, _yaw, *rates = flight.attitude()
    assert (roll, pitch) == pytest.approx((25, 0), abs=1.5)
    assert rates == pytest.approx([0, 0, 0], abs=0.5)


def test_a_loop_that_stands_still_is_reset_and_flies_on(bootloader):
    flight = aloft(bootloader)
    flight.rig.servo.clear()
    before = flight.rig.cycle
    hang(flight)
    reset = flight.rig.cycle
    # The watchdog's 120 ms, the fuses' 66 ms: no servo waits longer than 300 ms in all.
    assert (reset - before) / 16_000 <= 140
    flight.run(before / 16 + 1_000_000 - flight.rig.now_us)
    assert_flies_on(flight, before)


def test_a_loop_that_stands_still_with_interrupts_off_flies_on_without_bootloader():
    flight = aloft()
    flight.rig.servo.clear()
    before = flight.rig.cycle
    hang_deaf(flight)
    flight.run(before / 16 + 1_000_000 - flight.rig.now_us)
    assert_flies_on(flight, before)


def test_with_optiboot_a_deaf_stop_gives_the_surfaces_back_and_no_motor():
    """Optiboot clears the cause of the reset, and nothing could be marked: it proves nothing."""
    try:
        flight = aloft(build_optiboot())
    except RigUnavailableError as error:
        unavailable(str(error))
    flight.rig.servo.clear()
    before = flight.rig.cycle
    hang_deaf(flight)
    flight.run(before / 16 + 1_500_000 - flight.rig.now_us)
    assert longest_gap_ms(flight, "ailerons", before) <= 300
    status = flight.status()
    assert not status.is_armed and not status.reset_cause & RESTORED
    assert status.mode_letter == "f" and status.flags & IMU
    assert flight.servo_us("throttle") == pytest.approx(1000, abs=1)


@pytest.mark.parametrize("offset_us", [0, 313, 701, 1207, 1903])
def test_a_reset_at_any_moment_of_a_slot_flies_on(offset_us):
    """Also in the middle of a byte of the IMU's: it hangs with data low, and is freed."""
    flight = aloft()
    flight.rig.imu.motion = turning(25)
    flight.run_ms(1000)
    flight.rig.imu.motion = motion_at(25, 0)
    heading = flight.attitude()[2]
    flight.run(offset_us)
    flight.rig.servo.clear()
    before = flight.rig.cycle
    flight.rig.force_watchdog_reset()
    flight.run_ms(1000)
    assert_flies_on(flight, before)
    # The accelerometer shows bank and pitch again; the heading has to be kept.
    assert flight.attitude()[2] == pytest.approx(heading, abs=2) and heading > 10


def test_a_second_reset_flies_on_too():
    flight = aloft()
    hang(flight)
    flight.run_ms(150)
    flight.rig.servo.clear()
    before = flight.rig.cycle
    hang(flight)
    flight.run_ms(900)
    assert_flies_on(flight, before)


def power_on(flight):
    flight.rig.power_on()


def power_gap(flight):
    """Switch off so shortly that the RAM keeps every byte."""
    flight.rig.power_on(ram=flight.rig.ram())


def brown_out(flight):
    flight.rig.brown_out()


def press_reset(flight):
    flight.rig.press_reset()


@pytest.mark.parametrize("how", [power_on, power_gap, brown_out, press_reset])
def test_no_other_reset_ever_arms(bootloader, how):
    flight = aloft(bootloader)
    how(flight)
    # Optiboot listens for a second after the reset pin before it starts the program.
    flight.run_ms(3500)
    flight.rig.servo.clear()
    flight.run_ms(200)
    throttles = flight.widths_us("throttle")
    assert throttles == pytest.approx([1000] * len(throttles), abs=1)
    status = flight.status()
    assert not status.is_armed
    assert not status.reset_cause & RESTORED
    assert not status.reset_cause & Reset.WATCHDOG
    assert status.mode_letter == "f"
    # AUX2 stays high: that is not an edge.
    flight.sticks(500, throttle=LOW)
    assert not flight.status().is_armed


def test_power_that_fails_after_a_reset_in_flight_does_not_arm(bootloader):
    flight = aloft(bootloader)
    hang(flight)
    flight.run_ms(300)
    power_gap(flight)
    flight.run_ms(2000)
    status = flight.status()
    assert not status.is_armed and not status.reset_cause & RESTORED


def turning(bank_deg, speed_m_s=12.0):
    """Return the readings of an IMU in a level turn without slip."""
    bank = math.radians(bank_deg)
    turn_deg_s = math.degrees(GRAVITY_M_S2 * math.tan(bank) / speed_m_s)
    rates = (0.0, turn_deg_s * math.sin(bank), turn_deg_s * math.cos(bank))
    return Motion(*rates, 0.0, 0.0, -GRAVITY_M_S2 / math.cos(bank))


@pytest.mark.parametrize("bias", [(-3.5, 1.2, -2.8), (5.0, -5.0, 5.0)])
@pytest.mark.parametrize("how", [brown_out, press_reset])
def test_a_reset_in_a_calm_turn_keeps_attitude_and_bias(how, bias):
    """EEPROM was blank at power-on; the turn is as still as an aircraft on the ground."""
    flight = Flight(aux1=MIDDLE, boots=False)
    flight.rig.imu.bias_deg_s = bias
    flight.run_ms(3000)
    flight.may_be_cut = True
    flight.arm()
    flight.tilt(15, seconds=0.3)
    flight.rig.imu.motion = turning(15)
    flight.run_ms(500)
    how(flight)
    flight.run_ms(500)
    status = flight.status()
    assert not status.is_armed
    assert not status.flags & BIAS_FROM_EEPROM
    for _ in range(10):
        flight.run_ms(1000)
        roll, pitch, *_ = flight.attitude()
        assert (roll, pitch) == pytest.approx((15, 0), abs=3)


def test_a_brown_out_that_spoils_memory_leaves_the_bias_of_power_on():
    flight = Flight(aux1=MIDDLE, boots=False)
    flight.rig.imu.bias_deg_s = (-3.5, 1.2, -2.8)
    flight.run_ms(3000)
    flight.may_be_cut = True
    flight.arm()
    flight.rig.imu.motion = turning(15)
    flight.run_ms(200)
    flight.rig.brown_out(keeps_ram=False)
    flight.run_ms(3000)
    status = flight.status()
    assert status.flags & BIAS_FROM_EEPROM
    assert not status.vetoes & CALIBRATING
    *_, roll_rate, pitch_rate, yaw_rate = flight.attitude()
    truth = turning(15)
    assert (roll_rate, pitch_rate, yaw_rate) == pytest.approx(
        (0, truth.pitch_rate_deg_s, truth.yaw_rate_deg_s), abs=1
    )


def test_servos_have_pulses_soon_after_power_on():
    flight = Flight(boots=False)
    flight.run_ms(66 + 100)
    for channel in ("ailerons", "elevator", "throttle", "rudder"):
        pulses = flight.rig.servo.pulses(channel)
        assert pulses, channel
        assert pulses[0].width_us == pytest.approx(1000 if channel == "throttle" else 1500, abs=1)
