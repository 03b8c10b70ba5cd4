"""A reader of ASCII surface data files after ISO 25178-71.

It is as strict as other people's: the file is ASCII, has the fields of the standard, and its dates are dates.
"""

import dataclasses
import datetime
import pathlib

import numpy

MAGIC = b"aISO-1.0\r\n"
FIELDS = {
    "ManufacID": str, "CreateDate": str, "ModDate": str, "NumPoints": int, "NumProfiles": int, "Xscale": float,
    "Yscale": float, "Zscale": float, "Zresolution": float, "Compression": int, "DataType": int, "CheckType": int
}
DATE = "%d%m%Y%H%M"
DOUBLE = 7  # the code of the data type


@dataclasses.dataclass
class SdfFile:
    heights: numpy.ndarray  # [m]; a row a profile, the first one at y = 0
    x_scale: float  # distance of the points of a profile [m]
    y_scale: float  # distance of the profiles [m]
    created: datetime.datetime
    modified: datetime.datetime
    trailer: list


def read_sdf(file):
    """Reads a file whole; what the standard does not have is an error."""
    content = pathlib.Path(file).read_bytes()
    if not content.startswith(MAGIC):
        raise ValueError(f"{file} begins with {content[:10]}")
    header_text, data, trailer, end = content.removeprefix(MAGIC).decode("ascii").split("*")
    if end.strip():
        raise ValueError(f"{file}: {end!r} after the trailer")
    header = {}
    for line in header_text.split("\r\n")[:-1]:
        name, value = (word.strip() for word in line.split("="))
        header[name] = FIELDS[name](value)
    if list(header) != list(FIELDS) or (header["Compression"], header["CheckType"]) != (0, 0):
        raise ValueError(f"{file}: {header}")
    if header["DataType"] != DOUBLE:
        raise ValueError(f"{file}: DataType = {header['DataType']}")
    values = numpy.array([float("nan" if word == "BAD" else word) for word in data.split()])
    dates = [datetime.datetime.strptime(header[name], DATE) for name in ("CreateDate", "ModDate")]
    return SdfFile(values.reshape(header["NumProfiles"], header["NumPoints"]) * header["Zscale"], header["Xscale"],
                   header["Yscale"], *dates, trailer.split("\r\n")[1:-1])
