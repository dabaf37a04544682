"""Whether plans keep their promises, in numbers.

A criterion holds when enough of the cases that it speaks of are good. A plan that could not be made or did not come to
its end is good in none.
"""

from collections import namedtuple

ESTIMATE_RANGE = (0.3, 3.0)
MOST_COST = 1.5
RUN_LENGTH = 10.0  # s simulated
PLANNING_SHARE = 0.1
MONOTONE_MARGIN = 1.1
NECESSARY_SHARE = 0.25
RESOLUTION = 5.0  # an error less than so many times the reference's own says nothing about estimates

Criterion = namedtuple("Criterion", "name asked needed cases")
Case = namedtuple("Case", "about good value")


def criteria(half):
    """Those of one half; `value` of a case is the number that is judged, or None where there is none."""
    return [
        Criterion("honest", "true error within the tolerance", 0.95, honest(half)),
        Criterion("estimate", "estimate over true error within [0.3, 3]", 0.9, estimates(half)),
        Criterion("cheap", "costs at most 1.5 times the best of the search", 0.9, cheap(half)),
        Criterion("planning", "planning takes less than 10 % of what a run of 10 s takes to work out", 0.9, planning(half)),
        Criterion("start", "planning takes less than 10 % of the 10 s that such a run lasts in a node", 0.9, start(half)),
        Criterion("monotone", "a looser tolerance costs no more, within 10 %", 1.0, monotone(half)),
        Criterion("left out", "forced on, the answer changes by less than the tolerance", 1.0, left_out(half)),
        Criterion("kept", "forced off, it changes by more than a quarter of the tolerance", 1.0, kept(half)),
    ]


def share(criterion):
    """Of good cases; None where there are none to judge."""
    return sum(case.good for case in criterion.cases) / len(criterion.cases) if criterion.cases else None


def holds(criterion):
    return None if not criterion.cases else share(criterion) >= criterion.needed


def failing(criterion):
    return [case for case in criterion.cases if not case.good]


def about(row):
    return "{} at {:.0e} m".format(row.scene, row.tolerance).replace("e-0", "e-")


def went_well(plan):
    return plan.status in ("ok", "not_converged")


def admits_failure(plan):
    """It says itself that the tolerance is not met."""
    return plan.estimate is not None and plan.estimate > plan.tolerance


def ratio(one, other):
    return one / other if one is not None and other else None


def honest(half):
    """Plans that say that they miss the tolerance are honest about it; that they could have met it counts as dear."""
    return [Case(about(plan), went_well(plan) and plan.true_error <= plan.tolerance, ratio(plan.true_error, plan.tolerance))
            for plan in half.plans if not admits_failure(plan)]


def estimates(half):
    own_error = {draw.scene: draw.reference_error or 0.0 for draw in half.draws}
    cases = []
    for plan in half.plans:
        if went_well(plan) and plan.true_error < RESOLUTION * own_error.get(plan.scene, 0.0):
            continue
        value = ratio(plan.estimate, plan.true_error)
        low, high = ESTIMATE_RANGE
        cases.append(Case(about(plan), value is not None and low <= value <= high, value))
    return cases


def cheap(half):
    """Where the search found something that meets the tolerance."""
    cases = []
    for plan in half.plans:
        if plan.best_solver:
            value = ratio(plan.cost, plan.best_cost) if went_well(plan) and not admits_failure(plan) else None
            cases.append(Case(about(plan), value is not None and value <= MOST_COST, value))
    return cases


def planning(half):
    cases = []
    for plan in half.plans:
        value = ratio(plan.planning, RUN_LENGTH * plan.cost) if plan.cost else None
        cases.append(Case(about(plan), value is not None and value < PLANNING_SHARE, value))
    return cases


def start(half):
    """A node is there once the plan is made, and then runs in real time."""
    cases = []
    for plan in half.plans:
        value = ratio(plan.planning_seconds, RUN_LENGTH)
        cases.append(Case(about(plan), value is not None and value < PLANNING_SHARE, value))
    return cases


def choice(plan):
    """Of the settings those that the method reads."""
    return (plan.method, plan.left_out, plan.time_step, plan.method_tolerance if plan.method == "dopri5" else None,
            plan.iterations if plan.method in ("projective", "xpbd") else None)


def cost_ratio(one, other):
    """What is the same choice costs the same."""
    return 1.0 if choice(one) == choice(other) else ratio(one.cost, other.cost)


def monotone(half):
    """Of each scene, every tolerance against the next tighter one, unless the plan for that says that it misses it: then
    its cost is not that of the tolerance."""
    cases = []
    for scene in sorted({plan.scene for plan in half.plans}):
        plans = sorted((plan for plan in half.plans if plan.scene == scene), key=lambda plan: -plan.tolerance)
        for loose, tight in zip(plans, plans[1:]):
            if not went_well(loose) or not went_well(tight) or admits_failure(tight):
                continue
            value = cost_ratio(loose, tight)
            cases.append(Case(about(loose), value <= MONOTONE_MARGIN, value))
    return cases


def left_out(half):
    return [Case("{}: {}".format(about(part), part.part), part.change is not None and part.change < part.tolerance,
                 ratio(part.change, part.tolerance)) for part in half.parts if part.is_left_out == "yes"]


def kept(half):
    """A part whose removal leaves no motion to compare is not seen to be needless."""
    return [Case("{}: {}".format(about(part), part.part),
                 part.change is None or part.change > NECESSARY_SHARE * part.tolerance,
                 ratio(part.change, part.tolerance)) for part in half.parts if part.is_left_out == "no"]
