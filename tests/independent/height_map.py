"""Maps as docs/formats.md describes them: text matrices with header comments, and NPY files with a sidecar.

Heights are in nm (rates in nm/s), lengths in mm. heights[row, column]; row 0 has the smallest y, column 0 the smallest
x; NaN is no data.
"""

import dataclasses
import json
import pathlib

import numpy


@dataclasses.dataclass
class HeightMap:
    heights: numpy.ndarray
    pitch: tuple  # (x, y) [mm]
    origin: tuple  # centre of pixel (0, 0), (x, y) [mm]
    unit: str = "nm"
    history: tuple = ()

    def x(self):
        """Centres of the columns [mm]."""
        return self.origin[0] + self.pitch[0] * numpy.arange(self.heights.shape[1])

    def y(self):
        """Centres of the rows [mm]."""
        return self.origin[1] + self.pitch[1] * numpy.arange(self.heights.shape[0])


def write_text(file, height_map):
    """Writes a text matrix whose header says pitch, origin and unit."""
    lines = [f"# pitch_mm: {height_map.pitch[0]!r},{height_map.pitch[1]!r}",
             f"# origin_mm: {height_map.origin[0]!r},{height_map.origin[1]!r}", f"# unit: {height_map.unit}"]
    lines += [",".join(repr(float(value)) for value in row) for row in height_map.heights]
    pathlib.Path(file).write_text("\n".join(lines) + "\n", encoding="ascii")


def pair(text):
    """One number or two: "0.1" is (0.1, 0.1)."""
    numbers = [float(word) for word in text.split(",")]
    return (numbers[0], numbers[-1])


def read_header(lines):
    """The values of the comments `# key: value`; `made` comes as a tuple in the order of the file."""
    header = {"made": ()}
    for line in lines:
        key, _, value = line.removeprefix("#").partition(":")
        if key.strip() == "made":
            header["made"] += (value.strip(),)
        else:
            header[key.strip()] = value.strip()
    return header


def read_text(file, separator=","):
    """Reads a text matrix; separator None stands for blanks."""
    lines = pathlib.Path(file).read_text(encoding="utf-8").splitlines()
    header = read_header(line for line in lines if line.startswith("#"))
    rows = [[float(word) for word in line.split(separator)] for line in lines if not line.startswith("#")]
    return HeightMap(numpy.array(rows), pair(header["pitch_mm"]), pair(header["origin_mm"]), header["unit"],
                     header["made"])


def read_npy(file):
    """Reads an NPY file and its sidecar."""
    sidecar = json.loads(pathlib.Path(f"{file}.json").read_text(encoding="utf-8"))
    return HeightMap(numpy.load(file), tuple(sidecar["pitch_mm"]), tuple(sidecar["origin_mm"]), sidecar["unit"],
                     tuple(sidecar["history"]))
