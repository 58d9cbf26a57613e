#!/usr/bin/env python3
"""What Spark costs on one machine: the same evolution by turns with --simulator resident and on Spark.

wall    seconds of all generations but the first, with as many evaluations at once (timings.csv), and their ratio
driver  processor time of the driver for each evaluation, ms: between a short and a long evolution of swims that cost almost
        nothing, with a master and two workers on the loopback interface that this starts

Both print a line for each turn, then the median and the span of all. Means little on a machine that does other work.
"""
import argparse
import csv
import os
import pathlib
import re
import shutil
import signal
import statistics
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
CHEAP = ["--scene", "thesis/creature-1", "--overrides", '{"fluid":null}', "--duration", "0.05", "--optimizer", "random",
         "--population", "150", "--starts", "1", "--no-cache"]


def fail(message):
    sys.exit(f"overhead.py: {message}")


def processor_seconds(process):
    """Waits for a process; its own processor time without that of its children, s, to a hundredth at best."""
    ticks = 0
    while process.poll() is None:
        try:
            fields = pathlib.Path(f"/proc/{process.pid}/stat").read_text().rsplit(")", 1)[1].split()
            ticks = max(ticks, int(fields[11]) + int(fields[12]))
        except (OSError, IndexError):
            pass
        time.sleep(0.01)
    return ticks / os.sysconf("SC_CLK_TCK")


def run(command, log):
    """Processor seconds of a command that must succeed."""
    with open(log, "w") as out:
        seconds = processor_seconds(process := subprocess.Popen(command, stdout=out, stderr=subprocess.STDOUT))
    if process.returncode:
        fail(f"exit code {process.returncode} of {' '.join(command)}\n{log.read_text()[-2000:]}")
    return seconds


class Programs:
    def __init__(self, arguments, folder):
        self.spark_home, self.folder = arguments.spark_home, folder
        self.simulator = ["--simulator-path", str(arguments.simulator)]

    def resident(self, workers):
        return ["java", "-jar", str(ROOT / "ga-java/target/natator.jar"), "evolve", "--simulator", "resident", "--workers",
                str(workers), *self.simulator]

    def spark(self, master):
        return [str(self.spark_home / "bin/spark-submit"), "--master", master, "--conf", "spark.ui.enabled=false",
                str(ROOT / "ga-java/target/natator-spark.jar"), "evolve", *self.simulator]

    def evolve(self, command, name, *more):
        """Processor seconds of the process, and the run folder."""
        output = self.folder / name
        shutil.rmtree(output, ignore_errors=True)
        return run([*command, *more, "--output-dir", str(output)], self.folder / f"{name}.log"), output


class Cluster:
    """A master and two workers with a core each, on the loopback interface."""

    def __init__(self, spark_home, folder):
        self.processes, self.spark_home, self.folder = [], spark_home, folder

    def __enter__(self):
        log = self.start("master", "org.apache.spark.deploy.master.Master", "--host", "127.0.0.1", "--port", "0", "--webui-port", "0")
        master = self.wait(log, r"Starting Spark master at (spark://\S+)")
        for worker in "worker-1", "worker-2":
            log = self.start(worker, "org.apache.spark.deploy.worker.Worker", "--host", "127.0.0.1", "--webui-port", "0", "--cores",
                             "1", "--memory", "1g", "--work-dir", str(self.folder / worker), master)
            self.wait(log, "(Successfully registered with master)")
        return master

    def start(self, name, *command):
        log = self.folder / f"{name}.log"
        with open(log, "w") as out:
            self.processes.append(subprocess.Popen([str(self.spark_home / "bin/spark-class"), *command], stdout=out,
                                                   stderr=subprocess.STDOUT, start_new_session=True))
        return log

    @staticmethod
    def wait(log, pattern):
        for _ in range(1200):
            if found := re.search(pattern, log.read_text()):
                return found.group(1)
            time.sleep(0.1)
        fail(f"no {pattern} in {log} after two minutes")

    def __exit__(self, *_):
        for process in self.processes:
            os.killpg(process.pid, signal.SIGKILL)


def later_generations(output):
    """Seconds of all generations but the first."""
    with open(output / "timings.csv") as file:
        return sum(float(row["seconds"]) for row in csv.DictReader(file) if row["generation"] != "0")


def summary(name, values, unit):
    print(f"{name}: median {statistics.median(values):.3f}{unit}, {min(values):.3f} to {max(values):.3f} in {len(values)} turns",
          flush=True)


def wall(programs, arguments):
    settings = ["--scene", "thesis/creature-1", "--population", str(arguments.population), "--generations",
                str(arguments.generations), "--duration", str(arguments.duration), "--starts", "1", "--seed", "1", "--no-cache"]
    at_once = len(os.sched_getaffinity(0))
    kinds = {"resident": programs.resident(at_once), "spark": programs.spark(f"local[{at_once}]")}
    ratios = []
    for turn in range(1, arguments.turns + 1):
        order = list(kinds) if turn % 2 else list(kinds)[::-1]
        outputs = {kind: programs.evolve(kinds[kind], kind, *settings)[1] for kind in order}
        if (outputs["resident"] / "evaluations.jsonl").read_bytes() != (outputs["spark"] / "evaluations.jsonl").read_bytes():
            fail(f"the evaluations differ: {outputs}")
        seconds = {kind: later_generations(output) for kind, output in outputs.items()}
        ratios.append(seconds["spark"] / seconds["resident"])
        print(f"turn {turn}: resident {seconds['resident']:.2f} s, spark {seconds['spark']:.2f} s, ratio {ratios[-1]:.3f}", flush=True)
    summary("wall, spark / resident", ratios, "")


def driver(programs, arguments):
    counts = arguments.evaluations // 5, arguments.evaluations
    with Cluster(programs.spark_home, programs.folder) as master:
        kinds = {"resident": programs.resident(2), "spark": programs.spark(master)}
        above = []
        for turn in range(1, arguments.turns + 1):
            each = {}
            for kind in list(kinds) if turn % 2 else list(kinds)[::-1]:
                seconds = [programs.evolve(kinds[kind], kind, *CHEAP, "--evaluations", str(count))[0] for count in counts]
                each[kind] = (seconds[1] - seconds[0]) / (counts[1] - counts[0]) * 1000
            above.append(each["spark"] - each["resident"])
            print(f"turn {turn}: resident {each['resident']:.3f} ms, spark {each['spark']:.3f} ms, above {above[-1]:.3f} ms", flush=True)
    summary("driver's processor time for an evaluation, spark - resident", above, " ms")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=["wall", "driver"])
    parser.add_argument("--turns", type=int, default=3, help="default: 3")
    parser.add_argument("--spark-home", type=pathlib.Path, default=os.environ.get("SPARK_HOME"), help="default: $SPARK_HOME")
    parser.add_argument("--simulator", type=pathlib.Path, default=ROOT / "build/release/bin/natator-sim")
    parser.add_argument("--population", type=int, default=60, help="of wall; default: 60")
    parser.add_argument("--generations", type=int, default=2, help="of wall, after the first; default: 2")
    parser.add_argument("--evaluations", type=int, default=6000, help="of driver's long evolution, the short one has a fifth; default: 6000")
    parser.add_argument("--duration", type=float, default=2, help="simulated seconds, of wall; default: 2")
    arguments = parser.parse_args()
    if arguments.spark_home is None or not (arguments.spark_home / "bin/spark-submit").exists():
        parser.error(f"--spark-home is {arguments.spark_home}; expected a folder with bin/spark-submit")
    if not arguments.simulator.exists():
        parser.error(f"--simulator is {arguments.simulator}, which does not exist; build it by cmake --build --preset release")
    if arguments.turns < 1 or arguments.generations < 1 or arguments.evaluations < 1000:
        parser.error("--turns and --generations are expected to be 1 or more, --evaluations 1000 or more")
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))  # so that what was started ends, too
    with tempfile.TemporaryDirectory() as folder:
        programs = Programs(arguments, pathlib.Path(folder))
        (wall if arguments.what == "wall" else driver)(programs, arguments)


if __name__ == "__main__":
    main()
