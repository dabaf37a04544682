"""Runs that nobody measured, of methods with known orders and costs, for the tests of what is made of runs.

A step h costs `cost`/h seconds a simulated second and makes an error of `error` h^order.
"""

import csv
import os
from collections import namedtuple

from work_precision.runs import RUN_COLUMNS, SCENE_COLUMNS

Law = namedtuple("Law", "order error cost longest")
LAWS = {
    "explicit_euler": Law(1, 40.0, 1.0e-4, 2e-5),
    "symplectic_euler": Law(1, 0.5, 1.0e-4, 2e-3),
    "velocity_verlet": Law(2, 80.0, 1.1e-4, 2e-3),
    "midpoint": Law(2, 200.0, 2.0e-4, 5e-4),
    "rk4": Law(4, 2e6, 4.0e-4, 2e-3),
    "implicit_euler": Law(1, 4.0, 1.5e-3, 1.0),
    "implicit_midpoint": Law(2, 50.0, 2.0e-3, 1.0),
    "tr_bdf2": Law(2, 30.0, 4.0e-3, 1.0),
    "projective": Law(1, 6.0, 2.0e-3, 1.0),
    "xpbd": Law(1, 5.0, 1.0e-3, 1.0),
    "odeint_runge_kutta_dopri5": Law(5, 5e8, 9.0e-4, 2e-3),
    "bullet": Law(1, 20.0, 3.0e-3, 1.0),
}
STEPS = [1.6e-2 / 2 ** k for k in range(10)]
TOLERANCES = [10.0 ** -k for k in range(2, 9)]
BY_TOLERANCE = {"dopri5": (0.5, 0.3), "cvode_bdf": (5.0, 3.0), "cvode_adams": (3.0, 0.9)}  # error/tolerance, cost at 1


def run(solver, setting, value, **fields):
    row = dict.fromkeys(RUN_COLUMNS, "")
    row.update(scene="sheet", kind="trajectory", solver=solver, setting=setting, value=value, horizon=0.5, status="ok",
               repeats=3, reference_error=1e-10, nodes=1024, tolerance_line=1e-3, machine="a machine",
               compiler="a compiler", commit="abc1234")
    row.update(fields)
    return row


def good_run(solver, setting, value, error, cost, **fields):
    return run(solver, setting, value, rms_error=error, worst_error=5.0 * error, energy_error=0.1 * error,
               strain_error=0.3 * error, seconds_per_second=cost, seconds_per_second_low=0.95 * cost,
               seconds_per_second_high=1.2 * cost, force_evaluations=1e5 * cost, solves=0, **fields)


def runs_by_step(solver, law, **fields):
    for step in STEPS:
        if step > law.longest:
            yield run(solver, "step", step, status="unstable", **fields)
        else:
            yield good_run(solver, "step", step, law.error * step ** law.order, law.cost / step, **fields)


def runs_by_tolerance(solver, error, cost, **fields):
    for tolerance in TOLERANCES:
        yield good_run(solver, "tolerance", tolerance, error * tolerance, cost * tolerance ** -0.2, **fields)


def all_runs(slow=1.0, **fields):
    """Of one scene; `slow` multiplies all costs of velocity_verlet."""
    rows = []
    for solver, law in LAWS.items():
        if solver == "velocity_verlet":
            law = law._replace(cost=slow * law.cost)
        rows += runs_by_step(solver, law, **fields)
    for solver, (error, cost) in BY_TOLERANCE.items():
        rows += runs_by_tolerance(solver, error, cost, **fields)
    return rows


def spatial_runs(order=2, scene="sheet", cells=16):
    """Grids of that many cells a side and twice as many, against four times as many."""
    def error(count):
        return 20.0 * (count ** -order - (4 * cells) ** -order)
    return [run("dopri5", "nodes_per_side", count + 1, scene=scene, kind="spatial", rms_error=error(count),
                nodes=(count + 1) ** 2) for count in (cells, 2 * cells)]


def scene(name="sheet", kind="trajectory", accepted="yes", reason=""):
    return {"scene": name, "kind": kind, "accepted": accepted, "horizon": 0.5, "reference_error": 1e-10,
            "growth": 300.0, "reason": reason}


def write(folder, scenes, rows):
    write_table(os.path.join(folder, "scenes.csv"), SCENE_COLUMNS, scenes)
    write_table(os.path.join(folder, "runs.csv"), RUN_COLUMNS, rows)


def write_table(path, columns, rows):
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, columns, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
