"""The link to the proxy, with a server of our own at its other end."""

import pytest
from mission_control_cog.uplink import Uplink
from twisted.logger import globalLogPublisher

from tests.cogs.mission_control_cog.system import Aircraft, uplinked
from tests.cogs.peers import Server
from tests.support.reactor import reactor, sleep, until
from up.commands.altitude_command import AltitudeCommand
from up.commands.system_commands import LinkStateCommand
from up.commands.telemetry_commands import TelemetryFrequencyCommand

OK = b"UP1 ok aircraft=default seat=air token=" + b"ab" * 16 + b"\n"
PERIOD = {"name": "up.telemetry.frequency", "data": {"frequency": 90}}


async def accepted(server, index=0):
    """The connection of an aircraft whose hello was answered."""
    peer = await server.peer(index)
    await until(lambda: peer.received.startswith(b"UP1 aircraft="))
    peer.say(OK)
    return peer


def test_hello_first_then_telemetry_after_the_answer(tmp_path):
    @uplinked(tmp_path, "aircraft: glider-1\n")
    async def _(a, server):
        a.listen_to(LinkStateCommand)
        peer = await server.peer()
        await until(lambda: peer.received)
        await sleep(0.3)
        assert peer.received == b"UP1 aircraft=glider-1 packed=1\n"
        assert not a.provider.connected
        # In two parts, and with a message right behind.
        peer.say(OK[:9])
        peer.say(OK[9:], {**PERIOD, "id": "h"})
        assert (await peer.answer("h"))["name"] == "up.ack"
        frames = await until(lambda: peer.named("up.telemetry.update"))
        assert isinstance(frames[0]["beacon"], int)
        assert a.heard == [LinkStateCommand("mission_control", True)]


def test_the_link_reconnects_with_its_token_and_without_the_partial_line(tmp_path):
    @uplinked(tmp_path)
    async def _(a, server):
        a.listen_to(TelemetryFrequencyCommand, LinkStateCommand)
        first = await accepted(server)
        await until(lambda: a.provider.connected)
        first.say(b'{"name": "up.telemetry.frequency", "data": {"frequency": 1')
        await until(lambda: first.named("up.telemetry.update"))
        first.transport.abortConnection()
        second = await accepted(server, 1)
        assert second.received.startswith(
            b"UP1 aircraft=default token=" + b"ab" * 16 + b" packed=1\n"
        )
        second.say(b"50}}\n", {**PERIOD, "id": "x"})
        await second.answer("x")
        assert a.heard.count(TelemetryFrequencyCommand(90)) == 1
        states = [c.connected for c in a.heard if isinstance(c, LinkStateCommand)]
        assert states == [True, False, True]
        assert a.up.command_receiver.counters["malformed"] == 1


async def test_an_absent_proxy_does_not_fail_the_start_and_is_found_later(tmp_path):
    server = Server(reactor)
    port = await server.open()
    await server.close()
    async with Aircraft(tmp_path, port) as a:
        assert a.provider.started
        assert a.up.vetoes.own == {}
        await sleep(0.5)
        late = Server(reactor)
        await late.open(port)
        peer = await accepted(late)
        first = await until(lambda: peer.named("up.telemetry.update"))
        # Messages from before the link are not sent later.
        assert first[0]["beacon"] > a.up.beacons._first
        await late.close()


def test_a_refused_hello_is_tried_again_without_the_token(tmp_path):
    @uplinked(tmp_path)
    async def _(a, server):
        peer = await server.peer()
        await until(lambda: peer.received)
        peer.say(b'UP1 error code=taken reason="an aircraft of this name is connected"\n', PERIOD)
        await peer.closed
        second = await accepted(server, 1)
        await until(lambda: a.provider.connected)
        second.transport.abortConnection()
        third = await server.peer(2)
        await until(lambda: b"token=" in third.received)
        third.say(b'UP1 error code=token reason="no"\n')
        fourth = await server.peer(3)
        assert await until(lambda: fourth.received) == b"UP1 aircraft=default packed=1\n"
        assert a.up.command_receiver.counters["received"] == 0


def test_a_refusal_that_does_not_judge_the_token_keeps_it(tmp_path):
    @uplinked(tmp_path)
    async def _(a, server):
        first = await accepted(server)
        await until(lambda: a.provider.connected)
        first.transport.abortConnection()
        for number, code in enumerate((b"cluster", b"full"), 1):
            refused = await server.peer(number)
            await until(lambda peer=refused: peer.received)
            refused.say(b"UP1 error code=" + code + b' reason="later"\n')
            await refused.closed
        again = await server.peer(3)
        expected = b"UP1 aircraft=default token=" + b"ab" * 16 + b" packed=1\n"
        assert await until(lambda: again.received) == expected


@pytest.mark.parametrize(
    ("answer", "code"),
    [
        (b'{"name": "up.heading.change"}\n', "not_an_answer"),
        (b"UP1 what\n", "not_an_answer"),
        (b"x" * 600, "answer_too_long"),
        (b"x" * 600 + b"\n", "answer_too_long"),
    ],
)
async def test_anything_but_an_answer_ends_the_connection(tmp_path, answer, code):
    server = Server(reactor)
    port = await server.open()
    events = []
    globalLogPublisher.addObserver(events.append)
    async with Aircraft(tmp_path, port) as a:
        peer = await server.peer()
        await until(lambda: peer.received)
        peer.say(answer)
        await peer.closed
        await accepted(server, 1)
        await until(lambda: a.provider.connected)
        assert a.up.command_receiver.counters["received"] == 0
    globalLogPublisher.removeObserver(events.append)
    assert code in [event.get("code") for event in events]
    await server.close()


def test_a_legacy_client_sends_no_hello_and_no_empty_lines(tmp_path):
    @uplinked(tmp_path, "hello: false\n")
    async def _(a, server):
        peer = await server.peer()
        peer.say({"name": "up.telemetry.frequency", "data": {"frequency": 10000}, "id": "f"})
        await peer.answer("f")
        await sleep(1.3)
        assert all(line.startswith(b"{") for line in peer.received.split(b"\n")[:-1])
        assert a.provider.connected


def test_a_silent_second_ends_with_an_empty_line(tmp_path):
    @uplinked(tmp_path)
    async def _(a, server):
        peer = await accepted(server)
        peer.say({"name": "up.telemetry.frequency", "data": {"frequency": 10000}, "id": "f"})
        await peer.answer("f")
        begin = len(peer.received)
        await until(lambda: b"\n\n\n" in peer.received[begin - 1 :])


def test_a_proxy_that_does_not_read_costs_bounded_memory_and_gets_the_newest_later(tmp_path):
    @uplinked(tmp_path)
    async def _(a, server):
        peer = await accepted(server)
        await until(lambda: a.provider.connected)
        a.up.command_executor.execute_command(TelemetryFrequencyCommand(10000))
        peer.transport.pauseProducing()
        link = a.provider._uplink._link
        filler = b'{"filler": "%s"}\n' % (b"x" * 8000)
        while link.output.dropped == 0:
            a.provider._transmit_data(filler)
        assert link.output._size <= 65536
        a.provider._transmit_newest(b'{"n": 1}\n')
        a.provider._transmit_newest(b'{"n": 2}\n')
        assert link.output._news[""]() == b'{"n": 2}\n'
        assert not a.provider._transmit_data(filler)
        peer.transport.resumeProducing()
        await until(lambda: b'{"n": 2}' in peer.lines)
        assert b'{"n": 1}' not in peer.lines
        assert link.output.replaced == 1


def test_the_result_of_sending_a_command_to_the_ground(tmp_path):
    @uplinked(tmp_path)
    async def _(a, server):
        assert not a.provider.send_command(AltitudeCommand(5.5))
        peer = await accepted(server)
        await until(lambda: a.provider.connected)
        assert a.provider.send_command(AltitudeCommand(6.5), "i")
        (got,) = await until(lambda: peer.named("up.altitude.change"))
        assert (got["data"]["altitude"], got["id"]) == (6.5, "i")
        assert a.provider.telemetry_content["counters"]["mission_control"] == {
            "connects": 1,
            "unsent": 1,
            "telemetry_faults": 0,
            "too_many": 0,
            "protected": {},
        }


async def test_without_a_proxy_the_module_runs(tmp_path):
    async with Aircraft(tmp_path) as a:
        assert a.provider.started
        assert not a.provider.connected
        assert not a.provider.send_command(AltitudeCommand(1))


async def test_stopping_ends_an_attempt_and_a_pause(tmp_path):
    def uplink(port):
        quiet = lambda *_: None  # noqa: E731
        return Uplink(
            reactor, "127.0.0.1", port, "x",
            on_message=quiet, on_malformed=quiet, on_ready=quiet, on_lost=quiet,
        )  # fmt: skip

    server = Server(reactor)
    port = await server.open()
    silent = uplink(port)
    silent.start()
    await server.peer()
    await silent.stop()
    await server.close()
    refused = uplink(port)
    refused.start()
    await sleep(0.2)
    await refused.stop()
