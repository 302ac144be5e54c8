"""Who flies: the switch, arming, Outputs with their age, a lost receiver, the status."""

import struct

import pytest

from tests.simulator.bench import Bench

LEFT = (1200, 1300, 0, 1700)
NEAR = 2


def near(pulses, expected):
    return all(abs(a - b) <= NEAR for a, b in zip(pulses, expected, strict=True))


def flying(sticks="", **options):
    """A board with the switch at AUTO that has streamed for a while."""
    bench = Bench(sticks, **options)
    bench.run(0.5)
    return bench


def armed(sticks="", **options):
    bench = Bench(sticks, has_motor=True, **options)
    bench.run(2.0)
    assert bench.board.authority.is_armed
    return bench


def test_sticks_pass_through_without_an_output():
    bench = flying("t=0 aileron=1600 rudder=1400")
    assert near(bench.flight.servos, (1600, 1500, 1000, 1400))
    assert bench.status()[1:2] == b"a"


def test_an_output_is_followed_for_250_ms():
    bench = flying()
    assert bench.output(LEFT, bench.newest_orientation()) is None
    bench.run(0.24)
    assert near(bench.flight.servos, (1200, 1300, 1000, 1700))
    assert bench.answer("m") == ("m", b"u")
    bench.run(0.02)
    assert near(bench.flight.servos, (1500, 1500, 1000, 1500))
    assert bench.answer("m") == ("m", b"a")


def test_output_that_is_asked_for_is_said_before_the_first_one_comes():
    bench = flying("t=0 aileron=1600")
    assert bench.confirmed("M", b"u")
    assert bench.status()[1:2] == b"u"
    assert near(bench.flight.servos, (1600, 1500, 1000, 1500))
    bench.run(0.5)
    assert bench.status()[1:2] == b"a"


def test_another_mode_from_the_ground_ends_output_until_it_is_asked_for_again():
    bench = flying()
    assert bench.output(LEFT, bench.newest_orientation()) is None
    assert bench.confirmed("M", b"f")
    bench.run(0.01)
    assert near(bench.flight.servos, (1500, 1500, 1000, 1500))
    assert bench.output(LEFT, bench.newest_orientation()) == 7
    assert bench.confirmed("M", b"u")
    assert bench.output(LEFT, bench.newest_orientation()) is None
    bench.run(0.01)
    assert near(bench.flight.servos, (1200, 1300, 1000, 1700))


def test_leaving_auto_forgets_the_mode_that_the_ground_asked_for():
    bench = flying("t=1 aux1=1000 t=1.5 aux1=2000")
    assert bench.confirmed("M", b"f")
    bench.run(1.2)
    assert bench.output(LEFT, bench.newest_orientation()) is None


def test_servo_outputs_are_what_r_says():
    bench = flying()
    bench.output(LEFT, bench.newest_orientation())
    bench.run(0.1)
    told = struct.unpack(">4H", bench.listener.take("r")[-1].payload)
    assert near(told, (1200, 1300, 1000, 1700))


def test_an_output_of_an_old_orientation_is_refused():
    bench = flying()
    old = bench.newest_orientation()
    bench.clock.advance(0.09)
    assert bench.output(LEFT, old) is None
    bench.clock.advance(0.01)
    assert bench.output(LEFT, old) == 6
    bench.clock.advance(2.0)
    assert bench.output(LEFT, old) == 6


def test_an_output_of_an_orientation_never_sent_is_refused():
    bench = flying()
    newest = bench.newest_orientation()
    assert bench.output(LEFT, (newest + 1) % 65536) == 6
    assert near(bench.flight.servos, (1500, 1500, 1000, 1500))


def test_an_orientation_of_the_round_before_is_not_taken_for_this_one():
    bench = flying()
    bench.board._orientation_sequence = 65535
    assert bench.newest_orientation() == 65535
    assert bench.newest_orientation() == 0
    assert bench.output(LEFT, 65535) is None
    bench.run(0.2)
    bench.clock.advance(1.0)
    assert bench.output(LEFT, 65535) == 6


def test_only_auto_gives_authority_and_leaving_it_acts_within_one_frame():
    bench = flying("t=2 aux1=1500")
    while bench.clock.seconds() < 1001.95:
        bench.output(LEFT, bench.newest_orientation())
    assert near(bench.flight.servos, (1200, 1300, 1000, 1700))
    bench.run(1002.025 - bench.clock.seconds())
    assert near(bench.flight.servos, (1500, 1500, 1000, 1500))
    assert bench.output(LEFT, bench.newest_orientation()) == 7
    bench.run(0.1)
    assert near(bench.flight.servos, (1500, 1500, 1000, 1500))


def test_an_output_before_the_switch_left_does_not_live_on_when_it_is_back():
    bench = flying("t=1 aux1=1000 t=1.04 aux1=2000")
    while bench.clock.seconds() < 1000.99:
        bench.output(LEFT, bench.newest_orientation())
    bench.run(0.1)
    assert near(bench.flight.servos, (1500, 1500, 1000, 1500))


def test_the_throttle_is_the_sticks_unless_an_output_demands_one():
    bench = armed("t=1.5 throttle=1300")
    bench.output((1500, 1500, 0, 1500), bench.newest_orientation())
    bench.run(0.02)
    assert abs(bench.flight.servos[2] - 1300) <= NEAR
    bench.output((1500, 1500, 1600, 1500), bench.newest_orientation())
    bench.run(0.02)
    assert bench.flight.servos[2] == 1600


def test_a_setpoints_throttle_lives_as_long_as_it_says():
    bench = armed()
    assert bench.refused("S", struct.pack(">3h2H", 0, 0, 0, 1600, 100)) is None
    bench.run(0.095)
    assert bench.flight.servos[2] == 1600
    bench.run(0.02)
    assert abs(bench.flight.servos[2] - 1000) <= NEAR


def test_disarmed_the_motor_gets_1000_whatever_the_stick_does():
    bench = Bench("t=0 throttle=1800 t=1 aux2=1000", has_motor=True)
    bench.run(2.0)
    assert bench.flight.servos[2] == 1000
    assert bench.output((1500, 1500, 1800, 1500), bench.newest_orientation()) == 11
    bench.run(0.1)
    assert bench.flight.servos[2] == 1000


def test_a_glider_needs_no_arming_for_its_channel_or_for_outputs():
    bench = flying("t=0 throttle=1700 t=1 aux2=1000")
    assert abs(bench.flight.servos[2] - 1700) <= NEAR
    assert bench.output(LEFT, bench.newest_orientation()) is None


def test_the_edge_of_aux2_arms_after_300_ms():
    bench = Bench(has_motor=True)
    bench.run(1.29)
    assert not bench.board.authority.is_armed
    bench.run(0.05)
    assert bench.board.authority.is_armed
    assert bench.said.count("armed") == 1


def test_aux2_high_from_the_beginning_is_no_edge():
    bench = Bench("t=0 aux2=2000", has_motor=True)
    bench.run(3.0)
    assert not bench.board.authority.is_armed


def test_a_short_low_is_no_edge():
    bench = Bench("t=0 aux2=2000 t=1 aux2=1000 t=1.2 aux2=2000", has_motor=True)
    bench.run(3.0)
    assert not bench.board.authority.is_armed


@pytest.mark.parametrize(
    ("sticks", "bit"), [("t=0 throttle=1200", 0), ("t=1.1 receiver=off", 1), ("t=1 aux2=1000", 3)]
)
def test_a_veto_keeps_it_disarmed_and_the_status_names_it(sticks, bit):
    bench = Bench(sticks, has_motor=True)
    bench.run(2.0)
    assert not bench.board.authority.is_armed
    assert bench.status()[4] & 1 << bit


def test_the_raspberry_pis_veto_is_heard_and_ends_with_it():
    bench = Bench(has_motor=True)
    bench.run(0.9)
    for _ in range(5):
        bench.send("v", b"\x01")
        bench.run(0.2)
    assert not bench.board.authority.is_armed
    assert bench.status()[4] == 1 << 4
    assert bench.refused("a") == 11
    bench.send("v", b"\x00")
    assert bench.status()[4] == 0
    assert bench.confirmed("a")


def test_a_veto_that_is_not_renewed_ends():
    bench = Bench("t=1 aux2=1000")
    bench.send("v", b"\x01")
    assert bench.status()[4] & 1 << 4
    bench.run(1.0)
    assert not bench.status()[4] & 1 << 4


@pytest.mark.parametrize(
    ("sticks", "reason"),
    [
        ("t=0 aux2=2000 throttle=1300", 8),
        ("t=0 aux2=2000 t=1 receiver=off", 9),
        ("t=1 aux2=1000", 11),
    ],
)
def test_arming_by_command_is_refused_with_its_reason(sticks, reason):
    bench = Bench(sticks, has_motor=True)
    bench.run(2.0)
    assert bench.refused("a") == reason
    assert not bench.board.authority.is_armed


def test_arming_and_disarming_by_command():
    bench = Bench("t=0 aux2=2000 t=5 throttle=1500 t=6 throttle=1000", has_motor=True)
    bench.run(2.1)
    assert bench.confirmed("a")
    assert bench.confirmed("d")
    assert bench.confirmed("a")
    bench.run(3.0)
    assert bench.refused("d") == 8
    bench.run(2.5)
    assert bench.refused("d") == 8
    bench.run(0.6)
    assert bench.confirmed("d")
    assert not bench.board.authority.is_armed


def test_aux2_low_disarms_and_a_lost_receiver_does_not():
    bench = armed("t=3 receiver=off t=5 receiver=on t=6 aux2=1000")
    bench.run(2.5)
    assert bench.board.authority.is_armed
    bench.run(2.0)
    assert not bench.board.authority.is_armed


def test_a_lost_receiver_presets_the_surfaces_after_a_second_and_is_flagged():
    bench = flying("t=0 aileron=1700 t=1 receiver=off t=4 receiver=on")
    bench.run(1.3)
    assert near(bench.flight.servos, (1700, 1500, 1000, 1500))
    bench.run(0.5)
    assert near(bench.flight.servos, (1500, 1500, 1000, 1500))
    flags = bench.status()[3]
    assert flags & 1 << 4
    assert not flags & 1 << 2
    assert bench.output(LEFT, bench.newest_orientation()) == 9
    bench.run(2.0)
    assert near(bench.flight.servos, (1700, 1500, 1000, 1500))


def test_a_receiver_that_sends_its_own_failsafe_is_recognised():
    bench = flying("t=1 throttle=890 aux1=1000 aileron=1900")
    bench.run(1.0)
    assert near(bench.flight.servos, (1500, 1500, 1000, 1500))
    status = bench.status()
    assert status[3] & 1 << 4
    assert status[2] == 2


def test_after_5_s_of_loss_the_throttle_waits_for_a_low_stick():
    bench = armed(
        "t=2.5 throttle=1600 t=3 receiver=off t=9 receiver=on t=10 throttle=1000 t=11 throttle=1500"
    )
    bench.run(7.5)
    assert bench.flight.servos[2] == 1000
    bench.run(2.0)
    assert abs(bench.flight.servos[2] - 1500) <= NEAR


def test_after_a_short_loss_the_throttle_is_back_at_once():
    bench = armed("t=2.5 throttle=1600 t=3 receiver=off t=6 receiver=on")
    bench.run(4.5)
    assert abs(bench.flight.servos[2] - 1600) <= NEAR


def test_the_status_says_all_of_it():
    bench = Bench()
    bench.run(2.5)
    bench.send("m")
    status = bench.status()
    assert len(status) == 20
    version, mode, switch, flags, vetoes, cause = struct.unpack(">BcBBBB", status[:6])
    assert (version, mode, switch, vetoes, cause) == (1, b"a", 2, 0, 1)
    assert flags == 0b10001111
    loop_us, late_us, dropped, missing, up_s, rx_ms, imu_ms = struct.unpack(">7H", status[6:])
    assert abs(loop_us - 5000) <= 30
    assert late_us <= 30
    assert (dropped, missing, up_s, imu_ms) == (0, 0, 2, 0)
    assert rx_ms <= 20


def test_the_status_forgets_a_raspberry_pi_that_is_silent():
    bench = Bench()
    bench.run(0.5)
    assert bench.status()[3] & 1 << 7
    bench.run(1.0)
    assert not bench.status()[3] & 1 << 7


@pytest.mark.parametrize(("aux1", "position"), [(1000, 0), (1500, 1), (2000, 2)])
def test_the_status_names_the_switch(aux1, position):
    bench = Bench(f"t=0 aux1={aux1}")
    bench.run(0.1)
    status = bench.status()
    assert status[2] == position
    assert bool(status[3] & 2) == (position == 2)
