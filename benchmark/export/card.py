"""The data card of a set: ``README.md`` in its folder."""

from collections.abc import Sequence
from typing import Final

from colift.benchmark.export.contents import Contents
from colift.benchmark.export.provenance import STAMP, Provenance

CARD: Final = "README.md"

_FRONT: Final = """\
---
license: {licence}
task_categories:
- robotics
tags:
- human-robot-interaction{tags}
---

"""

_LEROBOT: Final = """
- LeRobot
configs:
- config_name: default
  data_files: data/*/*.parquet"""


def card(
    provenance: Provenance,
    contents: Contents,
    form: str,
    *,
    about: str,
    people: str,
    shows: Sequence[str],
    licence: str,
) -> str:
    """Return the text of a data card.

    Parameters
    ----------
    provenance
        The origin of the set.
    contents
        Its size.
    form
        Its format, ``minari`` or ``lerobot``.
    about
        A paragraph on the lifts and the robot.
    people
        The people at the other end, and their seeds.
    shows
        Sentences on the conclusions that the set allows, and those that it does not.
    licence
        Identifier of the licence.
    """
    behaviours = ", ".join(f"{name} {count}" for name, count in contents.behaviours.items())
    rows = {
        "lifts": f"{contents.lifts} ({behaviours})",
        "steps": f"{contents.steps}, one every {provenance.control_period:g} s",
        "dropped tables": str(contents.dropped),
        "people": people,
        "seeds": f"{contents.first_seed} to {contents.last_seed}",
        "policy": f"{provenance.policy} (digest {provenance.policy_digest})",
        "suite": f"{provenance.suite} (digest {provenance.suite_digest})",
        "view": _view(provenance),
        "colift": provenance.colift,
        "licence": licence,
    }
    if contents.empty:
        rows["left out"] = f"{contents.empty} lifts without a step: the policy failed at once"
    table = "\n".join(f"| {name} | {value} |" for name, value in rows.items())
    points = "\n".join(f"- {each}" for each in shows)
    front = _FRONT.format(licence=licence.lower(), tags=_LEROBOT if form == "lerobot" else "")
    return (
        f"{front}# {provenance.name}\n\n{about}\n\n"
        f"Made by `{provenance.source}`; `{STAMP}` has the origin for programs.\n\n"
        f"| | |\n|---|---|\n{table}\n\n"
        f"## What it can and cannot show\n\n{points}\n\n"
        f"## Reading it\n\n{_READING[form]}{_replay(provenance, form)}"
    )


def _view(provenance: Provenance) -> str:
    agents = "both agents" if provenance.view == "both" else "the robot"
    if provenance.converted:
        return f"{agents}; a person's references as changes of a hand command"
    return agents


def _replay(provenance: Provenance, form: str) -> str:
    if form != "minari":
        return ""
    if provenance.converted:
        return "The converted actions do not replay; those of `--view both` do.\n"
    return (
        "The environment of colift with these, and the stored actions, gives the stored "
        "observations and rewards, bit for bit, on the platform that made them.\n"
    )


_READING: Final = {
    "minari": (
        "```python\nimport minari\n\n"
        'lifts = minari.MinariDataset("FOLDER/data")\n'
        "lift = lifts[0]  # observations, actions, rewards, terminations, truncations\n```\n\n"
        "The metadata of each lift name its scenario and seed. "
    ),
    "lerobot": (
        "The layout is that of LeRobot v3.0: `LeRobotDataset(NAME, root=FOLDER)`, or any reader of "
        "Parquet. Numbers are single precision. `meta/episodes/` names the scenario and the seed "
        "of each lift.\n"
    ),
}
