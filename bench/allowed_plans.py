#!/usr/bin/env python3
"""What plans cost beside the cheapest that their own rules allow.

    bench/allowed_plans.py CLOTH_RUN DIR

reads what plan_matrix has left in DIR. A plan may err by 0.85 of the tolerance at most, which it does where errors are
measured; it has to keep its steps within 0.9 of the stability limit of its method (as CLOTH_RUN has it at the start) and
leave a quarter of real time to others. The best of the search, which the criterion `cheap` speaks of, need not. Costs are those of the search, times what the best
of it cost beside the plan. Printed is for each half how many plans cost at most 1.5 times the best that is allowed, of
those for which something is, and which do not.
"""

import argparse
import csv
import os
import re
import subprocess
import tempfile

from plan_matrix import tables, verdict

ERROR_SHARE = 0.85
LIMIT_SHARE = 0.9
REAL_TIME_SHARE = 0.75
ROUNDING = 1.001  # of a step in its ladder


def main():
    arguments = parse()
    for half in tables.read(arguments.folder):
        folder = os.path.join(arguments.folder, half.name)
        limits = Limits(arguments.program, folder)
        ratios = {}
        for plan in half.plans:
            allowed = cost_of_best_allowed(plan, folder, limits)
            if allowed is not None:
                good = verdict.went_well(plan) and not verdict.admits_failure(plan)
                ratios[verdict.about(plan)] = plan.cost / allowed if good else None
        dear = {about: ratio for about, ratio in ratios.items() if ratio is None or ratio > verdict.MOST_COST}
        print("{}: {:.1f} % of {}; not: {}".format(
            half.name, 100.0 * (1.0 - len(dear) / len(ratios)), len(ratios),
            "; ".join("{} ({})".format(about, "misses" if ratio is None else "{:.1f}".format(ratio))
                      for about, ratio in dear.items())))


def cost_of_best_allowed(plan, folder, limits):
    """Yardsticks for a simulated second; None: nothing is allowed."""
    with open(os.path.join(folder, "searched", plan.scene + ".csv"), encoding="utf-8", newline="") as file:
        rows = [row for row in csv.DictReader(file) if row["status"] == "ok"]
    if not plan.best_cost:
        return None
    of_best = [cost(row) for row in rows if (row["solver"], row["value"]) == (plan.best_solver, plan.best_value)]
    scale = plan.best_cost / median(of_best) if of_best else 1.0
    allowed = [cost(row) for row in rows if is_allowed(row, plan, limits)]
    return scale * min(allowed) if allowed else None


def is_allowed(row, plan, limits):
    if float(row["rms_error"]) > ERROR_SHARE * plan.tolerance or float(row["seconds_per_second"]) > REAL_TIME_SHARE:
        return False
    return row["setting"] != "step" or float(row["value"]) <= ROUNDING * LIMIT_SHARE * limits.of(plan.scene, row["solver"])


def cost(row):
    return float(row["seconds_per_second"]) / float(row["yardstick"])


def median(numbers):
    return sorted(numbers)[len(numbers) // 2]


class Limits:
    """Stability limits, s, by scene and method; infinite where any step is stable."""

    def __init__(self, program, folder):
        self._program = program
        self._folder = folder
        self._known = {}

    def of(self, scene, method):
        if (scene, method) not in self._known:
            self._known[scene, method] = self._found(scene, method)
        return self._known[scene, method]

    def _found(self, scene, method):
        path = os.path.join(self._folder, "scenes", scene + ".yaml")
        with tempfile.NamedTemporaryFile("r", suffix=".yaml", encoding="utf-8") as summary:
            subprocess.run([self._program, path, "--duration", "1e-6", "--summary", summary.name, "--set",
                            "solver.method=" + method, "--set", "solver.time_step=1e-6"], check=True,
                           stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            with open(summary.name, encoding="utf-8") as file:
                limit = re.search(r"^stability_limit: (\S+)", file.read(), re.MULTILINE).group(1)
        return float(limit.replace(".inf", "inf"))


def parse():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", metavar="CLOTH_RUN")
    parser.add_argument("folder", metavar="DIR")
    return parser.parse_args()


if __name__ == "__main__":
    main()
