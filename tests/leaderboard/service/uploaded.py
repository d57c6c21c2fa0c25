"""Uploads, and what they leave."""

import io
import zipfile

SUBMIT = "/api/v1/submissions"
MANY = 2**30


def packed(*entries):
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in entries:
            archive.writestr(name, content)
    return file.getvalue()


def left_over(folder):
    return list((folder / "submissions").glob(".*"))
