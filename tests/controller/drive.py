#!/usr/bin/python3
"""Runs one program on LinuxCNC, which starts this script in the place of a screen, and records the motion.

It stands in the working folder that controller.py makes, beside drive.json: {"timeout_s": seconds of the clock}. The
program is program.nc; samples.txt gets a line for every servo period, and outcome.json says how the run ended. This
file imports nothing of its neighbours, since it runs as another user who cannot see their folder.
"""

import json
import pathlib
import subprocess
import time

import linuxcnc

FOLDER = pathlib.Path(__file__).resolve().parent
START_TIMEOUT_S = 30


class Fault(Exception):
    """LinuxCNC did not do what was asked."""


class Driver:
    def __init__(self):
        self.command, self.status, self.channel = linuxcnc.command(), linuxcnc.stat(), linuxcnc.error_channel()

    def check_errors(self):
        """Whatever LinuxCNC reports as an error ends the run."""
        message = self.channel.poll()
        if message and message[0] in (linuxcnc.NML_ERROR, linuxcnc.OPERATOR_ERROR):
            raise Fault(message[1].strip())

    def wait(self, what, seconds, condition):
        end = time.monotonic() + seconds
        while True:
            self.status.poll()
            self.check_errors()
            if condition(self.status):
                return
            if time.monotonic() > end:
                s = self.status
                raise Fault(f"waited {seconds} s for {what}; task state {s.task_state}, mode {s.task_mode}, interpreter "
                            f"{s.interp_state}, queue {s.queue}, in position {s.inpos}, place {s.position[:3]} mm")
            time.sleep(0.02)

    def start(self):
        self.wait("the controller to come up", START_TIMEOUT_S,
                  lambda s: s.joints == 3 and s.max_velocity > 0 and s.cycle_time > 0)
        self.command.state(linuxcnc.STATE_ESTOP_RESET)
        self.wait("the end of the emergency stop", START_TIMEOUT_S, lambda s: s.task_state != linuxcnc.STATE_ESTOP)
        self.command.state(linuxcnc.STATE_ON)
        self.wait("the machine to be on", START_TIMEOUT_S, lambda s: s.task_state == linuxcnc.STATE_ON)
        self.command.mode(linuxcnc.MODE_MANUAL)
        self.command.wait_complete()
        self.command.home(-1)
        self.wait("all joints to be homed", START_TIMEOUT_S, lambda s: all(s.homed[:3]))

    def run(self, timeout):
        self.command.mode(linuxcnc.MODE_AUTO)
        self.command.wait_complete()
        self.command.program_open(str(FOLDER / "program.nc"))
        self.command.wait_complete()
        self.command.auto(linuxcnc.AUTO_RUN, 0)
        self.wait("the program to begin", START_TIMEOUT_S, lambda s: s.interp_state != linuxcnc.INTERP_IDLE)
        self.wait("the program to end", timeout,
                  lambda s: s.interp_state == linuxcnc.INTERP_IDLE and s.queue == 0 and s.inpos)


def main():
    outcome = {"fault": ""}
    with open(FOLDER / "samples.txt", "wb") as samples, \
            subprocess.Popen(["halsampler", "-t"], stdout=samples) as sampler:
        began = time.monotonic()
        try:
            driver = Driver()
            driver.start()
            driver.run(json.loads((FOLDER / "drive.json").read_text())["timeout_s"])
            time.sleep(0.3)  # the end stands in the record, too
        except (Fault, linuxcnc.error) as error:
            outcome["fault"] = str(error) or repr(error)
        if sampler.poll() is not None:
            outcome["fault"] += f" halsampler ended with {sampler.returncode} before the run did"
        sampler.terminate()
    outcome["wall_s"] = time.monotonic() - began
    (FOLDER / "outcome.json").write_text(json.dumps(outcome))


main()
