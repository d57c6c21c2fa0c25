"""What pages show, without a browser."""

import dataclasses
import shutil

import pytest
from colift.benchmark.bundle.files import EPISODES, RESULTS
from colift.benchmark.comparison.scatter.scene import NARROW, WIDE
from colift.benchmark.rendering.axis import make_axis
from colift.benchmark.rendering.formats import interval, number, signed
from colift.benchmark.results.parts import Part
from colift.benchmark.statistics import Estimate, MeanWithMissing
from colift.leaderboard.core.board import Board
from colift.leaderboard.core.decisions import Decisions
from colift.leaderboard.core.standings import UnrankedScores
from colift.leaderboard.database.queries import record_entry
from colift.leaderboard.pages.formats import p_text, tex
from colift.leaderboard.pages.links import Links
from colift.leaderboard.pages.rendering import render_page
from colift.leaderboard.views.asked import CHOSEN
from colift.leaderboard.views.behaviour import behaviours
from colift.leaderboard.views.board import board_page
from colift.leaderboard.views.compare import compare_page
from colift.leaderboard.views.exports import standings_csv
from colift.leaderboard.views.lifts import (
    part_estimate,
    public_lifts,
    stratum_scores,
)
from colift.leaderboard.views.page import Visit
from colift.leaderboard.views.picture import make_picture
from colift.leaderboard.views.policy import policy_page

from .. import rows
from ..rows import add, make_entry, make_row, slow, unverified
from .boards import digest, unpacked


@pytest.fixture
def shown(folder):
    board = Board.open(folder)
    yield board
    board.close()


def human_human(mean):
    return UnrankedScores(
        rmse_mm=around(mean), ratio=1.0, means={"sparc": -2.8, "human_force_n": 0.3}
    )


def around(mean):
    return Estimate(mean=mean, ci95=(mean - 1, mean + 1))


def test_a_scale_shows_the_near_ones_and_marks_the_far_ones():
    axis = make_axis([around(5.0), around(6.0), around(9.0), around(200.0)])
    assert axis.top == 10.0
    assert axis.ticks == (0.0, 2.0, 4.0, 6.0, 8.0, 10.0)
    assert axis.at(5.0) == 50.0
    assert axis.beyond(200.0)
    assert axis.at(200.0) == 100.0


def test_a_mark_is_on_the_scale_whatever_the_rest_is():
    assert not make_axis([around(5.0)], marks=(40.0,)).beyond(40.0)


@pytest.mark.parametrize(
    ("told", "text"),
    [
        (number(None), "\N{EN DASH}"),
        (number(-0.04), "0.0"),
        (number(-1.26, 2), "\N{MINUS SIGN}1.26"),
        (signed(0.3), "+0.3"),
        (signed(-0.3), "\N{MINUS SIGN}0.3"),
        (signed(0.04), "0.0"),
        (interval(around(2.0)), "1.0 to 3.0"),
        (interval(Estimate(mean=2.0, ci95=(2.0, 2.0))), ""),
        (interval(Estimate(mean=2.0, ci95=None)), ""),
        (p_text(0.0002), "< 0.001"),
    ],
)
def test_numbers_are_written_as_people_write_them(told, text):
    assert told == text


def test_a_policy_is_shown_part_by_part_beside_two_people_and_blend(shown):
    visit = Visit(board=shown)
    view = policy_page(visit, "2026", digest("copy"))
    blend = policy_page(visit, "2026", digest("blend"))
    parts, public = view["parts"], view["standing"].row.public
    assert parts[0].part == Part(behaviour=None)
    assert parts[0].rmse_mm.mean == pytest.approx(public.rmse_mm.mean)
    assert parts[0].rmse_mm.ci95 == pytest.approx(public.rmse_mm.ci95)
    for mine, theirs in zip(parts, blend["parts"], strict=True):
        assert mine.other_mm == pytest.approx(theirs.rmse_mm.mean)
    assert parts[0].ratio == pytest.approx(public.vs_human.mean)
    assert [entry.season for entry in view["history"]] == ["2026", "2025"]


def test_only_so_many_are_compared_and_no_one_with_itself(shown):
    copy = digest("copy")
    assert compare_page(Visit(board=shown, chosen=[copy, copy]), "2026")["pairs"] == ()
    everyone = [each.row.submission for each in shown.standings("2026")]
    many = compare_page(Visit(board=shown, chosen=[*everyone, "nonsense"]), "2026")
    assert len(many["columns"]) == CHOSEN


def test_without_single_lifts_there_are_means_and_no_intervals(played, tmp_path):
    bundle = unpacked(played.entries[0], tmp_path / "whole")
    (tmp_path / RESULTS).write_bytes((bundle / RESULTS).read_bytes())
    part = Part(behaviour="pause")
    whole, bare = part_estimate(bundle, part), part_estimate(tmp_path, part)
    assert (bundle / EPISODES).is_file()
    assert bare.mean == pytest.approx(whole.mean)
    assert whole.ci95[0] < whole.mean < whole.ci95[1]
    assert bare.ci95 is None


def test_the_picture_has_hidden_errors_and_public_smoothness():
    row = make_row("a", 10.0, sparc=-2.5)
    picture = make_picture([row], human_human(9.7), size=WIDE)
    policy, people = picture.dots
    assert policy.tip == "a: RMSE 10.0 mm, SPARC \N{MINUS SIGN}2.50"
    assert people.tip.startswith("two people: RMSE 9.7 mm")
    assert people.at[0] == picture.baseline


def test_a_policy_that_never_moves_along_is_in_the_strip_and_not_on_the_front():
    still = make_row("still", 20.0)
    metrics = {**still.public.metrics, "sparc": MeanWithMissing(mean=None, missing=12)}
    still = dataclasses.replace(still, public=dataclasses.replace(still.public, metrics=metrics))
    picture = make_picture([still, make_row("moving", 10.0)], None, size=NARROW)
    dots = {dot.point.name: dot for dot in picture.dots}
    assert dots["still"].at[1] > picture.scale.inner[3] > dots["moving"].at[1]
    assert [name for name, dot in dots.items() if dot.best] == ["moving"]


def test_a_board_without_policies_has_no_picture():
    assert make_picture([], human_human(9.7), size=WIDE) is None


def test_a_policy_that_failed_in_every_lift_says_why_once(tmp_path):
    board = Board.open(tmp_path / "board", "quick-v1")
    add(board, "ruin", 250.0)
    row = make_row("ruin", 250.0)
    ruined = dataclasses.replace(row, public=dataclasses.replace(row.public, failed=12))
    Decisions(board).rescore("1", ruined, (250.0,) * 12, who="Ada", why="it never lifted")
    bundle = board.store.bundle("1", row.submission)
    bundle.mkdir(parents=True)
    lines = [f"smooth,S1,{seed},250.0,step 0: TypeError" for seed in range(11)]
    lines.append("jerky,S3,0,250.0,start: OSError")
    (bundle / EPISODES).write_text("\n".join(["behaviour,subject,seed,rmse_mm,failure", *lines]))
    (bundle / RESULTS).write_text('{"groups": []}')
    view = policy_page(Visit(board=board), "1", row.submission)
    page = render_page("policy.html", Links(), **view | {"has_replays": True})
    board.close()
    assert [(why, len(lifts)) for why, lifts in view["failures"]] == [
        ("step 0: TypeError", 11),
        ("start: OSError", 1),
    ]
    assert "The policy failed in all 12 public lifts" in page
    assert "Watch it lift" not in page


def test_what_tex_would_take_for_a_command_is_escaped():
    assert tex(r"a_b {50 %} \x ~") == (r"a\_b \{50 \%\} \textbackslash{}x \textasciitilde{}")


def test_the_map_of_behaviours_has_every_policy_of_the_ranking(shown):
    content = behaviours(Visit(board=shown), "2026")
    ranked = [each.row.name for each in shown.standings("2026") if each.ranked]
    assert [row["standing"].row.name for row in content["rows"]] == ranked
    assert content["behaviours"] == ["smooth", "pause", "jerky", "changing_goal"]
    assert content["people"] == 3
    for row in content["rows"]:
        view = policy_page(Visit(board=shown), "2026", row["standing"].row.submission)
        means = {each.part.behaviour: each.rmse_mm.mean for each in view["parts"][1:]}
        assert row["rmse_mm"] == pytest.approx(means)
        for name, spread in row["spread"].items():
            assert spread.best <= row["rmse_mm"][name] <= spread.worst


def test_no_name_is_a_formula_of_a_spreadsheet(tmp_path):
    board = Board.open(tmp_path / "board", "quick-v1")
    add(board, "=cmd|' /C calc'!A0", 9.0)
    assert "'=cmd|" in standings_csv(board)
    board.close()


def test_a_refused_submission_has_a_page_with_the_reason(tmp_path):
    board = Board.open(tmp_path / "board", "quick-v1")
    entry = make_entry(board, "mine", refusal="lift 3 differs when it is played again")
    with board.database.writing() as connection:
        record_entry(connection, entry, ())
    view = policy_page(Visit(board=board), "1", entry.submission)
    board.close()
    assert view["template"] == "refusal.html"
    assert view["entry"].refusal == entry.refusal


def test_a_page_shows_what_is_not_real_time_apart_and_says_what_has_no_rank(tmp_path):
    """The pages of a board with a row of each section, and of the rows themselves."""
    import asyncio

    import httpx
    from colift.leaderboard.service.app import create_app

    board = Board.open(tmp_path / "board", "quick-v1")
    add(board, "good", 10.0)
    add(board, "snail", 5.0, change=slow)
    add(board, "free", 1.0, change=unverified)
    board.standings()  # Computes the ranks.
    view = board_page(board)
    names = [[each.row.name for each in some] for some in (view["slow"], view["out"])]
    assert ([each.standing.row.name for each in view["rows"]], *names) == (
        ["good"],
        ["snail"],
        ["free"],
    )
    board.close()
    app = create_app(tmp_path / "board")

    async def answers():
        paths = ["/", *(f"/seasons/1/policies/{digest(name)}" for name in told)]
        transport = httpx.ASGITransport(app)
        async with httpx.AsyncClient(transport=transport, base_url="http://board") as client:
            return [await client.get(path) for path in (*paths, "/api/v1/standings")]

    told = {
        "good": "Rank",
        "snail": "would not wait for this policy",
        "free": "did not run in a sandbox",
    }
    front, *pages, api = asyncio.run(answers())
    app.state.service.board.close()
    text = front.text
    assert text.index("Not real-time") < text.index("snail") < text.index("Out of the ranking")
    for page, words in zip(pages, told.values(), strict=True):
        assert (page.status_code, words in page.text) == (200, True)
    assert [(each["section"], each["rank"]) for each in api.json()] == [
        ("ranking", 1),
        ("not real-time", 1),
        ("unverified", 0),
    ]


def test_the_picture_of_another_task_has_that_tasks_second_metric_and_words():
    row = make_row("a", 20.0)
    metrics = {
        "settling_ms": MeanWithMissing(mean=1352.0, missing=0),
        "human_force_n": MeanWithMissing(mean=0.3, missing=0),
    }
    public = dataclasses.replace(row.public, metrics=metrics)
    row = dataclasses.replace(row, suite="intent-v1", public=public)
    picture = make_picture([row], None, size=WIDE)
    assert picture.dots[0].tip == "a: RMSE 20.0 mm, settling 1352 ms"
    assert picture.axis == "← more accurate · RMSE on the hidden lifts, mm"
    assert picture.axis_up == "Time to the right pose, ms · quicker →"


def test_a_bundle_that_a_rescore_has_replaced_is_read_again(tmp_path, played):
    board = Board.open(tmp_path / "board", "quick-v1")
    add(board, "mine", 10.0)
    first, second = (
        unpacked(each, tmp_path / f"run of {each.entry.name}") for each in played.entries[:2]
    )
    seen = []
    for bundle in (first, second):
        copy = shutil.copytree(bundle, tmp_path / "copy")
        board.store.place_bundle("1", rows.digest("mine"), copy)
        place = board.bundle("1", rows.digest("mine"))
        whole = Part(behaviour=None)
        assert public_lifts(place) == public_lifts(bundle)
        assert stratum_scores(place) == stratum_scores(bundle)
        assert part_estimate(place, whole) == part_estimate(bundle, whole)
        seen.append(part_estimate(place, whole).mean)
    board.close()
    assert seen[0] != seen[1]
