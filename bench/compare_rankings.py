#!/usr/bin/env python3
"""Whether two runs of cloth_bench rank the solvers the same.

    bench/compare_rankings.py DIR1 DIR2

compares, scene by scene and at each error that the summary names, the costs of every two solvers. Where they differ by
more than 20 % in one run, the other run must have them in the same order. Who is too slow to get there in one run ranks
behind all who do, and so must not be cheaper by more than 20 % than any of them in the other. Prints how many pairs
were compared and each that disagrees; exit status 1 if any does, 2 if a file is malformed.
"""

import itertools
import sys

from work_precision import rankings, words
from work_precision.runs import Malformed, read


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    try:
        (_, first), (_, second) = (read(folder) for folder in sys.argv[1:])
    except Malformed as error:
        print("compare_rankings: {}".format(error), file=sys.stderr)
        return 2
    return report(compare(first, second))


def compare(first, second):
    """For each (scene, kind, tolerance) of both runs: how many pairs were compared, and lines on what disagrees."""
    found = {}
    for scene, kind in scenes_of(first) & scenes_of(second):
        for tolerance in rankings.TOLERANCES:
            costs = [costs_at(runs, scene, kind, tolerance) for runs in (first, second)]
            found[scene, kind, tolerance] = compare_costs(*costs)
    return found


def scenes_of(runs):
    return {(run.scene, run.kind) for run in runs if run.kind != "spatial"}


def costs_at(runs, scene, kind, tolerance):
    own = [run for run in runs if (run.scene, run.kind) == (scene, kind)]
    return {entry.solver: entry.cost for entry in rankings.ranking(own, tolerance)}


def compare_costs(first, second):
    pairs = 0
    faults = []
    for solver, other in itertools.combinations(sorted(first.keys() & second.keys()), 2):
        ratios = [costs[other] / costs[solver] for costs in (first, second)]
        if not any(max(ratio, 1.0 / ratio) > rankings.LEVEL for ratio in ratios):
            continue
        pairs += 1
        if (ratios[0] > 1.0) != (ratios[1] > 1.0):
            faults.append("{} costs {} {} in the first run, {} in the second".format(
                other, words.times(ratios[0]), solver, words.times(ratios[1])))
    for costs, others in ((first, second), (second, first)):
        for solver, other in itertools.product(sorted(costs.keys() - others.keys()),
                                               sorted(costs.keys() & others.keys())):
            pairs += 1
            ratio = costs[other] / costs[solver]
            if ratio > rankings.LEVEL:
                faults.append("{} costs {} {} in one run, and {} does not get there in the other".format(
                    other, words.times(ratio), solver, solver))
    return pairs, faults


def report(found):
    if not found:
        print("the two runs have no scene in common")
        return 1
    for (scene, kind, tolerance), (_, faults) in sorted(found.items()):
        for fault in faults:
            print("{} ({}), {}: {}".format(scene, kind, words.tolerance(tolerance), fault))
    pairs = sum(count for count, _ in found.values())
    wrong = sum(len(faults) for _, faults in found.values())
    print("{} pairs that differ by more than 20 %, {} disagreements".format(pairs, wrong))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
