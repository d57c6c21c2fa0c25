"""Random requests, made from the OpenAPI document: no server error, and only answers it names."""

import pytest
import schemathesis
from colift.leaderboard.service.app import api_router
from fastapi import FastAPI
from hypothesis import HealthCheck, given, settings
from schemathesis import GenerationMode

EXAMPLES = 25

NOTHING_ASKED = ("GET /api/v1/seasons", "GET /api/v1/rules")


@schemathesis.serializer("application/zip")
def as_it_is(context, value):
    """Send a body as it was drawn."""
    return value


def operations():
    app = FastAPI()
    app.include_router(api_router())
    schema = schemathesis.openapi.from_dict(app.openapi())
    return [found.ok() for found in schema.get_all_operations()]


OPERATIONS = operations()


def test_all_routes_are_described(client):
    document = client.get("/api/v1/openapi.json").json()
    described = {(op.method.upper(), op.path) for op in OPERATIONS} | {("GET", "/healthz")}
    assert described == {
        (method.upper(), path) for path, methods in document["paths"].items() for method in methods
    }


def test_every_parameter_says_what_it_is(client):
    document = client.get("/api/v1/openapi.json").json()
    silent = [
        (path, parameter["name"])
        for path, methods in document["paths"].items()
        for operation in methods.values()
        for parameter in operation.get("parameters", ())
        if not parameter.get("description")
    ]
    assert silent == []


@pytest.mark.slow
@pytest.mark.parametrize(
    ("operation", "mode"),
    [
        pytest.param(operation, mode, id=f"{operation.label}, {mode.value}")
        for operation in OPERATIONS
        for mode in GenerationMode
        # Who gives nothing gives nothing wrong.
        if mode is GenerationMode.POSITIVE or operation.label not in NOTHING_ASKED
    ],
)
def test_no_request_is_a_server_error(url, ada, operation, mode):
    """Each answer is one that the document has for the route, in the shape that it says."""

    @settings(
        max_examples=EXAMPLES,
        derandomize=True,
        deadline=None,
        database=None,
        suppress_health_check=list(HealthCheck),
    )
    @given(case=operation.as_strategy(generation_mode=mode))
    def ask(case):
        headers = ada if operation.method == "post" and len(str(case.body)) % 2 else {}
        case.call_and_validate(base_url=url, headers=headers)

    ask()
