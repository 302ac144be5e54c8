"""The Java phone's orientation over links that lose and cut: frames are missing, none is wrong."""

import itertools

import pytest

from tests.android.far_network import HERE, FarNetwork
from tests.android.lossy_relay import LossyRelay
from tests.android.numbered_motion import numbers_of
from tests.android.phone_program import PhoneProgram
from tests.android.real_daemon import RealDaemon
from tests.android.slow_relay import SlowRelay
from tests.support.waiting import until

ORIENTATION = "up.orientation.update"
FRAME_BYTES = 24
FRAMES = 300


@pytest.fixture
def daemon(tmp_path):
    made = RealDaemon(tmp_path / "daemon")
    yield made
    made.end()


def counter(daemon, name):
    return daemon.ground.at(f"counters.android.orientation_{name}") or 0


def check(daemon):
    """Return the numbers that were recorded, each one of ours and none out of order."""
    assert daemon.end() == 0
    numbers = numbers_of(daemon.log_of(ORIENTATION))
    assert all(b - a >= 0 for a, b in itertools.pairwise(numbers)), "none overtakes another"
    return numbers


def test_lost_datagrams_are_missing_and_the_others_are_right(daemon):
    daemon.start()
    with LossyRelay(daemon.ports.orientation, loss=0.2, seed=7) as relay:
        place = daemon.place_at("127.0.0.1", orientation=relay.port)
        with PhoneProgram(*place, "--orientation", "udp", "--orientation-hz", 200) as phone:
            phone.connected()
            until(lambda: relay.passed >= FRAMES and relay.lost >= 20, "frames enough")
        until(lambda: counter(daemon, "frames") == relay.passed, "all that was not lost")
        assert counter(daemon, "dropped") == 0
    numbers = check(daemon)
    assert len(numbers) == relay.passed
    print(f"UDP: {relay.lost} of {relay.lost + relay.passed} datagrams lost, all others right")


def test_a_frame_cut_in_the_middle_dies_with_its_connection(daemon):
    """Cut at each third of a frame and more; after each cut the first frame is whole again."""
    daemon.start()
    with SlowRelay(daemon.ports.orientation) as relay:
        place = daemon.place_at("127.0.0.1", orientation=relay.port)
        with PhoneProgram(*place, "--orientation", "tcp", "--orientation-hz", 200) as phone:
            phone.connected()
            for number, part in enumerate((1, 8, 11, 16, 23), 1):
                begun = counter(daemon, "frames")
                until(lambda begun=begun: counter(daemon, "frames") > begun + 30, "frames flow")
                # Whole frames so far: the next ones begin a frame.
                relay.cut(10 * FRAME_BYTES + part)
                until(lambda number=number: relay.cuts == number, "the cut")
                until(lambda number=number: relay.connections > number, "a new connection")
            begun = counter(daemon, "frames")
            until(lambda: counter(daemon, "frames") > begun + 30, "frames flow again")
        assert counter(daemon, "dropped") == 0
        assert counter(daemon, "replaced") >= 0
    numbers = check(daemon)
    print(f"TCP: 5 cuts in a frame, {len(numbers)} frames, all right")


def test_a_radio_that_loses_packets_costs_frames_and_spoils_none(daemon):
    """One packet in ten is lost, either way; TCP sends again, what waits is replaced."""
    daemon.start()
    with FarNetwork(delay_s=0.02, loss=0.1, seed=11) as radio:
        options = ("--orientation", "tcp", "--orientation-hz", 100)
        with PhoneProgram(*daemon.place_at(HERE), *options, prefix=radio.prefix) as phone:
            phone.connected()
            until(lambda: counter(daemon, "frames") >= FRAMES, "frames enough")
            said = phone.number
        assert counter(daemon, "dropped") == 0
    numbers = check(daemon)
    assert radio.lost > 20
    print(f"TCP: {radio.lost} of {radio.lost + radio.passed} packets lost;"
          f" {len(set(numbers))} attitudes of {said} arrived, all right")  # fmt: skip
