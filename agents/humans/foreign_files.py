"""Names of the formats of motion files that are no recordings, by the first bytes of a file."""

import re
from typing import Final

FIRST: Final = 4096
"""Bytes from which a format is recognised."""

FORMATS: Final = {
    rb"[\x01-\x1f]P": "a C3D file",
    rb"HIERARCHY\b": "a BVH file",
    rb"PathFileType\t": "a TRC file of OpenSim or Cortex",
    rb"[^\0]*^endheader\b": "a STO or MOT file of OpenSim",
    rb"NO_OF_FRAMES\b": "a TSV file of Qualisys Track Manager",
    rb'"?Format Version"?,': "a CSV file of OptiTrack Motive",
    rb'"?(Trajectories|Devices|Joints|Segments|Model Outputs)"?[,;\s]*$': "a file of Vicon Nexus",
    rb"%time,": "the output of rostopic echo -p, with times in nanoseconds",
    rb"#ROSBAG|\x89MCAP": "a bag of ROS",
    rb":(FULLY-SPECIFIED|DEGREES)|#!OML:ASF": "an AMC file",
    rb":VERSION\b|# AST/ASF": "an ASF file",
    rb"Kaydara FBX": "an FBX file",
    rb"XDF:": "an XDF file of LabRecorder",
    rb"<\?xml|<mvnx|<!DOCTYPE|<html": "an XML or HTML file",
    rb"PK\x03\x04": "a ZIP archive, or a workbook of Excel or LibreOffice",
    rb"\xd0\xcf\x11\xe0": "a workbook of old Excel",
    rb"MATLAB 5\.0 MAT-file": "a MAT file of MATLAB",
    rb"\x89HDF": "an HDF5 file, or a MAT file of MATLAB",
    rb"\x93NUMPY": "an array of NumPy",
    rb"PAR1": "a Parquet file",
    rb"\x80[\x02-\x05]": "a pickle of Python",
    rb"\x1f\x8b|BZh|\xfd7zXZ|7z\xbc\xaf": "a compressed file",
    rb"%PDF-|\x89PNG|\xff\xd8\xff|....ftyp": "a document, picture or film",
    rb"\s*[{\[]": "a JSON file",
}
"""Formats by a pattern of their first bytes, in any case, where ``$`` ends a line."""


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
