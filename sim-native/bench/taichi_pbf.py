"""A plain Position Based Fluids solver in Taichi, of the size of the thesis tank: what Natator's speed is compared with.

Macklin, Müller: Position Based Fluids (2013), with poly6 and spiky kernels, a uniform grid, neighbour lists built once
per substep, relaxation epsilon, XSPH viscosity, planes. One thread, float. Prints a line of JSON: particles, substeps,
iterations, seconds of the processor (without compiling), million_particle_iterations_per_second, mean neighbours, mean density error.

    pip install taichi==1.7.4
    python taichi_pbf.py [--duration 4] [--substeps 4] [--iterations 4]
"""

import argparse
import json
import math
import time

import taichi as ti

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("--duration", type=float, default=4.0, help="simulated time, s")
parser.add_argument("--substeps", type=int, default=4, help="per frame of 1/60 s")
parser.add_argument("--iterations", type=int, default=4, help="per substep")
options = parser.parse_args()

ti.init(arch=ti.cpu, cpu_max_num_threads=1, default_fp=ti.f32, fast_math=True, log_level=ti.ERROR)

COUNT = (50, 7, 17)
N = COUNT[0] * COUNT[1] * COUNT[2]
SPACING = 0.09
RADIUS = 0.15
REST = 0.1
WALL = 0.05
LOW = ti.Vector([WALL, WALL, WALL])
HIGH = ti.Vector([2 * WALL + SPACING * (COUNT[0] - 1) - WALL, 1e9, 2 * WALL + SPACING * (COUNT[2] - 1) - WALL])
CELLS = (32, 16, 12)
MOST_NEIGHBOURS = 96
H = 1.0 / 60 / options.substeps
EPSILON = 100.0
VISCOSITY = 0.05

POLY6 = 315.0 / (64.0 * math.pi * RADIUS**9)
SPIKY = -45.0 / (math.pi * RADIUS**6)

position = ti.Vector.field(3, ti.f32, N)
start = ti.Vector.field(3, ti.f32, N)
velocity = ti.Vector.field(3, ti.f32, N)
change = ti.Vector.field(3, ti.f32, N)
lambda_ = ti.field(ti.f32, N)
density = ti.field(ti.f32, N)
neighbour = ti.field(ti.i32, (N, MOST_NEIGHBOURS))
neighbours = ti.field(ti.i32, N)
cell_begin = ti.field(ti.i32, CELLS[0] * CELLS[1] * CELLS[2] + 1)
cell_end = ti.field(ti.i32, CELLS[0] * CELLS[1] * CELLS[2])
in_order = ti.field(ti.i32, N)
rest_density = ti.field(ti.f32, ())


@ti.func
def poly6(r2):
    d = RADIUS * RADIUS - r2
    return POLY6 * d * d * d if d > 0 else 0.0


@ti.func
def spiky_gradient(x, r):
    result = ti.Vector([0.0, 0.0, 0.0])
    if 0.0 < r < RADIUS:
        result = SPIKY * (RADIUS - r) * (RADIUS - r) / r * x
    return result


@ti.func
def cell_of(x):
    cell = ti.cast(x / RADIUS, ti.i32)
    return ti.Vector([min(max(cell[k], 0), CELLS[k] - 1) for k in ti.static(range(3))])


@ti.func
def number_of(cell):
    return (cell[2] * CELLS[1] + cell[1]) * CELLS[0] + cell[0]


@ti.kernel
def fill():
    for i in range(N):
        place = ti.Vector([i % COUNT[0], i // COUNT[0] % COUNT[1], i // (COUNT[0] * COUNT[1])])
        position[i] = WALL + SPACING * ti.cast(place, ti.f32)


@ti.kernel
def predict():
    for i in range(N):
        start[i] = position[i]
        velocity[i][1] -= 10.0 * H
        position[i] = ti.min(ti.max(position[i] + H * velocity[i], LOW), HIGH)


@ti.kernel
def sort_into_cells():
    for c in cell_begin:
        cell_begin[c] = 0
    for i in range(N):
        cell_begin[number_of(cell_of(position[i])) + 1] += 1
    ti.loop_config(serialize=True)
    for c in range(CELLS[0] * CELLS[1] * CELLS[2]):
        cell_begin[c + 1] += cell_begin[c]
        cell_end[c] = cell_begin[c]
    ti.loop_config(serialize=True)
    for i in range(N):
        c = number_of(cell_of(position[i]))
        in_order[cell_end[c]] = i
        cell_end[c] += 1


@ti.kernel
def find_neighbours():
    for i in range(N):
        x = position[i]
        base = cell_of(x)
        n = 0
        for dz, dy in ti.ndrange((-1, 2), (-1, 2)):
            y_cell, z_cell = base[1] + dy, base[2] + dz
            if 0 <= y_cell < CELLS[1] and 0 <= z_cell < CELLS[2]:
                first = number_of(ti.Vector([max(base[0] - 1, 0), y_cell, z_cell]))
                last = number_of(ti.Vector([min(base[0] + 1, CELLS[0] - 1), y_cell, z_cell]))
                for k in range(cell_begin[first], cell_end[last]):
                    j = in_order[k]
                    if j != i and (x - position[j]).norm_sqr() < RADIUS * RADIUS and n < MOST_NEIGHBOURS:
                        neighbour[i, n] = j
                        n += 1
        neighbours[i] = n


@ti.kernel
def compute_lambda():
    for i in range(N):
        x = position[i]
        sum_density = poly6(0.0)
        own = ti.Vector([0.0, 0.0, 0.0])
        squares = 0.0
        for k in range(neighbours[i]):
            apart = x - position[neighbour[i, k]]
            r2 = apart.norm_sqr()
            sum_density += poly6(r2)
            gradient = spiky_gradient(apart, ti.sqrt(r2)) / rest_density[None]
            own += gradient
            squares += gradient.norm_sqr()
        density[i] = sum_density / rest_density[None]
        lambda_[i] = -max(density[i] - 1.0, 0.0) / (squares + own.norm_sqr() + EPSILON)


@ti.kernel
def solve_density_constraint():
    for i in range(N):
        x = position[i]
        move = ti.Vector([0.0, 0.0, 0.0])
        for k in range(neighbours[i]):
            j = neighbour[i, k]
            apart = x - position[j]
            move += (lambda_[i] + lambda_[j]) * spiky_gradient(apart, apart.norm())
        change[i] = move / rest_density[None]
    for i in range(N):
        position[i] = ti.min(ti.max(position[i] + change[i], LOW), HIGH)


@ti.kernel
def update_velocities():
    for i in range(N):
        velocity[i] = (position[i] - start[i]) / H
    for i in range(N):
        x = position[i]
        smooth = ti.Vector([0.0, 0.0, 0.0])
        for k in range(neighbours[i]):
            j = neighbour[i, k]
            smooth += poly6((x - position[j]).norm_sqr()) * (velocity[j] - velocity[i])
        change[i] = smooth / rest_density[None]
    for i in range(N):
        velocity[i] += VISCOSITY * change[i]


def packing_density():
    """Density of the close packing at rest distance REST, by summing the kernel over the lattice."""
    total, reach = 0.0, 3
    for a in range(-reach, reach + 1):
        for b in range(-reach, reach + 1):
            for c in range(-reach, reach + 1):
                if (a + b + c) % 2 == 0:
                    r2 = (a * a + b * b + c * c) * REST * REST / 2
                    total += POLY6 * max(RADIUS * RADIUS - r2, 0.0) ** 3
    return total


def step():
    predict()
    sort_into_cells()
    find_neighbours()
    for _ in range(options.iterations):
        compute_lambda()
        solve_density_constraint()
    update_velocities()


rest_density[None] = packing_density()
fill()
step()  # compiles
fill()
velocity.fill(0)
ti.sync()
substeps = round(options.duration * 60) * options.substeps
begin = time.process_time()
for _ in range(substeps):
    step()
ti.sync()
seconds = time.process_time() - begin
values = density.to_numpy()
print(json.dumps({
    "particles": N,
    "substeps": substeps,
    "iterations": options.iterations,
    "seconds": round(seconds, 4),
    "million_particle_iterations_per_second": round(1e-6 * N * substeps * options.iterations / seconds, 3),
    "mean_neighbours": round(float(neighbours.to_numpy().mean()), 2),
    "mean_density_error": round(float((values - 1).clip(min=0).mean()), 4),
}))
