#!/usr/bin/env python3
"""Charts and the verdict in words of what plan_matrix has measured.

    bench/plot_plan_matrix.py DIR [OUT_DIR] [--build BUILD] [--no-charts]

reads DIR/development and DIR/held_out, as far as they are there, and writes to OUT_DIR (default: DIR) verdict.md and
honest, cheap, planning, monotone and necessary, each as .png and .svg. BUILD is a program's number in plans.csv; without
it the one that planned last. The table of the verdict is printed.
"""

import argparse
import os
import sys

from plan_matrix import report, tables, verdict
from work_precision.runs import Malformed


def main():
    arguments = parse()
    try:
        halves = tables.read(arguments.folder, arguments.build)
    except Malformed as error:
        sys.exit("plot_plan_matrix: {}".format(error))
    if not halves:
        sys.exit("plot_plan_matrix: {} has no plans: neither development/plans.csv nor held_out/plans.csv".format(
            arguments.folder))
    out = arguments.out or arguments.folder
    os.makedirs(out, exist_ok=True)
    report.write(os.path.join(out, "verdict.md"), halves)
    for half in halves:
        print("{}\n{}".format(half.name, report.table(verdict.criteria(half))))
    if arguments.charts:
        draw(halves, out)


def draw(halves, out):
    from plan_matrix import charts
    from work_precision import figures
    figures.set_style()
    for name, figure in charts.draw_all(halves):
        figures.save(figure, out, name)


def parse():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", metavar="DIR")
    parser.add_argument("out", metavar="OUT_DIR", nargs="?")
    parser.add_argument("--build")
    parser.add_argument("--no-charts", dest="charts", action="store_false")
    return parser.parse_args()


if __name__ == "__main__":
    main()
