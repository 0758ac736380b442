"""Headers, drivers, linker scripts and emulated chips against ST's SVD files, as Rust crates publish them."""

import re

import pytest

from tests.judges.chips import SETUP, TABLE, each_of, read_table, together
from tests.judges.svd_judge import JUDGES, bases, drivers, emulated, offsets, unexplained

TEXT = TABLE.read_text()
EXCEPTIONS = SETUP["exceptions"]


@pytest.fixture(scope="module")
def found():
    """All differences, explained or not."""
    return [difference for judge in JUDGES for difference in judge(read_table(TEXT))]


def test_chips_match_their_svd_files(found):
    assert unexplained(found, EXCEPTIONS) == []


@pytest.mark.parametrize(
    ("judge", "fact", "changed", "difference"),
    [
        (bases, "stm32g431 TIM3 0x40000400", "stm32g431 TIM3 0x40000c00", "stm32g431 base TIM3"),
        (offsets, "0x018 APB2ENR", "0x018 APB3ENR", "stm32f103 offset rcc_registers.apb2enr"),
        (drivers, "AFIOEN=0:0", "AFIOEN=1:1", "stm32f103 bits hal/stm32/stm32f103/pins.c AFIO_ON"),
        (emulated, "0x000 CRL 0x44444444", "0x000 CRL 0x44444440", "stm32f103 emulated GPIOA.CRL"),
        (emulated, "0x000 ISR 0x00000000 ADRDY", "0x004 ISR 0x00000000 ADRDY", "stm32g431 emulated ADC1.ISR"),
    ],
    ids=["base", "offset", "bits", "reset value", "emulated offset"],
)
def test_changed_svd_fact_is_named(judge, fact, changed, difference):
    assert TEXT.count(fact) == 1

    names = [name for name, _ in judge(read_table(TEXT.replace(fact, changed)))]

    assert difference in names


def test_table_has_one_row_for_registers_that_differ_by_a_number():
    blocks = [block.splitlines()[1:] for block in re.split(r"(?m)^(?=stm32|rp2040)", TEXT)[1:]]

    assert sum(len(block) for block in blocks) < sum(len([*each_of(block)]) for block in blocks) / 1.5
    assert all([*together(each_of(block))] == block for block in blocks)


def test_field_that_the_svd_files_lack_is_an_error():
    with pytest.raises(KeyError, match="AFIOEN"):
        list(drivers(read_table(TEXT.replace(" AFIOEN=0:0", ""))))


def test_difference_without_an_exception_is_named(found):
    without = {it: why for it, why in EXCEPTIONS.items() if it != "stm32g431 emulated RCC.CR"}

    assert unexplained(found, without) == ["stm32g431 emulated RCC.CR: 1280 after power-up, SVD {99}"]


def test_unneeded_exception_is_named(found):
    wrong = {**EXCEPTIONS, "stm32f103 base RCC": "it is right"}

    assert unexplained(found, wrong) == ["the exception stm32f103 base RCC is not needed"]
