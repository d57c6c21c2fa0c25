"""The JSON Schema of ``results.json``."""

from collections.abc import Mapping
from dataclasses import fields
from typing import Any, Final

from colift.benchmark.channels import Link
from colift.benchmark.episode.metric import LEADING, Metric, Metrics, on_boards
from colift.benchmark.tasks.level.task import LEVEL

DIALECT: Final = "https://json-schema.org/draft/2020-12/schema"

Schema = dict[str, Any]

COUNT: Final[Schema] = {"type": "integer", "minimum": 0}
NUMBER: Final[Schema] = {"type": "number"}
NUMBER_OR_NULL: Final[Schema] = {"type": ["number", "null"]}
TEXT: Final[Schema] = {"type": "string"}
FLAG: Final[Schema] = {"type": "boolean"}
INTERVAL: Final[Schema] = {
    "type": "array",
    "prefixItems": [NUMBER, NUMBER],
    "items": False,
    "minItems": 2,
}


def results_schema(metrics: Metrics = LEVEL.metrics) -> Schema:
    """Return the JSON Schema of ``results.json``, the content of :meth:`.Results.plain`.

    Every key except ``channel``, ``session`` and ``goals`` is required; no other is allowed.

    Parameters
    ----------
    metrics
        The metrics of the suite's task.
    """
    interval = {"anyOf": [INTERVAL, {"type": "null"}]}
    estimate = _object({"mean": NUMBER, "ci95": interval})
    means = {
        name: _object(
            {
                "mean": _of(NUMBER_OR_NULL, "Mean over the lifts with a value, null without any."),
                "missing": _of(COUNT, "Lifts without a value."),
            },
            _label(metric),
        )
        for name, metric in metrics.items()
    }
    summary = {
        "episodes": _of(COUNT, "Lifts."),
        "failed": _of(COUNT, "Failed lifts."),
        "goal_missed": _of(COUNT, "Lifts in which the human did not reach the intended height."),
        LEADING: _object(
            {
                "mean": NUMBER,
                "iqm": _of(NUMBER, "Interquartile mean."),
                "ci95": _of(
                    interval,
                    "95 % confidence interval of the mean, for other people; null if all lifts are "
                    "of one person.",
                ),
            },
            _label(metrics[LEADING]),
        ),
        "vs_human": {
            "anyOf": [estimate, {"type": "null"}],
            "description": "RMSE divided by that of two people on the same lift: "
            "geometric mean over the lifts.",
        },
        "rougher": _of(
            {"type": ["array", "null"], "items": TEXT},
            "Metrics by which the policy is rougher than two people; null if that is not known.",
        ),
        **{name: mean for name, mean in means.items() if name != LEADING},
        "step_ms": _object(
            {"p50": NUMBER_OR_NULL, "p99": NUMBER_OR_NULL},
            "Percentiles of the policy's time per step [ms]; null if it never acted.",
        ),
        "real_time": _of(
            {"type": ["boolean", "null"]},
            "Whether the policy is real-time capable; null if it never acted.",
        ),
    }
    group = {
        "behaviour": TEXT,
        "subject": TEXT,
        "episodes": _of(COUNT, "Lifts."),
        "failed": _of(COUNT, "Failed lifts."),
        **means,
        "human_human_rmse_mm": _object(
            {"mean": NUMBER_OR_NULL}, "RMSE of two people in the stratum [mm]."
        ),
        "vs_human": _object(
            {"mean": NUMBER_OR_NULL}, "Geometric mean of the ratio to it over these lifts."
        ),
    }
    baseline = {
        LEADING: estimate,
        **{metric.name: _object({"mean": NUMBER_OR_NULL}) for metric in on_boards(metrics)},
    }
    content = {
        "colift": _of(TEXT, "Version of colift."),
        "suite": _of(TEXT, "Name of the suite."),
        "suite_digest": _of(TEXT, "Digest of the suite."),
        "scoring": _of(COUNT, "Version of the scores."),
        "complete": _of(FLAG, "Whether every lift of the suite was played."),
        "policy": _object({"name": TEXT, "digest": TEXT}, "The policy and its digest."),
        "isolation": _of(TEXT, "Isolation level of the policy."),
        "evaluator_faults": _of(COUNT, "Lifts played again because the machine had failed."),
        "summary": _object(summary, "The numbers of the run."),
        "groups": {
            "type": "array",
            "items": _object(group),
            "description": "The means in each stratum.",
        },
        "baselines": {
            "type": "object",
            "additionalProperties": _object(baseline),
            "description": "The baselines on the same lifts, by name.",
        },
    }
    schema = _object(content)
    schema["properties"]["channel"] = _object(
        {"down": _link(), "up": _link(), "code": _of(TEXT, "Hash of what a channel does.")},
        "The channel to the policy; only if there was one.",
    )
    curve = {"type": "array", "items": estimate}
    schema["properties"]["session"] = _object(
        {
            "counted": _of(COUNT, "Lifts at the end of a session that count."),
            "rmse_mm": _of(curve, "Mean RMSE of each lift of a session [mm]."),
            "human_human_rmse_mm": _of(
                {"anyOf": [curve, {"type": "null"}]},
                "That of two people; null without this baseline.",
            ),
            "change_mm": _of(
                {"anyOf": [estimate, {"type": "null"}]},
                "Rise of the RMSE in the lift of a changed habit [mm]; null if nobody has one.",
            ),
            "trust": _of(
                curve,
                "Mean trust of the people after each lift, from 0 to 1; empty if it is not known.",
            ),
        },
        "The errors lift by lift; only of suites with sessions.",
    )
    schema["properties"]["goals"] = _object(
        {
            "error_mm": _object(
                {
                    "mean": _of(NUMBER_OR_NULL, "Mean over the lifts that did not fail."),
                    "missing": _of(COUNT, "Failed lifts."),
                },
                "Goal error.",
            ),
            "missed": _of(COUNT, "Lifts in which a goal was not reached."),
            "lifts": {
                "type": "object",
                "additionalProperties": NUMBER_OR_NULL,
                "description": "Goal error by trial; null if the lift failed.",
            },
        },
        "Goal errors of live lifts [mm]; only of these, and not in older bundles.",
    )
    return {"$schema": DIALECT, "title": "results.json of a colift bundle", **schema}


def _link() -> Schema:
    """Return the schema of a direction of a channel; see :class:`.channel.Link`."""
    return _object(
        {each.name: TEXT if isinstance(each.default, str) else NUMBER for each in fields(Link)}
    )


def _label(metric: Metric) -> str:
    return f"{metric.label} [{metric.unit}]." if metric.unit else f"{metric.label}."


def _of(kind: Schema, description: str) -> Schema:
    return {**kind, "description": description}


def _object(properties: Mapping[str, Schema], description: str = "") -> Schema:
    """Return the schema of an object with exactly these keys."""
    made = {
        "type": "object",
        "properties": dict(properties),
        "required": list(properties),
        "additionalProperties": False,
    }
    return _of(made, description) if description else made
