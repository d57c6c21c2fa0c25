"""Analytic policy gradients: a recurrent policy by gradients through whole lifts of the twin.

The loss is that of a :class:`.GradientLesson`, such as :mod:`.level_lesson`.
The variation of the arms grows from the first update to the last: with a large variation from the
beginning, the policy becomes less exact with all arms. Nothing is estimated: the gradient is that
of the lifts themselves (compare J. Freeman et al., "Brax", NeurIPS 2021, on short-horizon
actor-critic and analytic gradients).
"""

from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from functools import cache, partial
from typing import Any, Final, NamedTuple

import jax
import jax.numpy as jnp
import optax
from colift.benchmark.training.apg_settings import PARTS, ApgSettings
from colift.benchmark.training.lesson import BatchDraw, GradientLesson
from colift.benchmark.training.lessons import lesson_for

LARGEST_GRADIENT: Final = 5.0
"""Norm to which gradients are clipped."""


class Learner(NamedTuple):
    """All that changes during the training."""

    network: Any
    """A :class:`.GatedNetwork`, or several."""
    optimiser: Any
    update: int
    """Updates done."""


class Update(NamedTuple):
    """A step of the training."""

    learner: Learner
    rmse_mm: float
    """Mean RMSE of the batch's lifts in the twin [mm]."""


def optimiser(settings: ApgSettings) -> optax.GradientTransformation:
    """Return Adam with its schedule and the clipping of gradients."""
    warm = max(settings.updates // 20, 1)
    schedule = optax.warmup_cosine_decay_schedule(
        0.1 * settings.rate, settings.rate, warm, max(settings.updates, warm + 1)
    )
    return optax.chain(optax.clip_by_global_norm(LARGEST_GRADIENT), optax.adam(schedule))


def first_learner(
    settings: ApgSettings, seed: int, lesson: GradientLesson | None = None
) -> Learner:
    """Return the learner before the first update; arguments as for :func:`updates`."""
    network = (lesson or lesson_for(settings)).first(settings, seed)
    return Learner(network, optimiser(settings).init(network), 0)


def updates(
    settings: ApgSettings,
    seed: int,
    learner: Learner | None = None,
    pool: Any = None,
    lesson: GradientLesson | None = None,
) -> Iterator[Update]:
    """Yield the learner after each update; the same seed gives the same weights.

    Parameters
    ----------
    settings
        The settings of the training.
    seed
        Seed of the first weights and of the batches; the lifts are the same for all seeds.
    learner
        The learner to continue from; None starts from the beginning.
    pool
        The drawn lifts; None draws them.
    lesson
        A lesson to use instead of that of the settings' task.
    """
    lesson = lesson or lesson_for(settings)
    learner = learner or first_learner(settings, seed, lesson)
    lifts = lesson.draw(settings) if pool is None else pool
    network, state = learner.network, learner.optimiser
    gradient = _gradient(settings.of_loss(), lesson)
    descend = _descent(settings)
    with ThreadPoolExecutor(PARTS) as threads:
        for update in range(learner.update, settings.updates):
            key = jax.random.fold_in(jax.random.key(seed), update)
            keys = [jax.random.fold_in(key, part) for part in range(PARTS)]
            varied = jnp.float32(settings.varied_in(update))
            of_part = partial(_finished, gradient, network, lifts, varied)
            parts = list(threads.map(of_part, keys))
            network, state, rmse = descend(network, state, parts)
            yield Update(Learner(network, state, update + 1), float(rmse))


def _finished(function: Any, *arguments: Any) -> Any:
    """Return the result of a function of JAX, once it has been computed."""
    result = function(*arguments)
    for leaf in jax.tree.leaves(result):
        leaf.block_until_ready()
    return result


@cache
def _gradient(settings: ApgSettings, lesson: GradientLesson) -> Any:
    """Return the gradient of a part of a batch, to be compiled."""

    @jax.jit
    def gradient(network: Any, lifts: Any, varied: jax.Array, key: jax.Array) -> tuple[Any, Any]:
        draw = BatchDraw(settings.batch // PARTS, key, varied)
        of_batch = partial(lesson.loss, pool=lifts, settings=settings, draw=draw)
        return jax.value_and_grad(of_batch, has_aux=True)(network)

    return gradient


@cache
def _descent(settings: ApgSettings) -> Any:
    """Return the step of the optimiser, to be compiled."""
    descent = optimiser(settings)

    @jax.jit
    def descend(
        network: Any, state: Any, parts: list[tuple[Any, Any]]
    ) -> tuple[Any, Any, jax.Array]:
        total = jax.tree.map(lambda *each: sum(each) / PARTS, *(part for _, part in parts))
        steps, state = descent.update(total, state, network)
        rmse = sum(rmse for (_, rmse), _ in parts) / PARTS
        return optax.apply_updates(network, steps), state, rmse

    return descend
