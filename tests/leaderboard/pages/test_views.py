"""What pages show, without a browser."""

import dataclasses
from itertools import pairwise

import pytest
from colift.benchmark.bundle.files import EPISODES, RESULTS
from colift.benchmark.comparison.standing import Estimate
from colift.leaderboard.board import Board
from colift.leaderboard.database.recording import record_entry
from colift.leaderboard.pages.formats import interval, number, p_value, signed
from colift.leaderboard.views.axis import make_axis
from colift.leaderboard.views.compare import MOST, compare_view
from colift.leaderboard.views.parts import Part, estimate
from colift.leaderboard.views.picture import make_picture
from colift.leaderboard.views.policy import RefusalView, policy_view
from colift.leaderboard.views.scenario import scenarios_view
from colift.leaderboard.views.table import standings_csv

from ..rows import add, make_entry, make_row
from .boards import digest


@pytest.fixture
def shown(folder):
    board = Board.open(folder)
    yield board
    board.close()


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
        (p_value(0.0002), "< 0.001"),
    ],
)
def test_numbers_are_written_as_people_write_them(told, text):
    assert told == text


def test_a_policy_is_shown_part_by_part_beside_two_people_and_blend(shown):
    view = policy_view(shown, "2026", digest("copy"))
    blend = policy_view(shown, "2026", digest("blend"))
    assert view.parts[0].part == Part(behaviour=None, subject=None)
    assert view.parts[0].rmse_mm.mean == pytest.approx(view.standing.row.public.rmse_mm.mean)
    assert view.parts[0].rmse_mm.ci95 == pytest.approx(view.standing.row.public.rmse_mm.ci95)
    for mine, theirs in zip(view.parts, blend.parts, strict=True):
        assert mine.blend_mm == pytest.approx(theirs.rmse_mm.mean)
    ratio = view.parts[0].rmse_mm.mean / view.parts[0].team_mm
    assert ratio == pytest.approx(view.standing.row.public.vs_human.mean)
    assert [entry.season for entry in view.history] == ["2026", "2025"]


def test_only_so_many_are_compared_and_no_one_with_itself(shown):
    copy = digest("copy")
    assert compare_view(shown, "2026", [copy, copy]).pairs == ()
    everyone = [each.row.submission for each in shown.standings("2026")]
    assert len(compare_view(shown, "2026", [*everyone, "nonsense"]).columns) == MOST


def test_without_single_lifts_there_are_means_and_no_intervals(played, tmp_path):
    bundle = played.entries[0].bundle
    (tmp_path / RESULTS).write_bytes((bundle / RESULTS).read_bytes())
    part = Part(behaviour="pause", subject=None)
    whole, bare = estimate(bundle, part), estimate(tmp_path, part)
    assert (bundle / EPISODES).is_file()
    assert bare.mean == pytest.approx(whole.mean)
    assert whole.ci95[0] < whole.mean < whole.ci95[1]
    assert bare.ci95 == (bare.mean, bare.mean)


def test_the_best_of_each_scenario_is_named(shown):
    view = scenarios_view(shown, "2026")
    assert set(view.cells) == {
        ("smooth", "S1"),
        ("pause", "S2"),
        ("jerky", "S3"),
        ("changing_goal", "S5"),
    }
    assert all(cell.best.row.name != "hold" for cell in view.cells.values())


def test_names_in_the_picture_do_not_cover_each_other():
    rows = [make_row(f"a-policy-{i}", 10.0 + 0.01 * i) for i in range(30)]
    picture = make_picture(rows, 9.0, width=600, height=400)
    assert len(picture.dots) == 30
    boxes = [
        (label.x - (0 if label.anchor == "start" else 70), label.y) for label in picture.labels
    ]
    for i, (x, y) in enumerate(boxes):
        assert all(abs(x - u) > 60 or abs(y - v) > 10 for u, v in boxes[:i])


@pytest.mark.parametrize(("width", "height"), [(920, 440), (390, 380)])
def test_the_names_of_the_front_stand_clear_of_its_line(width, height):
    rows = [make_row("anticipate", 3.8, sparc=-2.09), make_row("task_model", 5.6, sparc=-2.13)]
    rows += [make_row("proactive", 11.8, sparc=-2.01), make_row("impedance", 19.1, sparc=-1.8)]
    picture = make_picture(rows, 10.3, width=width, height=height)
    labels = {label.text: label for label in picture.labels}
    places = [tuple(map(float, corner.split(","))) for corner in picture.stair.split()]
    for dot in picture.dots:
        if dot.front:
            label = labels[dot.name]
            assert not any(
                left <= label.x <= right and label.y - 10 < y < label.y
                for (left, y), (right, _) in pairwise(places)
            )


def test_who_never_moves_along_is_in_the_strip_and_not_on_the_front():
    still = make_row("still", 5.0)
    still = dataclasses.replace(
        still, public=dataclasses.replace(still.public, sparc=None, sparc_missing=12)
    )
    picture = make_picture([still, make_row("moving", 10.0)], None, width=600, height=400)
    dots = {dot.name: dot for dot in picture.dots}
    assert dots["still"].y > picture.still > dots["moving"].y
    assert [dot.name for dot in picture.dots if dot.front] == ["moving"]


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
    view = policy_view(board, "1", entry.submission)
    board.close()
    assert isinstance(view, RefusalView)
    assert view.entry.refusal == entry.refusal
