"""Evaluations, trajectories and driven swimmers through the Python client."""

import json
import subprocess
import tempfile
import time
import unittest
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from unittest import mock

import natator
import numpy as np
from natator.program import simulator_path
from natator.simulator import make_request

TANK = "bench/small-tank"
GAIT = natator.Gait(1.861, [0.973, 0.69], [0, 0.648])
ALL_THE_WAY = {"stopping": {"planeContact": False, "noProgressAfter": 0}}


def evaluated(**request):
    """The simulator's own answer."""
    text = json.dumps(make_request(TANK, GAIT, id=1, **request))
    return json.loads(subprocess.run([simulator_path(), "evaluate"], input=text.encode(), capture_output=True).stdout)


class EvaluationTest(unittest.TestCase):
    def test_one_is_what_the_program_says(self):
        result = natator.evaluate(TANK, GAIT, duration=0.1, start=2)
        self.assertEqual(result["hash"], evaluated(duration=0.1, start=2)["hash"])
        self.assertEqual(result["fitness"], result["distance"])

    def test_a_gait_is_given_as_a_whole(self):
        gait = natator.Gait(1.5, np.array([0.5, 0.6]), (0, 0.5), offset=[0.2, -0.1], power=2)
        request = {"id": 1, "scene": TANK, "duration": 0.1, "gait": {
            "frequency": 1.5, "amplitude": [0.5, 0.6], "phase": [0, 0.5], "offset": [0.2, -0.1], "power": 2}}
        done = subprocess.run([simulator_path(), "evaluate"], input=json.dumps(request).encode(), capture_output=True)
        self.assertEqual(natator.evaluate(TANK, gait, duration=0.1)["hash"], json.loads(done.stdout)["hash"])

    def test_numbers_of_numpy_and_paths_are_taken(self):
        gait = {"frequency": np.float32(1.5), "amplitude": np.array([0.5, 0.6]), "phase": (0, np.float64(0.5))}
        plain = {"frequency": 1.5, "amplitude": [0.5, 0.6], "phase": [0, 0.5]}
        self.assertEqual(natator.evaluate(Path(TANK), gait, duration=np.float64(0.1), start=np.int64(2))["hash"],
                         natator.evaluate(TANK, plain, duration=0.1, start=2)["hash"])

    def test_what_json_cannot_hold_is_refused_before_anything_is_sent(self):
        with natator.Simulator(1) as simulator:
            for duration, message in ((float("nan"), "requests[1].duration = nan: must be a finite number"),
                                      ({1, 2}, "requests[1].duration = {1, 2}: must be a number, a text, a list or a dict")):
                with self.assertRaises(natator.InputError) as refused:
                    simulator.evaluate_all([make_request(TANK, GAIT, duration=0.05), {"scene": TANK, "duration": duration}])
                self.assertEqual(str(refused.exception), message)
            self.assertEqual(simulator.evaluate(TANK, GAIT, duration=0.05)["status"], "ok")

    def test_which_of_many_requests_is_refused_is_told(self):
        with natator.Simulator(1) as simulator:
            with self.assertRaisesRegex(natator.InputError, r"^requests\[1\]: gait\.amplitude\[0\] = 5: must be"):
                simulator.evaluate_all([make_request(TANK, GAIT, duration=0.05), make_request(TANK, natator.Gait(1, [5, 0], [0, 0]))])

    def test_what_is_no_request_is_refused_in_one_line(self):
        cyclic, deep = {}, {}
        cyclic["solver"] = cyclic
        part = deep
        for _ in range(900):
            part["solver"] = part = {}
        with natator.Simulator(1) as simulator, natator.Stream(TANK) as stream:
            for requests, message in (
                    (3, "requests = 3: must be a list of dicts"),
                    ({"scene": TANK}, "requests = {'scene': 'bench/small-tank'}: must be a list of dicts"),
                    ([3], "requests[0] = 3: must be a dict"), ([{"scene": TANK}, "abc"], "requests[1] = 'abc': must be a dict"),
                    ([None], "requests[0] = None: must be a dict"), ([[]], "requests[0] = []: must be a dict"),
                    ([{(1, 2): 3}], "key (1, 2): must be a text"),
                    ([make_request(TANK, GAIT, overrides={"solver": {(1, 2): 3}})], "overrides.solver: key (1, 2): must be a text"),
                    ([make_request(TANK, GAIT, overrides=cyclic)],
                     "overrides.solver.solver.solver.solver.solver.solver.solver.s…: nested deeper than 100 levels"),
                    ([make_request(TANK, GAIT, overrides=deep)],
                     "overrides.solver.solver.solver.solver.solver.solver.solver.s…: nested deeper than 100 levels")):
                with self.subTest(message):
                    with self.assertRaises(natator.InputError) as refused:
                        simulator.evaluate_all(requests)
                    self.assertEqual(str(refused.exception), message)
            for overrides in ({(1, 2): 3}, cyclic, deep):
                with self.assertRaises(natator.InputError):
                    natator.Stream(TANK, overrides=overrides)
                with self.assertRaises(natator.InputError):
                    stream.ask({"do": "overrides", "overrides": overrides})
            with self.assertRaisesRegex(natator.InputError, "null byte"):
                natator.Stream("bench\0")
            self.assertEqual(simulator.evaluate(TANK, GAIT, duration=0.05)["status"], "ok")
            self.assertEqual(stream.step(1).frame, 1)

    def test_an_interrupted_simulator_is_closed(self):
        with natator.Simulator(1) as simulator:
            with mock.patch("natator.program.exchange", side_effect=KeyboardInterrupt), self.assertRaises(KeyboardInterrupt):
                simulator.evaluate(TANK, GAIT, duration=0.05)
            with self.assertRaisesRegex(natator.ProgramError, "closed"):
                simulator.evaluate(TANK, GAIT, duration=0.05)

    def test_many_come_in_order_whatever_the_number_of_workers(self):
        requests = [make_request(TANK, GAIT, duration=0.05 + 0.05 * (k % 3), start=k) for k in range(7)]
        with natator.Simulator(workers=1) as one, natator.Simulator(workers=3) as three:
            expected, results = one.evaluate_all(requests), three.evaluate_all(requests)
            self.assertEqual(three.evaluate_all([]), [])
        self.assertEqual([r["hash"] for r in results], [r["hash"] for r in expected])
        self.assertEqual([r["frames"] for r in results], [3, 6, 9, 3, 6, 9, 3])

    def test_threads_that_share_one_get_their_own_answers(self):
        def max_at_once(self, lines):
            nonlocal inside, most
            inside += 1
            most = max(most, inside)
            time.sleep(0.02)
            inside -= 1
            return answers(self, lines)

        inside, most, answers = 0, 0, natator.Simulator._answers
        with natator.Simulator(1) as simulator, mock.patch("natator.Simulator._answers", max_at_once):
            with ThreadPoolExecutor(4) as pool:
                results = list(pool.map(lambda start: simulator.evaluate(TANK, GAIT, duration=0.05, start=start), range(4)))
            self.assertEqual(most, 1)
            self.assertEqual([r["hash"] for r in results],
                             [simulator.evaluate(TANK, GAIT, duration=0.05, start=k)["hash"] for k in range(4)])

    def test_bad_requests_are_refused_and_others_go_on(self):
        with natator.Simulator(workers=1) as simulator:
            with self.assertRaisesRegex(natator.InputError, r"gait.amplitude has length 1: must have length 2"):
                simulator.evaluate(TANK, natator.Gait(1, [1], [0]))
            with self.assertRaisesRegex(natator.InputError, "speed"):
                simulator.evaluate(TANK, GAIT, speed=3)
            self.assertEqual(simulator.evaluate(TANK, GAIT, duration=0.05)["status"], "ok")
        with self.assertRaisesRegex(natator.ProgramError, "closed"):
            simulator.evaluate(TANK, GAIT)

    def test_arguments_are_a_list(self):
        for client in (natator.Simulator, lambda **options: natator.Stream(TANK, **options)):
            for bad in (3, None, "--no-cache", {"--no-cache": True}):
                with self.assertRaisesRegex(natator.InputError, r"^arguments = .*: must be a list of texts$"):
                    client(arguments=bad)
        with self.assertRaisesRegex(natator.InputError, "^fields = 3: must be a list of texts$"):
            natator.Stream(TANK, fields=3)

    def test_workers_are_counted(self):
        for bad in (0, -1, 1.5, True, "2"):
            with self.assertRaisesRegex(natator.InputError, "workers = .*: must be a whole number from 1 on"):
                natator.Simulator(bad)

    def test_an_unstable_one_is_a_result(self):
        result = natator.evaluate(TANK, GAIT, duration=1, overrides={"solver": {"relaxationMode": "global"}})
        self.assertEqual((result["status"], result["fitness"]), ("unstable", 0))

    def test_a_program_that_is_not_there_is_named(self):
        with self.assertRaisesRegex(natator.ProgramError, "/no/such: must be the program natator-sim"):
            natator.evaluate(TANK, GAIT, program="/no/such")
        with self.assertRaisesRegex(natator.ProgramError, "exit code 0"):
            natator.evaluate(TANK, GAIT, program="/bin/true")

    def test_another_program_is_no_simulator(self):
        with tempfile.TemporaryDirectory() as folder:
            for name, says in (("words", "y"), ("numbers", "3"), ("others", '{"id": 0}'), ("bytes", "\\377\\376")):
                program = Path(folder, name)
                program.write_text(f"#!/bin/sh\nwhile printf '%b\\n' '{says}'; do :; done\n")
                program.chmod(0o755)
                message = f"{program} answers as no simulator does: must be the program natator-sim"
                with self.subTest(name), mock.patch.dict("os.environ", NATATOR_SIM=str(program)):
                    with self.assertRaisesRegex(natator.ProgramError, message):
                        natator.evaluate(TANK, GAIT)
                    with self.assertRaisesRegex(natator.ProgramError, message):
                        natator.Stream(TANK)


class TrajectoryTest(unittest.TestCase):
    def test_arrays_are_the_swim(self):
        every = natator.record(TANK, GAIT, duration=0.1, fields=("position", "velocity", "density"), overrides=ALL_THE_WAY)
        third = natator.record(TANK, GAIT, duration=0.1, every=3, overrides=ALL_THE_WAY)
        self.assertEqual((every.position.shape, every.velocity.shape, every.density.shape), ((7, 938, 3), (7, 938, 3), (7, 938)))
        self.assertEqual((every.drive.shape, every.body.shape, every.fluid), ((7, 2), (81,), slice(81, 938)))
        np.testing.assert_array_equal(third.position, every.position[::3])
        np.testing.assert_allclose(third.time, [0, 0.05, 0.1])
        self.assertIsNone(third.velocity)
        result = evaluated(duration=0.1, overrides=ALL_THE_WAY)
        self.assertEqual(every.distance[-1], result["distance"])
        hashed = 0xcbf29ce484222325  # FNV-1a, as measure.h says
        for byte in every.position[-1].tobytes() + every.velocity[-1].tobytes():
            hashed = (hashed ^ byte) * 0x100000001b3 % 2**64
        self.assertEqual(f"{hashed:016x}", result["hash"])

    def test_bad_lengths_are_refused(self):
        with self.assertRaisesRegex(natator.InputError, "every = 0"):
            natator.record(TANK, GAIT, every=0)
        with self.assertRaisesRegex(natator.InputError, r"duration = 1e\+300: must be at most 166667 s, 10000000 time steps"):
            natator.record(TANK, GAIT, duration=1e300)


class StreamTest(unittest.TestCase):
    def test_an_interrupted_call_leaves_no_answer_to_be_taken_for_anothers(self):
        for where in ("_message", "receive"):
            with self.subTest(where), natator.Stream(TANK) as stream:
                with mock.patch.object(stream, where, side_effect=KeyboardInterrupt), self.assertRaises(KeyboardInterrupt):
                    stream.step(2)
                with self.assertRaisesRegex(natator.ProgramError, "interrupted before its answer was read"):
                    stream.step(1)

    def test_what_is_refused_leaves_the_stream_as_it_was(self):
        with natator.Stream(TANK) as stream:
            for call, message in [(lambda: stream.sense(flow=3), "flow = 3: must be pairs of two values each"),
                                  (lambda: stream.sense(flow=[1, 2]), r"flow = \[1, 2\]: must be pairs of two values each"),
                                  (lambda: stream.sense(within=float("nan")), "within = nan: must be a finite number"),
                                  (lambda: stream.step(drive=[5, 0]), "drive")]:
                with self.assertRaisesRegex(natator.InputError, message):
                    call()
            self.assertEqual(stream.step(1).frame, 1)

    def test_the_same_commands_give_the_same_senses_and_frames(self):
        def swim(start, frames=6):
            with natator.Stream(TANK, start=start, fields="position") as stream:
                stream.sense(flow=[(2, "left"), (4, "above")], target=(3, 0.5, 0.5))
                for k in range(frames):
                    senses = stream.step(drive=[0.1 * k, -0.2])
                return senses, stream.frame

        (first, frame), (again, same), (other, _) = swim(3), swim(3), swim(4)
        for name in vars(first):
            np.testing.assert_array_equal(getattr(first, name), getattr(again, name), name)
        np.testing.assert_array_equal(frame.position, same.position)
        self.assertEqual((first.frame, frame.number, first.flow.shape, first.target.shape), (6, 6, (2, 3), (3,)))
        self.assertGreater(np.abs(first.velocity - other.velocity).max(), 0)
        np.testing.assert_allclose(frame.position[:81].mean(axis=0), first.centre, atol=1e-6)
        np.testing.assert_array_equal(first.drive, [0.5, -0.2])

    def test_rows_are_frames(self):
        rows = np.array([[0.1, 0.2], [0.5, -0.4], [0, 0.3]])
        with natator.Stream(TANK) as together, natator.Stream(TANK) as apart:
            at_once = together.step(drive=rows)
            for row in rows:
                one_by_one = apart.step(drive=row)
            np.testing.assert_array_equal(at_once.centre, one_by_one.centre)
            self.assertEqual(at_once.frame, 3)

    def test_steering_and_reset(self):
        with natator.Stream(TANK, gait=GAIT) as stream:
            before = stream.step(5)
            stream.reset()
            steered = stream.step(5, offset=[0.3, 0.3])
            np.testing.assert_allclose(steered.drive - before.drive, [0.3, 0.3])
            stream.steer()
            np.testing.assert_array_equal(stream.step(1).drive, stream.sense().drive)
            stream.reset()
            np.testing.assert_array_equal(stream.step(5).centre, before.centre)
            stream.reset(start=9)
            self.assertEqual(stream.scene["start"], 9)
            stream.set_gait(natator.Gait(1, [0, 0], [0, 0]))
            np.testing.assert_array_equal(stream.step(3).drive, [0, 0])

    def test_refusals_say_what_and_change_nothing(self):
        with natator.Stream(TANK) as stream:
            for bad, reason in (([1, 3], r"drive\[1\] = 3: must be a number in \[-2, 2\]"), ([1], "must have length 2"),
                                ([np.nan, 0], r"drive\[0\] = nan: must be a finite number"),
                                ([[0, 0], [0, np.inf]], r"drive\[1\]\[1\] = inf: must be a finite number"),
                                ([0, "1"], "drive = .*: must be numbers"), ([[0, 0], [0]], "drive: must be numbers, in rows")):
                with self.assertRaisesRegex(natator.InputError, reason):
                    stream.step(drive=bad)
            with self.assertRaisesRegex(natator.InputError, "flow.0..slice = 99"):
                stream.sense(flow=[(99, "left")])
            self.assertEqual(stream.sense().frame, 0)
        with self.assertRaisesRegex(natator.ProgramError, "closed"):
            stream.step()
        with self.assertRaisesRegex(natator.InputError, "unknown scene \"none/such\""):
            natator.Stream("none/such")
        for arguments, reason in (({"scene": {"creature": {}}}, "scene = {'creature': {}}: must be a name or a path"),
                                  ({"scene": None}, "scene = None: must be a name or a path"),
                                  ({"scene": TANK, "gait": "gait.json"}, "gait = 'gait.json': must be a dict or a Gait"),
                                  ({"scene": TANK, "overrides": "{}"}, "overrides = '{}': must be a dict$")):
            with self.assertRaisesRegex(natator.InputError, reason):
                natator.Stream(**arguments)

    def test_nothing_is_rounded_or_taken_for_a_number(self):
        with natator.Stream(TANK) as stream:
            for bad in (1.5, True, np.True_, "1", 0, -1):
                with self.assertRaisesRegex(natator.InputError, "frames = .*: must be a whole number from 1 on"):
                    stream.step(bad)
            with self.assertRaisesRegex(natator.InputError, "start = 1.5: must be a whole number from 0 on"):
                stream.reset(start=1.5)
            with self.assertRaisesRegex(natator.InputError, r"offset\[1\] = nan"):
                stream.steer(offset=[0, np.nan])
            with self.assertRaisesRegex(natator.InputError, r"flow\[0\].slice = 1.5"):
                stream.sense(flow=[(1.5, "left")])
            with self.assertRaisesRegex(natator.InputError, "gait.frequency = '1': must be numbers"):
                stream.set_gait(natator.Gait("1", [1, 1], [0, 0]))
            self.assertEqual(stream.step(np.int64(1)).frame, 1)

    def test_instability_is_an_error_until_a_reset(self):
        with natator.Stream(TANK, gait=GAIT) as stream:
            stream.ask({"do": "overrides", "overrides": {"solver": {"relaxationMode": "global"}}})
            with self.assertRaises(natator.Unstable) as caught:
                stream.step(600)
            self.assertGreater(caught.exception.time, 0)
            stream.ask({"do": "overrides", "overrides": {"solver": {"relaxationMode": "local"}}})
            self.assertEqual(stream.step().frame, 1)


if __name__ == "__main__":
    unittest.main()
