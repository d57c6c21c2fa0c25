"""What a sandboxed policy sees of the file system."""

import pytest
from colift.agents.sandbox.host.policy import SandboxedPolicy, close_sandboxes
from colift.agents.sandbox.host.view import View
from colift.benchmark.execution.playing import play
from colift.benchmark.suites.catalogue import make_scenario


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


@pytest.mark.slow
def test_a_submission_can_begin_from_every_policy_of_colift(tmp_path):
    """They need nothing that is hidden, of people or of the benchmark."""
    (tmp_path / "all.py").write_text(
        "import importlib, pkgutil\n"
        "import colift.agents.policies as package\n"
        "for module in pkgutil.iter_modules(package.__path__):\n"
        "    importlib.import_module(f'{package.__name__}.{module.name}')\n"
        "from colift.agents.policies.copy import Copy as All\n"
    )
    policy = SandboxedPolicy(name="all", origin="all.py:All", folder=tmp_path, isolation="limits")
    (episode,) = play(policy, make_scenario("smooth", "S1"), (0,))
    close_sandboxes()
    assert episode.failure is None
