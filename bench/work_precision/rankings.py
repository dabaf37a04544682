"""Who is cheapest at which error.

A ladder is the runs of one solver on one scene over one setting, in the order of the setting's values.
"""

import math
from collections import namedtuple

from work_precision import solvers

TOLERANCES = (1e-1, 1e-2, 1e-3, 1e-4, 1e-6)  # m, RMS
LEVEL = 1.2  # costs that differ by less than this factor count as level

# cost in s of work a simulated second; value that of the ladder's setting; measured: no two points were joined.
Entry = namedtuple("Entry", "cost solver setting value measured")


def ladders(runs):
    """{(solver, setting): runs} in the order of the table of methods."""
    found = {}
    for run in runs:
        found.setdefault((run.solver, run.setting), []).append(run)
    names = solvers.in_order(run.solver for run in runs)
    return {key: sorted(found[key], key=lambda run: run.value)
            for key in sorted(found, key=lambda key: (names.index(key[0]), key[1]))}


def succeeded(runs):
    return [run for run in runs if run.status == "ok"]


def pareto_front(points):
    """Those of the (cost, error) that no other beats in both, cheapest first."""
    front = []
    for cost, error in sorted(points):
        if not front or error < front[-1][1]:
            front.append((cost, error))
    return front


def cheapest(ladder, tolerance):
    """The least cost at which a ladder makes an RMS error of `tolerance` at most, or None.

    That is a measured run, or lies on the straight line, in logarithms, between two neighbours of the ladder, one more
    exact and one less exact than the tolerance.
    """
    entries = [Entry(run.seconds_per_second, run.solver, run.setting, run.value, True)
               for run in succeeded(ladder) if run.rms_error <= tolerance]
    for run, other in zip(ladder, ladder[1:]):
        if run.status == other.status == "ok" and (run.rms_error <= tolerance) != (other.rms_error <= tolerance):
            entries.append(between(run, other, tolerance))
    return min(entries, default=None)


def between(run, other, tolerance):
    part = math.log(tolerance / run.rms_error) / math.log(other.rms_error / run.rms_error)

    def there(begin, end):
        return begin * (end / begin) ** part
    return Entry(there(run.seconds_per_second, other.seconds_per_second), run.solver, run.setting,
                 there(run.value, other.value), False)


def least_costs(runs, tolerances):
    """[(least cost of any ladder, tolerance)] of those tolerances that a run meets."""
    own = ladders(runs).values()
    best = [(min(filter(None, (cheapest(ladder, tolerance) for ladder in own)), default=None), tolerance)
            for tolerance in tolerances]
    return [(entry.cost, tolerance) for entry, tolerance in best if entry]


def ranking(runs, tolerance):
    """The best Entry of each solver that gets there, cheapest first."""
    best = {}
    for (solver, _), ladder in ladders(runs).items():
        entry = cheapest(ladder, tolerance)
        if entry and (solver not in best or entry < best[solver]):
            best[solver] = entry
    return sorted(best.values())


# points of the ladder from `begin` to `end`, both values of its setting; kept within 0.2 of one slope.
Slope = namedtuple("Slope", "slope points begin end")


def slope(runs, error_floor=0.0):
    """The slope of log error over log value where a ladder is asymptotic, or None.

    That is its longest row of neighbours, three or more of them and all with errors above the floor, whose slopes from
    one to the next lie within 0.2 of that of the line through all of them; of two as long the one with smaller errors.
    """
    points = [(run.value, run.rms_error) for run in sorted(succeeded(runs), key=lambda run: run.value)
              if run.rms_error > error_floor]
    for count in range(len(points), 2, -1):
        rows = [points[begin:begin + count] for begin in range(len(points) - count + 1)]
        straight = [row for row in rows if is_straight(row)]
        if straight:
            best = min(straight, key=lambda row: row[0][1] * row[-1][1])
            return Slope(fitted_slope(best), count, best[0][0], best[-1][0])
    return None


def is_straight(points):
    overall = fitted_slope(points)
    return all(abs(fitted_slope(pair) - overall) <= 0.2 for pair in zip(points, points[1:]))


def fitted_slope(points):
    """By least squares in logarithms."""
    logs = [(math.log(value), math.log(error)) for value, error in points]
    middle = sum(x for x, _ in logs) / len(logs)
    return sum((x - middle) * y for x, y in logs) / sum((x - middle) ** 2 for x, _ in logs)
