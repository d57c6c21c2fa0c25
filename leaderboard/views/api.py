"""The page of the API: the operations of its OpenAPI document, and their objects."""

from collections.abc import Iterator
from typing import Any, Final

from colift.leaderboard.client import API
from colift.leaderboard.views.page import Content, Page, Visit

Part = dict[str, Any]
"""An operation, an object, or a part of one."""


def operations(document: dict[str, Any]) -> Iterator[Part]:
    """Yield the operations of an OpenAPI document, in its order: method, path, and the rest.

    ``body`` has media types and meaning of the body, and is empty without one. ``responses`` have
    ``status``, ``meaning``, and ``kinds``: media types with the type of the content.
    """
    for path, methods in document["paths"].items():
        for method, content in methods.items():
            yield {
                "method": method.upper(),
                "path": path,
                "description": content["description"],
                "needs_token": "security" in content,
                "body": _body(content.get("requestBody")),
                "parameters": [
                    {**_named(each["name"], each["schema"], each), "place": each["in"]}
                    for each in content.get("parameters", ())
                ],
                "responses": [
                    {
                        "status": status,
                        "meaning": answer["description"],
                        "kinds": [
                            f"{media}: {kind_of(each['schema'])}" if each.get("schema") else media
                            for media, each in answer.get("content", {}).items()
                        ],
                    }
                    for status, answer in sorted(content["responses"].items())
                ],
            }


def schemas(document: dict[str, Any]) -> Iterator[Part]:
    """Yield the objects that an OpenAPI document describes, in its order, with their keys."""
    for name, content in document["components"]["schemas"].items():
        yield {
            "name": name,
            "meaning": content.get("description", ""),
            "properties": [
                _named(key, each, each) for key, each in content.get("properties", {}).items()
            ],
        }


def _named(name: str, schema: dict[str, Any], content: dict[str, Any]) -> Part:
    """Return a key or a parameter: name, type in a few words, and meaning."""
    return {"name": name, "kind": kind_of(schema), "meaning": content.get("description", "")}


def _body(content: dict[str, Any] | None) -> str:
    if content is None:
        return ""
    return f"{', '.join(content['content'])}. {content.get('description', '')}".strip()


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
        meaning="The JSON interface, operation by operation.",
    ),
    Page(name="openapi", url=f"{API}/openapi.json"),
)
