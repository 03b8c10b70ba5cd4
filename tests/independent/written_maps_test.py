"""Opens every map format that the program writes with other people's readers; compares values, places, units, history.

The map is asymmetric in every respect: a bump at large x and y, pixels without data, pitches that differ along x and y.
"""

import hashlib
import importlib
import json
import math
import pathlib
import re
import sys
import tempfile
import unittest

import loud_unittest

try:
    import numpy
except ImportError as error:
    loud_unittest.skip_module("independent.written_maps", f"{sys.executable} has no NumPy: {error}")

import dwell_program
from height_map import HeightMap, pair, read_header, read_npy, read_text, write_text
from png_file import read_png
from sdf_file import read_sdf

STEP = "subtract:file=flat_\u00fc*.csv"  # a name that not every format can hold
HISTORY = "subtract:file=flat_\u00fc*.csv,how=strict (75 pixels with data in both)"


def module(name):
    """A module of other people, or a skip that names it."""
    try:
        return importlib.import_module(name)
    except ImportError as missing:
        raise unittest.SkipTest(f"{sys.executable} has no module {name}: {missing}") from missing


def part():
    """11 x 7 pixels with numbers of all sizes; the highest one is at large x and large y."""
    part = HeightMap(numpy.zeros((7, 11)), (0.0938, 0.25), (-1.7, 30.3))
    x, y = numpy.meshgrid(part.x() - part.x()[8], part.y() - part.y()[5])
    part.heights = 1000 / 3 * numpy.exp(-(x / 0.3) ** 2 - y**2) + x / 7
    part.heights[0, 1] = part.heights[4, 0] = math.nan
    part.heights[2, 3], part.heights[3, 2], part.heights[6, 0] = -12345.678901234567, 1.2345e-7, 0
    return part


class WrittenMap(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.part = part()
        write_text(self.folder / "part.csv", self.part)
        flat = HeightMap(numpy.zeros_like(self.part.heights), self.part.pitch, self.part.origin)
        write_text(self.folder / "flat_\u00fc*.csv", flat)

    def write(self, name, option="--write"):
        """The map written by the program under a name, after a step that changes nothing but is in the history."""
        dwell_program.run("map", "part.csv", "--step", STEP, option, name, folder=self.folder)
        return self.folder / name

    def check_values(self, heights, rounding=0.0):
        """Values to the last bit unless said otherwise, in nm; and the bump lies at large x and y."""
        numpy.testing.assert_allclose(heights, self.part.heights, rtol=rounding, atol=0, equal_nan=True)
        row, column = numpy.unravel_index(numpy.nanargmax(heights), heights.shape)
        self.assertEqual((row, column), (5, 8))

    def check_header(self, lines, history=HISTORY):
        header = read_header(lines)
        self.assertEqual(pair(header["pitch_mm"]), self.part.pitch)
        self.assertEqual(pair(header["origin_mm"]), self.part.origin)
        self.assertEqual((header["unit"], header["made"]), ("nm", (history,)))

    def test_every_format_is_checked(self):
        text = dwell_program.run("map", "--help", folder=self.folder)
        formats = re.search(r"--write FILE .*?\[nm\]: (.*)", text)[1]
        checked = {"csv", "txt", "xyz", "npy", "h5", "hdf5", "fits", "sdf"}
        self.assertEqual(set(re.findall(r"\.(\w+)", formats)), checked)

    def check_matrix(self, name, separator):
        file = self.write(name)
        self.check_values(numpy.loadtxt(file, delimiter=separator, encoding="utf-8"))
        self.check_header(line for line in file.read_text(encoding="utf-8").splitlines() if line.startswith("#"))

    def test_csv(self):
        self.check_matrix("out.csv", ",")

    def test_txt(self):
        self.check_matrix("out.txt", None)

    def test_xyz(self):
        file = self.write("out.xyz")
        x, y, z = numpy.loadtxt(file, encoding="utf-8", unpack=True)
        shape = self.part.heights.shape
        numpy.testing.assert_allclose(x.reshape(shape), numpy.tile(self.part.x(), (shape[0], 1)), rtol=1e-15)
        numpy.testing.assert_allclose(y.reshape(shape), numpy.tile(self.part.y()[:, None], shape[1]), rtol=1e-15)
        self.check_values(z.reshape(shape))
        lines = [line for line in file.read_text(encoding="utf-8").splitlines() if line.startswith("#")]
        self.assertEqual(lines.pop(), "# x_mm y_mm z_nm")
        self.check_header(lines)

    def test_npy(self):
        file = self.write("out.npy")
        said = read_npy(file)
        self.assertEqual((said.heights.dtype, said.heights.flags.c_contiguous), (numpy.dtype("<f8"), True))
        self.check_values(said.heights)
        self.assertEqual((said.pitch, said.origin, said.unit), (self.part.pitch, self.part.origin, "nm"))
        self.assertEqual(said.history, (HISTORY,))
        sidecar = json.loads((self.folder / "out.npy.json").read_text(encoding="utf-8"))
        self.assertEqual(sidecar["sha256"], hashlib.sha256(file.read_bytes()).hexdigest())

    def check_attributes(self, attributes, history):
        self.assertEqual(tuple(attributes["pitch_mm"]), self.part.pitch)
        self.assertEqual(tuple(attributes["origin_mm"]), self.part.origin)
        self.assertEqual((attributes["unit"], history), ("nm", [HISTORY]))

    def check_h5py(self, name):
        h5py = module("h5py")
        with h5py.File(self.write(name), "r") as file:
            self.assertEqual(list(file), ["map"])
            self.check_values(file["map"][()])
            self.check_attributes(file["map"].attrs, list(file["map"].attrs["history"]))

    def test_h5_by_h5py(self):
        self.check_h5py("out.h5")

    def test_hdf5_by_h5py(self):
        self.check_h5py("out.hdf5")

    def test_h5_by_netcdf4(self):
        netcdf4 = module("netCDF4")
        with netcdf4.Dataset(self.write("out.h5")) as file:
            file.set_auto_mask(False)
            variable = file.variables["map"]
            self.check_values(variable[:])
            attributes = {name: variable.getncattr(name) for name in variable.ncattrs()}
            self.check_attributes(attributes, list(numpy.atleast_1d(attributes["history"])))

    def test_fits_by_astropy(self):
        fits, wcs, units = module("astropy.io.fits"), module("astropy.wcs"), module("astropy.units")
        with fits.open(self.write("out.fits")) as file:
            file.verify("exception")
            image = file[0]
            self.check_values(image.data)
            self.assertEqual(units.Unit(image.header["BUNIT"]), units.nm)
            self.assertEqual(image.header["MADE1"], HISTORY.replace("\u00fc", "??"))
            world = wcs.WCS(image.header)
            self.assertEqual([units.Unit(unit) for unit in world.wcs.cunit], [units.mm, units.mm])
            x, y = world.pixel_to_world_values(*numpy.meshgrid(numpy.arange(11), numpy.arange(7)))
            numpy.testing.assert_allclose(x[0], self.part.x(), rtol=1e-14)
            numpy.testing.assert_allclose(y[:, 0], self.part.y(), rtol=1e-14)

    def test_sdf(self):
        said = read_sdf(self.write("out.sdf"))
        self.check_values(said.heights / 1e-9, rounding=1e-15)
        numpy.testing.assert_allclose((said.x_scale, said.y_scale), numpy.array(self.part.pitch) / 1000, rtol=1e-15)
        self.assertEqual(said.created, said.modified)
        self.check_header(said.trailer, HISTORY.replace("\u00fc", "??").replace("*", "?"))

    def test_height_image(self):
        said = read_png(self.write("out.png", "--write-image"))
        texts = dict(said.texts)
        step = float(texts["nm_per_level"])
        heights = float(texts["offset_nm"]) + step * said.levels.astype(float)
        heights[said.levels == int(texts["no_data_level"])] = math.nan
        heights = heights[::-1]  # the first row of an image is its top: largest y
        numpy.testing.assert_allclose(heights, self.part.heights, rtol=0, atol=0.5 * step * (1 + 1e-9), equal_nan=True)
        self.assertEqual(numpy.unravel_index(numpy.nanargmax(heights), heights.shape), (5, 8))
        self.assertEqual((pair(texts["pitch_mm"]), pair(texts["origin_mm"])), (self.part.pitch, self.part.origin))
        self.assertEqual((texts["unit"], texts["made"]), ("nm", HISTORY))
        self.assertEqual(said.pixels_per_metre, tuple(round(1000 / pitch) for pitch in self.part.pitch))


class WrittenRates(unittest.TestCase):
    """A removal function has rates, and its tool axis at (0, 0): here it is asked for about an axis between samples."""

    AXIS = (-1.03, 31.4)

    def write(self, name):
        """A lobed function written by the program, and what it must hold."""
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        tool = HeightMap(numpy.zeros((19, 31)), (0.0938, 0.15), (-2.5, 30.1), "nm/s")
        x, y = numpy.meshgrid(tool.x() - self.AXIS[0], tool.y() - self.AXIS[1])
        tool.heights = 4 * numpy.exp(-8 * (x**2 + y**2)) + numpy.exp(-8 * ((x - 0.5) ** 2 + (y - 0.3) ** 2))
        write_text(pathlib.Path(folder.name, "tool.csv"), tool)
        dwell_program.run("tif", "tool.csv", "--tif-centre", "{!r},{!r}".format(*self.AXIS), "--write", name,
                          folder=folder.name)
        tool.origin = tuple(tool.origin[i] - self.AXIS[i] for i in (0, 1))
        return pathlib.Path(folder.name, name), tool

    def check(self, said, tool):
        numpy.testing.assert_array_equal(said.heights, tool.heights)
        numpy.testing.assert_allclose(said.pitch, tool.pitch, rtol=1e-15)
        numpy.testing.assert_allclose(said.origin, tool.origin, rtol=1e-14)
        self.assertEqual(said.unit, "nm/s")

    def test_csv(self):
        file, tool = self.write("out.csv")
        self.check(read_text(file), tool)

    def test_npy(self):
        file, tool = self.write("out.npy")
        self.check(read_npy(file), tool)

    def test_h5_by_h5py(self):
        h5py = module("h5py")
        file, tool = self.write("out.h5")
        with h5py.File(file, "r") as content:
            said = content["map"]
            self.check(HeightMap(said[()], said.attrs["pitch_mm"], said.attrs["origin_mm"], said.attrs["unit"]), tool)

    def test_fits_by_astropy(self):
        fits, units = module("astropy.io.fits"), module("astropy.units")
        file, tool = self.write("out.fits")
        with fits.open(file) as content:
            header = content[0].header
            self.assertEqual(units.Unit(header["BUNIT"]), units.nm / units.s)
            pitch, origin = ([header[f"{key}{axis}"] for axis in (1, 2)] for key in ("CDELT", "CRVAL"))
            self.check(HeightMap(content[0].data, pitch, origin, header["BUNIT"]), tool)


if __name__ == "__main__":
    loud_unittest.run_module("__main__", *sys.argv[1:])
