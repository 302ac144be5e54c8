"""The quota of a tenant at one proxy."""

import pytest

from tests.proxy.virtual import Bench
from up_proxy.tenant_quota import HOUR_S, METER_STEP_S, SAMPLE_S, Usage

MEGABYTE = b"x" * 49_999 + b"\n"
"""20 of these lines."""


def used(bench):
    return bench.proxy._quota.used()


def pass_minutes(bench, count):
    for _ in range(int(count)):
        bench.reactor.advance(METER_STEP_S)
        bench.pump()


def test_aircraft_are_bounded():
    with Bench(quota={"aircraft": 2}) as bench:
        first, token = bench.hello_air("a")
        # Counted immediately: the third of a burst is refused.
        bench.hello_air("b")
        assert bench.air("UP1 aircraft=c\n").refusal() == "quota"
        # A waiting ground is not an aircraft; one that resumes is not another aircraft.
        bench.hello_ground("d")
        bench.hello_air("a", f" token={token}")
        first.expect_closed()
        bench.pass_time(4.0)
        # Both are silent: their places are free.
        assert used(bench).aircraft == 0
        bench.hello_air("c")


def test_the_count_never_refuses_an_aircraft_that_may_be_in_flight():
    with Bench(quota={"aircraft": 1}) as bench:
        first, _ = bench.hello_air("a")
        bench.pass_time(SAMPLE_S + 0.25, heartbeats=[first])
        first.close()
        bench.pass_time(4.0)
        bench.hello_air("b")
        bench.hello_air("a")
        assert bench.air("UP1 aircraft=c\n").refusal() == "quota"


def test_grounds_are_bounded_and_the_owner_of_control_resumes_it():
    with Bench(quota={"grounds": 2}) as bench:
        owner, token = bench.hello_ground("a")
        listener, _ = bench.hello_ground("a", asks="listen")
        assert bench.ground("UP1 aircraft=b\n").refusal() == "quota"
        bench.hello_ground("a", extra=f" token={token}")
        owner.expect_closed()
        listener.close()
        bench.pass_time(SAMPLE_S + 0.25)
        assert used(bench) == Usage(aircraft=0, grounds=1)
        bench.hello_ground("b")


def test_a_legacy_client_counts():
    with Bench(quota={"aircraft": 1, "grounds": 1}) as bench:
        bench.hello_ground("a")
        ground = bench.ground('{"ground": 1}\n')
        ground.expect_closed()
        bench.hello_air("a")
        air = bench.air('{"air": 1}\n')
        air.expect_closed()
        assert [bench.proxy._acceptors[i].refused["quota"] for i in (0, 1)] == [1, 1]


@pytest.fixture
def busy():
    """A proxy whose tenant has used its megabyte, with an aircraft and its ground in control."""
    with Bench(quota={"mb_per_hour": 1}) as bench:
        air, _ = bench.hello_air("a")
        ground, _ = bench.hello_ground("a")
        for _ in range(20):
            air.say(MEGABYTE)
            ground.expect(MEGABYTE)
        bench.pass_time(SAMPLE_S + 0.25, heartbeats=[air, ground])
        assert used(bench).hour_bytes >= 1_000_000
        bench.pair = air, ground
        yield bench


def test_bytes_refuse_new_aircraft_and_listeners_and_end_no_connection(busy):
    assert busy.air("UP1 aircraft=b\n").refusal() == "quota"
    assert busy.ground("UP1 aircraft=a seat=listen\n").refusal() == "quota"
    assert busy.ground("UP1 aircraft=a seat=command\n").refusal() == "quota", "control is not free"
    air, ground = busy.pair
    air.say("still relayed\n")
    ground.expect("still relayed\n")


def test_bytes_never_refuse_an_aircraft_that_may_be_in_flight_nor_its_only_ground(busy):
    for peer in busy.pair:
        peer.close()
    busy.pass_time(30.0)
    air, _ = busy.hello_air("a")
    busy.hello_ground("a")
    assert busy.ground("UP1 aircraft=a seat=listen\n").refusal() == "quota"
    assert busy.ground("UP1 aircraft=b\n").refusal() == "quota", "its aircraft is not connected"
    assert not air.closed


def test_bytes_count_for_an_hour(busy):
    for peer in busy.pair:
        peer.close()
    pass_minutes(busy, HOUR_S / METER_STEP_S - 1)
    assert busy.air("UP1 aircraft=b\n").refusal() == "quota"
    pass_minutes(busy, 3)
    assert used(busy).hour_bytes < 1000
    busy.hello_air("b")


def test_without_a_quota_nothing_is_refused_and_the_usage_is_known():
    with Bench() as bench:
        bench.hello_air("a")
        bench.hello_ground("a")
        bench.pass_time(SAMPLE_S)
        assert used(bench)[:2] == (1, 1)
        assert bench.proxy._quota.limits == {}


def test_the_figures_of_a_tenant():
    with Bench(quota={"aircraft": 3, "mb_per_hour": 2}) as bench:
        bench.hello_air("a")
        lines = bench.proxy.page().splitlines()
    assert 'up_proxy_tenant_usage{kind="aircraft"} 1' in lines
    assert 'up_proxy_tenant_quota{kind="aircraft"} 3' in lines
    assert 'up_proxy_tenant_quota{kind="hour_bytes"} 2000000' in lines
    assert not any("tenant_quota" in line and "grounds" in line for line in lines)
