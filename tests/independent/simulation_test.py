"""Plans random jobs with the program under test and simulates what it wrote, independently.

The simulation follows docs/math.md, docs/formats.md and docs/removal_functions.md and shares no code with the program.
It reads the map, the removal function (or takes its formula) and the program from disk, and integrates the removal by a
quadrature of its own. Run by hand, for the tests with `spiral` in their name:

    DWELL_PROGRAM=build/release/dwell /usr/bin/python3 -B tests/independent/simulation_test.py spiral
"""

import dataclasses
import json
import pathlib
import sys
import tempfile
import unittest

import loud_unittest

try:
    import numpy
except ImportError as error:
    loud_unittest.skip_module("independent.simulation", f"{sys.executable} has no NumPy: {error}")

import dwell_program
from height_map import read_npy
from machine_program import SECONDS_PER_MINUTE, read_feed_table, read_gcode, read_table
from random_jobs import random_job
from removal_functions import oriented
from simulation import removal, without_form

# The path of each job; with the number of a job go its dialect, its removal function and more (random_jobs.py).
PATHS = ("raster", "spiral", "random", "cross-hatch", "circles", "fibonacci", "random-raster", "nearest", "hilbert",
         "multi-pitch", "peano", "file", "line")
# What the program's spline on pixels and the quadrature here leave is below a third of these.
LARGEST_SHARE = 0.002  # of the removal of the pixel
RMS_SHARE = 0.0002  # of the largest removal
EXACT_SHARE = 0.001  # of the removal of the pixel; only the quadratures leave something
STATED_SHARE = 0.01  # of what is stated to be left
TIME_SHARE = 1e-6
ROUNDING = 1e-12  # of the arithmetic here, relative


class JobCase(unittest.TestCase):
    """Plans a job in a folder of its own, which goes when the test ends."""

    def plan(self, number, kind=None):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.job = random_job(number, PATHS[number], self.folder, kind)
        dwell_program.run("plan", *self.job.options, *self.job.plan_options, "--remove", self.job.terms,
                          "--out", "plan", folder=self.folder)
        return self.job

    def file(self, name):
        return self.folder / "plan" / name

    def deviation(self, removed, expected):
        """Largest share of a pixel's removal, and RMS as a share of the largest removal, over the pixels with data."""
        valid = numpy.isfinite(self.job.part.heights)
        difference, expected = (removed - expected)[valid], expected[valid]
        return abs(difference / expected).max(), numpy.sqrt((difference**2).mean()) / expected.max()


class Simulation(JobCase):
    def check_job(self, number):
        job = self.plan(number)
        summary = json.loads(self.file("summary.json").read_text(encoding="utf-8"))
        program, table = read_gcode(self.file("program.nc")), read_feed_table(self.file("feed.csv"))
        removed = removal(program, job.function, job.part)
        self.check_residual(removed)
        self.check_stated(summary["program"], removed)
        self.check_simulate("program.nc", program, removed)
        self.check_simulate("feed.csv", table, removal(table, job.function, job.part))
        self.check_time(program, summary["program"], "plan")
        dwell = [row["dwell_s"] for row in read_table(self.file("feed.csv"))[1]]
        numpy.testing.assert_allclose(numpy.load(self.file("dwell.npy")), dwell, rtol=TIME_SHARE)

    def check_residual(self, removed):
        """The surface that the plan says its program leaves, against the one that is left here."""
        job, said = self.job, read_npy(self.file("residual.npy"))
        self.assertEqual((said.pitch, said.origin, said.unit), (job.part.pitch, job.part.origin, "nm"))
        left = without_form(job.part.heights - removed, job.terms, job.part)
        numpy.testing.assert_array_equal(numpy.isfinite(said.heights), numpy.isfinite(left))
        self.check_deviation(removed + left - said.heights, removed)

    def check_stated(self, said, removed):
        """The figures in the last lines of a plan, against the surface that is left here."""
        left = without_form(self.job.part.heights - removed, self.job.terms, self.job.part)
        left = left[numpy.isfinite(left)]
        self.assertLess(abs(said["residual_rms_nm"] / left.std() - 1), STATED_SHARE, "RMS")
        self.assertLess(abs(said["residual_pv_nm"] / numpy.ptp(left) - 1), STATED_SHARE, "PV")

    def check_time(self, program, said, name):
        """The time of the run, without that of rapids, which no program says."""
        self.assertLess(abs(program.seconds() / (said["total_s"] - said["lift_s"]) - 1), TIME_SHARE, name)

    def check_simulate(self, name, program, removed):
        """What `dwell simulate` says of a file, against the simulation of the same file here; and its feeds."""
        said = dwell_program.run_json("simulate", *self.job.options, "--remove", "none", "--program", f"plan/{name}",
                                      "--residual", "left.npy", folder=self.folder)
        self.check_deviation(self.job.part.heights - read_npy(self.folder / "left.npy").heights, removed)
        self.check_time(program, said["program"], name)
        limit = self.job.max_feed / SECONDS_PER_MINUTE
        self.assertLessEqual(program.largest_speed, limit * (1 + ROUNDING), f"{name}: speed in mm/s")

    def check_deviation(self, said, removed):
        largest, rms = self.deviation(said, removed)
        self.assertLess(largest, LARGEST_SHARE, "largest deviation, relative to the removal of the pixel")
        self.assertLess(rms, RMS_SHARE, "RMS of the deviation, relative to the largest removal")

    def test_jobs_cover_every_kind_of_path(self):
        lines = dwell_program.run("paths", "--kinds", folder=".").splitlines()
        kinds = {line.partition(":")[0] for line in lines if line and not line.startswith(" ")}
        self.assertEqual(kinds, set(PATHS))


def add_jobs():
    """A test for each job, named after its path."""
    for number, path in enumerate(PATHS):
        setattr(Simulation, f"test_{path.replace('-', '_')}", lambda self, number=number: self.check_job(number))


add_jobs()


class SharpFunction(JobCase):
    """What changes within a pixel no spline on pixels holds; the lattice of the plan must be finer."""

    def test_ring_is_exact(self):
        job = self.plan(0, "ring")
        removed = removal(read_gcode(self.file("program.nc")), job.function, job.part, 4)
        dwell_program.run("simulate", *job.options, "--remove", "none", "--program", "plan/program.nc", "--exact",
                          "--residual", "left.npy", folder=self.folder)
        said = job.part.heights - read_npy(self.folder / "left.npy").heights
        self.assertLess(self.deviation(said, removed)[0], EXACT_SHARE)


class Sensitivity(JobCase):
    """The bounds would not hold if one of the two were wrong: small errors in the simulation here break them."""

    JOB = 7  # a measured function with a lobe to one side, on pixels that are not square

    def exceeds(self, program, function, part):
        largest, rms = self.deviation(removal(program, function, part, 1), self.right)
        return largest > LARGEST_SHARE and rms > RMS_SHARE

    def test_small_errors_are_seen(self):
        job = self.plan(self.JOB)
        program, function, part = read_gcode(self.file("program.nc")), job.function, job.part
        self.right = removal(program, function, part, 1)
        self.assertFalse(self.exceeds(read_feed_table(self.file("feed.csv")), function, part))
        shifted = dataclasses.replace(part, origin=(part.origin[0] + 0.1 * part.pitch[0], part.origin[1]))
        longer = dataclasses.replace(program, steps=[dataclasses.replace(s, seconds=1.003 * s.seconds)
                                                     for s in program.steps])
        for error, wrong in {
                "removal function turned by 3 degrees": (program, oriented(function, "none", 3), part),
                "removal function mirrored": (program, oriented(function, "x", 0), part),
                "map shifted by a tenth of a pixel": (program, function, shifted),
                "times longer by 0.3 %": (longer, function, part),
                "F read in another dialect": (read_gcode(self.file("program.nc"), "g93-seconds"), function, part)
        }.items():
            with self.subTest(error):
                self.assertTrue(self.exceeds(*wrong))


if __name__ == "__main__":
    loud_unittest.run_module("__main__", *sys.argv[1:])
