"""The limits of the proxy."""

from tests.proxy.virtual import Bench
from up.protocols.proxy_lines import Side


def test_aircraft_names_are_bounded():
    with Bench(aircraft=3) as bench:
        for name in ("a", "b", "c"):
            bench.hello_ground(name)
        assert bench.ground("UP1 aircraft=d\n").refusal() == "full"
        assert bench.air("UP1 aircraft=d\n").refusal() == "full"
        bench.hello_air("a")
        assert len(bench.proxy.registry) == 3


def test_listeners_are_bounded():
    with Bench(listeners=2) as bench:
        for kind in ("command", "listen", "listen"):
            bench.hello_ground(asks=kind)
        assert bench.ground("UP1 aircraft=a seat=listen\n").refusal() == "full"
        assert bench.ground("UP1 aircraft=a seat=command\n").refusal() == "full"
        bench.hello_ground("b")


def test_the_owner_resumes_control_beyond_the_limit_of_listeners():
    with Bench(listeners=1) as bench:
        owner, token = bench.hello_ground()
        bench.hello_ground(asks="listen")
        again, _ = bench.hello_ground(extra=f" token={token}")
        owner.expect_closed()
        assert not again.closed


def test_new_connections_beyond_the_rate_wait_and_delay_nobody():
    """Two in a second; four may wait, and one that has left costs nothing of the rate."""
    with Bench(connections_hz=2) as bench:
        acceptor = next(each for each in bench.proxy._acceptors if each.side is Side.GROUND)
        (air, _), (ground, _) = bench.hello_air(), bench.hello_ground()
        bench.pass_time(0.5)
        peers = [bench.ground() for _ in range(6)]
        assert peers[5].refusal() == "full"
        assert (acceptor.accepted, acceptor.over_limit) == (2, 1)
        air.say("frame\n")
        assert ground.line() == "frame\n"
        peers[2].say("UP1 aircraft=a seat=listen\n").close()
        for accepted in (3, 4, 5, 5):
            bench.reactor.pump([0.0625] * 8)
            assert acceptor.accepted == accepted
        peers[4].say("UP1 aircraft=a seat=listen\n").line()


def test_attack_a_flood_from_one_address_delays_only_itself():
    with Bench(connections_hz=2) as bench:
        bench.hello_air()
        for _ in range(20):
            bench.ground(host="127.0.0.2")
        bench.settle()
        ground = bench.ground("UP1 aircraft=a seat=command\n")
        bench.settle()
        bench.reactor.pump([0.0625] * 8)
        assert not ground.heard
        bench.reactor.pump([0.0625] * 8)
        assert ground.line().startswith("UP1 ok ")
