"""Answers what a page asks the robots of a live run, or ELIZA."""

from dataclasses import dataclass, field, replace
from typing import Any

from host_sim.live.paced_run import PacedRun
from host_sim.live.page_commands import Question
from host_sim.recording.phrases import news_of
from host_sim.recording.trajectory import at
from host_sim.talk.conversation import NO_FACTS, Conversation, script_named, texts_of
from host_sim.talk.eliza import Facts
from host_sim.talk.facts import RobotFacts
from host_sim.talk.log_index import LogIndex

_PLACES_MAX = 100


@dataclass
class PageTalk:
    """The conversations of one page."""

    live: PacedRun
    _talks: dict[str, Conversation] = field(default_factory=dict)

    def answer(self, question: Question) -> dict[str, Any]:
        """An answer, as the page's TalkBox takes it.

        Returns:
            `who` and `sentence`, as they were asked; `said`: mark, text, ticks, cells and food, as in
            `host_sim.talk.conversation`; and `places`, where the robot was in those ticks of this environment, mm.
        """
        talk = self._talks.get(question.who)
        if talk is None:
            talk = self._talks[question.who] = Conversation(
                script_named(question.who), NO_FACTS, texts_of(question.who)
            )
        nodes = self.live.simulation.nodes
        robot = nodes.index(question.node) if question.node in nodes else 0
        run = self.live.recorder.trajectory
        talk.ask_about(self._facts(question.who, robot) if run.ticks else NO_FACTS)
        said = talk.answer(question.text)
        first = at(run.scenes, run.ticks - 1)["first_tick"] if run.ticks else 0
        ticks = [tick for tick in said.rests.ticks if tick >= max(first, run.first_tick)][-_PLACES_MAX:]
        places = [[round(part, 1) for part in run.tracks[robot].pose(tick)[:2]] for tick in ticks]
        answer = {"mark": said.mark, "text": said.text, **said.rests._asdict()}
        return {"who": question.who, "sentence": question.text, "said": answer, "places": places}

    def _facts(self, who: str, robot: int) -> Facts:
        run, simulation = self.live.recorder.trajectory, self.live.simulation
        run = replace(run, news=news_of(simulation.record))
        return RobotFacts(run, LogIndex(), run.ticks - 1, texts_of(who), robot).by_name()
