"""What a simulated cluster does (results/cluster/make.py), beside what follows by hand."""

import importlib.util
import pathlib
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "results"))
_spec = importlib.util.spec_from_file_location("cluster_page", ROOT / "results/cluster/make.py")
page = importlib.util.module_from_spec(_spec)
sys.modules[_spec.name] = page  # where dataclasses look
_spec.loader.exec_module(page)

IDEAL = page.IDEAL


def run(cluster, evaluations, runs, generations, executors, times=(1,), seed=1):
    return page.Simulation(cluster, evaluations, runs, generations, executors, list(times), seed)


class Cluster(unittest.TestCase):
    def test_waits_for_the_last_evaluation_of_a_generation(self):
        """10 evaluations on 4 executors take three rounds."""
        done = run(IDEAL, 10, 1, 5, 4)
        self.assertAlmostEqual(15, done.seconds, 9)
        self.assertAlmostEqual(10 / 12, done.efficiency, 9)

    def test_a_driver_hands_out_one_after_another(self):
        """One evaluation begins every half second, so two executors are busy however many there are."""
        self.assertAlmostEqual(20 * 0.5 + 1, run(page.replace(IDEAL, per_part=0.4, per_evaluation=0.1), 20, 1, 1, 100).seconds, 9)
        self.assertAlmostEqual(3 * 1.25 + 2 * 2, run(page.replace(IDEAL, latency=0.25, per_generation=2), 4, 1, 3, 4).seconds, 9)

    def test_short_evaluations_go_out_together(self):
        """Ten evaluations of 0.1 s on one executor: 5, 2, 1, 1 and 1 of them, each part half a second of the driver."""
        self.assertAlmostEqual(5 * 0.5 + 10 * 0.1, run(page.replace(IDEAL, per_part=0.5), 10, 1, 1, 1, [0.1]).seconds, 9)

    def test_several_runs_fill_each_others_gaps(self):
        done = run(IDEAL, 10, 8, 5, 4)
        self.assertGreater(done.efficiency, 0.97)
        self.assertAlmostEqual(8 * 5 * 10, done.seconds * 4 * done.efficiency, 6)

    def test_slow_executors_are_overtaken(self):
        """After the limit of 10 s another one takes a second; the slow one, one of 100 by seed 2, is then free for the next generation."""
        slow = page.replace(IDEAL, slow_share=0.01, slow_factor=100)
        self.assertAlmostEqual(300, run(slow, 300, 1, 3, 100, seed=2).seconds, 9)
        done = run(page.replace(slow, speculation=True), 300, 1, 3, 100, seed=2)
        self.assertEqual(3, done.copies)
        self.assertAlmostEqual(3 * 11, done.seconds, 9)

    def test_what_fails_is_done_again(self):
        """One in ten is lost, after a second in the mean; an executor is away for a third of the time."""
        done = run(page.replace(IDEAL, failures_per_hour=180, restart=10), 200, 2, 5, 20, [2])
        self.assertAlmostEqual(4000, done.seconds * 20 * done.efficiency, 6)  # every evaluation counts once
        self.assertTrue(150 <= done.lost <= 260 and 0.5 <= done.efficiency <= 0.7, (done.lost, done.efficiency))

    def test_a_limit_is_before_the_first_that_falls_below(self):
        def rows(*efficiencies):
            return page.pandas.DataFrame({"executors": [10, 20, 30][:len(efficiencies)], "efficiency": efficiencies})
        self.assertEqual(["20", "10", "fewer than 10", "more than 10000"],
                         [page.limit(one) for one in (rows(0.9, 0.8, 0.7), rows(0.9, 0.7, 0.9), rows(0.7, 0.9), rows(0.9, 0.9))])

    def test_the_committed_rows_are_what_it_gives(self):
        table = page.pandas.read_csv(ROOT / "results/cluster/efficiency.csv")
        times = page.pandas.read_csv(ROOT / "results/cluster/times.csv").seconds.tolist()
        for name in list(page.LOADS)[:2]:
            evaluations, runs, generations, cluster = page.LOADS[name]
            done = [run(cluster, evaluations, runs, generations, 100, times, seed).efficiency for seed in range(1, page.REPEATS + 1)]
            row = table[(table.variant == name) & (table.executors == 100)].iloc[0]
            self.assertAlmostEqual(row.efficiency, sum(done) / len(done), 12)


if __name__ == "__main__":
    unittest.main()
