"""The limits of the proxy."""

from tests.proxy.virtual import Bench
from up.protocols.proxy_lines import Side


def refusal(peer):
    line = peer.line()
    peer.expect_closed()
    return line.split(" reason=")[0]


def test_aircraft_names_are_bounded():
    with Bench(aircraft=3) as bench:
        for name in ("a", "b", "c"):
            bench.hello_ground(name)
        assert refusal(bench.ground("UP1 aircraft=d\n")) == "UP1 error code=full"
        assert refusal(bench.air("UP1 aircraft=d\n")) == "UP1 error code=full"
        bench.hello_air("a")
        assert len(bench.proxy.registry) == 3


def test_listeners_are_bounded():
    with Bench(listeners=2) as bench:
        for kind in ("command", "listen", "listen"):
            bench.hello_ground(asks=kind)
        assert refusal(bench.ground("UP1 aircraft=a seat=listen\n")) == "UP1 error code=full"
        assert refusal(bench.ground("UP1 aircraft=a seat=command\n")) == "UP1 error code=full"
        bench.hello_ground("b")


def test_the_owner_resumes_control_beyond_the_limit_of_listeners():
    with Bench(listeners=1) as bench:
        owner, token = bench.hello_ground()
        bench.hello_ground(asks="listen")
        again, _ = bench.hello_ground(extra=f" token={token}")
        owner.expect_closed()
        assert not again.closed


def test_new_connections_beyond_the_rate_wait_and_delay_nobody():
    """Two in 50 ms; those that are refused do not count."""
    with Bench(rate=40, per_address=4) as bench:
        acceptor = next(each for each in bench.proxy._acceptors if each.side is Side.GROUND)
        (air, _), (ground, _) = bench.hello_air(), bench.hello_ground()
        bench.pass_time(0.25)
        for _ in range(8):
            bench.ground()
            bench.settle()
        assert acceptor.accepted == 3
        air.say("frame\n")
        assert ground.line() == "frame\n"
        bench.reactor.advance(0.05)
        bench.settle()
        assert (acceptor.accepted, acceptor.over_limit) == (4, 5)
