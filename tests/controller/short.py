"""The short judgement: a small part, so that the motion of each run is less than a minute."""

import random_jobs_read
from controller import Limits
import interpreter
from parts import TOOL_WORDS, tool, write_small_part
from run import G61, G64, Case, blending_file, compare, fit, keep, machine_file, plan, program_with, record, simulate

MACHINES = (Limits(50.0, 500.0), Limits(50.0, 50.0))
CALIBRATION = ("random:pitch=1,overrun=2,seed=4", ())  # another path than those that are judged
PROGRAMS = {"raster": ("raster:pitch=1,overrun=2", ("--smoothness", "0.1")),
            "random": ("random:pitch=1,overrun=2,seed=3", ("--smoothness", "0.1"))}
LONGEST_S = 60  # of motion in a run

# Of a target: the total time with G61 and with G64 P0.01, and the removals of a raster and of a random path with G61.
TIME_SHARE = {G61: 0.003, G64: 0.02}
REMOVALS = {"raster": 0.05, "random": 0.05}  # RMS of their difference over the recorded residual; target of random: 0.5
# No target, twice what was measured (0.3 to 0.9 %): dwell follows the blended path, too.
BLENDED_REMOVALS = 0.02
FROM_PATH_MM = 0.002


def judge(report, folder, logs):
    case = Case(folder, ["--map", "map.csv", "--tif", TOOL_WORDS], write_small_part(folder), tool())
    for limits in MACHINES:
        judge_machine(report, case, limits, logs)
    random_jobs_read.judge(report, folder)


def judge_machine(report, case, limits, logs):
    key = f"{limits.speed:g}-{limits.acceleration:g}"
    report.say(f"\naxes of {limits.name()}")
    ideal = machine_file(case, f"ideal-{key}", limits, limits.acceleration, 0.0)
    path, words = CALIBRATION
    plan(case, f"calibration-{key}", "--path", path, "--machine", ideal.name, *words)
    folder = f"calibration-{key}"
    run = record(program_with(case, folder, G61), limits, LONGEST_S)
    keep(logs, folder + "-g61", run, ideal, limits)
    found = fit(case, run, limits)
    report.say(f"  fitted on {path} ({found.stops} stops): {found.acceleration:.4g} mm/s^2, "
               f"{1e3 * found.delay:.3g} ms at a stop, {1e3 * found.scatter:.3g} ms scatter")
    machines = {G61: machine_file(case, f"fitted-{key}", limits, found.acceleration, found.delay),
                G64: blending_file(case, f"blending-{key}", limits)}
    for name, (path, words) in PROGRAMS.items():
        judge_program(report, case, limits, machines, f"{name}-{key}", name, path, words, logs)


def judge_program(report, case, limits, machines, folder, name, path, words, logs):
    summary = plan(case, folder, "--path", path, "--machine", machines[G61].name, *words)
    report.say(f"\n{path} on {limits.name()}: {summary['program']['residual_rms_nm']:.4g} nm, as dwell says")
    exact = program_with(case, folder, G61)
    steps = interpreter.check(exact, case.folder)
    report.say(f"  LinuxCNC's interpreter reads its {steps} moves and halts as meant")
    for mode in (G61, G64):
        program = program_with(case, folder, mode)
        table, removed = simulate(case, program, machines[mode])
        report.hold("motion", table.total(), LONGEST_S, " s")
        run = record(program, limits, table.total())
        keep(logs, f"{folder}-{mode[:3].lower()}", run, machines[mode], limits)
        seen = compare(case, run, table, removed, stops=mode == G61)
        report.say(f"  {mode}: {seen.recorded_s:.3f} s, simulated {seen.simulated_s:.3f} s; {seen.residual_nm:.4g} nm "
                   f"left, simulated {seen.simulated_nm:.4g} nm")
        report.hold("total time, share of difference", seen.time_share(), TIME_SHARE[mode])
        report.hold("difference of the removals over the residual", seen.difference,
                    REMOVALS[name] if mode == G61 else BLENDED_REMOVALS)
        if mode == G61:
            report.hold("time at any stop, share of the total", seen.lag_share(), TIME_SHARE[mode])
        report.hold("beside the way", seen.from_path_mm, FROM_PATH_MM, " mm")
