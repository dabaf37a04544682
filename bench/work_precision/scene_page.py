"""The page of a scene: RMS error against cost, and above it a strip with the runs that failed."""

import matplotlib.pyplot as plt

from work_precision import axes as chart
from work_precision import failures, grid, legend, words

LEFT, WIDTH = 0.125, 0.595  # of the axes, in parts of the figure's width


def draw(scene, runs, all_names, own_grid=None):
    failed = [run for run in runs if run.status != "ok"]
    strip = 0.17 * len(failures.failing(failed))  # lengths in inches
    gap = 0.06 if failed else 0.0
    below, chart_height, above = 0.55, 5.2, 0.78
    height = below + chart_height + gap + strip + above
    figure = plt.figure(figsize=(11.0, height))
    figure.text(LEFT, 1.0 - 0.25 / height, title(scene), fontsize=12, va="center")
    figure.text(LEFT, 1.0 - 0.5 / height, subtitle(scene, runs), va="center", color="#555555")
    limits = chart.cost_limits(runs)
    if failed:
        rim = figure.add_axes([LEFT, (below + chart_height + gap) / height, WIDTH, strip / height])
        failures.draw(rim, failed, runs, limits, all_names)
        name_real_time(rim)
    axes = figure.add_axes([LEFT, below / height, WIDTH, chart_height / height])
    chart.draw_work_precision(axes, runs, limits, all_names, with_spread=True)
    axes.set_xlabel(chart.COST)
    axes.set_ylabel("RMS error of the positions, m")
    if not failed:
        name_real_time(axes)
    for tolerance in chart.tolerances(runs):
        name_level(axes, tolerance, "tolerance " + words.tolerance(tolerance), chart.TOLERANCE)
    mark_what_errors_mean(axes, scene, own_grid)
    legend.add(axes, runs, all_names, loc="upper left", bbox_to_anchor=(1.0, 1.0), fontsize=8.5)
    return figure


def title(scene):
    return scene.scene + (": with strain limit, against the same rule at h to 0" if scene.kind == "limited" else "")


def subtitle(scene, runs):
    nodes = sorted({run.nodes for run in runs if run.nodes})
    parts = ["{} nodes".format(words.listed(["{:.0f}".format(number) for number in nodes]))] if nodes else []
    if scene.horizon is not None:
        parts.append("compared up to {} s".format(words.rounded(scene.horizon)))
    machines = sorted({run.machine for run in runs if run.machine})
    return ", ".join(parts) + (" ({})".format("; ".join(machines)) if machines else "")


def name_real_time(axes):
    axes.annotate("real time", (1.0, 1.0), xycoords=axes.get_xaxis_transform(), xytext=(0.0, 2.0),
                  textcoords="offset points", color=chart.REAL_TIME, ha="center", va="bottom", fontsize=8)


def mark_what_errors_mean(axes, scene, own_grid):
    """Errors far below that of the grid are of no use; those below that of the reference are none."""
    bottom, top = axes.get_ylim()
    if own_grid and bottom < own_grid.rms_error < top:
        axes.axhline(own_grid.rms_error, color=chart.GRID, linewidth=1.0, linestyle=(0, (6, 2)))
        name_level(axes, own_grid.rms_error, "error of the grid " + grid.horizon_in_words(own_grid), chart.GRID)
    if scene.reference_error and bottom < scene.reference_error < top:
        axes.axhspan(bottom, scene.reference_error, color="#e2e2e2", linewidth=0, zorder=0.2)
        name_level(axes, scene.reference_error, "the references differ", "#555555")


def name_level(axes, error, text, colour):
    """On the left, where nothing is: nobody is cheap and exact at once."""
    axes.text(axes.get_xlim()[0], error, " " + text, color=colour, ha="left", va="bottom", fontsize=8)
