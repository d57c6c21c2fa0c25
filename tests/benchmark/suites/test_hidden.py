"""Hidden episodes: new people and plans from a secret, equal anywhere, of which nothing is told."""

import hashlib
import subprocess
import sys

import pytest
from colift.agents.humans import SUBJECTS
from colift.agents.loading.policy_spec import PolicySpec
from colift.agents.spec import InProcess
from colift.base.errors import InputError
from colift.base.registry import SUITES, own_entries
from colift.benchmark.episode.turns import policy_seed
from colift.benchmark.execution.batches import shuffled_batches
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.results.baselines import human_human_run
from colift.benchmark.suites.hidden import commitment, hidden_suite, keyed, new_secret
from colift.benchmark.suites.suite import make_suite

SECRET = bytes(range(32))
OTHER = bytes(range(1, 33))
QUICK = make_suite("quick-v1")

FRESH = """
from colift.benchmark.suites.hidden import hidden_suite
from colift.benchmark.suites.suite import make_suite
print(hidden_suite(make_suite("quick-v1"), bytes(range(32))).digest)
"""


class Listening(InProcess):
    """A policy that stands still and keeps the seeds that it is given."""

    name = "listening"

    def __init__(self):
        self.seeds = []

    def check(self):
        pass

    def digest(self):
        return "0"

    def make(self):
        return self

    def reset(self, seed):
        self.seeds.append(seed)

    def act(self, observation):
        return [0.0]


def digests(run):
    return [episode.trace.digest() for episode in run.episodes]


@pytest.fixture(scope="module")
def public():
    return run_suite(PolicySpec(text="copy"), QUICK)


@pytest.fixture(scope="module")
def hidden():
    return run_suite(PolicySpec(text="copy"), hidden_suite(QUICK, SECRET))


def test_keyed_is_hmac_sha256_by_its_definition():
    """RFC 2104, written out."""
    key = SECRET.ljust(64, b"\0")
    inner = hashlib.sha256(bytes(b ^ 0x36 for b in key) + b"lift\0standard-v1\x007").digest()
    outer = hashlib.sha256(bytes(b ^ 0x5C for b in key) + inner).digest()
    assert keyed(SECRET, "lift", "standard-v1", 7) == outer


def test_labels_do_not_run_into_each_other():
    assert keyed(SECRET, "a", "bc") != keyed(SECRET, "ab", "c")


@pytest.mark.parametrize("name", own_entries(SUITES))
def test_a_hidden_suite_has_the_size_and_the_behaviours_of_the_public_one(name):
    public = make_suite(name)
    hidden = hidden_suite(public, SECRET)
    assert hidden.size == public.size
    assert [s.behaviour for s in hidden.scenarios] == [s.behaviour for s in public.scenarios]
    assert [s.human for s in hidden.scenarios] == [s.human for s in public.scenarios]


@pytest.mark.parametrize("name", own_entries(SUITES))
def test_each_person_is_replaced_by_one_whom_nobody_knows_in_all_behaviours(name):
    public = make_suite(name)
    hidden = hidden_suite(public, SECRET)
    pairs = {
        (mine.subject, theirs.subject)
        for mine, theirs in zip(public.scenarios, hidden.scenarios, strict=True)
    }
    known, unknown = ({pair[i] for pair in pairs} for i in (0, 1))
    assert len(pairs) == len(known) == len(unknown)
    assert unknown.isdisjoint((*SUBJECTS.values(), *known))


def test_seeds_are_of_128_bits_and_all_different():
    seeds = hidden_suite(make_suite("paper-v1"), SECRET).seeds
    assert len(set(seeds)) == 10
    assert 2**120 < max(seeds) < 2**128


def test_another_secret_or_another_suite_has_other_people_and_other_seeds():
    first = hidden_suite(QUICK, SECRET)
    for other in (hidden_suite(QUICK, OTHER), hidden_suite(make_suite("paper-v1"), SECRET)):
        assert set(first.seeds).isdisjoint(other.seeds)
        assert {s.subject for s in first.scenarios}.isdisjoint(s.subject for s in other.scenarios)


def test_a_fresh_process_makes_the_same_hidden_suite():
    done = subprocess.run([sys.executable, "-c", FRESH], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == hidden_suite(QUICK, SECRET).digest


def test_a_hidden_run_is_repeated_by_its_secret_and_by_no_other(public, hidden):
    again = run_suite(PolicySpec(text="copy"), hidden_suite(QUICK, SECRET))
    assert digests(again) == digests(hidden)
    other = run_suite(PolicySpec(text="copy"), hidden_suite(QUICK, OTHER))
    for run in (public, other):
        assert set(digests(hidden)).isdisjoint(digests(run))


def test_every_hidden_lift_has_a_plan_of_its_own(public, hidden):
    goals = [episode.trace.target.max() for episode in (*public.episodes, *hidden.episodes)]
    assert len(set(goals)) == 24


def test_the_human_human_baseline_meets_the_same_hidden_plans(hidden):
    human_human = human_human_run(hidden_suite(QUICK, SECRET))
    for ours, theirs in zip(hidden.episodes, human_human.episodes, strict=True):
        assert ours.trace.target.tobytes() == theirs.trace.target.tobytes()


def test_a_policys_seed_does_not_tell_hidden_episodes_from_public_ones():
    told = Listening()
    for suite in (QUICK, hidden_suite(QUICK, SECRET), hidden_suite(QUICK, OTHER)):
        run_suite(told, suite)
    assert set(told.seeds) == {policy_seed()}
    assert len(told.seeds) == 3 * 12


def test_the_order_in_which_episodes_are_played_follows_from_the_secret_and_the_policy():
    suite = hidden_suite(QUICK, SECRET)
    orders = {
        tuple(due.place for each in shuffled_batches(policy, suite, secret) for due in each.lifts)
        for policy in (PolicySpec(text="copy"), PolicySpec(text="hold"))
        for secret in (SECRET, OTHER)
    }
    assert len(orders) == 4
    assert {tuple(sorted(order)) for order in orders} == {tuple(range(12))}


def test_the_order_changes_no_episode(hidden):
    played = []
    policy, suite = PolicySpec(text="copy"), hidden_suite(QUICK, SECRET)
    run = run_suite(policy, suite, secret=SECRET, keep=lambda place, _: played.append(place))
    assert digests(run) == digests(hidden)
    batches = shuffled_batches(policy, suite, SECRET)
    assert [due.place for batch in batches for due in batch.lifts] == played
    assert played != sorted(played)


def test_the_commitment_is_the_sha256_of_the_secret():
    assert commitment(SECRET) == hashlib.sha256(SECRET).hexdigest()
    assert commitment(OTHER) != commitment(SECRET)


def test_new_secrets_differ():
    assert len({new_secret() for _ in range(10)}) == 10
    assert {len(new_secret()) for _ in range(10)} == {32}


@pytest.mark.parametrize("use", [commitment, lambda s: hidden_suite(QUICK, s)])
def test_a_short_secret_is_refused(use):
    with pytest.raises(InputError, match="31 bytes; it needs at least 32"):
        use(SECRET[:31])
