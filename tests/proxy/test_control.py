"""The commanding ground, the listeners, and how the seat changes hands."""


def command_token(peer):
    line = peer.line()
    assert line.startswith("UP1 seat command token="), line
    return line.removeprefix("UP1 seat command token=").strip()


def test_the_first_ground_commands_and_a_newcomer_listens(bench):
    air, _ = bench.hello_air()
    first, _ = bench.hello_ground()
    second, _ = bench.hello_ground(gets="listen")
    assert first.number == "UP1 seat holder=1\n" == second.number
    second.say('{"name": "steal"}\n')
    first.say('{"name": "fly"}\n')
    assert air.line() == '{"name": "fly"}\n'
    assert b"steal" not in air.heard
    assert bench.aircraft().rejected_lines == 1


def test_all_grounds_receive_the_aircraft(bench):
    air, _ = bench.hello_air()
    grounds = [bench.hello_ground()[0]] + [bench.hello_ground(asks="listen")[0] for _ in range(3)]
    air.say('{"name": "telemetry"}\n')
    for ground in grounds:
        assert ground.line() == '{"name": "telemetry"}\n'


def test_aircraft_are_apart(bench):
    one, _ = bench.hello_air("one")
    two, _ = bench.hello_air("two")
    ground_one, _ = bench.hello_ground("one")
    ground_two, _ = bench.hello_ground("two")
    one.say("from one\n")
    two.say("from two\n")
    ground_one.say("to one\n")
    ground_two.say("to two\n")
    assert ground_one.line() == "from one\n"
    assert ground_two.line() == "from two\n"
    assert one.line() == "to one\n"
    assert two.line() == "to two\n"
    bench.settle()
    assert not any(peer.heard for peer in bench.peers)


def test_handing_over(bench):
    air, _ = bench.hello_air()
    owner, old_token = bench.hello_ground()
    asker, _ = bench.hello_ground(gets="listen")
    asker.say("UP1 seat request\n")
    assert owner.line() == "UP1 seat asked by=2\n"
    owner.say("before\nUP1 seat give to=2\nafter\n")
    assert owner.line() == "UP1 seat listen\n"
    assert owner.line() == "UP1 seat holder=2\n"
    token = command_token(asker)
    assert token != old_token
    assert asker.line() == "UP1 seat holder=2\n"
    asker.say("mine\n")
    assert air.line() == "before\n"
    assert air.line() == "mine\n"
    bench.settle()
    assert air.heard == b""


def test_released_control_goes_to_the_next_request(bench):
    bench.hello_air()
    owner, old_token = bench.hello_ground()
    other, _ = bench.hello_ground(gets="listen")
    owner.say("UP1 seat release\n")
    assert owner.line() == "UP1 seat listen\n"
    assert owner.line() == other.line() == "UP1 seat holder=none\n"
    other.say("UP1 seat request\n")
    command_token(other)
    assert other.line() == owner.line() == "UP1 seat holder=2\n"
    other = bench.ground(f"UP1 aircraft=a seat=command token={old_token}\n")
    assert "seat=listen" in other.line()


def test_only_the_owner_gives_and_releases(bench):
    air, _ = bench.hello_air()
    owner, _ = bench.hello_ground()
    other, _ = bench.hello_ground(gets="listen")
    other.say("UP1 seat give to=2\nUP1 seat release\nUP1 seat command token=0\nUP1 nonsense\n")
    owner.say("still here\n")
    assert air.line() == "still here\n"
    assert bench.aircraft().rejected_lines == 4
    owner.say("UP1 seat give to=77\nstill\n")
    assert air.line() == "still\n"


def test_requests_reach_the_owner_once_a_second(bench):
    owner, _ = bench.hello_ground()
    asker, _ = bench.hello_ground(gets="listen")
    asker.say("UP1 seat request\n" * 1000)
    assert owner.line() == "UP1 seat asked by=2\n"
    bench.settle()
    assert owner.heard == b""
    bench.pass_time(1, heartbeats=(owner, asker))
    asker.say("UP1 seat request\n")
    assert owner.line() == "UP1 seat asked by=2\n"


def test_a_silent_owner_keeps_control_for_three_seconds(bench):
    air, _ = bench.hello_air()
    owner, _ = bench.hello_ground()
    bench.pass_time(2.75, heartbeats=(air,))
    bench.hello_ground(gets="listen")[0].close()
    bench.pass_time(0.5, heartbeats=(air,))
    owner.expect("UP1 seat holder=none\n")
    taker, _ = bench.hello_ground(gets="command")
    owner.expect("UP1 seat listen\n")
    owner.say("too late\n")
    taker.say("new\n")
    air.expect("new\n")
    assert b"too late" not in air.heard


def test_a_silent_owner_that_sends_again_still_has_control(bench):
    air, _ = bench.hello_air()
    owner, _ = bench.hello_ground()
    bench.pass_time(5, heartbeats=(air,))
    owner.expect("UP1 seat holder=none\n")
    owner.say("back\n")
    bench.pass_time(0.25)
    owner.expect("UP1 seat holder=1\n")
    air.expect("back\n")


def test_heartbeats_keep_control(bench):
    owner, _ = bench.hello_ground()
    bench.pass_time(60, heartbeats=(owner,))
    bench.hello_ground(gets="listen")
    assert not owner.closed


def test_the_resume_token_regains_control_immediately(bench):
    air, _ = bench.hello_air()
    owner, token = bench.hello_ground()
    again, same = bench.hello_ground(extra=f" token={token}")
    assert same == token
    owner.expect_closed()
    again.say("resumed\n")
    assert air.line() == "resumed\n"


def test_control_is_reserved_for_the_token_of_a_closed_connection(bench):
    owner, token = bench.hello_ground()
    owner.close()
    other, _ = bench.hello_ground(gets="listen")
    again, _ = bench.hello_ground(extra=f" token={token}")
    again.close()
    bench.pass_time(3.25, heartbeats=(other,))
    bench.hello_ground(gets="command")


def test_wrong_tokens_and_newcomers_gain_nothing(bench):
    air, air_token = bench.hello_air()
    owner, token = bench.hello_ground()
    for number in range(200):
        guess = f"{number:032x}"
        for line in (
            f"UP1 aircraft=a seat=command token={guess}\nUP1 seat release\nstolen\n",
            f"UP1 aircraft=a seat=command token={token[:-1] + 'g'}\nstolen\n",
            f"UP1 aircraft=a seat=command token={air_token}\nstolen\n",
            "UP1 aircraft=a seat=command\nUP1 seat give to=2\nstolen\n",
        ):
            bench.ground(line).close()
        bench.air(f"UP1 aircraft=a token={guess}\nforged\n").close()
    owner.say("mine\n")
    assert air.line() == "mine\n"
    assert b"forged" not in owner.heard
    assert not owner.closed
    assert not air.closed


def test_the_aircraft_of_a_name_is_not_displaced_while_it_lives(bench):
    air, token = bench.hello_air()
    assert bench.air("UP1 aircraft=a\n").refusal() == "taken"
    assert bench.air("UP1 aircraft=a token=" + "0" * 32 + "\n").refusal() == "token"
    again, same = bench.hello_air(extra=f" token={token}")
    assert same == token
    air.expect_closed()
    bench.pass_time(3.5)
    successor, _ = bench.hello_air()
    again.expect_closed()
    assert not successor.closed


def test_grounds_are_notified_of_the_aircraft(bench):
    ground = bench.ground("UP1 aircraft=a seat=command\n")
    ground.expect("UP1 aircraft offline\nUP1 seat holder=1\n")
    air, token = bench.hello_air()
    assert ground.line() == "UP1 aircraft online\n"
    air.close()
    assert ground.line() == "UP1 aircraft offline\n"
    air, _ = bench.hello_air(extra=f" token={token}")
    assert ground.line() == "UP1 aircraft online\n"
    bench.pass_time(3.5, heartbeats=(ground,))
    assert ground.line() == "UP1 aircraft offline\n"
    air.say("\n")
    bench.pass_time(0.25)
    ground.expect("UP1 aircraft online\n")


def test_commands_for_an_absent_aircraft_are_counted_not_kept(bench):
    ground, _ = bench.hello_ground()
    ground.say("one\ntwo\n")
    air, _ = bench.hello_air()
    ground.say("three\n")
    assert air.line() == "three\n"
    assert bench.aircraft().rejected_lines == 2


def test_an_aircraft_without_connections_is_removed_but_its_counts_stay(bench):
    air, _ = bench.hello_air()
    ground, _ = bench.hello_ground()
    air.say("12345678\n")
    ground.expect("12345678\n")
    air.close()
    ground.close()
    assert len(bench.proxy.registry) == 1
    bench.pass_time(3.5)
    assert len(bench.proxy.registry) == 0
    assert bench.proxy.registry.totals().air_bytes == 9


HANDSHAKE = b"\x03" + b"h" * 40 + b"\n"


def test_handshakes_of_listeners_reach_the_aircraft_at_a_limited_rate(bench):
    air, _ = bench.hello_air()
    bench.hello_ground()
    listener, _ = bench.hello_ground(asks="listen")
    listener.say(HANDSHAKE * 6 + b'{"name": "up.arm"}\n')
    assert air.expect(HANDSHAKE * 4) == b""
    bench.settle()
    assert air.heard == b""
    assert bench.aircraft().rejected_lines == 3
    bench.pass_time(1.0)
    listener.say(HANDSHAKE)
    air.expect(HANDSHAKE)


def test_a_handshake_takes_no_control_and_is_short(bench):
    air, _ = bench.hello_air()
    listener, _ = bench.hello_ground(asks="listen")
    listener.say(HANDSHAKE)
    air.expect(HANDSHAKE)
    assert bench.aircraft().grounds.lease.owner is None
    listener.say(b"\x03" + b"h" * 300 + b"\n")
    bench.settle()
    assert air.heard == b""
    assert bench.aircraft().rejected_lines == 1
