"""Instructions for installing libraries of an extra of colift."""

import json
import shlex
from importlib.metadata import distributions
from pathlib import Path
from urllib.parse import unquote, urlsplit


def how_to_install(extra: str) -> str:
    """Return the command that installs an extra, for the sources that colift was installed from.

    Colift is in no package registry: its bare name would install nothing, or another project.
    """
    source, editable = _source()
    if source is None:
        return f"pip install 'CLONE[{extra}]', where CLONE is the folder of colift's sources"
    if editable and (source / "uv.lock").exists():
        return f"uv sync --all-extras --project {shlex.quote(str(source))}"
    return f"pip install '{source}[{extra}]'"


def _source() -> tuple[Path | None, bool]:
    """Return the folder that colift was installed from, if it is there, and whether editable."""
    found = (each.read_text("direct_url.json") for each in distributions(name="colift"))
    origin = json.loads(next(filter(None, found), "{}"))
    address = urlsplit(origin.get("url", ""))
    folder = Path(unquote(address.path))
    if address.scheme != "file" or not (folder / "pyproject.toml").is_file():
        return None, False
    return folder, bool(origin.get("dir_info", {}).get("editable"))
