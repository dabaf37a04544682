"""The page of a scene: RMS error against cost, and above it a strip with the runs that failed."""

import matplotlib.pyplot as plt

from work_precision import axes as chart
from work_precision import failures, legend, words

LEFT, WIDTH = 0.075, 0.645  # of the axes, in parts of the figure's width


def draw(scene, runs, all_names):
    failed = [run for run in runs if run.status != "ok"]
    strip = 0.17 * len(failures.failing(failed))  # lengths in inches
    gap = 0.06 if failed else 0.0
    below, chart_height, above = 0.55, 5.2, 0.7
    height = below + chart_height + gap + strip + above
    figure = plt.figure(figsize=(10.4, height))
    figure.text(LEFT, 1.0 - 0.25 / height, title(scene), fontsize=12, va="center")
    figure.text(LEFT, 1.0 - 0.5 / height, subtitle(scene, runs), va="center", color="#555555")
    limits = chart.cost_limits(runs)
    if failed:
        rim = figure.add_axes([LEFT, (below + chart_height + gap) / height, WIDTH, strip / height])
        failures.draw(rim, failed, runs, limits, all_names)
    axes = figure.add_axes([LEFT, below / height, WIDTH, chart_height / height])
    chart.draw_work_precision(axes, runs, limits, all_names, with_spread=True)
    axes.set_xlabel(chart.COST)
    axes.set_ylabel("RMS error of the positions, m")
    name_lines(axes, runs, scene)
    legend.add(axes, runs, all_names, loc="upper left", bbox_to_anchor=(1.0, 1.0), fontsize=8.5)
    return figure


def title(scene):
    return scene.scene + (": with strain limit, against its own h to 0" if scene.kind == "limited" else "")


def subtitle(scene, runs):
    nodes = sorted({run.nodes for run in runs if run.nodes})
    parts = ["{} nodes".format(words.listed(["{:.0f}".format(number) for number in nodes]))] if nodes else []
    if scene.horizon is not None:
        parts.append("compared up to {} s".format(words.rounded(scene.horizon)))
    machines = sorted({run.machine for run in runs if run.machine})
    return ", ".join(parts) + (" ({})".format("; ".join(machines)) if machines else "")


def name_lines(axes, runs, scene):
    """Where nothing is: nobody is cheap and exact at once."""
    bottom, top = axes.get_ylim()
    left, right = axes.get_xlim()
    axes.text(0.97, bottom * 1.1, "real time", color=chart.REAL_TIME, rotation=90, ha="right", va="bottom", fontsize=8)
    for tolerance in chart.tolerances(runs):
        axes.text(left, tolerance, " tolerance {}".format(words.tolerance(tolerance)), color=chart.TOLERANCE,
                  ha="left", va="bottom", fontsize=8)
    if scene.reference_error and bottom < scene.reference_error < top:
        axes.axhspan(bottom, scene.reference_error, color="#e2e2e2", linewidth=0, zorder=0.2)
        axes.text(right, scene.reference_error, "less than the references differ ", color="#555555", ha="right",
                  va="top", fontsize=8)
