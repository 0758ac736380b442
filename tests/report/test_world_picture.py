"""Pictures of worlds are made by the command that the documents name."""

from pathlib import Path

import pytest
from PIL import Image, ImageChops

from host_sim.cli.main import main
from host_sim.world.world_names import WORLD_NAMES

IMAGES = Path(__file__).resolve().parents[2] / "docs/images"


@pytest.mark.parametrize("name", WORLD_NAMES)
def test_the_pictures_in_the_documents_are_those_of_the_command(name, tmp_path):
    drawn = tmp_path / "drawn.png"

    assert main(["world", name, "--width", "320", "--png", str(drawn)]) == 0

    with Image.open(drawn) as new, Image.open(IMAGES / f"world-{name}.png") as old:
        assert ImageChops.difference(new.convert("RGB"), old.convert("RGB")).getbbox() is None


def test_the_command_says_what_an_environment_has(capsys):
    assert main(["world", "small"]) == 0

    said = "small: 2000 x 1500 mm, 2 obstacles, 3 pieces of food, all of which can be reached\n"
    assert capsys.readouterr().out == said


def test_a_mistake_is_one_line(capsys):
    assert main(["world", "smal"]) == 2

    assert capsys.readouterr().err == "octet: there is no world 'smal': did you mean small?\n"
