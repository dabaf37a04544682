"""One chart a criterion, the halves side by side."""

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.ticker import FuncFormatter, LogLocator, NullLocator

from plan_matrix import verdict

COLOURS = {1e-2: "#0072b2", 1e-3: "#e69f00", 1e-4: "#cc3311"}
BAND = "#e5e5e5"


def draw_all(halves):
    """Pairs of a name and a figure."""
    for name, draw in (("honest", draw_honest), ("cheap", draw_cheap), ("planning", draw_planning),
                       ("monotone", draw_monotone), ("necessary", draw_necessary)):
        figure, rows = plt.subplots(1, len(halves), figsize=(4.6 * len(halves), 3.8), squeeze=False, sharex=True, sharey=True)
        for axes, half in zip(rows[0], halves):
            draw(axes, half)
            axes.set_title(half.name.replace("_", " "))
        figure.tight_layout()
        yield name, figure


def colour(tolerance):
    return COLOURS.get(tolerance, "#555555")


def by_tolerance(plans):
    for tolerance in sorted({plan.tolerance for plan in plans}, reverse=True):
        yield tolerance, [plan for plan in plans if plan.tolerance == tolerance]


def label(tolerance):
    return "{:g} m".format(tolerance)


def draw_honest(axes, half):
    """The true error over the estimate; dotted, what was asked for."""
    low, high = verdict.ESTIMATE_RANGE
    axes.set(xscale="log", yscale="log", xlabel="estimated error, m", ylabel="true error, m")
    edges = [1e-8, 1e1]
    axes.fill_between(edges, [x / high for x in edges], [x / low for x in edges], color=BAND, linewidth=0.0)
    drawn = []
    for tolerance, plans in by_tolerance(half.plans):
        points = [(plan.estimate, plan.true_error) for plan in plans if plan.estimate and plan.true_error]
        drawn += [number for point in points for number in point]
        axes.plot([x for x, _ in points], [y for _, y in points], "o", color=colour(tolerance), label=label(tolerance))
        axes.axhline(tolerance, color=colour(tolerance), linestyle=":", linewidth=1.0)
    if drawn:
        axes.set(xlim=(0.5 * min(drawn), 2.0 * max(drawn)), ylim=(0.5 * min(drawn), 2.0 * max(drawn)))
    axes.legend(title="tolerance", frameon=False)


def draw_shares(axes, half, value, most, name):
    """Which part of the plans is at most so high."""
    axes.set(xscale="log", xlabel=name, ylabel="part of the plans", ylim=(0.0, 1.02))
    axes.axvline(most, color="#555555", linestyle=":", linewidth=1.0)
    for tolerance, plans in by_tolerance(half.plans):
        values = sorted(number for number in map(value, plans) if number is not None)
        if values:
            parts = [(count + 1.0) / len(plans) for count in range(len(values))]
            axes.step(values, parts, where="post", color=colour(tolerance), label=label(tolerance))
    axes.legend(title="tolerance", frameon=False)


def draw_cheap(axes, half):
    draw_shares(axes, half, lambda plan: verdict.ratio(plan.cost, plan.best_cost), verdict.MOST_COST,
                "cost, times the best of the search")
    number_plainly(axes.xaxis)


def draw_planning(axes, half):
    draw_shares(axes, half, lambda plan: verdict.ratio(plan.planning, verdict.RUN_LENGTH * (plan.cost or 0.0)),
                verdict.PLANNING_SHARE, "planning time, parts of a run of 10 s")


def draw_monotone(axes, half):
    """A line a scene: what is the same choice costs the same."""
    axes.set(xscale="log", yscale="log", xlabel="tolerance, m", ylabel="cost, times that at the tightest tolerance")
    for scene in sorted({plan.scene for plan in half.plans}):
        plans = sorted((plan for plan in half.plans if plan.scene == scene and verdict.went_well(plan)),
                       key=lambda plan: plan.tolerance)
        costs = [1.0]
        for tight, loose in zip(plans, plans[1:]):
            costs.append(costs[-1] * verdict.cost_ratio(loose, tight))
        is_good = all(loose <= verdict.MONOTONE_MARGIN * tight for tight, loose in zip(costs, costs[1:]))
        axes.plot([plan.tolerance for plan in plans], costs[:len(plans)], color="#999999" if is_good else "#cc3311",
                  linewidth=0.8)
    number_plainly(axes.yaxis)


def number_plainly(axis):
    axis.set_major_locator(LogLocator(base=10.0, subs=(1.0, 2.0, 5.0)))
    axis.set_major_formatter(FuncFormatter(lambda value, _: "{:g}".format(value)))
    axis.set_minor_locator(NullLocator())


def draw_necessary(axes, half):
    """What a part comes to, left out and kept, in tolerances."""
    axes.set(xscale="log", xlabel="change of the answer, tolerances", ylabel="")
    names = sorted({part.part for part in half.parts})
    for place, name in enumerate(names):
        for was, offset, style in (("yes", 0.15, "v"), ("no", -0.15, "^")):
            changes = [part.change / part.tolerance for part in half.parts
                       if part.part == name and part.is_left_out == was and part.change]
            axes.plot(changes, [place + offset] * len(changes), style, markersize=3.5, alpha=0.6,
                      color="#0072b2" if was == "yes" else "#333333",
                      label={"yes": "left out", "no": "kept"}[was] if place == 0 else None)
    axes.set_yticks(range(len(names)))
    axes.set_yticklabels(names)
    axes.set_ylim(-0.5, max(1, len(names)) - 0.5)
    axes.axvline(1.0, color="#0072b2", linestyle=":", linewidth=1.0)
    axes.axvline(verdict.NECESSARY_SHARE, color="#333333", linestyle=":", linewidth=1.0)
    if names:
        axes.legend(frameon=False, loc="upper center", bbox_to_anchor=(0.5, -0.15), ncol=2)
