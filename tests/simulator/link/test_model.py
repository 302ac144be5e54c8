"""A link's delay, order, rate, loss and faults, for any traffic."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from up_simulator.link.model import LinkModel, LinkSettings
from up_simulator.link.pipe import LinkPipe

SETTINGS = st.builds(
    LinkSettings,
    delay_ms=st.floats(0, 2000),
    jitter_ms=st.floats(0, 500),
    loss_percent=st.floats(0, 90),
    rate_bytes_s=st.one_of(st.just(0.0), st.floats(100, 1e6)),
)
TRAFFIC = st.lists(st.tuples(st.integers(1, 5000), st.floats(0, 0.5)), min_size=1, max_size=60)
TINY_S = 1e-9


def sent(model, traffic, **how):
    """Return when each packet left and when it arrives."""
    now_s, times = 0.0, []
    for size, pause_s in traffic:
        now_s += pause_s
        times.append((now_s, model.send(size, now_s, **how)))
    return times


@given(SETTINGS, TRAFFIC, st.integers(0, 2**32))
def test_a_stream_keeps_its_order_loses_nothing_and_is_never_early(settings, traffic, seed):
    times = sent(LinkModel(settings, seed), traffic)
    arrivals = [arrival for _, arrival in times]
    assert None not in arrivals
    assert arrivals == sorted(arrivals)
    assert all(arrival >= left + settings.delay_ms / 1000 - TINY_S for left, arrival in times)


@given(SETTINGS, TRAFFIC, st.integers(0, 2**32))
def test_no_window_carries_more_than_the_rate(settings, traffic, seed):
    times = sent(LinkModel(settings, seed), traffic)
    if not settings.rate_bytes_s:
        return
    for first, (left, _) in enumerate(times):
        carried = 0
        for last in range(first, len(times)):
            carried += traffic[last][0]
            least_s = carried / settings.rate_bytes_s + settings.delay_ms / 1000
            assert times[last][1] >= left + least_s - 1e-6


@given(SETTINGS, TRAFFIC, st.integers(0, 2**32))
def test_the_same_seed_gives_the_same_times(settings, traffic, seed):
    how = {"is_datagram": True}
    assert sent(LinkModel(settings, seed), traffic) == sent(LinkModel(settings, seed), traffic)
    first, second = LinkModel(settings, seed), LinkModel(settings, seed)
    assert sent(first, traffic, **how) == sent(second, traffic, **how)


def test_datagrams_are_lost_as_often_as_asked():
    model = LinkModel(LinkSettings(loss_percent=20), seed=3)
    lost = [model.send(100, n / 100, is_datagram=True) for n in range(20_000)].count(None)
    assert 0.19 < lost / 20_000 < 0.21


def test_a_loss_costs_a_stream_the_time_of_a_retransmission_and_of_what_is_behind_it():
    model = LinkModel(LinkSettings(delay_ms=50, loss_percent=30), seed=5)
    delays = [model.send(100, n * 20.0) - n * 20.0 for n in range(2000)]
    at_once = [delay for delay in delays if delay < 0.051]
    assert min(delays) == pytest.approx(0.05)
    assert 0.5 < len(at_once) / len(delays) < 0.7
    assert max(delays) > 0.7


def test_packets_queue_before_a_narrow_place_and_the_queue_drains():
    model = LinkModel(LinkSettings(rate_bytes_s=1000))
    assert [model.send(500, 0.0) for _ in range(4)] == pytest.approx([0.5, 1.0, 1.5, 2.0])
    assert model.send(500, 10.0) == pytest.approx(10.5)


def test_nothing_comes_through_a_loss_of_100_percent():
    model = LinkModel(LinkSettings(loss_percent=100))
    assert model.send(1, 0.0) is None
    assert model.send(1, 0.0, is_datagram=True) is None


@pytest.mark.parametrize(
    "field",
    [{"delay_ms": -1}, {"jitter_ms": math.nan}, {"loss_percent": 101}, {"rate_bytes_s": math.inf}],
)
def test_settings_that_no_link_has_are_refused_by_name(field):
    with pytest.raises(ValueError, match=next(iter(field))):
        LinkSettings(**field)


@given(SETTINGS, TRAFFIC, st.integers(0, 2**32), st.data())
def test_a_stall_loses_nothing_and_ends_in_a_burst(settings, traffic, seed, data):
    stalls_s = data.draw(st.floats(0, 5))
    resumes_s = stalls_s + data.draw(st.floats(0, 5))
    model = LinkModel(settings, seed)
    pipe, now_s, arrived, events = LinkPipe(model), 0.0, [], []
    for number, (size, pause_s) in enumerate(traffic):
        now_s += pause_s
        events.append((now_s, "send", (number, size)))
    events += [(stalls_s, "stall", None), (resumes_s, "resume", None)]
    for at_s, what, packet in sorted(events, key=lambda event: event[0]):
        arrived += [(each, at_s) for each in pipe.take(at_s - TINY_S)]
        if what == "send":
            pipe.send(packet[0], packet[1], at_s)
        elif what == "stall":
            model.stall()
        else:
            assert model.arrival_s(at_s) == math.inf
            model.resume(at_s)
    while pipe.waiting:
        at_s = model.arrival_s(pipe.waiting[0][0])
        assert math.isfinite(at_s) and at_s >= resumes_s
        arrived += [(each, at_s) for each in pipe.take(at_s)]
    assert [each for each, _ in arrived] == list(range(len(traffic)))


def test_a_blackout_loses_what_is_on_its_way_and_what_is_sent():
    model = LinkModel(LinkSettings(delay_ms=100))
    pipe = LinkPipe(model)
    pipe.send("before", 10, 0.0)
    model.black_out()
    pipe.send("during", 10, 0.05)
    model.restore()
    pipe.send("after", 10, 0.06)
    assert pipe.take(1.0) == ["after"]


@given(SETTINGS, TRAFFIC, st.integers(0, 2**32), st.integers(0, 60))
def test_a_blackout_of_datagrams_shifts_nothing_that_is_sent_later(settings, traffic, seed, cut):
    calm, dark = LinkModel(settings, seed), LinkModel(settings, seed)
    before, after = traffic[:cut], traffic[cut:]
    sent(calm, before, is_datagram=True)
    dark.black_out()
    assert {arrival for _, arrival in sent(dark, before, is_datagram=True)} <= {None}
    dark.restore()
    # Long after, so that no queue is left.
    later = [(size, pause_s + 1000.0) for size, pause_s in after]
    fresh = [arrival for _, arrival in sent(calm, later, is_datagram=True)]
    assert [arrival for _, arrival in sent(dark, later, is_datagram=True)] == fresh
