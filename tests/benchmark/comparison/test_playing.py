"""Comparisons that are played, on the quick suite."""

import dataclasses
from pathlib import Path

import pytest
from colift.agents.loading.policy_spec import PolicySpec
from colift.benchmark.bundle import results
from colift.benchmark.comparison.compare import compare
from colift.benchmark.comparison.files import comparison_json
from colift.benchmark.comparison.html import html_page
from colift.benchmark.comparison.paired_results import PairedResults
from colift.benchmark.comparison.playing import episodes_to_play, play_policies
from colift.benchmark.execution.journal import open_journal
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.results.baselines import (
    HUMAN_HUMAN_LABEL,
    human_human_run,
    shipped_baselines,
    shipped_references,
)
from colift.benchmark.suites.suite import Suite, make_suite


@pytest.fixture(scope="module")
def quick() -> Suite:
    return make_suite("quick-v1")


@pytest.fixture(scope="module")
def played(quick: Suite) -> PairedResults:
    return play_policies({name: PolicySpec(text=name) for name in ("copy", "hold")}, quick)


def test_a_policy_has_the_numbers_that_run_gives_it(quick: Suite, played: PairedResults) -> None:
    run = run_suite(PolicySpec(text="copy"), quick)
    summary = results(run, shipped_baselines(quick) or {}).summary.plain()
    ranked = next(p for p in comparison_json(compare(played))["policies"] if p["name"] == "copy")
    for name in ("mean", "ci95"):
        assert list_of(ranked["rmse_mm"][name]) == list_of(summary["rmse_mm"][name])
        assert list_of(ranked["vs_human"][name]) == list_of(summary["vs_human"][name])
    assert ranked["sparc"]["mean"] == pytest.approx(summary["sparc"]["mean"])
    assert ranked["human_force_n"]["mean"] == pytest.approx(summary["human_force_n"]["mean"])
    assert ranked["digest"] == run.policy_digest


def list_of(value: object) -> list[object]:
    return list(value) if isinstance(value, list | tuple) else [value]


def test_the_references_are_there_when_they_are_shipped(
    quick: Suite, played: PairedResults
) -> None:
    assert played.references == shipped_references(quick)
    told = comparison_json(compare(played))["references"]
    assert [reference["name"] for reference in told] == ["best_known", "oracle"]
    assert told[1]["rmse_mm"]["ci95"][1] < told[0]["rmse_mm"]["ci95"][0]
    page = html_page(compare(played))
    parts = page.replace("<wbr>", "").split("<table")[1:]
    tables = [part.partition("</table>")[0] for part in parts]
    for name in (HUMAN_HUMAN_LABEL, "oracle", "best known (trained)"):
        assert [name in table for table in tables] == [True, False, True, True]


def test_the_human_human_baseline_is_the_one_shipped_or_is_played(
    quick: Suite, played: PairedResults
) -> None:
    assert played.human_human == (shipped_baselines(quick) or {})["human_human"]
    other = dataclasses.replace(quick.with_seeds(7, 8), scenarios=quick.scenarios[:1])
    counted: list[int] = []
    copies = {"a": PolicySpec(text="copy"), "b": PolicySpec(text="copy")}
    found = play_policies(copies, other, progress=counted.append)
    assert found.references == {}
    human_human = human_human_run(other)
    assert list(found.human_human.rmse_mm) == [
        episode.scores["rmse_mm"] for episode in human_human.episodes
    ]
    assert sum(counted) == episodes_to_play(2, other) == 3


def test_a_policy_against_itself_shares_the_first_rank(quick: Suite, played: PairedResults) -> None:
    (copy, _) = played.policies
    twice = dataclasses.replace(copy, name="copy again")
    first, second = compare(dataclasses.replace(played, policies=(copy, twice))).overall.policies
    assert first.rank == second.rank == 1
    assert second.to_best is not None
    assert (second.to_best.mean, second.to_best.p, second.to_best.share_better) == (0.0, 1.0, 0.5)


def test_an_interrupted_comparison_gives_no_results(quick: Suite) -> None:
    def stop(episodes: int) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        play_policies({"copy": PolicySpec(text="copy")}, quick, progress=stop)


def test_a_comparison_goes_on_where_it_was_interrupted(
    quick: Suite, played: PairedResults, tmp_path: Path
) -> None:
    policies = {name: PolicySpec(text=name) for name in ("copy", "hold")}
    left = iter(range(quick.size + 4))  # All lifts of the first, and some of the second.

    def stop(episodes: int) -> None:
        if next(left, None) is None:
            raise KeyboardInterrupt

    with (
        pytest.raises(KeyboardInterrupt),
        open_journal(tmp_path / "made", {}, resume=False) as journal,
    ):
        play_policies(policies, quick, progress=stop, journal=journal)
    counted: list[int] = []
    with open_journal(tmp_path / "made", {}, resume=True) as journal:
        kept = len(journal.done)
        found = play_policies(policies, quick, progress=counted.append, journal=journal)
    assert quick.size < kept < 2 * quick.size
    assert counted == [quick.size, kept - quick.size, *[1] * (2 * quick.size - kept)]
    assert timeless(found) == timeless(played)


def timeless(found: PairedResults) -> dict[str, object]:
    content = comparison_json(compare(found))
    for policy in content["policies"]:
        del policy["step_ms"]
    return content
