"""The keys of the paired devices follow their file; each revocation of test_protection, too."""

import pytest

from tests.support.reactor import reactor, until
from up.config.keys_file import KEYS, add_key, revoke_key
from up.key_ring import KeyRing


@pytest.mark.parametrize("end", ["revoked", "removed"])
async def test_an_instance_follows_the_runners_file_through_its_link(tmp_path, end):
    shared, instance = tmp_path / "runner", tmp_path / "instance"
    for folder in (shared, instance):
        folder.mkdir()
    add_key(shared, "tablet", "pilot", aircraft="glider-1")
    (instance / KEYS.filename).symlink_to(shared / KEYS.filename)
    found = []
    ring = KeyRing(reactor, instance, found.append, "glider-1")
    ring.start()
    assert [each.name for each in found[0].values()] == ["tablet"]
    if end == "revoked":
        revoke_key(shared, "tablet")
    else:
        (shared / KEYS.filename).unlink()
    await until(lambda: len(found) == 2)
    assert ring.is_empty
    ring.stop()


def test_an_aircraft_leaves_out_the_keys_for_others(tmp_path):
    for name, aircraft in (("a", "glider-1"), ("b", "glider-2"), ("c", "")):
        add_key(tmp_path, name, "pilot", aircraft=aircraft)
    for aircraft, names in ((None, "abc"), ("glider-1", "ac"), ("other", "c")):
        found = []
        ring = KeyRing(reactor, tmp_path, found.append, aircraft)
        ring.start()
        ring.stop()
        assert sorted(each.name for each in found[0].values()) == list(names)
