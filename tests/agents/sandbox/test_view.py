"""What a sandboxed policy sees of the file system."""

from colift.agents.sandbox.host.view import View


def test_what_is_hidden_within_something_hidden_does_not_show_the_rest_of_it(tmp_path):
    """As in an installation, where the agents are within the package that is hidden."""
    agents = tmp_path / "site" / "colift" / "agents"
    humans = agents / "humans"
    for folder in (tmp_path / "site" / "numpy", tmp_path / "site/colift/benchmark", humans):
        folder.mkdir(parents=True)
    (agents / "agent.py").touch()
    view = View(
        python=tmp_path,
        packages=(),
        readable=(tmp_path / "site", agents),
        hidden=(agents.parent, humans),
    )
    assert set(view.visible()) == {tmp_path / "site" / "numpy", agents / "agent.py"}
