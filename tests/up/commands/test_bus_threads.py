import threading

from tests.support.reactor import reactor, run_in_reactor, until
from tests.up.commands.samples import NumberCommand, make_bus


def test_a_publish_from_other_threads_reaches_the_reactor_thread_in_each_threads_order():
    heard = []

    async def scenario():
        bus = make_bus(call_from_thread=reactor.callFromThread)
        bus.adopt_thread()
        bus.register_command(
            NumberCommand, lambda command: heard.append((threading.get_ident(), command.number))
        )

        def work():
            for number in range(50):
                bus.execute_command(NumberCommand(number))

        threads = [threading.Thread(target=work) for _ in range(4)]
        for thread in threads:
            thread.start()
        await until(lambda: len(heard) == 200)
        for thread in threads:
            thread.join()
        return threading.get_ident()

    reactor_thread = run_in_reactor(scenario)
    assert {thread for thread, _ in heard} == {reactor_thread}
    assert sorted(number for _, number in heard) == sorted(list(range(50)) * 4)


def test_a_thread_that_publishes_during_a_dispatch_does_not_get_in_between():
    heard = []

    async def scenario():
        bus = make_bus(call_from_thread=reactor.callFromThread)
        bus.adopt_thread()

        def first(command):
            if command.number == 1:
                thread = threading.Thread(target=bus.execute_command, args=(NumberCommand(2),))
                thread.start()
                thread.join()
            heard.append(("first", command.number, threading.get_ident()))

        bus.register_command(NumberCommand, first)
        bus.register_command(NumberCommand, lambda c: heard.append(("second", c.number, None)))
        bus.execute_command(NumberCommand(1))
        await until(lambda: len(heard) == 4)

    run_in_reactor(scenario)
    assert [each[:2] for each in heard] == [
        ("first", 1), ("second", 1), ("first", 2), ("second", 2)
    ]  # fmt: skip
