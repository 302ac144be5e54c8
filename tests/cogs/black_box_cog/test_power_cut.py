"""Files after a power cut: every synced byte, and any part of the rest."""

import pytest
from black_box_cog.recorder import BUSY_S

from tests.cogs.black_box_cog.flights import Flight, TestedDisk
from up.flight_log.mcap_format import FlightLogError
from up_flightlog.read.flight_log import FlightLog

SECOND_S = 1.0
LATE_S = BUSY_S + 0.03
AT_A_ROUND = 2


class SyncedDisk(TestedDisk):
    """Notes how long the file was whenever it was forced onto the disk."""

    def __init__(self, clock):
        super().__init__()
        self.clock = clock
        self.written = 0
        self.synced = []

    def write(self, descriptor, data):
        count = super().write(descriptor, data)
        self.written += count
        return count

    def sync(self, descriptor):
        super().sync(descriptor)
        self.synced.append((self.clock(), self.written))


@pytest.fixture
def flown(tmp_path):
    """A flight of a few seconds: its file before its end, the times of its syncs, its messages."""
    flight = Flight(tmp_path, SyncedDisk(lambda: flight.now_s))
    said = []
    for _ in range(15):
        for _ in range(AT_A_ROUND):
            said.append((flight.now_s, len(said)))
            flight.say(len(said) - 1)
        flight.recorder.work()
        flight.pass_s(LATE_S)
    (path,) = flight.files
    return path, path.read_bytes(), flight.disk.synced, said, flight.now_s


def test_no_moment_is_more_than_a_second_after_a_sync(flown):
    _, _, synced, _, end_s = flown
    moments = [at_s for at_s, _ in synced]
    later = [*moments[1:], end_s]
    assert len(moments) >= 3
    assert all(b - a <= SECOND_S + 1e-6 for a, b in zip(moments, later, strict=True))


def test_cut_at_every_byte_a_second_is_lost_at_most(flown, tmp_path):
    _, data, synced, said, _ = flown
    cut = tmp_path / "0001-20260814T093000Z-kite.mcap"
    for (at_s, size), (_, following) in zip(synced, [*synced[1:], (0, len(data))], strict=True):
        on_disk = {number for time_s, number in said if time_s <= at_s}
        for length in range(size, following + 1):
            cut.write_bytes(data[:length])
            found = FlightLog.read([cut]).series("up.orientation.update", "roll")[1]
            assert found == list(range(len(found)))
            assert on_disk <= {int(number) for number in found}, (at_s, length)


def test_what_the_disk_had_room_for_but_not_written_is_read_as_nothing(flown, tmp_path):
    """A journal may keep the new length of a file without the data written there."""
    path, data, synced, said, _ = flown
    at_s, size = synced[-2]
    path.write_bytes(data[:size] + bytes(len(data) - size))
    found = FlightLog.read([path]).series("up.orientation.update", "roll")[1]
    assert [int(number) for number in found] == [n for time_s, n in said if time_s <= at_s]


def test_cut_before_the_first_sync_it_is_read_or_an_error(flown):
    path, data, synced, _, _ = flown
    for length in range(0, synced[0][1], 10):
        path.write_bytes(data[:length])
        try:
            found = FlightLog.read([path])
        except FlightLogError as error:
            assert path.name in str(error)
        else:
            assert not found.is_complete
