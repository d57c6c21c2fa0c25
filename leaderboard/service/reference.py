"""The description of the API as a page, made from its OpenAPI document; nothing is loaded."""

from typing import Any, Final

from fastapi import APIRouter, Request
from fastapi.responses import HTMLResponse

from ..pages.links import ServiceLinks
from ..pages.rendering import render_page
from .dependencies import Service

router: Final = APIRouter(include_in_schema=False)


@router.get("/api")
def api_page(service: Service, request: Request) -> HTMLResponse:
    """Return the page."""
    document = request.app.openapi()
    root = str(request.scope.get("root_path", "")).rstrip("/")
    current = next(season for season in service.board.seasons() if season.current)
    return HTMLResponse(
        render_page(
            "api.html",
            ServiceLinks(root),
            season=current,
            root=root,
            url=request.app.openapi_url,
            info=document["info"],
            operations=[
                _operation(method, path, operation)
                for path, operations in document["paths"].items()
                for method, operation in operations.items()
            ],
            schemas=[
                _schema(name, schema) for name, schema in document["components"]["schemas"].items()
            ],
        )
    )


def _operation(method: str, path: str, operation: dict[str, Any]) -> dict[str, Any]:
    responses = {
        status: {**answer, "kinds": [_content(*each) for each in answer.get("content", {}).items()]}
        for status, answer in operation["responses"].items()
    }
    return {**operation, "method": method.upper(), "path": path, "responses": responses}


def _content(media: str, content: dict[str, Any]) -> str:
    return f"{media}: {schema_kind(content['schema'])}" if content.get("schema") else media


def _schema(name: str, schema: dict[str, Any]) -> dict[str, Any]:
    fields = [
        {**each, "name": key, "kind": schema_kind(each)}
        for key, each in schema.get("properties", {}).items()
    ]
    return {**schema, "name": name, "fields": fields}


def schema_kind(schema: dict[str, Any]) -> str:
    """Return a JSON schema in a few words."""
    if "$ref" in schema:
        return str(schema["$ref"]).rpartition("/")[2]
    if "anyOf" in schema:
        return " or ".join(schema_kind(each) for each in schema["anyOf"])
    if "enum" in schema:
        return " or ".join(map(repr, schema["enum"]))
    if schema.get("type") == "array":
        return f"list of {schema_kind(schema['items'])}" if schema.get("items") else "list"
    return " ".join(str(schema[key]) for key in ("type", "format") if key in schema) or "anything"
