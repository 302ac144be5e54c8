"""Work beside the reactor: in its order, whatever the threads do."""

import threading

from tests.support.reactor import reactor
from up.system.disk_thread import DiskThread


async def test_work_is_done_in_its_order_and_a_fault_ends_one_piece_only():
    disk, done, hold = DiskThread(reactor), [], threading.Event()
    first = disk.run(hold.wait)
    more = [disk.run(lambda each=each: done.append(each)) for each in range(50)]
    faulty = disk.run(lambda: 1 / 0).addErrback(lambda failure: failure.type)
    last = disk.run(lambda: tuple(done))
    hold.set()
    disk.wait()
    assert done == list(range(50)), "everything is done"
    assert await faulty is ZeroDivisionError
    assert await last == tuple(range(50))
    for each in (first, *more):
        await each
    assert await disk.run(lambda: "again") == "again"
