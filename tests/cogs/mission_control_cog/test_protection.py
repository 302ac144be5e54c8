"""Protected links between a real aircraft and a real ground link."""

from tests.cogs.mission_control_cog.hostile_relay import fly
from tests.support.reactor import until


def test_a_paired_pilot_arms_on_a_link_that_requires_protection(tmp_path):
    async def body(s):
        await s.ground.ready()
        assert s.ground.send(id_="a")
        (answer,) = await until(lambda: s.ground.answers("a"))
        assert (answer.name, s.armed) == ("up.ack", 1)
        assert s.ground.status.security == "end_to_end"
        assert s.ground.status.key_role == "pilot"
        assert not [line for line in s.relay.down if line.startswith(b"{")]

    fly(body, tmp_path)
