"""The code that is typed: how many wrong ones are looked at."""

import pytest

from host_sim.live.join_code import _WORDS, ALL_MAX, EACH_MAX, PERIOD_S, JoinCode, TooManyGuessesError


def is_refused(code: JoinCode, given: str, address: str) -> bool:
    try:
        return not code.opens(given, address)
    except TooManyGuessesError:
        return True


def test_after_some_wrong_codes_an_address_has_to_wait_and_others_need_not():
    now = [0.0]
    code = JoinCode(lambda: now[0])
    assert not any(code.opens("mint-", "a") for _ in range(EACH_MAX))

    with pytest.raises(TooManyGuessesError, match="wait a minute"):
        code.opens(code.text, "a")
    assert code.opens(code.text, "b")
    now[0] = PERIOD_S
    assert code.opens(code.text, "a")


def test_many_addresses_together_have_to_wait_too():
    code = JoinCode(lambda: 0.0)
    for i in range(ALL_MAX):
        code.opens("mint-", f"{i}")

    assert is_refused(code, code.text, "one that has not guessed")


def test_a_code_is_a_word_that_is_easy_to_type_and_four_digits():
    assert len(set(_WORDS)) == len(_WORDS) > 128
    assert all(word.isascii() and word.islower() and 4 <= len(word) <= 7 for word in _WORDS)
    assert all(code.opens(code.text.replace("-", "").upper(), "a") for code in (JoinCode() for _ in range(20)))
