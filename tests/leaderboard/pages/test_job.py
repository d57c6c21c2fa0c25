"""The page of a job: what its count means, which stages are over, and how long it takes."""

from datetime import timedelta

import pytest
from colift.leaderboard.evaluation.evaluate import episode_count
from colift.leaderboard.pages.formats import duration
from colift.leaderboard.pages.links import Links
from colift.leaderboard.pages.rendering import render_page
from colift.leaderboard.queue import Queue, WorkerQueue
from colift.leaderboard.views.job import job_page
from colift.leaderboard.views.page import Visit


@pytest.fixture
def view_at(board, clock, write_submission):
    """Return what begins a job, and looks at it after some minutes in a stage."""
    queue, work = Queue(board), WorkerQueue(board, lease=timedelta(days=1))
    queued = queue.enqueue(board.keep(write_submission()), "ada")
    job = work.claim("here")
    total = episode_count(board.season)

    def look(stage, done, minutes):
        clock.turn(minutes=minutes)
        work.report(job, stage, done, total)
        return job_page(Visit(board=board, queue=queue), queued.id)

    return look


def states(view):
    return [(each["name"], each["over"], each["now"]) for each in view["stages"]]


def test_the_lifts_of_the_stages_are_those_that_the_job_counts(view_at):
    view = view_at("check", 0, 0)
    assert sum(each["lifts"] for each in view["stages"]) == view["job"].total
    assert states(view)[:2] == [("check", False, True), ("public run", False, False)]


def test_stages_are_ticked_one_after_the_other(view_at):
    view = view_at("audit", 10, 1)
    assert [each["over"] for each in view["stages"]] == [True, True, False, False, False]
    assert [each["now"] for each in view["stages"]] == [False, False, True, False, False]


def test_the_time_that_is_left_follows_from_the_speed_so_far(view_at, board):
    assert view_at("check", 0, 5)["left"] is None
    view = view_at("public run", 10, 5)
    assert view["elapsed"] == timedelta(minutes=10)
    assert view["left"] == timedelta(minutes=10) * ((view["job"].total - 10) / 10)
    text = render_page("job.html", Links(), **view)
    assert f"10 of {view['job'].total} lifts of all stages" in text
    assert f"10 min so far, about {duration(view['left'])} left" in text


def test_the_hidden_run_tells_nothing_of_its_speed(view_at):
    assert view_at("hidden run", 30, 5)["left"] is None


@pytest.mark.parametrize(
    ("seconds", "text"),
    [(-3, "0 s"), (40, "40 s"), (99, "99 s"), (100, "2 min"), (720, "12 min"), (3900, "1 h 5 min")],
)
def test_a_duration_is_told_in_its_largest_units(seconds, text):
    assert duration(timedelta(seconds=seconds)) == text
