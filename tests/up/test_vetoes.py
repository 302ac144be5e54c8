from up.vetoes import Vetoes


def test_set_clear_and_who_is_told():
    vetoes, told = Vetoes(), []
    vetoes.on_changed = lambda: told.append(vetoes.own)
    vetoes.set("pids.yml", "corrupt")
    vetoes.set("pids.yml", "corrupt")
    vetoes.set("pids.yml", "worse")
    vetoes.clear("nothing")
    vetoes.clear("pids.yml")
    assert told == [{"pids.yml": "corrupt"}, {"pids.yml": "worse"}, {}]


def test_own_and_reported_are_apart():
    vetoes, told = Vetoes(), []
    vetoes.on_changed = lambda: told.append(1)
    vetoes.report("arduino", ("throttle", "receiver"))
    vetoes.set("app.broken", "SyntaxError")
    assert vetoes.own == {"app.broken": "SyntaxError"}
    assert vetoes.all == [
        "app.broken: SyntaxError", "arduino: throttle", "arduino: receiver"
    ]  # fmt: skip
    vetoes.report("arduino", ())
    assert vetoes.all == ["app.broken: SyntaxError"]
    assert told == [1]
    vetoes.own.clear()
    assert vetoes.own
