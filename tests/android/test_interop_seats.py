"""The Python ground and the Java ground hand the seat of one aircraft to each other."""

import pytest

from tests.android.console_program import ConsoleProgram
from tests.android.real_daemon import AIRCRAFT, RealDaemon
from tests.proxy.program import Program
from tests.support.reactor import reactor, run_in_reactor, until
from up.protocols.general_message import encode
from up_ground.ground_link import GroundLink
from up_ground.settings import Seat, Settings
from up_ground.token_store import TokenStore
from up_simulator.in_process.host import LiteralResolver


@pytest.fixture
def proxy(tmp_path):
    with Program(tmp_path / "proxy") as program:
        yield program


@pytest.fixture
def daemon(tmp_path, proxy):
    made = RealDaemon(tmp_path / "daemon", proxy)
    made.start()
    yield made
    made.end()


@pytest.fixture(autouse=True)
def no_look_up():
    """Addresses need none: the reactor's threads for it would outlive the tests."""
    before = reactor.installNameResolver(LiteralResolver())
    yield
    reactor.installNameResolver(before)


class PythonGround:
    """The link of the Python ground station, and its received messages."""

    def __init__(self, folder, port):
        settings = Settings("127.0.0.1", port, AIRCRAFT, Seat.LISTEN)
        self.link = GroundLink(reactor, settings, self, TokenStore(folder, settings))
        self.messages = []

    def on_message(self, message):
        self.messages.append(message)

    def on_link(self):
        """Receive it: the status is read."""

    @property
    def frames(self):
        return [each for each in self.messages if each.name == "up.telemetry.update"]

    async def ask(self, name, id_, **data):
        """Send a Command with the newest beacon and return the name of its answer."""
        await until(lambda: self.frames, what="telemetry")
        assert self.link.send(encode(name, data, id_, self.frames[-1].beacon))

        def answer():
            ids = [each for each in self.messages if each.data.get("id") == id_]
            return ids and ids[0].name

        return await until(answer, what=f"the answer to {name}")


def test_the_seat_goes_to_the_python_ground_and_back(proxy, daemon, tmp_path):
    async def flight():
        at = ("--proxy", f"127.0.0.1:{proxy.ground_port}", "--aircraft", AIRCRAFT)
        python = PythonGround(tmp_path / "tokens", proxy.ground_port)
        with ConsoleProgram(*at) as java:
            await until(lambda: java.status.get("standing") == "OURS" and java.frames)
            python.link.start()
            await until(lambda: python.link.status.seat is Seat.LISTEN, what="a listener")

            assert python.link.request_seat()
            await until(lambda: java.status["asked_by"], what="that Java is asked")
            java.say(seat={"give": java.status["asked_by"]})
            await until(lambda: python.link.status.seat is Seat.COMMAND, what="Python's seat")
            await until(lambda: java.status["seat"] == "listen", what="Java listens")
            assert await python.ask("up.telemetry.frequency", "p1", frequency=50) == "up.ack"
            refused = java.ask_later("up.telemetry.frequency", frequency=70)
            await until(lambda: java.answer(refused), what="Java's refusal")
            assert java.answer(refused)["code"] == "no_control"

            java.say(seat="request")
            await until(lambda: python.link.status.asked_by, what="that Python is asked")
            assert python.link.give_seat(python.link.status.asked_by)
            await until(lambda: java.status["standing"] == "OURS", what="Java's seat")
            await until(lambda: python.link.status.seat is Seat.LISTEN, what="Python listens")
            sent = java.ask_later("up.telemetry.frequency", frequency=60)
            await until(lambda: java.answer(sent), what="Java's answer")
            assert java.answer(sent)["outcome"] == "ACK"
            assert java.all("telemetry")[-1]["beacon"] <= python.frames[-1].beacon + 20
        await python.link.stop()

    run_in_reactor(flight, timeout_s=120.0)
