"""The other charts of a scene: order, cost in force evaluations, and the other errors."""

import matplotlib.pyplot as plt

from work_precision import axes as chart
from work_precision import legend, scene_page


def draw(scene, runs, all_names):
    figure, panels = plt.subplots(2, 3, figsize=(12.4, 7.2))
    figure.subplots_adjust(left=0.055, right=0.985, top=0.87, bottom=0.075, wspace=0.2, hspace=0.34)
    figure.text(0.055, 0.965, scene_page.title(scene) + ": details", fontsize=12, va="center")
    figure.text(0.055, 0.935, scene_page.subtitle(scene, runs), va="center", color="#555555")
    steps = [run for run in runs if run.setting == "step"]
    chart.draw_ladders(panels[0, 0], steps, "value", "rms_error", all_names)
    label(panels[0, 0], "RMS error, m, against step: the slope is the order", "step, s")
    chart.draw_ladders(panels[0, 1], runs, "force_evaluations", "rms_error", all_names)
    label(panels[0, 1], "RMS error, m, against force evaluations", "force evaluations a simulated second")
    limits = chart.cost_limits(runs)
    for panel, error, name in ((panels[0, 2], "worst_error", "Error of the worst node, m"),
                               (panels[1, 0], "energy_error", "Error of the energy, J"),
                               (panels[1, 1], "strain_error", "Error of the worst strain")):
        draw_error(panel, error, name, runs, limits, all_names)
    panels[1, 2].axis("off")
    legend.add(panels[1, 2], runs, all_names, two_columns=True, with_front=False, loc="upper left",
               bbox_to_anchor=(-0.1, 1.05), fontsize=7.5)
    return figure


def draw_error(axes, error, name, runs, limits, all_names):
    label(axes, name, chart.COST)
    if any(getattr(run, error) for run in runs):
        chart.draw_work_precision(axes, runs, limits, all_names, error=error)
    else:
        axes.text(0.5, 0.5, "not measured", transform=axes.transAxes, ha="center", color="#555555")
        axes.set_xticks([])
        axes.set_yticks([])


def label(axes, title, across):
    axes.set_title(title, loc="left")
    axes.set_xlabel(across)
