"""The template of a submission with an author, as boards want it."""

from pathlib import Path

from colift.agents.submissions.new import write_template

AUTHOR = "Ada Lovelace"


def write_signed(folder: Path) -> None:
    """Write the template, with the name of an author."""
    write_template(folder)
    manifest = folder / "policy.toml"
    manifest.write_text(manifest.read_text().replace("Your Name", AUTHOR))
