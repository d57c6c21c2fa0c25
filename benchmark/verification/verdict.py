"""The outcome of a verification."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Final

from colift.benchmark.bundle import Results, one_line
from colift.benchmark.execution.provenance import POLICIES_ONLY
from colift.benchmark.execution.runner import Run

PROVES: Final = (
    "This proves that the scores follow from the logged actions, not who produced them: only a "
    "board's own run gives a row."
)

UNPROVEN: Final = (
    "Taken as said: the policy's name and digest, its step times, what it reports or prints of "
    "itself, why it failed, the isolation, the evaluator's faults, the version of colift, the "
    "platform."
)

ACTIONS_FROM_LOG: Final = (
    "The policy's actions are from the log: with other code for linear algebra or functions of "
    "arrays, a policy that uses them may act otherwise in the last bits. The humans, the world and "
    "the scores use none."
)


@dataclass(frozen=True, kw_only=True)
class Finding:
    """A fault of a bundle."""

    file: str
    """The file with the claim."""
    message: str
    """A description of the fault."""
    episode: str = ""
    """Name of the episode, such as ``pause/S3 seed 4``; empty if it is not about a single one."""
    step: int | None = None
    """The first step in which the fault shows, counted from 0."""

    def __str__(self) -> str:
        place = [self.file, self.episode, "" if self.step is None else f"step {self.step}"]
        # Names and values come from the bundle: their control sequences must not reach a terminal.
        return one_line(f"{', '.join(filter(None, place))}: {self.message}")


@dataclass(frozen=True, kw_only=True, eq=False)
class Verdict:
    """The outcome of a verification."""

    findings: tuple[Finding, ...]
    """The faults; empty if the bundle is verified."""
    suite: str = ""
    """The played suite: its registered name, found by its digest, or a description; with the
    channel, if the policy was behind one."""
    run: Run | None = None
    """The episodes with the scores of the present code; None if a replay failed."""
    results: Results | None = None
    """The results that follow from the actions; None if ``run`` is None."""
    bit_equal: bool = False
    """Whether every simulated bit equals the logged one."""
    tolerance_mm: float | None = None
    """The tolerance that was applied instead; None if bits were compared."""
    other_platform: Mapping[str, tuple[str, str]] = field(default_factory=dict)
    """Differences of the platforms by name: the entry of the bundle, and the entry here."""
    platform: Mapping[str, str] = field(default_factory=dict)
    """The fingerprint of the platform that the bundle comes from."""
    scoring: tuple[int, int] | None = None
    """The version of the scores in the bundle and here, if they differ: the bundle's scores were
    then not compared, and ``results`` has the present ones."""

    @property
    def policies_differ(self) -> bool:
        """Whether the policy, played again here, could act differently."""
        return any(name in POLICIES_ONLY for name in self.other_platform)

    @property
    def ok(self) -> bool:
        """Whether the bundle is verified as it is."""
        return not self.findings and self.run is not None and self.scoring is None

    @property
    def rescorable(self) -> bool:
        """Whether only the code of the scores has changed: the actions are verified."""
        return not self.findings and self.run is not None and self.scoring is not None

    def plain(self) -> dict[str, Any]:
        """Return the verdict, ready for JSON."""
        return {
            "verified": self.ok,
            "findings": [
                {
                    "file": each.file,
                    "episode": each.episode or None,
                    "step": each.step,
                    "message": each.message,
                }
                for each in self.findings
            ],
            "suite": self.suite or None,
            "episodes": None if self.run is None else len(self.run.episodes),
            "bit_equal": self.bit_equal,
            "tolerance_mm": self.tolerance_mm,
            "other_platform": {
                name: {"bundle": there, "here": here}
                for name, (there, here) in self.other_platform.items()
            },
            "scoring": None
            if self.scoring is None
            else {"bundle": self.scoring[0], "here": self.scoring[1]},
            "actions": ACTIONS_FROM_LOG if self.policies_differ else None,
            # A suite can have any name, even one that looks like that of a shipped suite.
            "results": self.results and {**self.results.plain(), "suite": self.suite},
            "proves": PROVES,
            "unproven": UNPROVEN,
        }
