"""The words of a command line are those that are generated for the protocol."""

from host_sim.protocol import generated, words


def test_the_behaviours_are_those_of_the_protocol():
    assert set(words.PROFILES) == set(generated.PROFILES)


def test_the_parameters_are_those_of_the_protocol():
    assert {name: it[:3] for name, it in words.PARAMETERS.items()} == {
        name: (it.minimum, it.maximum, it.default) for name, it in generated.PARAMETERS.items()
    }


def test_the_last_node_is_that_of_the_protocol():
    assert words.NODE_MAX == generated.NODE_MAX
