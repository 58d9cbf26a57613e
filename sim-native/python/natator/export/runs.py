"""Runs of `natator evolve` for other programs: TensorBoard, MLflow, Optuna's dashboard, pyribs' archives."""

import contextlib
import csv
import json
import logging
import warnings
from datetime import datetime
from pathlib import Path

import numpy as np

from natator.errors import InputError
from natator.export.folder import FILES, METADATA, ExportFolder, files_in
from natator.runs import Run, effort, kind, measures, qd_score, worth
from natator.script import package
from natator.simulator import Simulator, make_request

FIGURES = ("best", "mean", "median", "worst")
FIRST_FRESH = 2**30  # starts that no generation has: Seeds.java
BATCH = 1000  # MLflow's limit of figures at once


def export_run(run, format, folder, force=False, fresh=0, workers=None):
    """Writes a run folder in one of RUN_FORMATS to a folder, which appears when it is whole.

    force: may replace an earlier export. fresh: with "archive", runs of each elite from new starts, by which a second, corrected archive is made;
    workers: at the same time. Returns metadata.json as a dict. Raises InputError and ProgramError, and then there is no folder.
    """
    if fresh and format != "archive":
        raise InputError(f"--fresh and --format {format}: expected --format archive")
    read = Run(run)
    if not read.generations:
        raise InputError(f"{run} has no finished generation yet; expected a run that has one")
    module, name = NEEDED[format]
    if module:
        package(module, name, f"--format {format}")
    with ExportFolder(folder, force) as target:
        written = RUN_FORMATS[format](read, target.path, Path(folder).resolve(), **({"fresh": fresh, "workers": workers} if format == "archive" else {}))
        metadata = {"format": format, "run": read.folder.resolve().name, "generations": len(read.generations), **written}
        metadata[FILES] = [*files_in(target.path), METADATA]
        (target.path / METADATA).write_text(json.dumps(metadata, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
        target.commit()
        return metadata


def _figures(run):
    """Of each generation its number, when it ended (s since 1970; from the run's start, in computing time), and its figures by name."""
    environment = run.folder / "environment.json"
    started = json.loads(environment.read_text(encoding="utf-8"))["started"] if environment.is_file() else None
    time = datetime.fromisoformat(started.replace("Z", "+00:00")).timestamp() if started else 0.0
    for row, seconds in zip(run.generations, run.seconds, strict=True):
        time += seconds or 0.0
        yield int(row["generation"]), time, {**{f"fitness/{name}": row[name] for name in FIGURES},
                                             **{name: row[name] for name in ("evaluations", "unstable", "failed")}}


def _kinds(run):
    """Of each generation how many kinds of gaits are known, the QD score, and the best worth of them; empty where kinds are not known."""
    rows = []
    for generation, tried in run.course():
        elites = run.elites(tried.values())
        rows.append({"generation": generation, "kinds": len(elites), "qd_score": qd_score(elites), "best": max((value for _, value in elites.values()), default=None)})
    return rows if any(row["kinds"] for row in rows) else []


def _settings(run):
    """The settings as texts."""
    return {key: value if isinstance(value, str) else json.dumps(value) for key, value in run.config.items()}


def _tensorboard(run, folder, _):
    from tensorboard.summary import Writer
    kinds = {row["generation"]: row for row in _kinds(run)}
    writer = Writer(str(folder))
    for generation, time, figures in _figures(run):
        known = kinds.get(generation, {})
        for name, value in {**figures, **{name: known[name] for name in ("kinds", "qd_score") if name in known}}.items():
            writer.add_scalar(name, value, generation, wall_time=time)
    writer.close()
    return {}


def _mlflow(run, folder, final):
    from mlflow import MlflowClient
    from mlflow.entities import Metric, Param, RunTag
    kinds = {row["generation"]: row for row in _kinds(run)}
    figures = list(_figures(run))
    with _quiet():
        client = MlflowClient(tracking_uri=f"sqlite:///{folder / 'mlflow.db'}")
        experiment = client.create_experiment("natator", artifact_location=(final / "artifacts").as_uri())
        name = run.folder.resolve().name
        own = client.create_run(experiment, start_time=int(1000 * figures[0][1]), run_name=name).info.run_id
        values = [Metric(key, value, int(1000 * time), generation) for generation, time, found in figures
                  for key, value in {**found, **{key: kinds[generation][key] for key in ("kinds", "qd_score") if generation in kinds}}.items()]
        fresh = (run.best or {}).get("fresh")
        if fresh:  # what is to be quoted of the winner
            values += [Metric(f"fresh/{key}", fresh["base"]["distance"][key], int(1000 * figures[-1][1]), figures[-1][0]) for key in ("mean", "sd")]
        for first in range(0, len(values), BATCH):
            client.log_batch(own, values[first:first + BATCH])
        client.log_batch(own, params=[Param(key, value[:6000]) for key, value in _settings(run).items()], tags=[RunTag("natator.run", str(run.folder))])
        client.set_terminated(own, end_time=int(1000 * figures[-1][1]))
    return {"experiment": "natator", "runName": name}


@contextlib.contextmanager
def _quiet():
    """Without what MLflow says of making its tables."""
    before = logging.root.manager.disable
    logging.disable(logging.INFO)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            yield
    finally:
        logging.disable(before)


def _optuna(run, folder, _):
    import optuna
    from optuna.storages import JournalStorage
    from optuna.storages.journal import JournalFileBackend
    from optuna.trial import TrialState, create_trial
    tried = run.tried()
    ranges = run.genes()
    if ranges is None:  # of bodies: between what was tried
        all_genes = np.array([gait.genes for gait in tried])
        ranges = {f"gene {i + 1}": (float(low), float(high)) for i, (low, high) in enumerate(zip(all_genes.min(0), all_genes.max(0), strict=True))}
    distributions = {name: optuna.distributions.FloatDistribution(*ends) for name, ends in ranges.items()}
    trials = []
    for gait in tried:
        attributes = {"generation": gait.generation, "runs": gait.worths, "stable": gait.stable}
        if gait.measures:
            attributes |= dict(zip(("beatsPerLength", "costOfTransport"), gait.measures, strict=True))
        trials.append(create_trial(state=TrialState.COMPLETE if gait.measured else TrialState.FAIL, value=run.judge(gait.worths) if gait.measured else None,
                                   params=dict(zip(ranges, gait.genes, strict=True)), distributions=distributions, user_attrs=attributes))
    level = optuna.logging.get_verbosity()
    optuna.logging.set_verbosity(optuna.logging.WARNING)
    try:
        name = run.folder.resolve().name
        study = optuna.create_study(storage=JournalStorage(JournalFileBackend(str(folder / "journal.log"))), study_name=name, direction="maximize")
        for key, value in _settings(run).items():
            study.set_user_attr(key, value)
        study.add_trials(trials)
    finally:
        optuna.logging.set_verbosity(level)
    return {"study": name, "trials": len(trials)}


def _archive(run, folder, _, fresh, workers):
    """As pyribs writes archives; measures are base-2 logarithms, whose cells are half as wide."""
    rows = _kinds(run)
    if not rows:
        raise InputError(f"--format archive: the kinds of gaits of {run.folder} are not known: none gets anywhere, their work was not measured (scheme flex), "
                         "or bodies are evolved by another optimizer than map-elites or external")
    with open(folder / "coverage.csv", "w", newline="", encoding="utf-8") as lines:
        table = csv.DictWriter(lines, rows[0])
        table.writeheader()
        table.writerows(rows)
    elites = run.elites(run.tried())
    _write_archive(folder / "archive.csv", elites)
    known = {"kinds": len(elites), "qd_score": qd_score(elites)}
    if fresh:
        again = _again(run, elites, fresh, workers)
        _write_archive(folder / "corrected.csv", again)
        known |= {"fresh": fresh, "corrected_kinds": len(again), "corrected_qd_score": qd_score(again)}
    (folder / "metrics.json").write_text(json.dumps(known, indent=1) + "\n", encoding="utf-8")
    return known


def _write_archive(file, elites):
    cells = list(elites)
    beats, costs = ([cell[k] for cell in cells] for k in (0, 1))
    width = max(costs, default=0) - min(costs, default=0) + 1
    genes = len(next(iter(elites.values()))[0].genes) if elites else 0
    with open(file, "w", newline="", encoding="utf-8") as lines:
        table = csv.writer(lines)
        table.writerow([*(f"solution_{i}" for i in range(genes)), "objective", "measures_0", "measures_1", "index"])
        for cell, (gait, value) in elites.items():
            index = (cell[0] - min(beats)) * width + cell[1] - min(costs)
            table.writerow([*map(repr, gait.genes), repr(value), *map(repr, np.log2(gait.measures).tolist()), index])


def _again(run, elites, fresh, workers):
    """The archive that the elites make by fresh runs alone, where each is of the kind that these say, and worth what they say."""
    if "evolve" in run.config or run.config.get("objectives") or run.config.get("fitness", "distance") != "distance":
        raise InputError("--fresh: expected a run that evolves gaits by distance or by the goals of its scene")
    request = {key: run.config[key] for key in ("duration", "scheme", "overrides") if run.config.get(key) is not None}
    gaits = [gait for gait, _ in elites.values()]
    requests = [make_request(run.config["scene"], gait.gait, start=FIRST_FRESH + k, **request) for gait in gaits for k in range(fresh)]
    arguments = ["--backend", run.config["backend"]] if run.config.get("backend", "cpu") != "cpu" else []
    with Simulator(workers, arguments) as simulator:
        results = simulator.evaluate_all(requests)
    best = {}
    for number, gait in enumerate(gaits):
        own = results[number * fresh:(number + 1) * fresh]
        if any(one["status"] != "ok" for one in own):
            continue
        pair = measures(*sum(effort(gait.gait, one, run.body_length) for one in own))
        value = run.judge([worth(one) for one in own])
        if pair and value > best.get(kind(pair), (None, -np.inf))[1]:
            best[kind(pair)] = _Again(gait.genes, pair), value
    return dict(sorted(best.items()))


class _Again:
    def __init__(self, genes, pair):
        self.genes, self.measures = genes, pair


RUN_FORMATS = {"tensorboard": _tensorboard, "mlflow": _mlflow, "optuna": _optuna, "archive": _archive}
#: a module and the package that brings it
NEEDED = {"tensorboard": ("tensorboard.summary", "tensorboard"), "mlflow": ("mlflow", "mlflow"), "optuna": ("optuna", "optuna"), "archive": (None, None)}
