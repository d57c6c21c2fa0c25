"""The page of the API: the operations of its OpenAPI document, and their objects."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Final

from colift.leaderboard.client import API
from colift.leaderboard.views.page import Content, Page, Visit


@dataclass(frozen=True, kw_only=True)
class Property:
    """A key of an object, or a parameter of a request."""

    name: str
    kind: str
    """Its type in a few words."""
    meaning: str
    place: str = ""
    """``path`` or ``query``; empty for a key."""


@dataclass(frozen=True, kw_only=True)
class Response:
    """One kind of answer to an operation."""

    status: str
    """HTTP status."""
    meaning: str
    kinds: tuple[str, ...]
    """Media types with the type of the content in a few words."""


@dataclass(frozen=True, kw_only=True)
class Operation:
    """A method on a path."""

    method: str
    path: str
    description: str
    needs_token: bool
    """Whether it requires the header ``Authorization``."""
    body: str
    """Media types and meaning of the body; empty if it has none."""
    parameters: tuple[Property, ...]
    responses: tuple[Response, ...]


@dataclass(frozen=True, kw_only=True)
class Schema:
    """An object in bodies and responses."""

    name: str
    meaning: str
    properties: tuple[Property, ...]


def operations(document: dict[str, Any]) -> Iterator[Operation]:
    """Yield the operations of an OpenAPI document, in its order."""
    for path, methods in document["paths"].items():
        for method, content in methods.items():
            yield Operation(
                method=method.upper(),
                path=path,
                description=content["description"],
                needs_token="security" in content,
                body=_body(content.get("requestBody")),
                parameters=tuple(
                    _property(each["name"], each, each["schema"], each["in"])
                    for each in content.get("parameters", ())
                ),
                responses=tuple(
                    _response(status, answer)
                    for status, answer in sorted(content["responses"].items())
                ),
            )


def schemas(document: dict[str, Any]) -> Iterator[Schema]:
    """Yield the objects that an OpenAPI document describes, in its order."""
    for name, content in document["components"]["schemas"].items():
        yield Schema(
            name=name,
            meaning=content.get("description", ""),
            properties=tuple(
                _property(key, each, each) for key, each in content.get("properties", {}).items()
            ),
        )


def _body(content: dict[str, Any] | None) -> str:
    if content is None:
        return ""
    return f"{', '.join(content['content'])}. {content.get('description', '')}".strip()


def _property(
    name: str, content: dict[str, Any], schema: dict[str, Any], place: str = ""
) -> Property:
    meaning = content.get("description", "")
    return Property(name=name, kind=kind_of(schema), meaning=meaning, place=place)


def _response(status: str, content: dict[str, Any]) -> Response:
    return Response(
        status=status,
        meaning=content["description"],
        kinds=tuple(
            f"{media}: {kind_of(each['schema'])}" if each.get("schema") else media
            for media, each in content.get("content", {}).items()
        ),
    )


def kind_of(schema: dict[str, Any]) -> str:
    """Return a JSON schema in a few words."""
    if "$ref" in schema:
        return str(schema["$ref"]).rpartition("/")[2]
    if "anyOf" in schema:
        return " or ".join(kind_of(each) for each in schema["anyOf"])
    if "enum" in schema:
        return " or ".join(map(repr, schema["enum"]))
    if schema.get("type") == "array":
        return f"list of {kind_of(schema['items'])}" if schema.get("items") else "list"
    return " ".join(str(schema[key]) for key in ("type", "format") if key in schema) or "anything"


def _api(visit: Visit) -> Content:
    document = visit.document()
    return {
        "info": document["info"],
        "operations": list(operations(document)),
        "schemas": list(schemas(document)),
    }


PAGES: Final = (
    Page(
        name="api",
        url="/api",
        view=_api,
        template="api.html",
        meaning="The JSON interface; the same as this page of the documentation.",
    ),
    Page(name="openapi", url=f"{API}/openapi.json"),
)
