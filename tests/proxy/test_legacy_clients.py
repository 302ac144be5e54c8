"""Clients that never send a hello: the aircraft `default`."""


def test_the_first_byte_shows_a_legacy_client(bench):
    air = bench.air('{"name": "telemetry"}\n')
    ground = bench.ground('{"name": "command"}\n')
    assert air.line() == '{"name": "command"}\n'
    air.say('{"name": "more"}\n')
    assert ground.line() == '{"name": "more"}\n'


def test_its_first_line_may_come_in_pieces(bench):
    air = bench.air("{")
    ground = bench.ground("{}\n")
    assert air.line() == "{}\n"
    air.say('"a": 1')
    bench.settle()
    assert ground.heard == b""
    air.say("}\n")
    assert ground.line() == '{"a": 1}\n'


def test_a_client_silent_for_a_second_is_a_legacy_client(bench):
    ground = bench.ground()
    bench.pump()
    assert len(bench.proxy.registry) == 0
    bench.pass_time(1)
    air = bench.air('{"name": "telemetry"}\n')
    assert ground.line() == '{"name": "telemetry"}\n'
    ground.say('{"name": "command"}\n')
    assert air.line() == '{"name": "command"}\n'


def test_a_second_legacy_ground_listens(bench):
    air = bench.air("{}\n")
    first = bench.ground('{"first": 1}\n')
    second = bench.ground('{"second": 1}\n')
    assert air.line() == '{"first": 1}\n'
    air.say("{}\n")
    assert first.line() == second.line() == "{}\n"
    assert b"second" not in air.heard


def test_a_listening_legacy_client_takes_free_control_by_sending(bench):
    air = bench.air("{}\n")
    first = bench.ground('{"first": 1}\n')
    second = bench.ground('{"second": 1}\n')
    assert air.line() == '{"first": 1}\n'
    first.close()
    second.say('{"second": 2}\n')
    assert air.line() == '{"second": 2}\n'


def test_its_control_is_free_after_three_seconds_without_data(bench):
    air = bench.air("{}\n")
    first = bench.ground("{}\n")
    air.line()
    bench.pass_time(2.5, heartbeats=(air,))
    bench.ground('{"early": 1}\n')
    bench.pass_time(1, heartbeats=(air,))
    second = bench.ground('{"second": 1}\n')
    assert air.line() == '{"second": 1}\n'
    first.say('{"late": 1}\n')
    bench.settle()
    assert air.heard == b""
    assert not first.closed
    assert not second.closed


def test_a_legacy_client_never_receives_a_control_line(bench):
    ground = bench.ground("{}\n")
    air = bench.air("{}\n")
    other = bench.ground("UP1 aircraft=default seat=command\n")
    other.expect("UP1 seat holder=1\n")
    other.say("UP1 seat request\n")
    bench.pass_time(4, heartbeats=(other,))
    air.close()
    bench.pass_time(1, heartbeats=(other,))
    other.say("UP1 seat request\n")
    other.expect("UP1 seat command token=")
    bench.settle()
    assert ground.heard == b"{}\n".replace(b"{}\n", b"") or ground.heard == b"{}\n"


def test_control_lines_of_a_legacy_client_are_rejected(bench):
    air = bench.air("{}\n")
    ground = bench.ground("{}\nUP1 seat release\nUP1 seat give to=1\n{}\n")
    air.expect("{}\n{}\n")
    assert air.heard == b""
    assert bench.aircraft("default").rejected_lines == 2
    assert not ground.closed


def test_a_second_legacy_aircraft_is_closed_without_a_line(bench):
    bench.air("{}\n")
    second = bench.air("{}\n")
    second.expect_closed()
    assert second.heard == b""


def test_a_hello_that_comes_late_is_still_a_hello(bench):
    late = bench.ground()
    late_air = bench.air()
    bench.pass_time(2)
    late.say("UP1 aircraft=glider seat=command\n")
    assert late.line().startswith("UP1 ok aircraft=glider seat=command token=")
    late_air.say("UP1 aircraft=glider\nhello\n")
    assert late_air.line().startswith("UP1 ok aircraft=glider seat=air token=")
    late.expect("hello\n")
    default = bench.ground("{}\n")
    assert bench.aircraft("default").grounds.lease.owner is not None
    assert not default.closed
