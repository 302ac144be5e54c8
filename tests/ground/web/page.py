"""A page as the server sees one (autobahn's own client), and the server as users start it."""

import json
import re
import urllib.error
import urllib.request

from autobahn.twisted.websocket import WebSocketClientFactory, WebSocketClientProtocol
from twisted.internet.endpoints import TCP4ClientEndpoint

from tests.ground import aircraft
from tests.ground.aircraft import Ground
from tests.support.reactor import reactor, run_in_reactor, until

MODE = "up.flight_mode.set"
FBW = {"mode": "FBW"}


class _Client(WebSocketClientProtocol):
    def onOpen(self):  # noqa: N802
        self.factory.page.is_open = True

    def onMessage(self, payload, isBinary):  # noqa: N802, N803
        self.factory.page.take(payload)

    def onClose(self, wasClean, code, reason):  # noqa: N802, N803
        page = self.factory.page
        page.is_closed, page.code, page.why = True, code, reason


class Page:
    """Keeps its received messages; `send` sends, the coroutines wait."""

    def __init__(self, port, origin=None, host="127.0.0.1", cookie=""):
        self.port, self.told = port, []
        self.is_open = self.is_closed = False
        self.code, self.why = None, ""
        self.factory = WebSocketClientFactory(
            f"ws://{host}:{port}/link",
            origin=origin,
            reactor=reactor,
            headers={"Cookie": cookie} if cookie else None,
        )
        self.factory.noisy = False
        self.factory.protocol = _Client
        self.factory.page = self
        self.asks = 0

    async def open(self):
        endpoint = TCP4ClientEndpoint(reactor, "127.0.0.1", self.port)
        self.client = await endpoint.connect(self.factory)
        await until(lambda: self.is_open or self.is_closed, what="the link")
        return self

    async def hello(self, name="test", watch="", **more):
        """Open the link, send the hello and watch; return the welcome."""
        await self.open()
        self.send("hello", name=name, **more)
        welcome = await self.next("welcome")
        if watch is not None:
            self.send("watch", **({"aircraft": watch} if watch else {}))
        return welcome

    def take(self, payload):
        self.told.append(json.loads(payload))

    def send(self, kind, **fields):
        if kind in ("watch", "control", "command"):
            fields.setdefault("aircraft", aircraft.NAME)
        self.raw(json.dumps({"type": kind, **fields}))

    def raw(self, text):
        self.client.sendMessage(text.encode() if isinstance(text, str) else text)

    def of(self, kind):
        return [each for each in self.told if each["type"] == kind]

    def newest(self, kind):
        found = self.of(kind)
        return found[-1] if found else None

    async def next(self, kind, test=lambda message: True):
        """Wait for a message of a kind that passes a test, and return it."""

        def find():
            return next((each for each in self.of(kind) if test(each)), None)

        return await until(find, what=f"{kind}; told {self.told[-8:]}, {self.why}")

    async def status(self, test):
        """Wait until the newest status passes a test."""

        def find():
            newest = self.newest("status")
            return newest if newest and test(newest) else None

        return await until(find, what=f"a status; the newest is {self.newest('status')}")

    async def command(self, name, data=None, **more):
        """Send a Command, with the last received beacon, and return its answer."""
        if "beacon" not in more:
            more["beacon"] = await self.beacon()
        self.asks += 1
        ask = self.asks
        self.send("command", ask=ask, name=name, data=data or {}, **more)
        return await self.next("answer", lambda each: each["ask"] == ask)

    async def beacon(self):
        """Return the newest frame's beacon; None without an aircraft to send one."""
        if not self.of("frame"):
            status = await self.next("status")
            if not (self.newest("status") or status)["link"]["aircraft_online"]:
                return None
            await self.next("frame")
        return self.newest("frame")["beacon"]

    async def control(self):
        self.send("control", action="request")
        return await self.status(lambda each: each["control"]["holder"] == "you")

    async def leave(self):
        if not self.is_closed:
            self.client.transport.abortConnection()
            await until(lambda: self.is_closed, what="the end of the link")


class Serve(Ground):
    """A running `up-ground serve` for one proxy."""

    def __init__(self, folder, ground_port, *arguments, before=()):
        words = [*before, "serve", "--listen", "127.0.0.1:0", *arguments]
        super().__init__(folder, ground_port, *words)

    def __enter__(self):
        self.expect("Ctrl-C")
        return self

    @property
    def port(self):
        return int(re.search(r":(\d+)/", self.event("page_open")["url"])[1])


def get(port, path, method="GET", **headers):
    request = urllib.request.Request(
        f"http://127.0.0.1:{port}{path}", method=method, headers=headers
    )
    try:
        with urllib.request.urlopen(request, timeout=30) as answer:
            return answer.status, answer.headers, answer.read()
    except urllib.error.HTTPError as error:
        with error:
            return error.code, error.headers, error.read()


def sign_in(port, key, **headers):
    """Return (status, cookie) of an attempt to sign in; the cookie is empty without success."""
    status, answer, _ = get(port, "/session", "POST", Authorization=f"Bearer {key}", **headers)
    return status, (answer["Set-Cookie"] or "").partition(";")[0]


def with_pages(server, look, *names):
    """Run `look(*pages)`; the pages have sent their hello and watch the aircraft."""

    async def run():
        pages = [Page(server.port) for _ in names]
        for page, name in zip(pages, names, strict=True):
            await page.hello(name)
        try:
            return await look(*pages)
        finally:
            for page in pages:
                await page.leave()

    return run_in_reactor(run)


def sent(flying, name=MODE):
    return [each for each in flying.received if each["name"] == name]
