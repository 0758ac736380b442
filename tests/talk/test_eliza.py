"""The language and the program of ELIZA, rule by rule."""

import pytest

from host_sim.base.errors import OctetError, UsageError
from host_sim.talk.eliza import Eliza, Known, slip_hash, words_of
from host_sim.talk.script import read_script

ENDS = """
(MEMORY MY (0 YOUR 0 = FIRST 3) (0 YOUR 0 = SECOND 3) (0 YOUR 0 = THIRD 3) (0 YOUR 0 = FOURTH 3))
(NONE ((0) (NONE 1) (NONE AGAIN)))
"""
MY = "(MY = YOUR 2 ((0 YOUR 0) (YOUR 3)))"


def eliza(rules: str, **facts: Known | None) -> Eliza:
    known = {name: (lambda _, it=it: it) for name, it in facts.items()}
    return Eliza(read_script(f"(HELLO)\nSTART\n{rules}\n{MY}\n{ENDS}", "a script", known), known)


def said(rules: str, *sentences: str) -> list[str]:
    talk = eliza(rules)
    return [talk.answer(sentence).text for sentence in sentences]


def test_greeting_is_the_first_list_of_a_script():
    assert read_script(f"(GOOD DAY .)\n{MY}{ENDS}", "a script").greeting == "GOOD DAY ."


@pytest.mark.parametrize(
    ("sentence", "words"),
    [
        ("Yes! Really?", ["YES", ".", "REALLY", "."]),
        ("a: b; c \u2014 d", ["A", ",", "B", ",", "C", ",", "D"]),
        ('say "hi" `you`', ["SAY", "HI", "YOU"]),
        ("don\u2019t", ["DON'T"]),
        ("tea-time,now", ["TEA-TIME", ",", "NOW"]),
        ("", []),
    ],
)
def test_punctuation_becomes_commas_and_full_stops(sentence, words):
    assert words_of(sentence) == words


def test_delimiter_keeps_only_the_part_with_the_first_keyword():
    rule = "(KEY ((0 KEY 0) (A 1 B 3)))"

    assert said(rule, "x, y key z, w") == ["A Y B Z"]
    assert said(rule, "x but y key but z") == ["A Y B"]


def test_keyword_of_highest_rank_wins_and_of_equal_ranks_the_first():
    rules = "(ONE 1 ((0) (ONE))) (THREE 3 ((0) (NEWKEY))) (TWO 2 ((0) (NEWKEY))) (FIVE 5 ((0) (NEWKEY)))"

    assert said(rules, "one three two five") == ["ONE"]
    assert said("(A 1 ((0) (A))) (B 1 ((0) (B)))", "b a") == ["B"]


def test_ranks_1_3_2_5_are_tried_as_5_3_1_2():
    rules = " ".join(
        f"(K{rank} {rank} ((0 {name} 0) ({name})) ((0) (NEWKEY)))"
        for rank, name in ((1, "P"), (3, "Q"), (2, "R"), (5, "S"))
    )

    assert said(rules, "k1 k3 k2 k5 r p") == ["P"]


def test_words_are_substituted_simultaneously_and_only_once():
    assert said("(I = YOU ((0) (1))) (YOU = I)", "i and you") == ["YOU AND I"]


def test_zero_in_a_decomposition_takes_as_few_words_as_possible():
    assert said("(A ((0 X 0 Y 0) (1 / 3 / 5)))", "a x b x y c y") == ["A / B X / C Y"]
    assert said("(A ((0 X 0 Y) (1 / 3)))", "a x b y c y") == ["A / B Y C"]


def test_numbers_lists_and_tags_stand_for_words():
    family = "(MOM DLIST(/FAMILY)) (DAD DLIST(/ NOUN FAMILY))"

    assert said("(A ((A 2 B) (2)))", "a x y b") == ["X Y"]
    assert said("(A ((0 (*X Y) 0) (2)))", "a b y c") == ["Y"]
    assert said(f"{family} (A ((0 (/FAMILY) 0) (GOT 2)))", "a b dad") == ["GOT DAD"]


def test_list_without_a_sign_matches_no_word():
    assert said("(A ((0 (A) 0) (LISTED)) ((0) (NOT LISTED)))", "a") == ["NOT LISTED"]


def test_leading_digits_of_a_word_are_a_part_number():
    assert said("(A ((0 A 0) (3, AND 1ST)))", "x a b c") == ["B C , AND X ST"]


def test_reassemblies_take_turns_including_those_that_lead_on():
    rules = "(A ((0) (ONE) (NEWKEY) (=B) (PRE (X 1) (=B)) (LAST))) (B ((0) (B 1)))"

    assert said(rules, *["a"] * 6) == ["ONE", "NONE A", "B A", "B X A", "LAST", "ONE"]


def test_unmatched_sentence_takes_the_link_or_gets_a_built_in_answer():
    assert said("(A ((X) (Y)) (=B)) (B ((0) (B)))", "a") == ["B"]
    assert said("(A ((X) (Y)))", *"aaaaa") == ["HMMM", "GO ON , PLEASE", "I SEE", "PLEASE CONTINUE", "HMMM"]


def test_fourth_sentence_recalls_a_memory_if_it_has_no_keyword():
    assert said("", "my dog here", "x", "y", "z") == ["YOUR DOG HERE", "NONE X", "FOURTH DOG HERE", "NONE AGAIN"]


def test_none_and_memory_are_no_keywords():
    assert said("", "none", "memory", "x") == ["NONE NONE", "NONE AGAIN", "NONE X"]


def test_hash_equals_that_of_slip():
    assert (slip_hash("ALWAYS", 7), slip_hash("HERE", 2)) == (14, 3)
    assert slip_hash("INVENTIONS", 15) == slip_hash("IONS", 15)
    assert 0 <= slip_hash("\U0001f600", 2) < 4


def test_endless_script_is_stopped_and_its_keyword_reported():
    with pytest.raises(OctetError, match="loops for ever at A: stopped after 100000 steps"):
        eliza("(A ((0) (=A)))").answer("a")
    with pytest.raises(OctetError, match="loops for ever at A"):
        eliza("(A ((0) (PRE (1 1) (=A))))").answer("a")


def test_known_fact_comes_with_its_evidence_and_unknown_one_leads_on():
    rules = "(A 2 ((0) (I KNOW (* IT)))) (B 1 ((0) (ONLY WORDS)))"

    assert eliza(rules, IT=Known("THIS", 7)).answer("a b") == ("I KNOW THIS", (7,))
    assert eliza(rules, IT=None).answer("a b") == ("ONLY WORDS", ())
    assert eliza(rules, IT=None).answer("a") == ("NONE A", ())


def test_fact_gets_the_words_of_its_part():
    asked: list[list[str]] = []
    facts = {"IT": lambda words: asked.append([*words])}
    Eliza(read_script(f"(HI)(A ((0 A 0) ((* IT 3)))) {MY} {ENDS}", "x", facts), facts).answer("x a y z")

    assert asked == [["Y", "Z"]]


ANYTHING = ["\x00\x1b[2J", "\U0001f600 my \U0001f600", "my " + "x " * 200_000, "(my) = ;", "\ud800"]


@pytest.mark.parametrize("sentence", ANYTHING, ids=["control", "emoji", "long", "brackets", "surrogate"])
def test_any_text_is_answered(sentence):
    assert isinstance(eliza("").answer(sentence).text, str)


@pytest.mark.parametrize(
    ("script", "error"),
    [
        ("", "x: a script begins with its greeting"),
        ("(A", "x: the list that begins in line 1 is not closed"),
        ("(A)\n)", "x, line 2: ) stands outside the lists"),
        ("(A)\nB", "x, line 2: B stands outside the lists"),
        ("(A)\n(B ((0) (C)))\n(B ((0) (C)))", "x, line 3: B has a rule already, in line 2"),
        ("(A)\n(B)", "x, line 2: the rule of B is empty"),
        ("(A)\n(B =)", "x, line 2: a word is expected"),
        ("(A)\n(B X)", "x, line 2: X is neither a rank nor a list"),
        ("(A)\n(B ((0)))", "x, line 2: a transformation is a decomposition"),
        ("(A)\n(B (() (X)))", "x, line 2: a decomposition is empty"),
        ("(A)\n(B ((0) ()))", "x, line 2: a reassembly is empty"),
        ("(A)\n(B ((0)\n(X 2)))", "x, line 3: there is no part 2: the decomposition has 1"),
        ("(A)\n(B ((0) (PRE (1))))", "x, line 2: PRE is written"),
        ("(A)\n(B ((0) ((* NAME))))", "x, line 2: there is no fact NAME here; there are: none"),
        ("(A)\n(MEMORY B (0 = X))", "x, line 2: MEMORY has a keyword and exactly 4"),
        ("(A)\n(NONE ((X) (Y)))", "x, line 2: NONE needs a transformation"),
        (f"(A)\n{ENDS}", "MEMORY's keyword MY has no rule"),
        (f"(A) {MY}\n(MEMORY MY (0=1)(0=1)(0=1)(0=1))", "x, line 2: the script has no NONE"),
        (f"(A) {MY}\n(NONE ((0) (X)))", "x, line 2: the script has no MEMORY"),
        (f"(A) {MY} {ENDS} (B ((0) (=C)))", "the link leads to C, which has no transformation"),
    ],
)
def test_mistake_in_a_script_is_reported_with_its_line(script, error):
    with pytest.raises(UsageError) as raised:
        read_script(script, "x")

    assert error in str(raised.value)


def test_script_may_have_comments_empty_lists_and_lower_case():
    assert said("; a comment (\n() (a ((0) (b))) ; and (another", "a") == ["B"]
