"""A matrix that nobody measured, for the tests of its verdict."""

import os

from plan_matrix.tables import DRAW_COLUMNS, PART_COLUMNS, PLAN_COLUMNS
from synthetic_runs import write_table


def draw(scene, **fields):
    row = {"scene": scene, "half": "development", "accepted": "yes", "rows": 9, "cols": 8, "node_steps": 1e5,
           "reference_error": 1e-8, "growth": 3.0, "reason": "checked"}
    row.update(fields)
    return row


def plan(scene, tolerance=1e-3, **fields):
    """A good one: an error of half the tolerance, estimated as such, at the cost of the best."""
    row = dict.fromkeys(PLAN_COLUMNS, "")
    row.update(build="b1", commit="abc", scene=scene, fingerprint="f" + scene, tolerance=tolerance, status="ok",
               method="rk4", time_step=tolerance, method_tolerance=tolerance, iterations=10, estimate=0.5 * tolerance,
               true_error=0.5 * tolerance, worst_error=tolerance, cost=tolerance ** -0.25, planning=0.1,
               planning_seconds=1e-4, best_solver="rk4", best_setting="step", best_value=tolerance,
               best_error=0.9 * tolerance, best_cost=tolerance ** -0.25)
    row.update(fields)
    return row


def part(scene, change, is_left_out, tolerance=1e-3, name="wind", **fields):
    row = {"build": "b1", "scene": scene, "fingerprint": "f" + scene, "tolerance": tolerance, "part": name,
           "is_left_out": is_left_out, "change": change}
    row.update(fields)
    return row


def write(folder, plans, parts=(), draws=None, half="development"):
    place = os.path.join(folder, half)
    os.makedirs(place)
    scenes = sorted({row["scene"] for row in plans})
    write_table(os.path.join(place, "scenes.csv"), DRAW_COLUMNS, draws or [draw(scene) for scene in scenes])
    write_table(os.path.join(place, "plans.csv"), PLAN_COLUMNS, plans)
    write_table(os.path.join(place, "parts.csv"), PART_COLUMNS, parts)
