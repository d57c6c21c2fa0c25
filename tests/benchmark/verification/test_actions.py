"""A changed action, or anything that follows from one, is refused with its first step."""

import dataclasses

import pytest
from colift.agents.policies.copy import Copy
from colift.benchmark.bundle import read_bundle
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.recorder import Recorder

from .forging import SUITE, edit_arrays, first_row, flip, mend, refused, rewrite


class TestActions:
    @pytest.mark.slow
    @pytest.mark.parametrize("place", [0, 5])
    @pytest.mark.parametrize("name", ["action", "human_action"])
    def test_one_bit_of_one_action_is_found_with_its_step(self, bundle, name, place):
        episode = SUITE.scenarios[place // 2].name + f" seed {3 + place % 2}"
        row = first_row(bundle, place) + 17
        edit_arrays(bundle, lambda arrays: flip(arrays[name], (row, 0)))
        assert "SHA-256" in refused(bundle, file="traces.npz", episode="")
        mend(bundle)
        message = refused(bundle, file="traces.npz", episode=episode, step=17)
        assert ("human's action" in message) == (name == "human_action")

    @pytest.mark.slow
    @pytest.mark.parametrize(
        "name", ["human_end", "robot_end", "human_velocity", "human_force", "robot_force", "target"]
    )
    def test_one_bit_of_what_follows_is_found_with_its_frame(self, bundle, name):
        edit_arrays(bundle, lambda arrays: flip(arrays[name], 234))
        mend(bundle)
        message = refused(bundle, file="traces.npz", episode="smooth/S1 seed 3", step=23)
        assert message.startswith(f"{name} in frame 234 is ")

    def test_one_bit_of_a_hash_is_found(self, bundle):
        def change(arrays):
            arrays["state"][40, 3] ^= 1

        edit_arrays(bundle, change)
        mend(bundle)
        assert "hash" in refused(bundle, episode="smooth/S1 seed 3", step=40)

    def test_a_human_who_helps_is_found_though_all_else_follows(self, bundle):
        """The cleverest forgery: a true simulation, with a human who does what is easy."""
        told = read_bundle(bundle)
        run = told.run()
        forged = [_with_kind_human(episode, run.suite) for episode in run.episodes[:1]]
        run = dataclasses.replace(run, episodes=(*forged, *run.episodes[1:]))
        assert forged[0].scores["rmse_mm"] < told.episodes[0].scores["rmse_mm"]
        rewrite(bundle, run)
        message = refused(bundle, file="traces.npz", episode="smooth/S1 seed 3", step=31)
        assert "scripted human's" in message

    def test_actions_of_another_episode_are_no_use(self, bundle):
        def swap(arrays):
            first, second = arrays["steps"][:2]
            both = min(first, second)
            one, other = slice(0, both), slice(first, first + both)
            rows = arrays["action"].copy()
            arrays["action"][one], arrays["action"][other] = rows[other], rows[one]

        edit_arrays(bundle, swap)
        mend(bundle)
        assert refused(bundle, file="traces.npz", episode="smooth/S1 seed 3", step=0)


def _with_kind_human(episode, suite):
    """Return an episode that was played to its end with a human who keeps still from step 31 on."""
    scenario = next(s for s in suite.scenarios if s.behaviour == episode.behaviour)
    lift = Lift(scenario)
    lift.reset(episode.seed)
    recorder, partner = Recorder(lift), Copy()
    partner.reset(0)
    still = [episode.trace.human_action[30, -1]] * 10
    for step, reference in enumerate(episode.trace.human_action.tolist()):
        reference = still if step >= 31 else reference
        action = partner.act(lift.partner_observation())
        lift.step(reference, action)
        recorder.step(reference, action.tolist(), {})
    trace = recorder.trace()
    scores = lift.task.score(lift, trace, failed=False)
    lift.close()
    return dataclasses.replace(episode, trace=trace, scores=scores)
