"""The comparison with Enki, which only those install who want it."""

from host_sim.lab.bench.__main__ import main


def test_without_enki_the_comparison_says_in_one_line_what_to_install(monkeypatch, tmp_path, capsys):
    monkeypatch.setenv("PATH", str(tmp_path))

    code = main(["--peers"])

    assert code == 1
    assert capsys.readouterr().err == "octet: cannot build enki_peer: install g++ and libenki-dev with apt-get\n"
