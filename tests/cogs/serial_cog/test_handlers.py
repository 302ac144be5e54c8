import pytest
from serial_cog.handlers import HandlerTable, type_byte


def test_a_type_may_be_a_letter_a_byte_or_a_number():
    assert type_byte("o") == type_byte(b"o") == type_byte(0x6F) == 0x6F


@pytest.mark.parametrize("wrong", ["", "ab", b"", 256, -1, "\u0105"])
def test_anything_else_is_no_type(wrong):
    with pytest.raises(ValueError):
        type_byte(wrong)


def test_the_sizes_come_from_the_handlers():
    table = HandlerTable()
    assert table.add("o", print, 12)
    assert not table.add(b"o", repr, 12)
    assert table.sizes == {0x6F: 12}


def test_handlers_of_one_type_must_agree_on_its_size():
    table = HandlerTable()
    table.add("o", print, 12)
    with pytest.raises(ValueError):
        table.add("o", repr, 26)
    with pytest.raises(ValueError):
        table.add("x", repr, 97)


def test_a_type_may_have_other_sizes_from_its_least_on():
    table = HandlerTable()
    table.add("x", print, 22, 20)
    assert (table.sizes, table.least) == ({0x78: 22}, {0x78: 20})
    table.remove("x")
    assert table.least == {}


def test_removing_takes_whatever_form_adding_takes():
    table = HandlerTable()
    table.add("o", print, 12)
    table.add("o", repr, 12)
    assert not table.remove(0x6F, print)
    assert table.by_type[0x6F] == (repr,)
    assert table.remove(b"o")
    assert table.sizes == {}
    with pytest.raises(KeyError):
        table.remove("o")
