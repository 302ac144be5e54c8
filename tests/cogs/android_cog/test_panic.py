from tests.cogs.android_cog.flight import Flight
from tests.support.reactor import until
from up.commands.panic_command import PanicCommand


async def test_the_phone_is_told_at_once_and_when_it_connects_during_panic(tmp_path):
    async with Flight(tmp_path) as f:
        phone = await f.phone()
        await until(lambda: f.provider.connected)
        publish = f.up.command_executor.execute_command
        publish(PanicCommand(True, 150, 91.5))
        (told,) = await until(lambda: phone.named("up.panic"))
        assert told["data"] == {"panic": True, "delay_ms": 150, "utilization": 91.5}
        late = await f.phone()
        assert (await until(lambda: late.named("up.panic")))[0]["data"]["panic"] is True
        publish(PanicCommand(False, 20))
        await until(lambda: len(late.named("up.panic")) == 2)
        assert late.named("up.panic")[1]["data"]["panic"] is False
        calm = await f.phone()
        await until(lambda: calm.named("up.telemetry.update"))
        assert calm.named("up.panic") == []
