"""The Pareto front, the cost at an error, and the measured order."""

import os
import re
import tempfile
import unittest

import synthetic_runs as synthetic
from work_precision import grid, rankings, solvers
from work_precision.runs import read

METHODS_PAGE = os.path.join(os.path.dirname(__file__), "..", "..", "docs", "methods.md")


def read_back(rows):
    with tempfile.TemporaryDirectory() as folder:
        synthetic.write(folder, [synthetic.scene()], rows)
        return read(folder)[1]


class Front(unittest.TestCase):
    def test_has_what_no_other_beats_in_both(self):
        points = [(1.0, 1e-2), (2.0, 1e-2), (0.5, 1e-1), (3.0, 1e-4), (4.0, 1e-3), (0.5, 2e-1), (3.0, 1e-3)]
        self.assertEqual(rankings.pareto_front(points), [(0.5, 1e-1), (1.0, 1e-2), (3.0, 1e-4)])

    def test_of_nothing_is_empty(self):
        self.assertEqual(rankings.pareto_front([]), [])

    def test_least_costs_follow_the_cheapest_ladder(self):
        runs = read_back([synthetic.good_run("rk4", "step", 2e-3, 1e-2, 1.0),
                          synthetic.good_run("rk4", "step", 1e-3, 1e-4, 2.0),
                          synthetic.good_run("xpbd", "step", 1e-3, 1e-1, 0.5)])
        self.assertEqual(rankings.least_costs(runs, [1e-1, 1e-2, 1e-6]), [(0.5, 1e-1), (1.0, 1e-2)])


class Cost(unittest.TestCase):
    def setUp(self):
        self.rows = [synthetic.good_run("rk4", "step", 4e-3, 1e-1, 1.0),
                     synthetic.good_run("rk4", "step", 1e-3, 1e-3, 4.0),
                     synthetic.run("rk4", "step", 8e-3, status="unstable")]

    def cheapest(self, tolerance):
        (ladder,) = rankings.ladders(read_back(self.rows)).values()
        return rankings.cheapest(ladder, tolerance)

    def test_between_two_runs_is_on_the_straight_line_in_logarithms(self):
        entry = self.cheapest(1e-2)
        self.assertAlmostEqual(entry.cost, 2.0, places=12)
        self.assertAlmostEqual(entry.value, 2e-3, places=15)
        self.assertFalse(entry.measured)

    def test_where_all_runs_are_more_exact_is_that_of_the_cheapest(self):
        self.assertEqual(self.cheapest(0.2), (1.0, "rk4", "step", 4e-3, True))

    def test_is_none_where_no_run_is_so_exact(self):
        self.assertIsNone(self.cheapest(1e-4))

    def test_is_not_taken_from_a_run_that_failed(self):
        self.rows[0]["status"] = "not_converged"
        self.assertEqual(self.cheapest(1e-2), (4.0, "rk4", "step", 1e-3, True))

    def test_is_not_taken_across_a_run_that_failed(self):
        self.rows.append(synthetic.run("rk4", "step", 2e-3, status="not_converged"))
        self.assertEqual(self.cheapest(1e-2), (4.0, "rk4", "step", 1e-3, True))

    def test_ranks_each_solver_by_its_best_ladder(self):
        self.rows += [synthetic.good_run("xpbd", "iterations", 10, 1e-2, 3.0),
                      synthetic.good_run("xpbd", "step", 1e-3, 1e-2, 2.5)]
        found = rankings.ranking(read_back(self.rows), 1e-2)
        self.assertEqual([(entry.solver, entry.setting) for entry in found], [("rk4", "step"), ("xpbd", "step")])


class Order(unittest.TestCase):
    def slope(self, errors, floor=0.0):
        rows = [synthetic.good_run("rk4", "step", 1e-2 / 2 ** place, error, 1.0) for place, error in enumerate(errors)]
        return rankings.slope(read_back(rows), floor)

    def test_is_the_slope_of_every_law(self):
        for solver, law in synthetic.LAWS.items():
            runs = read_back(synthetic.runs_by_step(solver, law))
            found = rankings.slope(runs)
            with self.subTest(solver):
                if law.longest < min(synthetic.STEPS):
                    self.assertIsNone(found)
                else:
                    self.assertAlmostEqual(found.slope, law.order, places=9)
                    self.assertEqual(found.points, sum(step <= law.longest for step in synthetic.STEPS))

    def test_leaves_out_where_the_ladder_is_not_asymptotic(self):
        found = self.slope([0.5, 0.3, 0.25, 1e-2, 1e-2 / 4, 1e-2 / 16, 1e-2 / 64, 1e-4])
        self.assertAlmostEqual(found.slope, 2.0, places=9)
        self.assertEqual((found.points, found.begin, found.end), (4, 1e-2 / 64, 1e-2 / 8))

    def test_leaves_out_errors_below_the_floor(self):
        self.assertEqual(self.slope([1e-2, 1e-2 / 4, 1e-2 / 16, 1e-2 / 64], floor=5e-4).points, 3)

    def test_needs_three_runs(self):
        self.assertIsNone(self.slope([1e-2, 1e-2 / 4]))


class Grid(unittest.TestCase):
    def found(self, rows):
        with tempfile.TemporaryDirectory() as folder:
            synthetic.write(folder, [synthetic.scene(kind="spatial")], rows)
            return grid.grids("sheet", read(folder)[1])

    def test_order_is_that_of_the_law(self):
        for order in (0.5, 1, 2):
            self.assertAlmostEqual(grid.order(self.found(synthetic.spatial_runs(order))), order, places=9)

    def test_without_order_is_said_to_be(self):
        coarse, fine = synthetic.spatial_runs()
        self.assertEqual(grid.order_in_words(self.found([coarse, dict(fine, rms_error=0.9 * coarse["rms_error"])])),
                         "no order yet")
        self.assertEqual(grid.order_in_words(self.found([coarse])), "")


class Solvers(unittest.TestCase):
    def test_are_the_methods_of_the_table_with_their_orders(self):
        with open(METHODS_PAGE, encoding="utf-8") as page:
            documented = re.findall(r"^\| (\w+) \| (\d) \|", page.read(), re.MULTILINE)
        self.assertEqual([(name, str(solver.order)) for name, solver in solvers.OURS.items()], documented)

    def test_outside_the_table_are_independent_and_look_different(self):
        names = ["cvode_bdf", "odeint_bulirsch_stoer", "odeint_dopri5", "rk4"]
        found = [solvers.look_up(name, names) for name in names]
        self.assertEqual([solver.family for solver in found], ["independent"] * 3 + ["explicit"])
        self.assertEqual(len({solver.colour for solver in found}), 4)


if __name__ == "__main__":
    unittest.main()
