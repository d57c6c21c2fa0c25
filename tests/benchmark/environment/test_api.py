"""The libraries' own conformance tests, over every behaviour and both partners."""

import gymnasium
import numpy as np
import pytest
import supersuit
from colift.benchmark.environment import RobotEnv, env, parallel_env
from gymnasium.utils.env_checker import check_env
from pettingzoo.test import api_test, parallel_api_test, parallel_seed_test, render_test

PARTNERS = ["nao", "human"]


@pytest.fixture(scope="module")
def recording(tmp_path_factory):
    path = tmp_path_factory.mktemp("recordings") / "lift.csv"
    times = np.arange(0, 3, 0.01)
    heights = 0.3 * np.sin(np.pi * times / 3) ** 2
    rows = "\n".join(f"one,{t:.2f},{z:.5f}" for t, z in zip(times, heights, strict=True))
    path.write_text(f"trial,t_s,z_m\n{rows}\n")
    return f"recorded:{path}"


@pytest.fixture(params=["smooth", "pause", "jerky", "changing_goal", "recorded"])
def scenario(request):
    return request.getfixturevalue("recording") if request.param == "recorded" else request.param


# PettingZoo would rather have "human_0" than "human", and agents that all see and do the same.
@pytest.mark.filterwarnings("ignore:We recommend agents to be named:UserWarning")
@pytest.mark.filterwarnings("ignore:Agents have different:UserWarning")
@pytest.mark.filterwarnings("ignore:Observations are different shapes:UserWarning")
@pytest.mark.parametrize("partner", PARTNERS)
class TestPettingZoo:
    def test_parallel_api(self, scenario, partner):
        made = parallel_env(behaviour=scenario, partner=partner)
        parallel_api_test(made, num_cycles=120)
        made.close()

    def test_parallel_seed(self, scenario, partner):
        parallel_seed_test(lambda: parallel_env(behaviour=scenario, partner=partner), num_cycles=40)

    def test_aec_api(self, scenario, partner):
        made = env(behaviour=scenario, partner=partner)
        api_test(made, num_cycles=120)
        made.close()


@pytest.mark.slow
@pytest.mark.parametrize("partner", PARTNERS)
def test_render(partner, monkeypatch):
    """Headless: the window is left out, and the log says so."""
    monkeypatch.delenv("DISPLAY", raising=False)
    render_test(lambda render_mode: env(partner=partner, render_mode=render_mode))


def test_an_unknown_render_mode_is_refused():
    with pytest.raises(ValueError, match="'ascii'"):
        parallel_env(render_mode="ascii")


@pytest.mark.parametrize("subject", ["S1", "S3", "draw-5"])
def test_gymnasium_checks(scenario, subject):
    made = RobotEnv(behaviour=scenario, subject=subject)
    check_env(made, skip_render_check=True)
    made.close()


def test_gymnasium_makes_it_by_name():
    made = gymnasium.make("colift/Lift-v0", behaviour="pause")
    observation, _ = made.reset(seed=3)
    assert made.observation_space.contains(observation)
    made.close()


def test_supersuit_steps_it_as_a_vector_environment():
    made = parallel_env()
    padded = supersuit.pad_action_space_v0(supersuit.pad_observations_v0(made))
    vector = supersuit.pettingzoo_env_to_vec_env_v1(supersuit.black_death_v3(padded))
    vector = supersuit.concat_vec_envs_v1(vector, 2, num_cpus=1, base_class="gymnasium")
    observations, _ = vector.reset(seed=1)
    assert observations.shape == (4, 51)
    for _ in range(100):
        observations, rewards, *_ = vector.step(np.zeros((4, *vector.action_space.shape[-1:])))
        assert np.isfinite(observations).all()
        assert np.isfinite(rewards).all()
    vector.close()


def test_supersuit_steps_two_humans_without_padding():
    vector = supersuit.pettingzoo_env_to_vec_env_v1(parallel_env(partner="human"))
    vector = supersuit.concat_vec_envs_v1(vector, 2, num_cpus=1, base_class="gymnasium")
    vector.reset(seed=1)
    observations, *_ = vector.step(np.zeros((4, 10)))
    assert observations.shape == (4, 51)
    vector.close()
