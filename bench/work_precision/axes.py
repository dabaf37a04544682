"""Error against cost: the lines, the least cost at each error, real time and the tolerance, on given axes."""

import math

from matplotlib.ticker import LogFormatterSciNotation, LogLocator, NullLocator

from work_precision import failures, rankings, solvers

COST = "seconds of work a simulated second"
FASTER = "#eef5ea"
FRONT = "#f6d36b"
REAL_TIME = "#3d7a2b"
TOLERANCE = "#b3282d"
GRID = "#7a5c2e"


def draw_work_precision(axes, runs, limits, all_names, error="rms_error", with_spread=False):
    """One line a ladder. The front and the tolerance are of the RMS error alone."""
    axes.axvspan(limits[0], 1.0, color=FASTER, linewidth=0, zorder=0)
    axes.axvline(1.0, color=REAL_TIME, linewidth=1.0)
    if error == "rms_error":
        draw_front(axes, runs)
        for tolerance in tolerances(runs):
            axes.axhline(tolerance, color=TOLERANCE, linewidth=1.0, linestyle=(0, (2, 2)))
    if with_spread:
        draw_spread(axes, rankings.succeeded(runs), all_names)
    draw_ladders(axes, runs, "seconds_per_second", error, all_names)
    axes.set_xlim(limits)
    axes.set_ylim(error_limits(runs, error))


def draw_ladders(axes, runs, across, up, all_names):
    """Joins neighbours that both went well. A run that did not converge, but has an error, is drawn hollow."""
    axes.set_xscale("log")
    axes.set_yscale("log")
    for (name, setting), ladder in rankings.ladders(runs).items():
        style = line_style(name, setting, all_names)
        # A gap in the line is where a point is not a number.
        line = [point(run, across, up) if run.status == "ok" else (math.nan, math.nan) for run in ladder]
        axes.plot(*columns(line), **style)
        hollow = [point(run, across, up) for run in ladder if run.status != "ok"]
        axes.plot(*columns(hollow), **dict(style, linestyle="none", markerfacecolor="white"))
    set_decades(axes)


def line_style(name, setting, all_names):
    """Thin where a method that has a line over its steps has another one over its iterations."""
    solver = solvers.look_up(name, all_names)
    thin = {"linewidth": 0.7, "markersize": 3.5} if setting == "iterations" else {}
    return dict(color=solver.colour, linestyle=solvers.LINES[solver.family], marker=solver.marker, **thin)


def point(run, across, up):
    numbers = getattr(run, across), getattr(run, up)
    return numbers if all(number is not None and number > 0.0 for number in numbers) else (math.nan, math.nan)


def columns(points):
    return [x for x, _ in points], [y for _, y in points]


def draw_spread(axes, runs, all_names):
    for run in runs:
        if run.seconds_per_second_low and run.seconds_per_second_high:
            axes.plot([run.seconds_per_second_low, run.seconds_per_second_high], [run.rms_error] * 2,
                      color=solvers.look_up(run.solver, all_names).colour, linewidth=3.0, alpha=0.35,
                      solid_capstyle="butt")


def draw_front(axes, runs):
    """A band along the least cost at each error, with a halo round the runs that no other beats in both."""
    points = [(run.seconds_per_second, run.rms_error) for run in rankings.succeeded(runs)]
    if not points:
        return
    low, high = error_limits(runs, "rms_error")
    count = 400
    errors = [low * (high / low) ** (place / count) for place in range(count + 1)]
    style = {"color": FRONT, "zorder": 0.5}
    axes.plot(*columns(rankings.least_costs(runs, errors)), linewidth=5.0, solid_joinstyle="round", **style)
    axes.plot(*columns(rankings.pareto_front(points)), linestyle="none", marker="o", markersize=11.0,
              markeredgewidth=0.0, **style)


def tolerances(runs):
    return sorted({run.tolerance_line for run in runs if run.tolerance_line})


def cost_limits(runs):
    """Round all costs, failures' and real time."""
    costs = [1.0]
    for run in runs:
        costs += [run.seconds_per_second, run.seconds_per_second_low, run.seconds_per_second_high]
        if run.status != "ok":
            costs.append(failures.cost(run, runs))
    return widened([cost for cost in costs if cost], 1.5)


def error_limits(runs, name):
    errors = [getattr(run, name) for run in runs if run.seconds_per_second and getattr(run, name)]
    if name == "rms_error":
        errors += tolerances(runs)
    return widened([error for error in errors if error > 0.0] or [1e-3, 1.0], 2.0)


def widened(numbers, factor):
    return min(numbers) / factor, max(numbers) * factor


def set_decades(axes):
    """A line at each decade, or at every few, and nothing between them."""
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_locator(LogLocator(base=10.0, numticks=9))
        axis.set_minor_locator(NullLocator())
    axes.grid(which="major", color="#dddddd", linewidth=0.6)


def number_between_decades(axis):
    axis.set_minor_locator(LogLocator(base=10.0, subs=(2.0, 5.0)))
    axis.set_minor_formatter(LogFormatterSciNotation(minor_thresholds=(4, 2)))
