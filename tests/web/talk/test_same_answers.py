"""The page's ELIZA and its facts give the answers of the command line: one table of conversations holds both."""

import json
import random
from itertools import chain
from pathlib import Path

from host_sim.api import RunConfig, resimulate, run
from host_sim.report.octet_page import speakers
from host_sim.report.replay_page import run_data
from host_sim.talk.conversation import NO_FACTS, SPEAKERS, Conversation, script_named, texts_of
from host_sim.talk.facts import RobotFacts
from host_sim.talk.log_index import index_log
from tests.runs.support import ROOT
from tests.web.sim.node import in_node

ANSWERS = """
const [speakers, run, told, table] = texts.map((text) => JSON.parse(text));
const data = await modules["core/run_data.ts"].RunData.from(run);
const { Conversation } = modules["talk/conversation.ts"];
const made = ([name, { script, texts }]) => [name, new Conversation(script, texts)];
const talks = Object.fromEntries(Object.entries(speakers).map(made));
return table.map(([who, tick, sentence]) => {
  const { mark, text, ticks, cells, food } = talks[who].answer(sentence, { data, robot: 0, tick, told });
  return [mark, text, [ticks, cells, food]];
});
"""
QUESTIONS = 4000
SIGNS = [
    "",
    ".",
    ",",
    "?",
    " but",
    ";",
    "-",
    " 12.5 s",
    " 3,75",
    " (",
    "\u2019s",
    " \U0001f600",
    " \x1b[2J",
    "\u00a0\u00df",
    " =",
]


def random_sentences(seed: int) -> list[tuple[str, str]]:
    """Who is asked, and what: words that the scripts know, in any order, and whole questions."""
    draw = random.Random(seed)
    files = chain.from_iterable(
        (ROOT / "tests/talk" / name).read_text().splitlines() for name in ("questions.txt", "fragen.txt")
    )
    asked = [line.partition(" ")[2] for line in files]
    words = {who: [*script_named(who).rules, *" ".join(asked).split()] for who in SPEAKERS}

    def sentence(who: str) -> str:
        if draw.random() < 0.5:
            return draw.choice(asked) + draw.choice(SIGNS)
        return " ".join(draw.choice(words[who]) + draw.choice(SIGNS) for _ in range(draw.randrange(8)))

    return [(who, sentence(who)) for who in draw.choices(SPEAKERS, k=QUESTIONS)]


def test_page_answers_thousands_of_sentences_as_the_command_line_does(tmp_path: Path):
    log = tmp_path / "run.log"
    run(RunConfig(seed=11, environments=2, bus="none", profile="forgetful", world="crowded", limit_s=120), log)
    trajectory = resimulate(log).trajectory
    index = index_log(log, 1)
    draw = random.Random(5)
    table = [(who, draw.randrange(trajectory.ticks), sentence) for who, sentence in random_sentences(7)]
    texts = {who: texts_of(who) for who in SPEAKERS}
    talks = {who: Conversation(script_named(who), NO_FACTS, texts[who]) for who in SPEAKERS}
    expected = []
    for who, tick, sentence in table:
        talks[who].ask_about(RobotFacts(trajectory, index, tick, texts[who]).by_name())
        expected.append(talks[who].answer(sentence))
    contents = (speakers(), run_data(trajectory, ""), {"starts": index.starts, "health": index.health}, table)
    files = [tmp_path / f"{i}.json" for i in range(len(contents))]
    for file, content in zip(files, contents, strict=True):
        file.write_text(json.dumps(content, default=vars))

    answers = in_node(tmp_path, "core/run_data.ts talk/conversation.ts", ANSWERS, *files)

    different = [it for it in zip(table, json.loads(json.dumps(expected)), answers, strict=True) if it[1] != it[2]]
    assert different == []
    assert sum(it.mark == "log" for it in expected) > QUESTIONS / 10
