"""Names of the formats of motion files that are no recordings, by the first bytes of a file."""

import re
from typing import Final

FIRST: Final = 4096
"""Bytes from which a format is recognised."""

AMC: Final = "an AMC file"
BVH: Final = "a BVH file"
C3D: Final = "a C3D file"
MOTIVE: Final = "a CSV file of OptiTrack Motive"
NUMPY: Final = "an array of NumPy"
QUALISYS: Final = "a TSV file of Qualisys Track Manager"
ROSTOPIC: Final = "the output of rostopic echo -p, with times in nanoseconds"
STO: Final = "a STO or MOT file of OpenSim"
TRC: Final = "a TRC file of OpenSim or Cortex"
VICON: Final = "a file of Vicon Nexus"

FORMATS: Final = {
    rb"[\x01-\x08\x0b-\x1f]P": C3D,
    rb"HIERARCHY\b": BVH,
    rb'"?PathFileType"?[\t,; ]': TRC,
    rb"[^\0]*^endheader\b": STO,
    rb"(NO_OF_(FRAMES|CAMERAS|MARKERS|BODIES)|FILE_VERSION)\t": QUALISYS,
    rb'"?Format Version"?[,;\t]': MOTIVE,
    rb'"?(Trajectories|Devices|Joints|Segments|Model Outputs)"?[,;\s]*$': VICON,
    rb"%time,": ROSTOPIC,
    rb"#ROSBAG|\x89MCAP|SQLite format 3": "a bag of ROS",
    rb":(FULLY-SPECIFIED|DEGREES)|#!OML:ASF": AMC,
    rb":VERSION\b|# AST/ASF": "an ASF file",
    rb"Kaydara FBX|; FBX": "an FBX file",
    rb"XDF:": "an XDF file of LabRecorder",
    rb"<\?xml|<mvnx|<!DOCTYPE|<html": "an XML or HTML file",
    rb"PK\x03\x04": "a ZIP archive, or a workbook of Excel or LibreOffice",
    rb"\xd0\xcf\x11\xe0": "a workbook of old Excel",
    rb"MATLAB 5\.0 MAT-file": "a MAT file of MATLAB",
    rb"\x89HDF": "an HDF5 file, or a MAT file of MATLAB",
    rb"\x93NUMPY": NUMPY,
    rb"PAR1": "a Parquet file",
    rb"\x80[\x02-\x05]": "a pickle of Python",
    rb"\x1f\x8b|BZh|\xfd7zXZ|7z\xbc\xaf": "a compressed file",
    rb"%PDF-|\x89PNG|\xff\xd8\xff|....ftyp|RIFF": "a document, picture or film",
    rb"\s*[{\[]": "a JSON file",
}
"""Formats by a pattern of their first bytes, in any case, where ``$`` ends a line."""

REMEDIES: Final = (
    ("bag", "write the poses as CSV: rostopic echo -b BAG -p TOPIC, or ros2 topic echo --csv"),
    ("ASF", "it is a skeleton; give the AMC file of its motion, with this file beside it"),
    ("FBX", "export BVH"),
    ("XML", "export C3D, BVH or CSV (Xsens MVN: C3D, or an Excel sheet saved as CSV)"),
    ("ZIP", "save the sheet as CSV, or unpack the archive"),
    ("Excel", "save the sheet as CSV"),
    ("compressed", "unpack it"),
    ("document", "give the data instead"),
    ("pickle", "it can run code when it is loaded; write the positions as CSV or a .npy file"),
    ("", "write the times and positions of the hand as CSV"),
)
"""Ways out by a word in the name of a format."""


def foreign_format(data: bytes) -> str:
    """Return the name of the format of a file that is no table; empty if it is none of these.

    Parameters
    ----------
    data
        The first :data:`FIRST` bytes or more.
    """
    start = data[:FIRST].removeprefix(b"\xef\xbb\xbf").lstrip(b"\r\n").replace(b"\r", b"\n")
    flags = re.MULTILINE | re.IGNORECASE
    return next((name for form, name in FORMATS.items() if re.match(form, start, flags)), "")


def remedy(name: str) -> str:
    """Return the way to the data of a format that colift does not read."""
    return next(text for word, text in REMEDIES if word in name)
