"""The Croissant metadata of a set: ``croissant.json`` in its folder.

Croissant is a vocabulary for machine-readable descriptions of data sets, JSON-LD over schema.org
(version 1.0, http://mlcommons.org/croissant/1.0), with terms for responsible use (RAI). Files are
named by their place in the folder, with their SHA-256. The steps of a LeRobot set are also
described as records, since a reader of Croissant knows Parquet; it does not know HDF5.
"""

import hashlib
import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Final

from colift.benchmark.export.lerobot_writer import INFO
from colift.benchmark.export.provenance import STAMP, Provenance

CROISSANT: Final = "croissant.json"

VERSION: Final = "http://mlcommons.org/croissant/1.0"

KINDS: Final[Mapping[str, str]] = {
    ".parquet": "application/x-parquet",
    ".json": "application/json",
    ".hdf5": "application/x-hdf5",
    ".md": "text/markdown",
}
"""Media types of the files by their suffix."""

TYPES: Final[Mapping[str, str]] = {
    "float32": "sc:Float",
    "int64": "sc:Integer",
    "bool": "sc:Boolean",
}
"""Croissant's types of LeRobot's."""

_TERMS: Final = (
    "citeAs column equivalentProperty extract field fileObject fileProperty fileSet format "
    "includes isLiveDataset "
    "jsonPath key md5 parentField path recordSet references regex repeated replace samplingRate "
    "separator source subField transform"
)

CONTEXT: Final[Mapping[str, Any]] = {
    "@language": "en",
    "@vocab": "https://schema.org/",
    "sc": "https://schema.org/",
    "cr": "http://mlcommons.org/croissant/",
    "rai": "http://mlcommons.org/croissant/RAI/",
    "dct": "http://purl.org/dc/terms/",
    "conformsTo": "dct:conformsTo",
    "data": {"@id": "cr:data", "@type": "@json"},
    "dataType": {"@id": "cr:dataType", "@type": "@vocab"},
    "examples": {"@id": "cr:examples", "@type": "@json"},
    **{name: f"cr:{name}" for name in _TERMS.split()},
}
"""The context that the specification prescribes (section "Namespaces")."""


def croissant(
    folder: Path,
    provenance: Provenance,
    *,
    about: str,
    people: str,
    shows: Sequence[str],
    licence: str,
) -> str:
    """Return the metadata of a finished folder as JSON-LD.

    Parameters
    ----------
    folder
        The folder with all other files of the set.
    provenance
        The origin of the set.
    about, people, shows, licence
        As for :func:`.card`.
    """
    files = sorted(path for path in folder.rglob("*") if path.is_file() and path.name != CROISSANT)
    content = {
        "@context": CONTEXT,
        "@type": "sc:Dataset",
        "conformsTo": VERSION,
        "name": provenance.name,
        "description": f"{about} Made by: {provenance.source}",
        "version": "1.0.0",
        "license": licence,
        "isBasedOn": f"colift {provenance.colift}, {provenance.suite} ({provenance.suite_digest})",
        "rai:dataCollection": f"{about} People: {people}. {STAMP} has the origin of every number.",
        "rai:dataLimitations": " ".join(shows),
        "rai:personalSensitiveInformation": people,
        "distribution": [_file(path, folder) for path in files],
        **_records(folder),
    }
    return json.dumps(content, indent=2, ensure_ascii=False) + "\n"


def _file(path: Path, folder: Path) -> dict[str, str]:
    place = path.relative_to(folder).as_posix()
    return {
        "@type": "cr:FileObject",
        "@id": place,
        "name": place,
        "contentUrl": place,
        "encodingFormat": KINDS.get(path.suffix, "application/octet-stream"),
        "sha256": hashlib.sha256(path.read_bytes()).hexdigest(),
    }


def _records(folder: Path) -> dict[str, Any]:
    """Return the steps of a LeRobot set as records, one set for each of its data files."""
    if not (folder / INFO).is_file():
        return {}
    features = json.loads((folder / INFO).read_text())["features"]
    files = sorted((folder / "data").rglob("*.parquet"))
    return {"recordSet": [_steps(path.relative_to(folder).as_posix(), features) for path in files]}


def _steps(place: str, features: Mapping[str, Mapping[str, Any]]) -> dict[str, Any]:
    steps = f"steps/{place.removesuffix('.parquet')}"
    return {
        "@type": "cr:RecordSet",
        "@id": steps,
        "name": steps,
        "description": "One record a step, in the order of the lifts.",
        "field": [
            {
                "@type": "cr:Field",
                "@id": f"{steps}/{name}",
                "name": name,
                "description": f"{feature['dtype']}, shape {tuple(feature['shape'])}",
                "dataType": TYPES[feature["dtype"]],
                **({"repeated": True} if feature["shape"] != [1] else {}),
                "source": {"fileObject": {"@id": place}, "extract": {"column": name}},
            }
            for name, feature in features.items()
        ],
    }
