"""The judge's own arithmetic, without LinuxCNC: part of ./dev test.

Run by hand: /usr/bin/python3 -B tests/controller/judge_test.py
"""

import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "independent"))

import loud_unittest

try:
    import numpy
except ImportError as error:
    loud_unittest.skip_module("controller.judge", f"{sys.executable} has no NumPy: {error}")

import controller
import motion
from controller import PERIOD_S, ControllerFault, Recording
from removal_functions import gaussian

PROGRAM = """(a comment with F100 in it)
G21
G94
G0 Z10
G0 X1 Y2
G1 Z0 F600
G1 X3.5 Y2 F123.456789
G4 P0.5
G0 Z10
M2
"""


def trapezoid(length, speed, acceleration):
    """Places along a line at every period, from rest to rest."""
    ramp = speed / acceleration
    total = length / speed + ramp
    t = numpy.arange(0, total + PERIOD_S, PERIOD_S).clip(max=total)
    up = 0.5 * acceleration * numpy.minimum(t, ramp) ** 2
    level = speed * (t - ramp).clip(min=0, max=total - 2 * ramp)
    down = (t - (total - ramp)).clip(min=0)
    return up + level + speed * down - 0.5 * acceleration * down**2


def record(legs, rest=5):
    """A record of legs [(from, to)] with a rest after each, the tool lifted before and after."""
    places = [numpy.array([legs[0][0]] * 3)]
    for begin, end in legs:
        begin, end = numpy.array(begin, float), numpy.array(end, float)
        length = numpy.hypot(*(end - begin))
        way = trapezoid(length, 5.0, 50.0)
        places.append(begin + (way / length)[:, None] * (end - begin))
        places.append(numpy.array([end] * rest))
    work = numpy.concatenate(places)
    lifted = numpy.array([[0, 0, 0], [0, 0, 4.0], [*work[0], 2.0]]), numpy.array([[*work[-1], 1.0]])
    return Recording(numpy.concatenate([lifted[0], numpy.column_stack([work, numpy.zeros(len(work))]), lifted[1]]))


LEGS = (((0, 0), (2, 0)), ((2, 0), (2, 1.5)), ((2, 1.5), (0.5, 3)))


class Programs(unittest.TestCase):
    def test_faster_scales_feeds_and_halts_but_no_comment(self):
        text = controller.faster(PROGRAM, 5)
        self.assertIn("F617.283945\n", text)
        self.assertIn("G1 Z0 F3000\n", text)
        self.assertIn("G4 P0.100000000\n", text)
        self.assertIn("(a comment with F100 in it)", text)
        self.assertIn("G1 X3.5 Y2 ", text)

    def test_path_mode_stands_before_the_first_motion(self):
        lines = controller.with_path_mode(PROGRAM, "G64 P0.01").splitlines()
        self.assertEqual(lines[3:5], ["G64 P0.01", "G0 Z10"])
        with self.assertRaisesRegex(ControllerFault, "no line that begins with G0"):
            controller.with_path_mode("G21\nM2\n", "G61")

    def test_axes_are_scaled_with_the_clock(self):
        text = controller.ini_text(controller.Limits(50.0, 500.0), 5)
        self.assertIn("SERVO_PERIOD = 200000\n", text)
        self.assertEqual(text.count("MAX_VELOCITY = 250.0\n"), 6)
        self.assertEqual(text.count("MAX_ACCELERATION = 12500.0\n"), 6)


class Records(unittest.TestCase):
    def read(self, text):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "samples.txt"
            file.write_text(text, encoding="ascii")
            return controller.read_samples(file)

    def test_only_whole_records_are_read(self):
        self.assertEqual(self.read("7 0.5 1 2 \n8 1 1 2 \n9 1.").tolist(), [[0.5, 1, 2], [1, 1, 2]])
        for text, words in (("7 0 0 0 \n9 0 0 0 \n", "sample 7 is not followed"), ("overrun\n7 0 0 0 \n", "were lost"),
                            ("", "0 samples")):
            with self.assertRaisesRegex(ControllerFault, words):
                self.read(text)

    def test_work_begins_and_ends_with_the_motion(self):
        work = motion.work_of(record(LEGS))
        ways = [2, 1.5, numpy.hypot(1.5, 1.5)]
        self.assertAlmostEqual(work.total(), sum(way / 5 + 0.1 for way in ways) + 2 * 5 * PERIOD_S, delta=0.006)

    def test_a_lift_within_the_work_is_refused(self):
        recording = record(LEGS)
        recording.places[300, 2] = 1.0
        with self.assertRaisesRegex(ControllerFault, "lifted during the work"):
            motion.work_of(recording)

    def test_stops_are_the_middle_of_the_rest(self):
        work = motion.work_of(record(LEGS, 41))
        times = motion.stops_of_work(work, [(2, 0), (2, 1.5)])
        self.assertAlmostEqual(times[0], 2 / 5 + 0.1 + 0.0205, delta=0.002)
        self.assertAlmostEqual(times[1] - times[0], 1.5 / 5 + 0.1 + 0.041, delta=0.002)
        with self.assertRaisesRegex(ControllerFault, "does not come within"):
            motion.stops_of_work(work, [(2, 0.1)] * 2 + [(0, 0)])

    def test_distance_from_the_path_is_seen(self):
        corners = numpy.array([LEGS[0][0], *(leg[1] for leg in LEGS)], float)
        recording = record(LEGS)
        self.assertLess(motion.distance_from_path(motion.work_of(recording), corners), 1e-9)
        recording.places[200, 1] += 0.03
        self.assertAlmostEqual(motion.distance_from_path(motion.work_of(recording), corners), 0.03, delta=1e-6)

    def test_pieces_remove_what_every_period_removes(self):
        work, tool = motion.work_of(record(LEGS)), gaussian(3.0, 1.2, 3.0)
        x, y = numpy.meshgrid(numpy.linspace(-1, 4, 21), numpy.linspace(-1, 4, 17))

        def removal(places, seconds):
            return sum(s * tool.rate(x - p[0], y - p[1]) for p, s in zip(places, seconds))

        middle = 0.5 * (work.places[:-1] + work.places[1:])
        every = removal(middle, numpy.full(len(middle), PERIOD_S))
        grouped = removal(*motion.pieces(work, tool.width))
        self.assertLess(len(motion.pieces(work, tool.width)[1]), 0.3 * len(middle))
        self.assertLess(numpy.abs(grouped - every).max(), 3e-5 * every.max())


class Tables(unittest.TestCase):
    def test_the_rows_at_work_and_their_stops(self):
        text = ("# dwell\nt_s,x_mm,y_mm,speed_mm_per_s,removes\n0,0,0,0,0\n1,1,1,0,0\n2,1,1,0,1\n3,2,1,2,1\n4,3,1,0,1\n"
                "4.5,3,1,0,1\n5.5,3,1.5,1,1\n6.5,3,2,0,1\n")
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "motion.csv"
            file.write_text(text, encoding="ascii")
            table = motion.read_table(file)
        self.assertEqual(table.total(), 4.5)
        places, times = table.stops()
        self.assertEqual(places.tolist(), [[3, 1]])
        self.assertEqual(times.tolist(), [2.25])
        work = motion.sampled(table)
        self.assertEqual(len(work.places), 4501)
        for second, place in ((0, (1, 1)), (0.5, (1.25, 1)), (1, (2, 1)), (1.5, (2.75, 1)), (2.2, (3, 1)),
                              (3, (3, 1.125)), (4.5, (3, 2))):
            self.assertLess(numpy.abs(work.places[round(second / PERIOD_S)] - place).max(), 1e-9, second)


if __name__ == "__main__":
    loud_unittest.run_module("__main__", *sys.argv[1:])
