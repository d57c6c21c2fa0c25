"""The conformance check of suites: what is registered passes, and each rule is enforced."""

import dataclasses

import pytest
from colift.base.registry import SUITES, entries
from colift.benchmark.suites.suite import make_suite
from colift.testing import check_suite


@pytest.mark.parametrize("name", entries(SUITES))
def test_every_suite_conforms(name):
    check_suite(make_suite(name))


def test_a_suite_that_breaks_a_rule_is_refused():
    quick = make_suite("quick-v1")
    first = quick.scenarios[0]
    heavier = dataclasses.replace(first.subject, mass=1.4)
    for changes, rule in (
        ({"name": "quick\n"}, "ASCII"),
        (
            {"scenarios": (dataclasses.replace(first, subject=heavier),)},
            "does not rebuild it",
        ),
    ):
        with pytest.raises(AssertionError, match=rule):
            check_suite(dataclasses.replace(quick, **changes))


@pytest.mark.parametrize("value", [[1], lambda: make_suite("quick-v1")])
def test_a_suite_is_an_object(value):
    with pytest.raises(AssertionError, match=r"check_suite takes a Suite, got a (list|function)"):
        check_suite(value)
