"""Holds what dwell says of a machine's motion to what a real controller does: LinuxCNC.

    ./dev real                 the short judgement: a small part, two programs on two machines
    ./dev real --full          the tables of docs/proof.md on the measured mirror udo-raster; goes on where it was stopped
    ./dev real --logs FOLDER   keeps every run there: program, machine file and the recorded motion

The program under test is named by the environment variable DWELL_PROGRAM. docs/motion.md says what is compared.
"""

import argparse
import pathlib
import signal
import sys
import tempfile
import traceback

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "independent"))

import controller
import full
import short
from controller import ControllerFault
from report import Report


def main():
    parser = argparse.ArgumentParser(prog="./dev real", description=__doc__.split("\n")[0])
    parser.add_argument("--full", action="store_true", help="the tables of docs/proof.md, resumable; hours")
    parser.add_argument("--logs", type=pathlib.Path, metavar="FOLDER",
                        help="keep program, machine file and recorded motion of every run in FOLDER")
    arguments = parser.parse_args()
    report = Report()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(128 + signal.SIGTERM))  # LinuxCNC is ended on the way out
    try:
        controller.require()
        if arguments.full:
            full.judge(report, arguments.logs)
        else:
            with tempfile.TemporaryDirectory(prefix="dwell-judge-") as folder:
                short.judge(report, pathlib.Path(folder), arguments.logs)
    except ControllerFault as fault:
        report.fail(str(fault))
    except Exception:  # what went wrong must not hide the figures so far
        report.fail(traceback.format_exc())
    sys.exit(report.end())


main()
