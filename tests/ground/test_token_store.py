import stat

from up_ground.settings import Settings
from up_ground.token_store import TokenStore, state_folder

TOKEN = "0123456789abcdef" * 2


def test_a_token_outlives_the_program_and_only_its_user_reads_it(tmp_path):
    first = TokenStore(tmp_path / "state", Settings())
    assert first.hold()
    assert first.load() is None
    first.save(TOKEN)
    assert stat.S_IMODE(first.path.stat().st_mode) == 0o600
    assert stat.S_IMODE(first.path.parent.stat().st_mode) == 0o700
    first.close()
    second = TokenStore(tmp_path / "state", Settings())
    assert second.hold()
    assert second.load() == TOKEN
    second.forget()
    assert second.load() is None
    second.close()


def test_a_second_program_gets_no_token_while_the_first_runs(tmp_path):
    first, second = TokenStore(tmp_path, Settings()), TokenStore(tmp_path, Settings())
    assert first.hold()
    first.save(TOKEN)
    assert not second.hold()
    assert second.load() is None
    second.save("f" * 32)
    second.forget()
    assert first.load() == TOKEN
    first.close()
    assert second.hold()
    second.close()


def test_aircraft_and_proxies_do_not_share_a_token(tmp_path):
    settings = [Settings(), Settings(port=1), Settings(host="::1"), Settings(aircraft="glider")]
    assert len({TokenStore(tmp_path, each).path for each in settings}) == 4


def test_a_damaged_token_is_none(tmp_path):
    store = TokenStore(tmp_path, Settings())
    store.hold()
    for damaged in (b"", b"\xff\xfe", b"0123\n", b"x" * 32):
        store.path.write_bytes(damaged)
        assert store.load() is None
    store.close()


def test_where_nothing_can_be_kept_nothing_is(tmp_path):
    (tmp_path / "file").write_text("in the way")
    store = TokenStore(tmp_path / "file" / "state", Settings())
    assert not store.hold()
    store.save(TOKEN)
    assert store.load() is None


def test_a_host_never_leads_out_of_the_folder(tmp_path):
    path = TokenStore(tmp_path, Settings(host="../../etc/passwd")).path
    assert path.parent == tmp_path


def test_the_folder_follows_the_environment(tmp_path):
    assert state_folder({"XDG_STATE_HOME": str(tmp_path)}) == tmp_path / "up-ground"
    assert state_folder({"XDG_STATE_HOME": "relative"}).is_absolute()
