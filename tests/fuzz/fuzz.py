#!/usr/bin/env python3
"""Mutated requests, scenes, gaits, arguments, meshes, particle files and stream commands for natator-sim: none may crash it, hang
it, set off a sanitizer, go without an answer or be answered by a number that is none. Needs nothing beyond Python 3.9."""
import argparse
import json
import os
import pathlib
import random
import sys
import tempfile
import time

from cases import KINDS, ROOT
from programs import Fault


def arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--simulator", type=pathlib.Path, default=ROOT / "build/asan/bin/natator-sim")
    parser.add_argument("--seed", type=int, default=1, help="the same seed gives the same cases (default: 1)")
    parser.add_argument("--cases", type=int, default=20000, help="at most so many (default: 20000)")
    parser.add_argument("--seconds", type=float, default=float("inf"), help="end after so long (default: no limit)")
    parser.add_argument("--limit", type=float, default=30, help="s that a case may take (default: 30)")
    parser.add_argument("--kind", action="append", choices=KINDS, help="only cases of this kind")
    parser.add_argument("--output", type=pathlib.Path, default=ROOT / "build/fuzz", help="folder for cases that failed")
    parser.add_argument("--most-faults", type=int, default=20, help="end after so many faults (default: 20)")
    parser.add_argument("--replay", type=pathlib.Path, metavar="FILE", help="run a saved case again")
    return parser.parse_args()


def replay(options, program):
    saved = json.loads(options.replay.read_text())
    runner = KINDS[saved["kind"]][2](program, options.limit)
    try:
        for text in saved["before"]:
            runner.run(text)
        runner.close()
    except Fault as fault:
        print(f"{options.replay}: {fault}")
        return 1
    print(f"{options.replay}: nothing wrong")
    return 0


def save(options, kind, number, text, runner, fault):
    """What led to the fault: a resident program's cases since it was started, the failing one last."""
    options.output.mkdir(parents=True, exist_ok=True)
    path = options.output / f"seed-{options.seed}-case-{number}.json"
    before = getattr(runner, "before", None) or [text]
    path.write_text(json.dumps({"kind": kind, "seed": options.seed, "number": number, "fault": str(fault), "before": before}))
    print(f"seed {options.seed}, case {number} ({kind}): {fault}\n  {text[:1000]!r}\n  again: tests/fuzz/fuzz.py --replay {path}",
          flush=True)


def fuzz(options, program):
    kinds = options.kind or list(KINDS)
    weights = [KINDS[kind][0] for kind in kinds]
    runners, counts, faults, begin = {}, dict.fromkeys(kinds, 0), 0, time.monotonic()
    slowest = (0, "")
    number = 0
    while number < options.cases and time.monotonic() - begin < options.seconds and faults < options.most_faults:
        number += 1
        chance = random.Random(f"{options.seed}/{number}")
        kind = chance.choices(kinds, weights)[0]
        text = KINDS[kind][1](chance)
        runner = runners.setdefault(kind, KINDS[kind][2](program, options.limit))
        counts[kind] += 1
        case_begin = time.monotonic()
        try:
            runner.run(text)
        except Fault as fault:
            faults += 1
            save(options, kind, number, text, runner, fault)
            if hasattr(runner, "kill"):
                runner.kill()
            del runners[kind]
        slowest = max(slowest, (time.monotonic() - case_begin, f"case {number}, {kind}"))
    for kind, runner in runners.items():
        try:
            runner.close()
        except Fault as fault:
            faults += 1
            save(options, kind, number, "", runner, fault)
    done = ", ".join(f"{count} {kind}" for kind, count in counts.items())
    print(f"seed {options.seed}: {number} cases in {time.monotonic() - begin:.0f} s ({done}); slowest {slowest[0]:.1f} s "
          f"({slowest[1]}); {faults} faults")
    return 1 if faults else 0


def main():
    options = arguments()
    if not os.access(options.simulator, os.X_OK):
        print(f"fuzz.py: no program {options.simulator}; build it, or name another by --simulator", file=sys.stderr)
        return 2
    program = str(options.simulator.resolve())
    with tempfile.TemporaryDirectory(prefix="natator-fuzz-cache-") as cache:
        os.environ["NATATOR_CACHE"] = cache
        return replay(options, program) if options.replay else fuzz(options, program)


if __name__ == "__main__":
    sys.exit(main())
