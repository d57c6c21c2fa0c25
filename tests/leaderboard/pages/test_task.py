"""Pages of boards of several tasks: each speaks of its own, and names commands that play it."""

import asyncio
import html
import inspect
import re

import httpx
import pytest
from colift.benchmark.suites.suite import make_suite
from colift.cli.check import check as check_command
from colift.cli.options import chosen_suite
from colift.leaderboard.core.board import Board
from colift.leaderboard.service.app import create_app
from colift.leaderboard.views.task import task_view

LEVEL = (
    "sometimes after a change of mind",
    "so giving up never pays",
    "colift validity FILE.csv",
    "Open questions",
)
"""Words that belong to a level table."""


@pytest.fixture
def pages(tmp_path, tiny_suite):
    """Return what reads pages of a new board of a suite as text, without tags but in code."""

    def read(suite, *paths):
        folder = tmp_path / suite
        Board.open(folder, suite).close()
        app = create_app(folder)

        async def answers():
            transport = httpx.ASGITransport(app)
            async with httpx.AsyncClient(transport=transport, base_url="http://board") as client:
                return [await client.get(path) for path in paths]

        answered = asyncio.run(answers())
        app.state.service.board.close()
        assert {each.status_code for each in answered} == {200}
        mains = (re.search("<main.*</main>", each.text, re.DOTALL)[0] for each in answered)
        return [html.unescape(re.sub("<[^>]*>", "", main)) for main in mains]

    return read


@pytest.mark.parametrize(
    ("suite", "run", "check", "said"),
    [
        ("standard-v1", "", "", ""),
        ("quick-v1", " --suite quick-v1", "", "without it the command plays"),
        ("ball-v1", " --suite ball-v1", " --suite ball-v1", "without it both commands play"),
    ],
)
def test_the_commands_on_the_submission_page_play_the_season_s_suite(
    pages, suite, run, check, said
):
    (page,) = pages(suite, "/submit")
    commands = {line.partition("#")[0].rstrip() for line in page.splitlines() if "#" in line}
    assert commands >= {f"colift run my-policy{run}", f"colift check my-policy{check}"}
    assert said in page
    assert ("names the suite of this season" in page) == bool(run)


def test_the_commands_play_those_suites_without_an_option():
    played = chosen_suite(name=None, seeds=None, recordings=None)
    checked = inspect.signature(check_command).parameters["suite"].default
    assert task_view(played.name).run == ""
    assert task_view(checked).check == ""


def test_the_method_of_a_level_table_is_about_it(pages):
    method, questions = pages("quick-v1", "/method", "/open")
    for words in LEVEL:
        assert words in method
    assert "colift run POLICY --suite quick-v1  # the public lifts" in method
    assert questions.strip().startswith("Open questions")


@pytest.mark.parametrize("suite", ["ball-v1", "intent-v1"])
def test_the_method_of_another_task_is_about_that_task(pages, suite):
    board, method, questions = pages(suite, "/", "/method", "/open")
    summary = type(make_suite(suite).scenarios[0].task).__doc__.partition("\n")[0]
    for page in (board, method):
        assert f"Their task: {summary[0].lower()}{summary[1:]}" in page
        for words in LEVEL:
            assert words not in page
    assert f"colift run POLICY --suite {suite}" in method
    assert questions.strip().startswith("These questions are about the suites of colift in which")


def test_references_that_have_not_been_played_are_not_explained(pages):
    (method,) = pages("tiny", "/method")
    assert "oracle" not in method
    assert "best known" not in method
    assert "better than it beyond chance" in method
