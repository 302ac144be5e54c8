"""What waits for a page: never an old frame, never without bound."""

from up_ground.web.client_session import PENDING_LIMIT, PageSendBuffer


class Transport:
    """A transport that sends on request."""

    def __init__(self):
        self.written, self.producer = [], None

    def registerProducer(self, producer, streaming):  # noqa: N802
        assert not streaming
        self.producer = producer

    def unregisterProducer(self):  # noqa: N802
        self.producer = None

    def write(self, data):
        self.written.append(data)

    def drain(self):
        self.producer.resumeProducing()


class Bench:
    def __init__(self):
        self.transport, self.overruns = Transport(), 0
        self.output = PageSendBuffer(self.on_overrun)
        self.output.start(self.transport)
        self.transport.drain()

    def on_overrun(self):
        self.overruns += 1


def test_of_frames_only_the_newest_waits():
    bench = Bench()
    for number in range(100):
        bench.output.send_newest("frame", lambda number=number: b"frame %d;" % number)
    assert bench.transport.written == [b"frame 0;"]
    assert bench.output.replaced == 98
    bench.transport.drain()
    assert bench.transport.written == [b"frame 0;", b"frame 99;"]


def test_its_age_is_that_of_the_moment_when_it_leaves():
    bench, age = Bench(), [1]
    bench.output.send(b"busy")
    bench.output.send_newest("frame", lambda: b"%d" % age[0])
    age[0] = 2
    bench.transport.drain()
    assert bench.transport.written[-1] == b"2"


def test_each_kind_has_its_own_newest_and_messages_keep_their_order():
    bench = Bench()
    bench.output.send(b"busy;")
    for text in (b"a;", b"b;"):
        bench.output.send(text)
        bench.output.send_newest("frame", lambda text=text: b"frame " + text)
        bench.output.send_newest("status", lambda text=text: b"status " + text)
    bench.transport.drain()
    assert bench.transport.written[-1] == b"a;b;frame b;status b;"


def test_a_page_that_reads_nothing_costs_a_bounded_amount():
    bench = Bench()
    for _ in range(5000):
        bench.output.send(bytes(1000))
        bench.output.send_newest("frame", lambda: bytes(2000))
        assert bench.output._size <= PENDING_LIMIT + 1000
    assert bench.overruns == 1
    assert sum(map(len, bench.transport.written)) == 1000


def test_an_end_sends_what_waits_and_then_nothing():
    bench = Bench()
    bench.output.send(b"busy;")
    bench.output.send(b"last;")
    bench.output.finish()
    bench.output.send(b"never")
    bench.output.send_newest("frame", lambda: b"never")
    assert b"".join(bench.transport.written) == b"busy;last;"
    assert bench.transport.producer is None
