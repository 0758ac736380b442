"""A study's TOML: what it means, and what is said of a mistake."""

import re
from pathlib import Path

import pytest

from host_sim.base.errors import UsageError
from host_sim.lab.study import folder
from host_sim.lab.study.plan import read_plan

ROOT = Path(__file__).resolve().parents[3]


@pytest.fixture
def plan(tmp_path):
    def read(text: str):
        (tmp_path / "a.toml").write_text(text)
        return read_plan(tmp_path / "a.toml")

    return read


def test_conditions_are_all_combinations_with_the_same_seeds(plan):
    found = plan(
        'profiles = ["article", "fixed"]\nchanges = ["none", "swap-motors@env2"]\nseeds = 2\nfirst_seed = 7\n'
        "[settings.plain]\n[settings.careful]\nfilter = 1\n"
    )

    names = [it.condition for it in found.conditions]
    assert len(names) == 8
    assert names[:3] == ["article plain none", "article plain swap-motors@env2", "article careful none"]
    assert [it.key for it in found.trials()] == [(name, seed) for seed in (7, 8) for name in names]
    assert found.conditions[2].config.settings == {"filter": 1}


def test_study_with_own_worlds_is_a_fleet(plan):
    assert not plan('profiles = ["article"]\nrobots = [4]').is_fleet
    assert plan('profiles = ["article"]\nrobots = [4]\nown_worlds = true').is_fleet


def test_seeds_of_all_robots_of_a_fleet_must_be_held_out(plan):
    text = 'profiles = ["article"]\nseeds = 10\nchosen_on = [20, 30]\nrobots = [1, 4]\nown_worlds = {}'
    assert plan(text.format("false")).chosen_on == (20, 30)

    with pytest.raises(UsageError, match=re.escape("seeds 1..40 are not held out")):
        plan(text.format("true"))


def test_too_deeply_nested_brackets_are_refused(plan):
    with pytest.raises(UsageError, match="brackets are nested too deeply"):
        plan("profiles = " + "[" * 5000)


def test_condition_is_named_by_what_varies(plan):
    several = plan('profiles = ["article"]\nrobots = [1, 4]')
    assert [it.condition for it in several.conditions] == ["1 robots", "4 robots"]
    assert [it.config.world for it in plan('profiles = ["article"]\nworlds = ["small", "posts"]').conditions] == [
        "small",
        "posts",
    ]
    bodies = plan('profiles = ["article"]\nbodies = ["ideal", "kit"]').conditions
    assert [(it.condition, it.config.body) for it in bodies] == [("ideal", "ideal"), ("kit", "kit")]
    assert [it.condition for it in plan('profiles = ["article"]').conditions] == ["article"]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("seeds = 3", ":1: profiles is missing"),
        ('profiles = ["article"\nseeds = 3', "a.toml:2: this is not TOML"),
        ('profiles = ["article"]\nbodies = ["nobody"]', ":2: bodies: "),
        ('seeds = 3\nprofiles = ["artcle"]', ":2: profiles: there is no 'artcle'; did you mean article?"),
        ('profiles = ["article"]\nown_worlds = 1', ":2: own_worlds is true or false, not 1"),
        ('profiles = ["article"]\nsedes = 3', ":2: unknown key 'sedes'; did you mean seeds?"),
        ('profiles = ["article"]\nseeds = 0', ":2: seeds is a whole number from 1 to 100000, not 0"),
        ('profiles = ["article"]\nseeds = true', ":2: seeds is a whole number"),
        ('profiles = "article"', ':1: profiles is a list of words, such as profiles = ["article"]'),
        ('profiles = ["article", "article"]', ":1: profiles has the same value twice"),
        (
            'profiles = ["article"]\nchanges = ["swap-motor@env1"]',
            ":2: changes: 'swap-motor@env1' is not a change: did you",
        ),
        ('profiles = ["article"]\nworlds = ["smal"]', ":2: worlds: there is no world 'smal': did you mean small?"),
        ('profiles = ["article"]\nrobots = [0]', ":2: robots is a whole number from 1 to 31, not 0"),
        ('profiles = ["article"]\nrobots = []', ":2: robots is a whole number"),
        ('profiles = ["article"]\ntitle = 3', ":2: title is a line of text, not 3"),
        ('profiles = ["article"]\nlimit_s = nan', ":2: limit_s is a number from 0.02 to 86400, not nan"),
        ('profiles = ["article"]\n\n[settings.a]\nfilter = 2', ":4: filter is a whole number from 0 to 1, not 2"),
        ('profiles = ["article"]\n[settings.a]\nfliter = 1', ":3: unknown key 'fliter'; did you mean filter?"),
        ('profiles = ["article"]\n[settings]\nfilter = 1', ":2: settings is a table for each setting"),
        ('profiles = ["article"]\ngoals = 3', ":2: goals are tables, each under a line [[goals]]"),
        ('profiles = ["article"]\n[[goals]]\nfigure = "median_s"', ":2: condition = None: choose from article"),
        (
            'profiles = ["article"]\n[[goals]]\nfigure = "median_s"\ncondition = "article"',
            ":2: a goal has at_least, at_most or both",
        ),
        (
            'profiles = ["article"]\n[[goals]]\nfigure="mean_s"\ncondition="article"\nat_least=1\n'
            '[[goals]]\nfigure = "men_s"\ncondition = "article"\nat_least = 1',
            ":7: figure = 'men_s': did you mean mean_s?",
        ),
        (
            'profiles = ["article"]\n[[goals]]\nfigure = "mean_s"\ncondition = "article"\nat_least = "1"',
            ":5: at_least is a number, not '1'",
        ),
        ('profiles = ["article"]\n[[goals]]\nfigure = ["mean_s"]', ":3: figure = ['mean_s']: did you mean mean_s?"),
        ('profiles = ["article"]\nseeds = ' + "9" * 5000, "a.toml: a number has too many digits"),
        (
            'profiles = ["article"]\n[[goals]]\nfigure="mean_s"\ncondition="article"\nagainst="fixed"\nat_most=1',
            ":5: against = 'fixed': choose from article",
        ),
    ],
)
def test_mistake_in_a_study_is_one_line_with_its_place_and_a_hint(plan, text, said):
    with pytest.raises(UsageError) as raised:
        plan(text)

    assert said in str(raised.value)
    assert "\n" not in str(raised.value)


def test_missing_or_binary_study_file_is_reported(tmp_path):
    with pytest.raises(UsageError, match="there is no file"):
        read_plan(tmp_path / "a.toml")
    (tmp_path / "a.toml").write_bytes(b"\xff")
    with pytest.raises(UsageError, match=r"a\.toml is not a study: it is not text"):
        read_plan(tmp_path / "a.toml")


STUDIES = sorted({*(ROOT / "studies").glob("*.toml")} - {folder.USED_SEEDS})


@pytest.mark.parametrize("path", STUDIES, ids=lambda path: path.stem)
def test_studies_of_the_project_can_be_read(path):
    found = read_plan(path)

    assert found.title != path.stem
    assert found.is_atlas or found.goals


@pytest.mark.parametrize("path", STUDIES, ids=lambda path: path.stem)
def test_seeds_of_the_project_s_studies_are_noted_as_used(path):
    first, last = read_plan(path).seeds_used

    assert any(it.first <= first and last <= it.last for it in folder.read_used())


def test_used_seeds_that_overlap_those_of_a_study_are_reported(tmp_path):
    file = tmp_path / "used.toml"
    file.write_text('[[used]]\nfirst = 10\nlast = 20\nwhat = "a"\n[[used]]\nfirst = 30\nlast = 30\nwhat = "b"\n')

    assert [*folder.used_seed_notes(20, 30, file)] == ["used      seeds 20..20 for a", "used      seeds 30..30 for b"]
    assert [*folder.used_seed_notes(21, 29, file)] == [*folder.used_seed_notes(31, 40, file)] == []


@pytest.mark.parametrize("text", ["first = 1", 'first = 2\nlast = 1\nwhat = ""', "first = 1\nlast = 2\nwhat = 3"])
def test_invalid_range_of_used_seeds_is_reported_with_its_line(tmp_path, text):
    (tmp_path / "used.toml").write_text(f"\n[[used]]\n{text}\n")

    with pytest.raises(UsageError, match=r"used\.toml:2: a range has first, last and what it was used for"):
        folder.read_used(tmp_path / "used.toml")
