"""Programs of random jobs, as tests/independent makes them, in every dialect that LinuxCNC's interpreter can read.

It reads F of G93 as 1/min; the dialect with F in seconds is another controller's.
"""

import pathlib
import tempfile

import dwell_program
import interpreter
from random_jobs import random_job

PATHS = ("raster", "spiral", "random", "cross-hatch", "circles", "fibonacci", "random-raster", "nearest", "hilbert",
         "multi-pitch", "peano")
READ = ("g94", "g93-per-minute")


def with_dialect(words, dialect):
    """The options of a plan, with this dialect in the place of its own."""
    words = list(words)
    words[words.index("--gcode") + 1] = dialect
    return words


def judge(report, folder):
    report.say("\nprograms of random jobs in LinuxCNC's interpreter")
    for number, path in enumerate(PATHS):
        with tempfile.TemporaryDirectory(dir=folder) as name:
            place = pathlib.Path(name)
            job = random_job(number, path, place)
            dialect = READ[number % len(READ)]
            dwell_program.run("plan", *job.options, *with_dialect(job.plan_options, dialect), "--remove", job.terms,
                              "--time-price", "0", "--out", "plan", folder=place, accepted=(0, 3))
            steps = interpreter.check(place / "plan" / "program.nc", place)
            report.checks += 1
            report.say(f"  {path}, {dialect}: {steps} moves and halts read as meant")
