"""The limits of the proxy."""

from tests.proxy.virtual import Bench


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
