"""The page's answer and table, of the runs: start by start in a fixed tank and in one that moves along."""
import json
import math
import pathlib
import statistics

from scipy import stats
import study

HERE = pathlib.Path(__file__).parent


def lines(name):
    return [json.loads(line) for line in (HERE / name).read_text(encoding="utf-8").splitlines()]


def make(folder):
    scenes = {one["id"]: (one["scene"], one["duration"]) for one in lines("requests.jsonl")}
    runs = {scene: [one for one in sorted(lines("results.jsonl"), key=lambda one: one["id"]) if scenes[one["id"]] == (scene, 4)]
            for scene in ("open-water/creature-2", "endless/creature-2")}
    fixed, moving = ([one["distance"] for one in own] for own in runs.values())
    apart = statistics.fmean(moving) / statistics.fmean(fixed) - 1
    error = math.sqrt(sum(statistics.variance(own) / len(own) for own in (fixed, moving))) / statistics.fmean(fixed)
    interval = stats.t.ppf(0.975, len(fixed) + len(moving) - 2) * error
    seen = "No difference in distance is seen" if abs(apart) < interval else "Distances differ"
    def of(own):
        return statistics.fmean(own), stats.sem(own)
    opened = [[one["swimming"]["cavities"] for one in own] for own in reversed(runs.values())]
    table = study.table(["tank", "distances", "mean ± standard error"], [
        [name, ", ".join(f"{way:.3f}" for way in own), study.with_error(*of(own), 3)]
        for name, own in (("6 long", fixed), ("4 long, moving", moving))], "<<<")
    differ = stats.ttest_ind(*opened).pvalue
    renewals = [one["renewal"] for one in runs["endless/creature-2"]]
    last, = (one for one in lines("results.jsonl") if scenes[one["id"]][1] == 60)
    answer = f"**{seen} between a moving tank 4 long (`endless/creature-2`) and a fixed one 6 long (`open-water/creature-2`): {100 * apart:.1f} ± " \
             f"{100 * interval:.1f} % (95 %, Student's t).** Creature 2, fish-like gait, 4 s, " \
             f"{len(fixed)} starts each; cavities are {' and in the fixed one '.join(study.with_error(*of(cavities), 2) for cavities in opened)} (standard errors; p {study.chance(differ)}) of the body's volume in the moving tank:\n"
    def ends(values, digits=0):
        least, most = (f"{end:.{digits}f}" for end in (min(values), max(values)))
        return least if least == most else f"{least} to {most}"
    renewal = f"In 4 s the tank replaced water {ends([one['times'] for one in renewals])} times, {ends([one['particles'] for one in renewals])} particles, " \
              f"with a kinetic energy of {ends([one['kineticEnergy'] for one in renewals])}; the muscles' work was " \
              f"{ends([one['work'] for one in runs['endless/creature-2']])} (`renewal`). A swim of a minute ended after {last['simulated']:.1f} s " \
              f"({last['stopped']}).\n"
    (folder / "README.md").write_text(study.filled(HERE / "README.md", answer=answer, distances=table, renewal=renewal), encoding="utf-8")


study.main(make)
