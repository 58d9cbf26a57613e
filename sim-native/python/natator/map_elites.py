"""MAP-Elites and CMA-ME by pyribs (natator[ribs]), over the kinds of gaits that `natator evolve --optimizer map-elites` tells apart."""

import math

import numpy as np

from natator.errors import InputError
from natator.runs import PER_OCTAVE
from natator.script import package

BEATS, COSTS = (-3, 7), (-20, 20)  # octaves; what is beyond them is of the first or last cell


class MapElites:
    """An optimizer for natator.evolve. kind: "map-elites" or "cma-me"; population: how many it asks for. Raises InputError without pyribs.

    `archive`: pyribs' own, over base-2 logarithms of beats for a body length and of cost of transport, in cells of half an octave. What gets nowhere, or
    was not measured, shares the last column.
    """

    measures = True  #: is told them

    def __init__(self, kind, genes, population, seed):
        archives, emitters = (package(f"ribs.{module}", "ribs", f"optimizer {kind}") for module in ("archives", "emitters"))
        dims = [PER_OCTAVE * (BEATS[1] - BEATS[0]) + 1, PER_OCTAVE * (COSTS[1] - COSTS[0])]
        self.archive = archives.GridArchive(solution_dim=genes, dims=dims, ranges=[(BEATS[0], BEATS[1] + 1 / PER_OCTAVE), COSTS], seed=seed)
        same = {"lower_bounds": [0.0] * genes, "upper_bounds": [1.0] * genes, "batch_size": population, "seed": seed}
        if kind == "cma-me":
            self._emitter = emitters.EvolutionStrategyEmitter(self.archive, x0=[0.5] * genes, sigma0=0.25, **same)
        else:  # steps and first gaits as of Java's
            first = np.random.default_rng(seed).random((population, genes))
            self._emitter = emitters.IsoLineEmitter(self.archive, iso_sigma=0.05, line_sigma=0.2, initial_solutions=first, **same)
        self._asked = 0

    def ask(self):
        """Genes in [0, 1], a list for each gait."""
        asked = self._emitter.ask()
        self._asked = len(asked)
        return asked.tolist()

    def tell(self, genes, costs, measures):
        """What came of them. measures: of each beats for a body length and cost of transport, or None."""
        places = [(BEATS[1], COSTS[0]) if one is None else (min(math.log2(one[0]), np.nextafter(BEATS[1], 0)), math.log2(one[1])) for one in measures]
        told = {"solution": np.array(genes), "objective": -np.array(costs), "measures": np.array(places)}
        info = self.archive.add(**told)
        if len(genes) != self._asked:
            raise InputError(f"{len(genes)} gaits told of {self._asked} asked for: must be all")
        self._emitter.tell(**told, add_info=info)
