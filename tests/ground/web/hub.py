"""A hub of pages without a network, and links to it that remember."""

import json

from twisted.internet.task import Clock

from up_ground.web.access import Access
from up_ground.web.aircraft_source import AircraftSource
from up_ground.web.client_hub import ClientHub
from up_ground.web.sessions import SignInError

KEY = "the-right-key"
PAIRING = f"upkey:1:kite:{'1' * 16}:{'2' * 64}:pilot:tablet"


class Output:
    def __init__(self):
        self.sent = []

    def send(self, message):
        self.sent.append(message)

    def send_newest(self, kind, make):
        self.sent.append(make())

    def discard(self, kind):
        pass


class Link:
    """A page's connection that remembers."""

    def __init__(self, host="192.0.2.1"):
        self.output, self.closed, self.alive = Output(), None, True
        self.host, self.is_admitted = host, False
        self.session, self.may_send_secrets = "", True

    def admit(self, max_bytes):
        self.is_admitted, self.max_bytes = True, max_bytes

    def close(self, code, reason):
        self.closed = (code, reason)

    def is_alive(self, within_s, notify):
        notify(self.alive)

    @property
    def told(self):
        return [json.loads(each[each.index(b"{") :]) for each in self.output.sent]

    def kinds(self):
        return [each["type"] for each in self.told]


class Kite(AircraftSource):
    """An aircraft that records its requests."""

    name, summary = "kite", "kite"

    def __init__(self):
        self.heard = []

    def start(self):
        pass

    async def stop(self):
        pass

    def past(self):
        return []

    def status(self, page):
        return {"type": "status", "aircraft": "kite"}

    def on_control(self, page, action, to):
        self.heard.append((action, to))

    def on_command(self, page, message):
        self.heard.append(("command", message.whole("ask"), message.text("name", 128)))
        message.object("data")
        message.optional_whole("beacon")

    async def pair(self, page, pairing):
        self.heard.append(("pair", pairing.name))

    def on_replay(self, page, action, message):
        message.number("value")

    def on_away(self, page):
        self.heard.append(("away", page.number))

    def on_gone(self, page):
        self.heard.append(("gone", page.number))


class Bench:
    def __init__(self, **access):
        self.clock = Clock()
        self.pages = ClientHub(self.clock, Access(**access))
        self.kite = Kite()
        self.pages.fleet["kite"] = self.kite

    def open(self, hello=True, host="192.0.2.1", session="", **more):
        link = Link(host)
        link.session = session
        self.pages.on_opened(link)
        if hello:
            self.send(link, type="hello", name="Ann", **more)
        return link

    def sign_in(self, host="192.0.2.1"):
        return self.pages.sessions.sign_in(host, KEY)

    def denial(self, key, host):
        """Return code and HTTP status with which a key is refused; None: it opens a session."""
        try:
            self.pages.sessions.sign_in(host, key)
        except SignInError as error:
            return error.code, error.status_code
        return None

    def send(self, link, **fields):
        self.pages.on_message(link, json.dumps(fields).encode())
