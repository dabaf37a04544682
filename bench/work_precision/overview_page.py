"""All scenes at a glance, those with a strain limit apart, and those that were refused."""

import textwrap

import matplotlib.pyplot as plt

from work_precision import axes as chart
from work_precision import legend

COLUMNS = 3


def draw(scenes, runs, all_names):
    in_order = [scene for kind in ("trajectory", "limited") for scene in scenes if scene.kind == kind]
    lines = -(-(len(in_order) + 1) // COLUMNS)
    height = 3.3 * lines + 0.7
    figure, panels = plt.subplots(lines, COLUMNS, figsize=(12.0, height), squeeze=False)
    figure.subplots_adjust(left=0.06, right=0.985, top=1.0 - 0.75 / height, bottom=0.5 / height, wspace=0.2,
                           hspace=0.32)
    figure.text(0.06, 1.0 - 0.25 / height, "RMS error of the positions, m, against " + chart.COST, fontsize=12,
                va="center")
    shown = [run for run in runs if run.kind != "spatial"]
    limits = chart.cost_limits(shown)
    places = list(panels.flat)
    for axes, scene in zip(places, in_order):
        draw_scene(axes, scene, [run for run in shown if (run.scene, run.kind) == (scene.scene, scene.kind)], limits,
                   all_names)
    for axes in places[len(in_order):]:
        axes.axis("off")
    legend.add(places[len(in_order)], shown, all_names, two_columns=True, loc="upper left",
               bbox_to_anchor=(-0.1, 1.05), fontsize=7.5)
    return figure


def draw_scene(axes, scene, runs, limits, all_names):
    axes.set_title(scene.scene + (": with strain limit" if scene.kind == "limited" else ""),
                   loc="left")
    if scene.accepted == "no" or not runs:
        axes.set_xticks([])
        axes.set_yticks([])
        axes.set_facecolor("#f4f4f4")
        text = "refused: " + scene.reason if scene.accepted == "no" else "no runs yet"
        axes.text(0.5, 0.5, textwrap.fill(text, 40), transform=axes.transAxes, ha="center", va="center",
                  color="#555555")
        return
    chart.draw_work_precision(axes, runs, limits, all_names)
    failed = [run for run in runs if run.status != "ok"]
    if failed:
        axes.text(0.99, 0.985, "{} of {} runs failed".format(len(failed), len(runs)), transform=axes.transAxes,
                  ha="right", va="top", fontsize=7, color="#555555",
                  bbox={"facecolor": "white", "edgecolor": "none", "pad": 1.0})
