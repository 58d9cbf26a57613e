"""The page's answer, table and picture: what policies that were learned, and a gait that was evolved, swim from starts that neither has seen."""
import csv
import json
import pathlib
import statistics

import numpy as np
from scipy import stats
import study

HERE, SCENE, DURATION = pathlib.Path(__file__).parent, "endless/small", 4.0
SUBSTEPS, STARTS = (2, 4, 8), range(1000, 1016)
SWIMMERS = {"seed-1": "learned, seed 1", "seed-2": "learned, seed 2", "varied": "learned at 2 and 4 substeps", "evolved": "evolved gait"}


def rows(name):
    with open(HERE / f"{name}.csv", encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def run():
    """Swims all of them: on a core of a server 5 minutes."""
    import natator
    from natator.gym import SwimmerVectorEnv
    told = [["swimmer", "substeps", "start", "return"]]
    for substeps in SUBSTEPS:
        overrides = {"solver": {"substeps": substeps}}
        with natator.Stream(SCENE) as stream:
            length = stream.scene["bodyLength"]
        for name in SWIMMERS:
            if name == "evolved":
                runs = [natator.evaluate(SCENE, json.loads((HERE / "evolved.json").read_text()), duration=DURATION, start=start, overrides=overrides)
                        for start in STARTS]
                returns = ["" if one["distance"] is None else one["distance"] / length for one in runs]
            else:
                layers = list(np.load(HERE / f"{name}.npz").values())
                env = SwimmerVectorEnv(len(STARTS), "SameStep", scene=SCENE, overrides=overrides, duration=DURATION)
                observations, _ = env.reset(options={"start": list(STARTS)})
                returns, over = np.zeros((2, len(STARTS)))
                while not np.all(over):
                    hidden = np.tanh(np.tanh(observations @ layers[0] + layers[1]) @ layers[2] + layers[3])
                    observations, rewards, terminated, truncated, _ = env.step(hidden @ layers[4] + layers[5])
                    returns, over = returns + np.where(over, 0, rewards), np.maximum(over, terminated | truncated)
                env.close()
            told += [[name, substeps, start, one if one == "" else round(float(one), 4)] for start, one in zip(STARTS, returns)]
    with open(HERE / "returns.csv", "w", encoding="utf-8", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows(told)


def speed(returns):
    """Body lengths/s with its interval of 95 %, of those that stayed stable."""
    stable = [float(one) / DURATION for one in returns if one != ""]
    error = stats.t.ppf(0.975, len(stable) - 1) * statistics.stdev(stable) / len(stable) ** 0.5
    return statistics.fmean(stable), error, len(returns) - len(stable)


def make(folder):
    swum = rows("returns")
    speeds = {(name, substeps): speed([one["return"] for one in swum if (one["swimmer"], int(one["substeps"])) == (name, substeps)])
              for name in SWIMMERS for substeps in SUBSTEPS}

    def cell(mean, error, unstable):
        return f"{mean:.2f} ± {error:.2f}" + (f", {unstable} unstable" if unstable else "")
    table = study.table(["body lengths/s at substeps of", *map(str, SUBSTEPS)],
                        [[text, *(cell(*speeds[name, substeps]) for substeps in SUBSTEPS)] for name, text in SWIMMERS.items()])
    best = max((name for name in SWIMMERS if name != "evolved"), key=lambda name: speeds[name, 2][0])
    own, half, evolved = speeds[best, 2], speeds[best, 4], speeds["evolved", 2]
    holds = [text for name, text in SWIMMERS.items() if all(abs(speeds[name, k][0] / speeds[name, 2][0] - 1) < 0.1 for k in SUBSTEPS[1:])]
    answer = f"**PPO learns to swim at {own[0]:.2f} ± {own[1]:.2f} body lengths/s, where evolution finds {evolved[0]:.2f} ± {evolved[1]:.2f}, but at half " \
             f"the time step it swims {half[0]:.2f} ± {half[1]:.2f}: {' and '.join(holds) if holds else 'no swimmer'} holds within 10 %.**\n"
    trainings = study.table(["training", "environment steps", "s", "steps/s"], [
        [SWIMMERS[one["swimmer"]], one["steps"], one["seconds"], f"{int(one['steps']) / int(one['seconds']):.0f}"] for one in rows("trainings")])
    figure, axes = study.pyplot.subplots(figsize=(7, 3.5))
    for name in ("seed-1", "seed-2", "varied"):
        seconds, episodes, means = (np.array([float(one[key]) for one in rows(name)]) for key in ("seconds", "episodes", "mean_return"))
        bins = (seconds - seconds[0]) // 5
        axes.plot([5 * one for one in np.unique(bins)], [np.average(means[bins == one], weights=episodes[bins == one]) for one in np.unique(bins)],
                  label=SWIMMERS[name])
    axes.set(xlabel="time since the first episodes ended, s", ylabel="mean return, body lengths")
    axes.legend()
    axes.grid(alpha=0.3)
    figure.tight_layout()
    figure.savefig(folder / "curve.png", dpi=100, metadata={"Software": None})
    study.pyplot.close(figure)
    (folder / "README.md").write_text(study.filled(HERE / "README.md", answer=answer, speeds=table, trainings=trainings), encoding="utf-8")


study.main(make, run)
