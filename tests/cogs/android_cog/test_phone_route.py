from android_cog.phone_route import PENDING_LIMIT

from tests.cogs.android_cog.flight import Asker, Flight
from tests.cogs.peers import UdpPeer
from tests.support.reactor import reactor, until


def ack(id_):
    return {"name": "up.ack", "data": {"id": id_}}


def spoken(phone):
    return phone.named("android.speak")


async def connected(flight):
    phone = await flight.phone()
    await until(lambda: flight.provider.connected)
    return phone


async def test_the_phones_answer_comes_back_to_the_asker(tmp_path):
    async with Flight(tmp_path) as f:
        phone = await connected(f)
        asker = Asker(f.up, "mission_control")
        asker.speak("s-1", "left")
        (asked,) = await until(lambda: spoken(phone))
        assert (asked["id"], asked["data"]) == ("s-1", {"text": "left"})
        assert asker.answers == []
        phone.say(ack("s-1"))
        (answer,) = await until(lambda: asker.answers)
        assert (answer.name, answer.data) == ("up.ack", {"id": "s-1"})
        asker.speak("s-2")
        await until(lambda: len(spoken(phone)) == 2)
        nack = {"id": "s-2", "code": "refused", "reason": "no voice is installed"}
        phone.say({"name": "up.nack", "data": nack})
        await until(lambda: len(asker.answers) == 2)
        assert (asker.answers[1].name, asker.answers[1].data) == ("up.nack", nack)


async def test_one_id_of_two_askers_stays_two_commands(tmp_path):
    async with Flight(tmp_path) as f:
        phone = await connected(f)
        one, two = Asker(f.up, "mission_control"), Asker(f.up, "ground")
        one.speak("7", "one")
        two.speak("7", "two")
        first, second = await until(lambda: len(spoken(phone)) == 2 and spoken(phone))
        assert first["id"] == "7" != second["id"]
        phone.say(ack(second["id"]))
        await until(lambda: two.answers)
        assert two.answers[0].data == {"id": "7"}
        assert one.answers == []
        # The phone remembers ids: a later asker's must not look like a repetition.
        phone.say(ack("7"))
        await until(lambda: one.answers)
        three = Asker(f.up, "other")
        three.speak("7", "three")
        await until(lambda: len(spoken(phone)) == 3)
        assert spoken(phone)[2]["id"] not in ("7", second["id"])


async def test_only_the_phones_own_answer_counts(tmp_path):
    async with Flight(tmp_path) as f:
        phone = await connected(f)
        asker, stranger = Asker(f.up, "mission_control"), Asker(f.up, "ground")
        asker.speak("x")
        await until(lambda: spoken(phone))
        stranger.ask(b'{"name": "up.ack", "data": {"id": "x"}}')
        asker.ask(b'{"name": "up.ack", "data": {"id": "x"}}')
        other = UdpPeer(reactor)
        f.peers.append(other)
        other.say(ack("x"), f.up.ports["general"])
        counters = lambda: f.telemetry["counters"]["android"]  # noqa: E731
        await until(lambda: counters()["foreign"] == 1)
        assert asker.answers == []
        phone.say(ack("x"))
        await until(lambda: asker.answers)


async def test_an_absent_phone_is_unavailable(tmp_path):
    async with Flight(tmp_path) as f:
        asker = Asker(f.up, "mission_control")
        asker.speak("a")
        (answer,) = asker.answers
        assert (answer.name, answer.data["code"]) == ("up.nack", "unavailable")
        assert "not connected" in answer.data["reason"]


async def test_a_phone_that_goes_away_answers_nothing_any_more(tmp_path):
    async with Flight(tmp_path) as f:
        phone = await connected(f)
        asker = Asker(f.up, "mission_control")
        asker.speak("a")
        await until(lambda: spoken(phone))
        await phone.close()
        (answer,) = await until(lambda: asker.answers)
        assert answer.data["code"] == "unavailable"
        late = await connected(f)
        late.say(ack("a"))
        await until(lambda: f.telemetry["counters"]["android"]["unasked_answers"] == 1)
        assert len(asker.answers) == 1


async def test_what_waits_for_the_phone_is_bounded(tmp_path):
    async with Flight(tmp_path) as f:
        await connected(f)
        asker = Asker(f.up, "mission_control")
        for number in range(PENDING_LIMIT + 1):
            asker.speak(str(number))
        (answer,) = asker.answers
        assert (answer.data["id"], answer.data["code"]) == (str(PENDING_LIMIT), "unavailable")
        await until(lambda: len(asker.answers) == PENDING_LIMIT + 1)
