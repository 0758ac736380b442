"""ELIZA once more, from the description of the language alone: slow, plain, sharing no code with the engine."""

import re
from collections.abc import Callable, Iterator
from typing import Any

Ask = Callable[[str, list[str]], str | None]
STEPS = 100_000
HUSH = ("PLEASE CONTINUE", "HMMM", "GO ON , PLEASE", "I SEE")
OCTAL = {
    **dict(zip("0123456789", range(0o12), strict=True)),
    **dict(zip("ABCDEFGHI", range(0o21, 0o32), strict=True)),
    **dict(zip("JKLMNOPQR", range(0o41, 0o52), strict=True)),
    **dict(zip("STUVWXYZ", range(0o62, 0o72), strict=True)),
    "=": 0o13,
    "'": 0o14,
    "+": 0o20,
    ".": 0o33,
    ")": 0o34,
    "-": 0o40,
    "$": 0o53,
    "*": 0o54,
    " ": 0o60,
    "/": 0o61,
    ",": 0o73,
    "(": 0o74,
}


def read(text: str) -> list[Any]:
    """Nested lists of words."""
    tokens = re.findall(r"[()=]|[0-9]+|[^\s()=]+", re.sub(";.*", "", text).upper())

    def group(at: int) -> tuple[list[Any], int]:
        found: list[Any] = []
        while at < len(tokens) and tokens[at] != ")":
            if tokens[at] == "(":
                inner, at = group(at + 1)
                found.append(inner)
            else:
                found.append(tokens[at])
            at += 1
        return found, at

    return [it for it in group(0)[0] if isinstance(it, list) and it]


def hashed(word: str, bits: int) -> int:
    """SLIP's hash of the last chunk of six characters."""
    chunk = [word[i : i + 6] for i in range(0, len(word), 6)][-1] if word else ""
    digits = "".join(f"{OCTAL.get(sign, ord(sign) % 64):06b}" for sign in f"{chunk:<6}")
    squared = f"{int(digits[1:], 2) ** 2:072b}"
    return int(squared[: 72 - (35 - bits // 2)][-bits:], 2)


class SecondReading:
    """Answers sentences by a script."""

    def __init__(self, text: str, ask: Ask) -> None:
        greeting, *rules = read(text)
        self.greeting, self.ask = " ".join(greeting), ask
        self.limit, self.kept, self.turns = 1, [], {}
        self.rules, self.none, self.memory = {}, None, None
        for rule in rules:
            if rule[0] == "MEMORY":
                self.memory = rule[1], [(way[: way.index("=")], way[way.index("=") + 1 :]) for way in rule[2:]]
            elif rule[0] == "NONE":
                self.none = self.rule(rule[1:])
            else:
                self.rules[rule[0]] = self.rule(rule[1:])

    def rule(self, body: list[Any]) -> dict[str, Any]:
        rule: dict[str, Any] = {"put": None, "tags": [], "rank": 0, "ways": [], "link": None}
        if body[:1] == ["="]:
            rule["put"], body = body[1], body[2:]
        for it in body:
            if it == "DLIST":
                continue
            if isinstance(it, str):
                rule["rank"] = int(it)
            elif it[0] == "=":
                rule["link"] = it[1]
            elif isinstance(it[0], str) and it[0].startswith("/"):
                rule["tags"] = listed(it)
            else:
                rule["ways"].append((it[0], it[1:]))
        return rule

    def answer(self, sentence: str) -> str:
        self.limit = self.limit % 4 + 1
        words, keys = self.scan(spoken(sentence))
        if not keys and self.limit == 4 and self.kept:
            return self.kept.pop(0)
        for _ in range(STEPS):
            key = keys.pop(0) if keys else None
            rule = self.none if key is None else self.rules[key]
            if key is not None and key == self.memory[0]:
                self.keep(words)
            done = self.apply(rule, words, keys)
            if isinstance(done, str):
                return done
            words = done
        raise RecursionError(key)

    def scan(self, words: list[str]) -> tuple[list[str], list[str]]:
        keys: list[str] = []
        best, begin = -1, 0
        for place, word in enumerate(words):
            if word in {",", ".", "BUT"}:
                if keys:
                    return words[begin:place], keys
                begin = place + 1
                continue
            rule = self.rules.get(word)
            if rule is None:
                continue
            if rule["put"] is not None:
                words[place] = rule["put"]
            if rule["ways"] or rule["link"]:
                keys.insert(0 if rule["rank"] > best else len(keys), word)
                best = max(best, rule["rank"])
        return words[begin:], keys

    def keep(self, words: list[str]) -> None:
        parts, pieces = self.memory[1][hashed(words[-1] if words else "", 2)]
        for found in self.matches(parts, words):
            self.kept.append(" ".join(put(pieces, found)))
            return

    def apply(self, rule: dict[str, Any], words: list[str], keys: list[str]) -> str | list[str]:
        for parts, answers in rule["ways"]:
            found = next(self.matches(parts, words), None)
            if found is None:
                continue
            turn = self.turns.get(id(answers), 0)
            self.turns[id(answers)] = turn + 1
            said = answers[turn % len(answers)]
            if said == ["NEWKEY"]:
                return words
            if said[0] == "=":
                keys.insert(0, said[1])
                return words
            if said[0] == "PRE":
                keys.insert(0, said[2][1])
                return put(said[1], found)
            answered = self.say(said, found)
            return words if answered is None else answered
        if rule["link"]:
            keys.insert(0, rule["link"])
            return words
        return HUSH[self.limit - 1]

    def say(self, pieces: list[Any], found: list[list[str]]) -> str | None:
        said: list[str] = []
        for piece in pieces:
            if isinstance(piece, list):
                name, *part = listed(piece)
                known = self.ask(name, found[int(part[0]) - 1] if part else [])
                if known is None:
                    return None
                said.append(known)
            else:
                said += put([piece], found)
        return " ".join(said)

    def matches(self, parts: list[Any], words: list[str]) -> Iterator[list[list[str]]]:
        """All ways to split the words among the parts, the shortest for the first parts first."""
        if not parts:
            if not words:
                yield []
            return
        part, rest = parts[0], parts[1:]
        if isinstance(part, str) and part.isdigit():
            sizes = range(len(words) + 1) if part == "0" else [int(part)] if int(part) <= len(words) else []
        else:
            sizes = [1] if words and self.stands_for(part, words[0]) else []
        for size in sizes:
            for found in self.matches(rest, words[size:]):
                yield [words[:size], *found]

    def stands_for(self, part: Any, word: str) -> bool:
        if isinstance(part, str):
            return part == word
        if part[0].startswith("*"):
            return word in listed(part)
        if not part[0].startswith("/"):
            return False  # the program of 1966 knows no other list
        return bool(set(listed(part)) & set(self.rules.get(word, {"tags": []})["tags"]))


def listed(group: list[str]) -> list[str]:
    """The words after a list's sign."""
    return [it for it in (group[0][1:], *group[1:]) if it]


def put(pieces: list[str], found: list[list[str]]) -> list[str]:
    return [word for it in pieces for word in (found[int(it) - 1] if it.isdigit() else [it])]


def spoken(sentence: str) -> list[str]:
    """The words of a sentence; commas and full stops are words."""
    text = sentence.upper()
    for signs, to in (
        ("!?", "."),
        (":;\u2012\u2013\u2014\u2015", ","),
        ('"`\u201c\u201d\u201e', " "),
        ("\u2018\u2019", "'"),
    ):
        for sign in signs:
            text = text.replace(sign, to)
    return text.replace(",", " , ").replace(".", " . ").split()
