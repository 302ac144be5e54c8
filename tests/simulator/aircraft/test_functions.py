import xml.etree.ElementTree as ElementTree

import pytest

from up_simulator.aircraft.functions import FunctionError, compile_sum

TABLE = "<table><independentVar>at</independentVar><tableData>-1 5 1 7 2 4</tableData></table>"


def value_of(*texts, **values):
    return compile_sum([ElementTree.fromstring(each) for each in texts], values)()


@pytest.mark.parametrize(
    ("at", "found"), [(-9.0, 5.0), (-1.0, 5.0), (0.0, 6.0), (1.0, 7.0), (1.5, 5.5), (9.0, 4.0)]
)
def test_a_table_is_linear_between_its_rows_and_constant_beyond_them(at, found):
    assert value_of(TABLE, at=at) == pytest.approx(found)


def test_operators_nest_and_functions_add_up():
    two, a = "<value>2</value>", "<property>a</property>"
    product = f"<product>{two}<difference>{a}{two}</difference></product>"
    power = f"<pow><sum>{two}{a}{a}</sum>{two}</pow>"
    turned = "<cos><value>0</value></cos>"
    assert value_of(product, power, turned, a=5.0) == 6.0 + 144.0 + 1.0
    assert value_of() == 0.0
    assert value_of("<pow><value>-0.5</value><value>2</value></pow>") == 0.25


@pytest.mark.parametrize(
    "text",
    [
        "<property>b</property>",
        "<value>__import__('os')</value>",
        "<value>nan</value>",
        "<pow><value>2</value></pow>",
        "<product/>",
        "<quotient><value>2</value><value>2</value></quotient>",
        TABLE.replace("1 7", "-2 7"),
        TABLE.replace(" 4", ""),
    ],
)
def test_what_is_not_supported_is_rejected(text):
    with pytest.raises(FunctionError):
        value_of(text, a=0.0, at=0.0)
