"""A network for sessions is played as it was trained: its units are kept, or begin anew."""

import jax.numpy as jnp
import numpy as np
import pytest
from colift.agents.submissions.submission import read_submission
from colift.benchmark.training.apg_settings import ApgSettings
from colift.benchmark.training.course import open_course
from colift.benchmark.training.lessons import lesson_for
from colift.benchmark.training.result import write_policy


@pytest.mark.parametrize(("kind", "remembers"), [("remember", True), ("forget", False)])
def test_the_submission_begins_a_lift_as_the_training_did(tmp_path, kind, remembers):
    settings = ApgSettings(session=kind, lifts=20, batch=2, units=3)
    lesson = lesson_for(settings)
    network = lesson.first(settings, 0)
    network = network._replace(output=jnp.ones_like(network.output))
    course = open_course(tmp_path, "apg", settings, 0, print)
    folder = write_policy(
        course,
        lesson.weights(network),
        lesson.about(settings),
        package=lesson.package,
        check=lesson.check,
    )
    policy = read_submission(folder).trusted().make()
    policy.begin_session()
    first, second = lift(policy), lift(policy)
    assert np.array_equal(first, second) != remembers


def lift(policy):
    policy.reset(0)
    steps = 0.1 * np.arange(20)
    return [policy.act(np.array([0.1 * t, 0.1 * t, 0.1 * t, 0.1 * t, t]))[0] for t in steps]
