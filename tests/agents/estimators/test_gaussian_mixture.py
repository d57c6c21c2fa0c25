import numpy as np
import pytest
from colift.agents.estimators.gaussian_mixture import GaussianMixture, GaussianMixtureRegression
from colift.base.errors import InputError

ONE = GaussianMixture(
    weights=np.ones(1),
    means=np.array([[1.0, -2.0, 0.5]]),
    covariances=np.array([[[2.0, 0.6, -0.4], [0.6, 1.0, 0.3], [-0.4, 0.3, 0.8]]]),
)
THREE = GaussianMixture(
    weights=np.array([0.5, 0.3, 0.2]),
    means=np.array([[0.0, 1.0], [2.0, -1.0], [-1.0, 0.3]]),
    covariances=np.array(
        [[[1.0, 0.5], [0.5, 0.6]], [[0.5, -0.3], [-0.3, 0.7]], [[2.0, 1.2], [1.2, 1.0]]]
    ),
)
FINE = np.linspace(-12.0, 12.0, 4001)


def joint_logs(mixture, x):
    """Return log w_i + log N(x; m_i, S_i) of each component, by the textbook."""
    logs = []
    for weight, mean, covariance in zip(
        mixture.weights, mixture.means, mixture.covariances, strict=True
    ):
        apart = np.asarray(x) - mean
        volume = np.log(np.linalg.det(2 * np.pi * covariance))
        logs.append(np.log(weight) - 0.5 * (volume + apart @ np.linalg.inv(covariance) @ apart))
    return np.array(logs)


def density(mixture, points):
    return np.array([np.exp(joint_logs(mixture, point)).sum() for point in points])


def test_one_component_is_the_analytic_conditional():
    """Over (x1, x2, y): Schur complement of the covariance, by hand."""
    x = np.array([0.2, -1.1])
    apart = x - [1.0, -2.0]
    determinant = 2.0 * 1.0 - 0.6**2
    slopes = np.array([-0.4 * 1.0 - 0.3 * 0.6, 0.3 * 2.0 - -0.4 * 0.6]) / determinant
    mean, covariance, responsibilities = GaussianMixtureRegression(ONE, 2)(x)
    assert mean == pytest.approx([0.5 + slopes @ apart])
    assert covariance == pytest.approx(np.array([[0.8 - slopes @ [-0.4, 0.3]]]))
    assert responsibilities.tolist() == [1.0]


@pytest.mark.parametrize("x", [-2.5, -0.3, 0.9, 2.0, 4.0])
def test_several_components_are_what_integration_gives(x):
    joint = density(THREE, np.column_stack((np.full(len(FINE), x), FINE)))
    total = np.trapezoid(joint, FINE)
    mean = np.trapezoid(joint * FINE, FINE) / total
    variance = np.trapezoid(joint * (FINE - mean) ** 2, FINE) / total
    found = GaussianMixtureRegression(THREE, 1)([x])
    assert found.mean == pytest.approx([mean], abs=1e-9)
    assert found.covariance == pytest.approx(np.array([[variance]]), abs=1e-9)
    of_x = GaussianMixture(
        weights=THREE.weights, means=THREE.means[:, :1], covariances=THREE.covariances[:, :1, :1]
    )
    logs = joint_logs(of_x, [x])
    assert np.exp(logs).sum() == pytest.approx(total)
    assert found.responsibilities == pytest.approx(np.exp(logs) / total)


def test_several_outputs_agree_with_samples():
    """The moments of y near an x, in samples of the mixture."""
    rng = np.random.default_rng(5)
    covariances = np.array([np.diag([0.4, 0.3, 0.2]) + 0.15, np.diag([0.5, 0.4, 0.6]) - 0.08])
    mixture = GaussianMixture(
        weights=np.array([0.4, 0.6]),
        means=np.array([[0.0, 1.0, -1.0], [0.5, -1.0, 0.5]]),
        covariances=covariances,
    )
    roots = np.linalg.cholesky(covariances)

    def near_some(count):
        chosen = rng.choice(2, count, p=mixture.weights)
        normal = rng.standard_normal((count, 3))
        samples = mixture.means[chosen] + np.einsum("nij,nj->ni", roots[chosen], normal)
        return samples[np.abs(samples[:, 0] - 0.3) < 0.02, 1:]

    near = np.concatenate([near_some(100_000) for _ in range(20)])
    found = GaussianMixtureRegression(mixture, 1)([0.3])
    assert len(near) > 20_000
    assert found.mean == pytest.approx(near.mean(axis=0), abs=0.02)
    assert found.covariance == pytest.approx(np.cov(near.T), abs=0.02)


def test_the_outputs_covariance_is_that_of_the_components_and_between_them():
    """Two distant components, both possible: the law of total variance."""
    mixture = GaussianMixture(
        weights=np.array([0.25, 0.75]),
        means=np.array([[0.0, -4.0], [0.0, 4.0]]),
        covariances=np.array([np.eye(2), np.eye(2)]),
    )
    mean, covariance, responsibilities = GaussianMixtureRegression(mixture, 1)([0.0])
    assert responsibilities == pytest.approx([0.25, 0.75])
    assert mean == pytest.approx([2.0])
    assert covariance == pytest.approx(np.array([[1.0 + 0.25 * 0.75 * 8.0**2]]))


def test_responsibilities_add_up_even_far_away():
    regression = GaussianMixtureRegression(THREE, 1)
    for x in (-1e4, -30.0, 0.0, 30.0, 1e4):
        found = regression([x])
        assert found.responsibilities.sum() == pytest.approx(1.0)
        assert np.isfinite(found.mean).all()
        assert found.covariance[0, 0] > 0


@pytest.mark.slow
def test_a_fit_recovers_a_known_mixture():
    learner = pytest.importorskip("sklearn.mixture")
    rng = np.random.default_rng(8)
    chosen = rng.choice(3, 40_000, p=THREE.weights)
    roots = np.linalg.cholesky(THREE.covariances)
    normal = rng.standard_normal((len(chosen), 2))
    samples = THREE.means[chosen] + np.einsum("nij,nj->ni", roots[chosen], normal)
    fit = learner.GaussianMixture(3, random_state=0, tol=1e-6, max_iter=2000).fit(samples)
    found = GaussianMixture(
        weights=fit.weights_,
        means=fit.means_,
        covariances=(fit.covariances_ + fit.covariances_.transpose(0, 2, 1)) / 2,
    )
    points = rng.normal(0.0, 1.5, (50, 2))
    assert density(found, points) == pytest.approx(np.exp(fit.score_samples(points)))
    known, learned = GaussianMixtureRegression(THREE, 1), GaussianMixtureRegression(found, 1)
    for x in (-1.5, 0.0, 1.0, 2.5):
        assert learned([x]).mean == pytest.approx(known([x]).mean, abs=0.06)
        assert learned([x]).covariance == pytest.approx(known([x]).covariance, abs=0.06)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"weights": np.array([0.5, 0.6, 0.2])}, "add up to 1, got"),
        ({"weights": np.array([1.5, -0.3, -0.2])}, "must be positive"),
        ({"weights": np.array([np.nan, 0.5, 0.5])}, "must be positive"),
        ({"weights": np.array([0.5, 0.5])}, r"means of shape \(2, 2\)"),
        ({"weights": np.array(1.0)}, r"shapes \(k,\) and \(k, d\)"),
        ({"means": np.full((3, 2), np.inf)}, "means must be finite"),
        ({"means": np.zeros((3, 3))}, r"covariances of shape \(3, 3, 3\)"),
        ({"covariances": np.array([np.eye(2), np.ones((2, 2)), np.eye(2)])}, "covariance 1 is not"),
        ({"covariances": np.array([[[1.0, 0.2], [0.1, 1.0]]] * 3)}, "covariance 0 is not symm"),
    ],
)
def test_what_is_no_mixture_is_refused(change, message):
    parts = {"weights": THREE.weights, "means": THREE.means, "covariances": THREE.covariances}
    with pytest.raises(InputError, match=message):
        GaussianMixture(**{**parts, **change})


@pytest.mark.parametrize("inputs", [0, 2, -1])
def test_a_regression_needs_inputs_and_outputs(inputs):
    with pytest.raises(InputError, match=f"inputs must be 1 to 1, got {inputs}"):
        GaussianMixtureRegression(THREE, inputs)
