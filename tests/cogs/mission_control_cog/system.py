"""A system with a link to the ground, on the real reactor."""

from mission_control_cog.modules.ground_listener import GroundListener
from mission_control_cog.modules.mission_control_provider import MissionControlProvider

from tests.cogs.peers import Server
from tests.support.reactor import reactor, run_in_reactor
from tests.support.system import build_up
from up.life_cycle import LifeCycle


class Aircraft:
    """Built, started, and stopped again; ``heard`` has the published Commands of chosen types."""

    def __init__(self, folder, port=None, text="", host="127.0.0.1", modules=(), security="auto"):
        peer = f"url: {host}, port: {port}, security: {security}"
        server = "" if port is None else f"remote_server: {{{peer}}}\n"
        config = {"mission_control.yml": server + text}
        mine = (MissionControlProvider, GroundListener)
        self.up = build_up((*mine, *modules), reactor, folder, config=config)
        self.provider = self.up.get_module(MissionControlProvider)
        self.heard = []

    async def __aenter__(self):
        self.life = LifeCycle(self.up)
        await self.life.start()
        return self

    async def __aexit__(self, *_):
        await self.life.stop()

    def listen_to(self, *commands):
        for cls in commands:
            self.up.command_executor.register_command(cls, self.heard.append)


def uplinked(folder, text=""):
    """Run a coroutine with an aircraft, and the test's own proxy that it connects to."""

    def run(body):
        async def fly():
            server = Server(reactor)
            port = await server.open()
            async with Aircraft(folder, port, text) as a:
                await body(a, server)
            await server.close()

        run_in_reactor(fly)

    return run


def listening(folder, text):
    """Run a coroutine with an aircraft that has no proxy."""

    def run(body):
        async def fly():
            async with Aircraft(folder, None, text) as a:
                await body(a)

        run_in_reactor(fly)

    return run
