"""The IMU on the compiled firmware: gone at any byte of a transfer, frozen, senseless, and back."""

import itertools

import pytest

from tests.arduino.flight import FRAME_US, HIGH, IMU, MIDDLE, Flight
from up_rig.imu import Fault, motion_at

# HANGS, which holds data low until the clock is worked by hand, is cured by the firmware itself.
LASTING = [Fault.NO_ANSWER, Fault.SDA_LOW, Fault.SCL_LOW]
FAULTS = [*LASTING, Fault.HANGS]
# A sample: device and register, then after the repeated start device and 14 bytes.
SAMPLE_BYTES = [(0, at) for at in range(2)] + [(1, at) for at in range(15)]
# Identity and power (device, register, device, byte), then the six settings of three bytes each.
SETUP_BYTES = [
    *((transfer, at) for transfer in range(4) for at in range(2)),
    *((transfer, at) for transfer in range(4, 10) for at in range(3)),
]
STICK_US = 1440


@pytest.fixture
def fbw(shared_armed):
    """Return an armed aircraft in FBW that banks 30 degrees to the right, stick a little left."""
    flight = shared_armed
    mend(flight.rig.imu)
    flight.sticks(ailerons=STICK_US, throttle=1300, aux1=MIDDLE, aux2=HIGH)
    if not flight.status().flags & IMU:
        flight.run_ms(700)
    flight.tilt(30, seconds=0.3)
    status = flight.status()
    assert status.is_armed and status.flags & IMU
    assert flight.servo_us("ailerons") < STICK_US - 100
    return flight


def unplug(imu):
    imu.unplug()


def freeze(imu):
    imu.is_frozen = True


def spoil(imu):
    imu.is_garbage = True


def mend(imu):
    imu.plug()
    imu.mend()
    imu.is_frozen = imu.is_garbage = False


@pytest.mark.parametrize(
    "loss",
    [unplug, freeze, spoil, *(lambda imu, fault=each: imu.fail(fault) for each in LASTING)],
    ids=["unplugged", "frozen", "garbage", *(each.name.lower() for each in LASTING)],
)
def test_a_lost_imu_passes_the_sticks_through_within_100_ms(fbw, loss):
    fbw.rig.servo.clear()
    start = fbw.rig.cycle
    loss(fbw.rig.imu)
    fbw.run_ms(400)
    passed = fbw.widths_us("ailerons", start + (100_000 + FRAME_US) * 16)
    assert len(passed) >= 12
    assert passed == pytest.approx([STICK_US] * len(passed), abs=1)
    status = fbw.status()
    assert status.mode_letter == "a"
    assert not status.flags & IMU
    assert status.vetoes & 4
    assert status.is_armed and not status.is_failsafe
    assert not any(each.type == "O" for each in fbw.messages)
    assert fbw.servo_us("throttle") == pytest.approx(1300, abs=1)
    mend(fbw.rig.imu)
    fbw.run_ms(1000)
    status = fbw.status()
    assert status.flags & IMU and status.mode_letter == "f" and status.is_armed
    assert fbw.servo_us("ailerons") < STICK_US - 100
    assert fbw.attitude()[0] == pytest.approx(30, abs=2)


@pytest.mark.parametrize("fault", LASTING)
def test_unplugged_at_any_byte_of_a_sample_and_back(fbw, fault):
    imu = fbw.rig.imu
    for transfer, byte in SAMPLE_BYTES:
        fbw.rig.servo.clear()
        start = fbw.rig.cycle
        imu.fail_at_byte(byte, fault, after_transfers=transfer)
        fbw.run_ms(180)
        assert imu.fault != Fault.NONE, "the fault never came"
        passed = fbw.widths_us("ailerons", start + (110_000 + FRAME_US) * 16)
        assert passed and passed == pytest.approx([STICK_US] * len(passed), abs=1)
        imu.mend()
        fbw.run_ms(250)
        assert fbw.mode() == "f", f"not back after byte {byte} of transfer {transfer}"
    status = fbw.status()
    assert status.is_armed and status.flags & IMU
    assert not status.reset_cause & 0x80
    assert status.late_us < 2000


def test_an_imu_that_hangs_at_any_byte_is_freed_at_once(fbw):
    imu = fbw.rig.imu
    for transfer, byte in SAMPLE_BYTES:
        fbw.rig.servo.clear()
        start, samples = fbw.rig.cycle, imu.transfers
        imu.fail_at_byte(byte, Fault.HANGS, after_transfers=transfer)
        fbw.run_ms(100)
        assert imu.fault == Fault.NONE, f"still hangs after byte {byte} of transfer {transfer}"
        assert imu.transfers > samples + 60
        assert max(fbw.widths_us("ailerons", start)) < STICK_US - 100
    status = fbw.status()
    assert status.is_armed and status.mode_letter == "f"


@pytest.mark.parametrize("fault", FAULTS)
def test_plugged_in_and_failing_at_any_byte_of_its_set_up(fbw, fault):
    imu = fbw.rig.imu
    for transfer, byte in SETUP_BYTES:
        imu.unplug()
        fbw.run_ms(60)
        imu.plug()
        imu.fail_at_byte(byte, fault, after_transfers=transfer)
        fbw.run_ms(60)
        imu.mend()
        fbw.run_ms(120)
        assert fbw.status().flags & IMU
        # It measures as before: no setting was left out.
        fbw.tilt(-20 if byte else 30, seconds=0.2)
        at = f"byte {byte} of transfer {transfer}"
        assert fbw.attitude()[0] == pytest.approx(-20 if byte else 30, abs=2), at
    fbw.tilt(30, seconds=0.2)
    status = fbw.status()
    assert status.is_armed and status.flags & IMU and status.mode_letter == "f"
    assert not status.reset_cause & 0x80
    assert fbw.servo_us("ailerons") < STICK_US - 100


@pytest.mark.parametrize("fault", FAULTS)
def test_a_transfer_that_fails_once_is_not_felt(fbw, fault):
    imu = fbw.rig.imu
    for transfer, byte in SAMPLE_BYTES[::3]:
        fbw.rig.servo.clear()
        start = fbw.rig.cycle
        imu.fail_at_byte(byte, fault, after_transfers=transfer)
        fbw.run_ms(5)
        imu.mend()
        fbw.run_ms(95)
        assert max(fbw.widths_us("ailerons", start)) < STICK_US - 100
    assert fbw.status().mode_letter == "f"


def test_another_part_at_the_address_is_not_taken_for_the_imu(fbw):
    imu = fbw.rig.imu
    imu.unplug()
    fbw.run_ms(100)
    imu.set_identity(0x70)
    imu.plug()
    fbw.run_ms(700)
    assert not fbw.status().flags & IMU
    imu.set_identity(0x68)
    fbw.run_ms(1000)
    assert fbw.status().flags & IMU


@pytest.mark.parametrize("loss", [unplug, lambda imu: imu.fail(Fault.SCL_LOW)])
def test_servos_and_loop_do_not_wait_for_an_imu(loss):
    """Not at start, and not later either."""
    flight = Flight(boots=False)
    loss(flight.rig.imu)
    flight.run_ms(300)
    assert flight.rig.servo.pulses("ailerons")
    flight.run_ms(1700)
    flight.sticks(200, ailerons=1234, aux1=MIDDLE)
    flight.rig.servo.clear()
    flight.run_ms(500)
    pulses = flight.rig.servo.pulses("ailerons")
    assert [each.width_us for each in pulses] == pytest.approx([1234] * len(pulses), abs=1)
    gaps_us = [(b.rise_cycle - a.rise_cycle) / 16 for a, b in itertools.pairwise(pulses)]
    assert gaps_us == pytest.approx([FRAME_US] * len(gaps_us), abs=2)
    status = flight.status()
    assert status.loop_us == pytest.approx(2000, abs=2)
    assert status.late_us < 1000
    assert status.imu_age_ms == 65535
    assert flight.ask("a") == 10
    mend(flight.rig.imu)
    flight.run_ms(1000)
    assert flight.status().flags & IMU


@pytest.mark.parametrize("gone_ms", [120, 240, 400])
def test_the_horizon_is_found_soon_after_a_turn_that_nobody_saw(gone_ms):
    flight = Flight(aux1=MIDDLE)
    flight.run_ms(1500)
    flight.rig.imu.fail(Fault.NO_ANSWER)
    start_s, gone_s = flight.rig.now_us / 1e6, gone_ms / 1000

    def motion(time_s):
        passed_s = min(time_s - start_s, gone_s)
        return motion_at(60 * passed_s, 0, (60.0 * (passed_s < gone_s), 0.0, 0.0))

    flight.rig.imu.motion = motion
    flight.run_ms(gone_ms)
    flight.rig.imu.mend()
    flight.run_ms(5000)
    roll, pitch, *_ = flight.attitude()
    assert roll == pytest.approx(60 * gone_s, abs=5)
    assert pitch == pytest.approx(0, abs=3)
