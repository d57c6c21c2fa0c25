"""The order of the gallery: from a first policy to the finer points of the paper."""

from typing import Final

ORDER: Final = (
    "plot_policy.py",
    "plot_lift.py",
    "plot_view.py",
    "plot_environment.py",
    "plot_force.py",
    "plot_plans.py",
    "plot_people.py",
    "plot_recording.py",
    "plot_pairs.py",
    "plot_report.py",
    "plot_smoothness.py",
    "plot_latency.py",
    "plot_speed.py",
    "plot_confidence.py",
    "plot_readings.py",
)


class SimpleFirst:
    """The place of a script in the gallery; one that has none fails the build."""

    def __init__(self, folder: str) -> None:
        pass

    def __call__(self, name: str) -> int:
        """Return the place of a script."""
        if name not in ORDER:
            raise ValueError(f"examples/{name} has no place in docs/extensions/gallery_order.py")
        return ORDER.index(name)
