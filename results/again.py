#!/usr/bin/env python3
"""Computes committed rows of results/ again, by the present program on a processor: results/again.py [PAGE]... [--seed S]

Draws by chance a few rows of each page that take seconds, and compares. They agree where the bits are the same. Else, as swims are chaotic and other
programs, GPUs and instruction sets round otherwise, within the 99.9 % prediction interval (Student's t) of rows that differ in the start alone; where
these are fewer than five, within a share of them that stands below with its reason. Exit status 1 if a figure differs.
"""
import argparse
import collections
import csv
import gzip
import importlib.util
import json
import math
import os
import pathlib
import random
import resource
import statistics
import subprocess
import sys
import tempfile
import time

from scipy import stats

HERE = pathlib.Path(__file__).resolve().parent
PROGRAM = os.environ.setdefault("NATATOR_SIM", str(HERE.parent / "build/release/bin/natator-sim"))
sys.path[:0] = [str(HERE), str(HERE.parent / "sim-native/python")]


def lines(name):
    with (gzip.open if name.endswith(".gz") else open)(HERE / name, "rt", encoding="utf-8") as file:
        return [json.loads(line) for line in file]


def table(name):
    with (gzip.open if str(name).endswith(".gz") else open)(HERE / name, "rt", encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def simulated(*arguments, given=None, **environment):
    """What natator-sim prints."""
    done = subprocess.run([PROGRAM, *map(str, arguments)], input=given, capture_output=True, text=True, env={**os.environ, **environment})
    if done.returncode:
        sys.exit(f"again.py: natator-sim {arguments[0]} ended with {done.returncode}: {(done.stderr.strip().splitlines() or ['no message'])[-1]}")
    return done.stdout


def width(others):
    """Half of the 99.9 % prediction interval of one more."""
    return stats.t.ppf(0.9995, len(others) - 1) * stats.tstd(others) * math.sqrt(1 + 1 / len(others))


def starts(rows):
    """(request, result, distances of all that differ in the start alone) of (request, result)."""
    def key(request):
        return json.dumps({name: value for name, value in request.items() if name not in ("id", "start", "perturbation")}, sort_keys=True)
    rows, alike = [row for row in rows if row[1]["status"] == "ok"], collections.defaultdict(list)
    for request, result in rows:
        alike[key(request)].append(result["distance"])
    return [(request, result, alike[key(request)]) for request, result in rows]


def swims(chance, rows, count, share=None):
    """(name, then, now, allowed, whether the bits are the same) of some of these, by natator-sim serve; without a share only where there are five or more."""
    drawn = chance.sample([row for row in rows if share or len(row[2]) > 4], count)
    asked = "".join(json.dumps({**request, "id": number}) + "\n" for number, (request, _, _) in enumerate(drawn))
    for now in map(json.loads, simulated("serve", given=asked).splitlines()):
        request, then, others = drawn[now["id"]]
        same = now.get("hash") == then.get("hash")
        name = f"{request['scene']}, {request['gait']['frequency']:.4g} beats/s, start {request.get('start', request.get('perturbation', {}).get('seed', 1))}"
        middle = then["distance"] if same else statistics.fmean(others)
        yield name, middle, math.nan if now.get("distance") is None else now["distance"], share * abs(middle) if share else width(others), same


def measured(*arguments, **environment):
    """The rows that natator-sim bench writes."""
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "rows.csv"
        simulated("bench", *arguments, "--output", file, **environment)
        return table(file)


def bench(arguments, rows, keys, figures, allowed):
    """The same as swims, of the rows that natator-sim bench ARGUMENTS writes, beside those of a page with the same keys."""
    known = {tuple(row[key] for key in keys): row for row in rows}
    for row in measured(*arguments):
        then = known.get(tuple(row[key] for key in keys))
        for figure in figures if then else ():
            if then[figure]:
                numbers = [{"ok": 1, "unstable": 0}.get(text) if figure == "status" else float(text) for text in (then[figure], row[figure])]
                yield (" ".join(filter(None, (*(row[key] for key in keys), figure))), *numbers, allowed(then, figure), then[figure] == row[figure])


def thesis(chance):
    measured, again = ([(row["request"], row["result"]) for row in lines(f"thesis/{name}")] for name in ("measurements.jsonl.gz", "processor.jsonl"))
    quick = [row for row in starts(again + measured) if "solver" not in row[0].get("overrides", {})]
    yield from swims(chance, [row for row in quick[:len(again)] if row[0]["scheme"] == "flex"], 4)
    yield from swims(chance, [row for row in quick if row[0]["scheme"] != "flex"], 1)


def flex_comparison(chance):
    yield from swims(chance, starts((row["request"], row["result"]) for row in lines("flex-comparison/evaluations.jsonl")
                                         if "maxAcceleration" not in row["request"]["overrides"].get("solver", {})), 6)  # without the clamp a law may end a run today


def answered(requests, results):
    answers = {one["id"]: one for one in lines(results)}
    return starts((one, answers[one["id"]]) for one in lines(requests))


def endless(chance):  # the eight starts of a tank are within 3 %
    yield from swims(chance, [row for row in answered("endless/requests.jsonl", "endless/results.jsonl") if row[0]["duration"] == 4], 1, 0.05)


def record(chance):  # its fresh starts, within 2 %, too; two minutes each
    yield from swims(chance, [row for row in answered("record/lattice/requests.jsonl", "record/lattice/fresh.jsonl") if row[0]["overrides"]["solver"]["substeps"] == 36], 1, 0.05)
    yield from swims(chance, [row for row in answered("record/fresh.jsonl", "record/fresh-results.jsonl") if "overrides" not in row[0] and any(row[0]["gait"]["amplitude"])], 1, 0.05)


def quick_evolution(chance):  # starts of its winners have standard deviations of up to 5 and 7 %
    for kind, scene, seconds, share in (("loach-seed-1", "plane/loach", 4, 0.1), ("loach-seed-3", "plane/loach", 4, 0.1), ("default-seed-1", "pool/creature-1", 2, 0.3)):
        swum = lines(f"quick-evolution/{kind}/evaluations.jsonl")
        yield from swims(chance, starts(({"scene": scene, "duration": seconds, "gait": row["gait"]}, row["result"]) for row in swum[:16] if row["result"].get("distance", 0) > 0.1), 1, share)


def optimizers(chance):  # gaits that swim: four standard deviations of their starts
    base, *tank = json.loads((HERE / "optimizers/creature-1.json").read_text(encoding="utf-8")).items()
    rows = [({"scene": base[1], "duration": 2, "start": 77, "overrides": dict(tank), "gait": {"frequency": f, "amplitude": [rear, front], "phase": [0, phase]}}, {"hash": ""},
             row["runs"]) for row in lines("optimizers/creature-1-again.jsonl") for f, rear, front, phase in [row["genes"]]]
    yield from swims(chance, [row for row in rows if min(row[2]) > 0.3], 2, 0.3)


def convergence(chance):
    base = json.loads((HERE / "convergence/creature-2.json").read_text(encoding="utf-8"))["levels"][0]["distance"]
    request = json.loads((HERE / "convergence/request.json").read_text(encoding="utf-8"))
    (name, _, now, _, _), = swims(chance, [({**request, "start": 99}, {"hash": ""}, [base["mean"]])], 1, 1)
    yield name, base["mean"], now, stats.t.ppf(0.9995, 15) * base["error"] * math.sqrt(17), False  # as width(), of 16 starts
    sys.path.insert(0, str(HERE / "convergence"))
    import bending
    row = chance.choice([row for row in table("convergence/bending.csv") if row["refinement"] == "1" and row["cluster_stiffness"] != "0.2"])
    *case, then = row.values()
    now = bending.bending(PROGRAM, int(case[0]), *map(float, case[1:3]), *map(int, case[3:]))
    yield f"bending {' '.join(case)}", float(then), now, 0.02 * float(then), f"{now:.1f}" == then  # in vacuum nothing is chaotic


def water(chance):
    rows = [row for row in table("water/water.csv") if [row[key] for key in ("scheme", "backend", "support", "resolution", "substeps", "iterations", "modified_pressure", "status")]
            == ["conserving", "cpu", "2.5", "20", "2", "4", "no", "ok"]]

    def allowed(then, _):
        others = [float(row["value"]) for row in rows if (row["case"], row["quantity"]) == (then["case"], then["quantity"])]
        value = float(then["value"])
        return max(width(others) + abs(value - statistics.fmean(others)), 0.01 * abs(value))  # where starts hardly differ
    for case in chance.sample(sorted({row["case"] for row in rows if float(row["run_time"]) < 8}), 2):
        yield from bench(["water", "--scheme", "conserving", "--case", case, "--resolution", 20, "--setting", "2x4", "--start", chance.randint(2, 5)], rows,
                         ("case", "start", "quantity"), ["value"], allowed)


def swimmers(chance):
    rows = table("swimmers/swimmers.csv")
    keys = ("case", "variant", "resolution", "box", "beats", "scheme", "mach")
    case, resolution, box, figure = chance.choice((("eel-2d", 32, "1", "speed"), ("sphere", 8, "3", "force")))
    yield from bench(["swimmers", "--scheme", "lattice", "--case", case, "--resolution", resolution, "--box", box], rows, keys, [figure],
                     lambda then, figure: 0.02 * abs(float(then[figure])))  # imposed motion is hardly chaotic


def precision(chance):
    rows, scene = table("precision/precision.csv"), chance.choice(("hanging-chain", "bending-body"))  # which no water makes chaotic
    substeps, iterations = chance.choice((1, 2, 4, 8, 16, 32)), chance.choice((1, 2, 4, 8, 16))
    yield from bench(["precision", "--scene", scene, "--precision", "float", "--substeps", substeps, "--iterations", iterations, "--repeats", 1], rows,
                     ("scene", "scheme", "precision", "substeps", "iterations"), ["path_error_0.1", "path_error_0.25"], lambda then, figure: 0.05 * float(then[figure]))


def stability(chance):
    rows = [row for row in table("stability/stability.csv") if not row["second_axis"] and not 0.7 < float(row["largest"]) < 1.4]  # else chance decides
    for scheme, axes in (("flex", ("gravity", "overlap", "dt", "radius-ratio", "stiffness")), ("conserving", ("overlap", "body-clearance", "viscosity", "radius-ratio"))):
        yield from bench(["stability", "--scheme", scheme, "--axis", chance.choice(axes)], rows, ("scheme", "precision", "scene", "axis", "value", "second_axis"), ["status"], lambda *_: 0)


def validation(chance):
    scheme, setting = chance.choice((("flex", "4x4"), ("flex", "8x4"), ("conserving", "4x4")))
    yield from bench(["validation", "--part", "tank", "--scheme", scheme, "--setting", setting], [row for row in table("validation/validation.csv") if row["status"] == "ok"],
                     ("part", "case", "scheme", "substeps", "iterations"), ["density_error_mean"], lambda then, figure: 0.1 * float(then[figure]))  # by how packed it is


def benchmarks(chance):
    rows = table("benchmarks/speed.csv")
    def ratio(rows):
        seconds = {row["scheme"]: float(row["seconds_least"]) for row in rows if (row["scene"], row["instruction_set"], row["threads"]) == ("creature-1", "avx2", "1")}
        return seconds["conserving"] / seconds["flex"]
    now = ratio(measured("speed", "--scene", "creature-1", "--repeats", 1, NATATOR_ISA="avx2"))
    yield "creature-1, avx2: time of conserving over that of flex", ratio(rows), now, 0.3 * ratio(rows), False  # machines differ


def schools(chance):
    sys.path.insert(0, str(HERE / "schools"))
    import measure
    row = chance.choice([row for row in lines("schools/frame.jsonl") if (row["n"], row["steps"]) == (1, 1)])
    now = measure.frame(row["current"], row["start"], 1, 1, "cpu")["speeds"]
    then = statistics.fmean(row["speeds"])
    yield f"frame, current {row['current']}", then, statistics.fmean(now), 0.05 * then, now == row["speeds"]  # four standard deviations of the loach's starts


def learning(chance):
    from natator.policy import Policy
    own = [row for row in table("learning/swims.csv") if (row["task"], row["swimmer"], row["level"]) == ("ahead", "ahead-1", "scene")]
    row = chance.choice(own)
    now = float(Policy(HERE / "learning/ahead-1/policy.json").swims([int(row["start"])], [int(row["start"]) - 500], {})["return"][0])
    others = [float(one["return"]) for one in own]
    yield f"ahead, start {row['start']}", statistics.fmean(others), now, width(others), f"{now:.4g}" == row["return"]


def cluster(chance):
    spec = importlib.util.spec_from_file_location("cluster_make", HERE / "cluster/make.py")
    module = sys.modules[spec.name] = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    row = chance.choice([row for row in table("cluster/efficiency.csv") if int(row["executors"]) <= 50])
    times, (evaluations, runs, generations, setup) = [float(one["seconds"]) for one in table("cluster/times.csv")], module.LOADS[row["variant"]]
    found = [module.Simulation(setup, evaluations, runs, generations, int(row["executors"]), times, seed).efficiency for seed in range(1, module.REPEATS + 1)]
    yield f"{row['variant']}, {row['executors']} executors", float(row["efficiency"]), statistics.fmean(found), 1e-9, False


PAGES = {page.__name__.replace("_", "-"): page for page in (water, swimmers, schools, thesis, record, convergence, precision, stability, endless, quick_evolution, flex_comparison,
                                                            validation, benchmarks, optimizers, learning, cluster)}

SLOW = ("record",)  # only if it is named


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("pages", nargs="*", metavar="PAGE", help=f"by default all but {', '.join(SLOW)}: {', '.join(PAGES)}")
    parser.add_argument("--seed", type=int, default=random.randrange(10**6), help="by which rows are drawn")
    parser.error = lambda message: parser.exit(2, f"again.py: {message}\n")
    asked = parser.parse_args()
    if unknown := set(asked.pages) - set(PAGES):
        parser.error(f"no page {', '.join(sorted(unknown))}; expected some of {', '.join(PAGES)}")
    counts, begun = collections.Counter(), time.monotonic()
    for page in asked.pages or [page for page in PAGES if page not in SLOW]:
        begin, before = time.monotonic(), counts.total()
        for name, then, now, allowed, same in PAGES[page](random.Random(f"{asked.seed} {page}")):
            verdict = "the same" if same else "agrees" if abs(now - then) <= allowed else "DIFFERS"
            counts[verdict] += 1
            print(f"{page}: {name}: {then:.4g} ± {allowed:.2g}, now {now:.4g}: {verdict}", flush=True)
        counts["nothing compared: DIFFERS"] += counts.total() == before
        print(f"{page}: {time.monotonic() - begin:.0f} s", flush=True)
    used = sum(sum(resource.getrusage(who)[:2]) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    print(f"seed {asked.seed}, {time.monotonic() - begun:.0f} s, of processors {used:.0f} s: {counts.total()} figures: " + ", ".join(f"{count} {verdict}" for verdict, count in sorted(counts.items()) if count))
    return int(any(count for verdict, count in counts.items() if "DIFFERS" in verdict))


if __name__ == "__main__":
    sys.exit(main())
