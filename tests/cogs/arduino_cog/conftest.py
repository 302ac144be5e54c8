from itertools import count

import pytest

from tests.cogs.arduino_cog.board import BoardRig


@pytest.fixture
def make_rig(tmp_path):
    made = []
    numbers = count()

    def make(*args, **more):
        made.append(BoardRig(tmp_path / str(next(numbers)), *args, **more))
        return made[-1]

    yield make
    for each in made:
        each.stop()


@pytest.fixture
def rig(make_rig):
    return make_rig()
