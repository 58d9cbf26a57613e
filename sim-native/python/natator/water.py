"""The water of a swim on a grid of cubic cells, and what is read off it."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from natator.errors import InputError
from natator.script import package

LEAST_DENSITY = 0.5  # less: a cell at a surface, or in a body


@dataclass(frozen=True)
class Water:
    """The water at a time: the cells of scheme lattice, or the particles of the others on cells as wide as they are apart at rest.
    Arrays are X × Y × Z, in the coordinates of the tank; derivatives are central differences, one-sided at the ends."""

    time: float           #: s
    cell: float           #: edge of a cell, length
    corner: np.ndarray    #: the lowest of the grid, length
    velocity: np.ndarray  #: X × Y × Z × 3, length/s; in scheme lattice about the body's where that is
    density: np.ndarray   #: X × Y × Z, rest densities: about 1 in water, 0 without
    pressure: np.ndarray = None  #: X × Y × Z, mass/(length s²), nan where it is not known; None in scheme flex

    @classmethod
    def from_message(cls, body):
        """Of a WATR message's body. Raises ValueError for what is none."""
        head = np.frombuffer(body, "<u4", 6)
        time, cell, *corner = np.frombuffer(body, "<f8", 5, 24)
        size, shape = int(np.prod(head[2:5], dtype=np.uint64)), tuple(int(count) for count in head[4:1:-1])
        if head[5] > 1 or len(body) != 64 + (16 + 4 * int(head[5])) * size or not (cell > 0 or size == 0):
            raise ValueError
        values = np.frombuffer(body, "<f4", offset=64)
        return cls(float(time), float(cell), np.array(corner), values[:3 * size].reshape(*shape, 3).transpose(2, 1, 0, 3),
                   values[3 * size:4 * size].reshape(shape).T, values[4 * size:].reshape(shape).T if head[5] else None)

    def gradient(self):
        """X × Y × Z × 3 × 3: derivative of component i along axis j, 1/s; 0 along y in plane flow, one cell deep. Raises InputError
        for fewer than two cells along another axis."""
        shape = self.density.shape
        if min(shape[0], shape[2]) < 2 or not shape[1]:
            raise InputError(f"water of {' x '.join(map(str, shape))} cells: must have 2 along each axis for derivatives")
        deep = np.repeat(self.velocity, 2, axis=1) if shape[1] == 1 else self.velocity
        all_deep = np.stack([np.stack(np.gradient(deep[..., i], self.cell), -1) for i in range(3)], -2)
        return all_deep[:, :shape[1]]

    def vorticity(self):
        """X × Y × Z × 3: curl of the velocity, 1/s."""
        g = self.gradient()
        return np.stack([g[..., 2, 1] - g[..., 1, 2], g[..., 0, 2] - g[..., 2, 0], g[..., 1, 0] - g[..., 0, 1]], -1)

    def q_criterion(self):
        """X × Y × Z: (|Ω|² − |S|²) / 2, 1/s², Ω and S the halves of the gradient that turn and that strain; above 0 in vortices
        (Hunt, Wray, Moin 1988)."""
        g = self.gradient()
        return -0.5 * np.einsum("...ij,...ji->...", g, g)

    def excess_pressure(self):
        """X × Y × Z: pressure less the mean of the water at the same height, without what gravity adds; 0 where it is not known."""
        known = (self.density >= LEAST_DENSITY) & ~np.isnan(self.pressure)
        values = np.where(known, self.pressure, 0).astype(float)
        mean = values.sum((0, 2)) / np.maximum(known.sum((0, 2)), 1)
        return np.where(known, values - mean[:, None], 0)

    def at(self, values, places):
        """N, or N × 3: what X × Y × Z, or X × Y × Z × 3, values of the cells are at N × 3 places in the tank, length: between the
        middles of cells interpolated, at the ends as there."""
        within = np.clip((np.asarray(places) - self.corner) / self.cell - 0.5, 0, np.array(self.density.shape) - 1)
        low = np.minimum(within.astype(int), np.maximum(np.array(self.density.shape) - 2, 0))
        share, sum_ = within - low, 0
        for side in np.ndindex(2, 2, 2):
            cell = np.minimum(low + side, np.array(self.density.shape) - 1)
            weight = np.prod(np.where(side, share, 1 - share), axis=-1)
            found = values[tuple(cell.T)]
            sum_ = sum_ + weight.reshape(weight.shape + (1,) * (found.ndim - 1)) * found
        return sum_

    def centres(self, axis):
        """Where the middles of the cells are along an axis (0, 1, 2), length."""
        return self.corner[axis] + self.cell * (np.arange(self.density.shape[axis]) + 0.5)

    def grid(self):
        """A pyvista.ImageData with all of it: cell data velocity, density, pressure, vorticity and Q."""
        pyvista = package("pyvista", "pyvista", "a grid")
        grid = pyvista.ImageData(dimensions=np.add(self.density.shape, 1), spacing=[self.cell] * 3, origin=self.corner)
        for name, values in (("velocity", self.velocity), ("density", self.density), ("pressure", self.pressure),
                             ("vorticity", self.vorticity()), ("Q", self.q_criterion())):
            if values is None:
                continue
            grid.cell_data[name] = values.reshape(-1, *values.shape[3:], order="F").astype("f4")
        grid.field_data["TimeValue"] = [self.time]
        return grid

    def save(self, file):
        """To .npz (numpy: time, cell, corner, velocity, density, pressure) or .vti (ParaView: `grid`, needs pyvista). Raises InputError and OSError."""
        kind = Path(file).suffix.lower()
        if kind == ".npz":
            np.savez_compressed(file, time=self.time, cell=self.cell, corner=self.corner, velocity=self.velocity, density=self.density,
                                **({} if self.pressure is None else {"pressure": self.pressure}))
        elif kind == ".vti":
            self.grid().save(file)
        else:
            raise InputError(f"file = {str(file)!r}: must end in .npz or .vti")
