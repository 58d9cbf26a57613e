"""That the client's programs end with what owns them, and that no wait of it is without an end."""

import gc
import os
import shlex
import signal
import subprocess
import sys
import tempfile
import textwrap
import time
import unittest
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import gymnasium
import natator
import natator.gym
from natator.simulator import make_request

TANK = "bench/small-tank"
GAIT = natator.Gait(1.861, [0.973, 0.69], [0, 0.648])
LONG = make_request(TANK, GAIT, duration=5000, overrides={"stopping": {"planeContact": False, "noProgressAfter": 0}})
SOON = 8  # s: less than a wait of ten, more than a busy machine needs


def children(of=None):
    """Ids of the processes that one has started."""
    return {int(child) for task in Path(f"/proc/{of or os.getpid()}/task").iterdir()
            for child in (task / "children").read_text().split()}


def descriptors():
    return len(os.listdir("/proc/self/fd"))


def is_there(process):
    """Whether it is one that has not ended."""
    try:
        return Path(f"/proc/{process}/stat").read_text().rsplit(")")[-1].split()[0] != "Z"
    except FileNotFoundError:
        return False


def wait_for(what, seconds=60):
    until = time.monotonic() + seconds
    while not what():
        if time.monotonic() > until:
            raise AssertionError("has not come")
        time.sleep(0.01)


class Cycle:
    """What refers to itself."""

    def __init__(self, owner):
        self.owner, self.self = owner, self


def stepping():
    stream = natator.Stream(TANK)
    stream.begin_step(1000)
    return stream


def reset(env):
    env.reset(seed=1)
    return env


def fails(make):
    try:
        make()
    except natator.NatatorError:
        return
    raise AssertionError("is made")


OWNERS = {
    "stream": lambda: natator.Stream(TANK),
    "stream with frames": lambda: natator.Stream(TANK, fields=("position", "velocity")),
    "stream that steps": stepping,
    "simulator": lambda: natator.Simulator(3),
    "environment": lambda: natator.gym.SwimmerEnv(TANK),
    "environment after a reset": lambda: reset(natator.gym.SwimmerEnv(TANK)),
    "made environment": lambda: gymnasium.make("natator/Swimmer-v0", scene=TANK),
    "vector": lambda: natator.gym.SwimmerVectorEnv(2, scene=TANK),
    "made vector": lambda: reset(gymnasium.make_vec("natator/Swimmer-v0", num_envs=2, scene=TANK)),
    "cycle": lambda: Cycle(natator.Stream(TANK)),
    "bound method": lambda: natator.Simulator(1).evaluate,
}
REFUSED = {
    "stream of no scene": lambda: natator.Stream("none/such"),
    "simulator of no option": lambda: natator.Simulator(2, ["--no-such"]).evaluate(TANK, GAIT),
    "environment without muscles": lambda: natator.gym.SwimmerEnv("thesis/tank"),
    "target beyond": lambda: natator.gym.SwimmerEnv(TANK, target=(99, 0, 0)),
    "places beyond": lambda: natator.gym.SwimmerEnv(TANK, flow=[(99, "left")]),
    "vector": lambda: natator.gym.SwimmerVectorEnv(2, scene=TANK, flow=99),
    "recording": lambda: natator.record(TANK, GAIT, duration=1e9),
    "evaluation": lambda: natator.evaluate(TANK, natator.Gait(1, [9, 9], [0, 0])),
}


class OwnerTest(unittest.TestCase):
    def assert_nothing_left(self, use):
        gc.collect()
        before = children(), descriptors()
        use()
        gc.collect()
        self.assertEqual((children(), descriptors()), before)

    def test_what_is_dropped_has_no_program_any_more(self):
        for name, make in OWNERS.items():
            with self.subTest(name):
                def use():
                    owner = make()
                    self.assertTrue(children())
                    del owner
                self.assert_nothing_left(use)

    def test_what_is_closed_has_none_either(self):
        for name, make in OWNERS.items():
            if name not in ("cycle", "bound method"):
                with self.subTest(name):
                    def use():
                        owner = make()
                        owner.close()
                        owner.close()
                    self.assert_nothing_left(use)

    def test_what_is_refused_has_none(self):
        for name, make in REFUSED.items():
            with self.subTest(name):
                self.assert_nothing_left(lambda: fails(make))

    def test_what_an_error_ends_has_none(self):
        def interrupted():
            with natator.Stream(TANK) as stream:
                stream.begin_step(1000)
                raise natator.InputError
        self.assert_nothing_left(lambda: fails(interrupted))
        self.assert_nothing_left(lambda: fails(lambda: next(natator.Stream(TANK).step(drive=[9]) for _ in range(2))))

    def test_with_python(self):
        for owner in ("natator.Stream('bench/small-tank')", "natator.Simulator(2)", "natator.gym.SwimmerEnv('bench/small-tank')",
                      "natator.gym.SwimmerVectorEnv(2, scene='bench/small-tank')"):
            for end in ("", "import os; os.fork()", "raise SystemExit", "import sys; sys.modules['kept'] = owner"):
                with self.subTest(f"{owner} {end}"):
                    done = run(f"""
                        import os, pathlib
                        owner = {owner}
                        print(*pathlib.Path("/proc/self/task", str(os.getpid()), "children").read_text().split(), flush=True)
                        {end}
                        """)
                    self.assertEqual((done.returncode, done.stderr), (0, ""))
                    self.assertTrue(done.stdout.split())
                    for process in done.stdout.split():
                        wait_for(lambda: not is_there(process))


class ForkTest(unittest.TestCase):
    def in_child(self, work):
        """The exit code of a forked child that works and ends as Python does."""
        child = os.fork()
        if child == 0:
            code = 9
            try:
                code = work()
                gc.collect()
            finally:
                os._exit(code)
        return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])

    def test_a_child_has_no_part_in_its_parents_programs(self):
        stream, simulator = natator.Stream(TANK), natator.Simulator(1)
        stream.step(3)

        def work():
            refused = 0
            for use in (lambda: stream.step(1), stream.reset, lambda: simulator.evaluate(TANK, GAIT, duration=0.05)):
                try:
                    use()
                except natator.ProgramError as error:
                    refused += "forked" in str(error)
            own = natator.evaluate(TANK, GAIT, duration=0.05)["status"] == "ok"
            stream.close()
            simulator.close()
            return 10 * own + refused

        def drop():
            nonlocal stream, simulator
            del stream, simulator
            return 7

        self.assertEqual(self.in_child(work), 13)
        self.assertEqual(self.in_child(drop), 7)
        self.assertEqual(stream.step(1).frame, 4)
        self.assertEqual(simulator.evaluate(TANK, GAIT, duration=0.05)["status"], "ok")
        stream.close()
        simulator.close()

    def test_a_child_holds_up_no_close(self):
        owners = [natator.Stream(TANK), natator.Simulator(4), natator.gym.SwimmerVectorEnv(4, scene=TANK)]
        child = os.fork()
        if child == 0:
            try:
                signal.pause()
            finally:
                os._exit(0)
        try:
            for owner in owners:
                begun = time.monotonic()
                owner.close()
                self.assertLess(time.monotonic() - begun, SOON)
        finally:
            os.kill(child, signal.SIGKILL)
            os.waitpid(child, 0)


class CloseTest(unittest.TestCase):
    def close_soon(self, owner):
        begun = time.monotonic()
        owner.close()
        self.assertLess(time.monotonic() - begun, SOON)

    def test_what_is_busy_is_closed_soon(self):
        self.close_soon(stepping())
        env = reset(natator.gym.SwimmerEnv(TANK, frames=1000))
        env._stream.begin_step(1000, drive=[0.1, 0.1])
        self.close_soon(env)
        vector = reset(natator.gym.SwimmerVectorEnv(3, scene=TANK, frames=1000))
        for swim in vector._batch.swims:
            swim.begin_step(1000, drive=[0.1, 0.1])
        self.close_soon(vector)
        running = natator.Stream(TANK, fields="position", arguments=["--rate=0"])
        running.ask({"do": "credit", "frames": 1000})
        running.ask({"do": "run"})
        self.close_soon(running)

    def test_programs_that_do_not_end(self):
        with tempfile.TemporaryDirectory() as folder:
            program = Path(folder, "deaf")
            program.write_text("#!/bin/sh\ntrap '' TERM\nwhile :; do sleep 0.1; done\n")
            program.chmod(0o755)
            self.close_soon(natator.Simulator(16, program=str(program)))

    def test_while_another_thread_waits(self):
        simulator = natator.Simulator(2)
        with ThreadPoolExecutor(2) as pool:
            waiting = [pool.submit(simulator.evaluate_all, [LONG] * 2) for _ in range(2)]
            wait_for(lambda: not simulator._turn.acquire(blocking=False) or simulator._turn.release())
            self.close_soon(simulator)
            for one in waiting:
                with self.assertRaisesRegex(natator.ProgramError, "closed"):
                    one.result(SOON)

    def test_neither_waits_for_the_other_with_a_full_pipe(self):
        env = natator.gym.SwimmerEnv(TANK, actions="gait", frames=1000, duration=100)
        env.reset(seed=1)
        self.assertFalse(env.step([0.0] * 4)[4]["unstable"])
        env.close()


class InterruptTest(unittest.TestCase):
    def interrupted(self, work, more=1, program=""):
        """Interrupts Python alone when it waits in some work, and sees it end."""
        with tempfile.TemporaryDirectory() as folder:
            stuck = Path(folder, "stuck")
            stuck.write_text(f"#!/bin/sh\ntrap '' TERM INT\n{program}\nwhile :; do sleep 0.1; done\n")
            stuck.chmod(0o755)
            process = subprocess.Popen([sys.executable, "-W", "error", "-c", script(f"""
                import natator, natator.gym, os, threading
                from natator.simulator import make_request
                from natator.program import Program
                stuck, LONG = {str(stuck)!r}, {LONG!r}
                {work}
                """)], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
            with process:
                try:
                    process.stdout.readline()
                    wait_for(lambda: sleeps(process.pid))
                    running = children(process.pid)
                    self.assertEqual(len(running), more)
                    process.send_signal(signal.SIGINT)
                    said = process.communicate(timeout=SOON)[1]
                finally:
                    process.kill()
            self.assertEqual(said.strip().splitlines()[-1], "KeyboardInterrupt")
            self.assertEqual(process.returncode, -signal.SIGINT)
            for child in running:
                self.assertFalse(is_there(child))

    def test_evaluations(self):
        self.interrupted("s = natator.Simulator(3); print(flush=True); s.evaluate_all([LONG] * 7)", more=3)
        self.interrupted("print(flush=True); natator.evaluate(**LONG)")
        self.interrupted("s = natator.Simulator(2, program=stuck); print(flush=True); s.evaluate_all([LONG] * 100000)", more=2)

    def test_streams(self):
        self.interrupted("s = natator.Stream('bench/small-tank'); print(flush=True)\n"
                         "                while True: s.step(1000, drive=[0, 0])")
        self.interrupted("print(flush=True); natator.Stream('bench/small-tank', program=stuck)")
        self.interrupted("print(flush=True); natator.Stream('bench/small-tank', program=stuck)", program="exec >&-")
        self.interrupted("print(flush=True); natator.record('bench/small-tank', duration=1e5)")
        self.interrupted("s = Program(stuck, []); print(flush=True); s.send(b'x' * 10**6)")

    def test_environments(self):
        self.interrupted("e = natator.gym.SwimmerVectorEnv(2, scene='bench/small-tank', frames=1000, duration=1e9); e.reset()\n"
                         "                print(flush=True)\n"
                         "                while True: e.step([[0, 0], [0, 0]])")

    def test_closing(self):
        self.interrupted("s = natator.Simulator(2, program=stuck); natator.program.PATIENCE = 1000; print(flush=True); s.close()", more=2)


def sleeps(process):
    """Whether it waits, and has started all that it will."""
    time.sleep(0.3)
    return Path(f"/proc/{process}/stat").read_text().rsplit(")")[-1].split()[0] == "S" and children(process)


def script(text):
    return textwrap.dedent(text)


def run(text):
    return subprocess.run([sys.executable, "-W", "error", "-c", script("import natator, natator.gym\n" + textwrap.dedent(text))],
                          stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=120)


if __name__ == "__main__":
    unittest.main()
