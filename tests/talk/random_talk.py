"""Random scripts and sentences, answered by the engine and by a second reading of the language."""

import random
from collections.abc import Sequence

from host_sim.talk.conversation import NO_FACTS, SCRIPTS
from host_sim.talk.eliza import Eliza, Facts, Known
from host_sim.talk.script import read_script
from tests.talk.second_reading import SecondReading

NASTY = """
(HELLO THERE) START ()
(A = B 3 ((0 B 0) (FIRST 1 , 3, 1ST) (=C) (NEWKEY) (PRE (B C 3 1) (=D))) ((2) (TWO 1)))
(C 3 ((1 C 0) (ONE 1 3)) ((0 (*X Y) 0 (/T) 0) (X 2 THEN 4) (4 2 5)) (=D))
(D 1 ((B 0 C) (BETWEEN 2)) ((0 2 C) (TAIL 2)) ((C 0) (NEWKEY) (HEAD 2 2)))
(E DLIST(/T U)) (F = G DLIST (/ U) 7 ((0 (/U) 0) (=A) (U 2 ; a comment (with brackets
)) ((0) (NEWKEY))) (G = F (/T)) (H 7 (=F)) (X = Y) (Y = X 2 ((0 X 1) (XX 2)) (=H))
(BUT 9 ((0) (NEVER))) (NONE ((3) (THREE 1)) ((0 NONE 0) (NOT ME)) ((0) (NOTHING 1) (=A) (GO ON)))
(MY = YOUR 2 ((0 YOUR 1 0) (YOUR 3 4)) ((0) (PRE (1 YOUR Z) (=K)))) (K ((0 Z) (Z : 1)) ((0) (NEWKEY)))
(FACTS 5 ((0 FACTS 0) (I KNOW (* LEARNED) AND (* WHY 3)) ((* CELL 1) ALONE)))
(MEMORY MY (0 YOUR 0 = ONE 3) (0 YOUR 1 0 = TWO 3 4) (1 0 = THREE 2) (0 = FOUR 1))
"""
LINKED = ("(=KEY{})", "(PRE (1 KEY{} Z) (=KEY{}))")
SIGNS = ("", "", "", "", ",", ".", " but", "!", "\u2014", ";", "'s", "\u2019S")


def facts(draw_seed: int) -> Facts:
    """Facts that are known or not, by what is asked."""

    def known(name: str, words: Sequence[str]) -> Known | None:
        text = f"{name} {draw_seed} {' '.join(words)}"
        return None if sum(map(ord, text)) % 3 == 0 else Known(f"<{text}>", name)

    return {name: (lambda words, name=name: known(name, words)) for name in NO_FACTS}


def random_script(draw: random.Random) -> str:
    """A script in which links lead only to later keywords, so that it ends."""
    keys = [f"KEY{i}" for i in range(8)]
    words = [*keys, "P", "Q", "R"]

    def parts() -> list[str]:
        pool = ("0", "0", "0", "1", "2", "(*P Q KEY1)", "(P)", "(/T)", "(/ U T)", draw.choice(words))
        return [draw.choice(pool) for _ in range(draw.randrange(1, 5))]

    def answer(i: int, count: int) -> str:
        after = draw.randrange(i + 1, len(keys)) if i + 1 < len(keys) else None
        if after is not None and draw.random() < 0.3:
            return draw.choice(LINKED).replace("{}", str(after))
        pieces = (str(draw.randrange(1, count + 1)), draw.choice(words), "(* CELL 1)", "(* LEARNED)")
        return "(NEWKEY)" if draw.random() < 0.2 else f"({' '.join(draw.choices(pieces, k=3))})"

    def rule(i: int) -> str:
        ways = [parts() for _ in range(draw.randrange(1, 4))]
        said = " ".join(f"(({' '.join(it)}) {' '.join(answer(i, len(it)) for _ in range(3))})" for it in ways)
        put = f"= {draw.choice(words)}" if draw.random() < 0.3 else ""
        tags = draw.choice(("", "DLIST(/T)", "(/ U)", "DLIST (/T U)"))
        return f"({keys[i]} {put} {tags} {draw.randrange(4)} {said})"

    memory = " ".join(f"({' '.join(it)} = {draw.choice(words)} {len(it)})" for it in (parts() for _ in range(4)))
    return f"(HI) {' '.join(map(rule, range(8)))} (MEMORY KEY0 {memory}) (NONE ((0) (NONE 1) (NONE)))"


def differences(script: str, sentences: int, seed: int) -> list[tuple[str, str, str]]:
    """The sentences of a random conversation with different answers: the sentence, and both answers."""
    known = facts(seed)
    engine = Eliza(read_script(script, "a script", known), known)
    other = SecondReading(script, lambda name, words: (it := known[name](words)) and it.text)
    draw = random.Random(seed)
    heard = [*other.rules, *script.replace("(", " ").replace(")", " ").split(), "hm", "12", "\u00e4h"]
    found = []
    for _ in range(sentences):
        text = " ".join(draw.choice(heard).lower() + draw.choice(SIGNS) for _ in range(draw.randrange(10)))
        one, two = engine.answer(text).text, other.answer(text)
        if one != two:
            found.append((text, one, two))
    return found


def own(name: str) -> str:
    """The text of one of our own scripts."""
    return (SCRIPTS / f"{name}.script").read_text(encoding="utf-8")
