#!/usr/bin/env python3
"""Swims the bodies of sim-native/references/swimmers in another water than the program's own, to check both: needs torch; --device cuda for
those that are no slabs.

Incompressible water in a periodic box, by Fourier series: u_t = u x w - grad p + nu lap u + f, aliasing taken off by the 2/3 rule, viscosity
exact, the rest by Adams and Bashforth's second-order rule. The body is a mask chi that takes on its cells (volume penalization: Angot, Bruneau,
Fabrie, Numer. Math. 81 (1999), 497; for swimmers Kolomenskiy, Schneider, J. Comput. Phys. 228 (2009), 5687): u += chi (u_body - u) once a step.
It is as heavy as water: its rigid motion is that by which it keeps the momentum of the water that it holds, and its bending may widen
it, which the pressure must not resist (Gazzola, Chatelain, van Rees, Koumoutsakos, J. Comput. Phys. 230 (2011), 7093, section 2). The pressure is
kept from step to step and mended by what is left of the divergence (incremental projection: Guermond, Minev, Shen, CMAME 195 (2006), 6011). A strip
half a box away from the body takes off its wake. With --mach the water is a lattice instead, of plane flow. Lengths in L, times in T, the nose towards -x; pictures of the body in the next boxes swim along."""
import argparse
import csv
import json
import math
import pathlib
import time

import numpy as np
import torch

SWIMMERS = pathlib.Path(__file__).resolve().parents[2] / "sim-native/references/swimmers"
PARTS = 400          # of the midline
COLUMNS = ["swimmer", "variant", "cells", "cfl", "mach", "box", "beats", "speed", "spread", "lateral", "slip", "tail_beat", "strouhal", "reynolds",
           "swimming_number", "force", "power", "steps", "seconds"]


def merged(value, patch):
    """JSON Merge Patch, RFC 7386."""
    if not isinstance(patch, dict):
        return patch
    out = dict(value) if isinstance(value, dict) else {}
    for key, change in patch.items():
        out[key] = merged(out.get(key), change)
    return out


class Midline:
    """Of a swimmer's file; by lengths, in a frame that begins at the nose and looks along the axis to the tail."""

    def __init__(self, data):
        self.by, self.waves, self.scale, self.phase = data["by"], data.get("waves", 1), data.get("scale", 1), data.get("phase")
        self.ramp = data["ramp"]
        self.s = np.linspace(0, 1, PARTS + 1)
        self.amplitude = data["amplitude"]

    def along(self, profile, s):
        """A polynomial, or a table with straight lines between its rows."""
        if isinstance(profile[0], list):
            at, value = np.array(profile).T
            return np.interp(s, at, value)
        return np.polyval(profile[::-1], s)

    def grown(self, t):
        if self.ramp == "tanh":
            return math.tanh(math.pi * max(t, 0))
        t = min(max(t, 0), 1)
        return math.sin(math.pi * t / 2) if self.ramp == "sine" else (1 - math.cos(math.pi * t)) / 2

    def wave(self, s, t):
        late = self.along(self.phase, s) if self.phase else self.waves * s
        return self.grown(t) * self.scale * self.along(self.amplitude, s) * np.sin(2 * math.pi * (t - late))

    def at(self, t):
        """Places x, y of the ends of its parts and the angle there."""
        ds, s = 1 / PARTS, self.s
        if self.by == "curvature":
            bend = self.wave((s[1:] + s[:-1]) / 2, t)
            angle = np.concatenate([[0], np.cumsum(bend) * ds])
        elif self.by == "displacement":
            angle = np.arcsin(np.gradient(self.wave(s, t), ds, edge_order=2))
        else:
            axis, fine = np.zeros(PARTS + 1), np.linspace(0, 1, 4 * PARTS + 1)
            slope = np.arctan(np.gradient(self.wave(fine, t), fine, edge_order=2))
            for k in range(PARTS):
                axis[k + 1] = axis[k] + ds * math.cos(slope[min(int(4 * PARTS * axis[k]), 4 * PARTS)])
            angle = np.interp(axis, fine, slope)
        cos, sin = np.cos(angle), np.sin(angle)
        x = np.concatenate([[0], np.cumsum((cos[1:] + cos[:-1]) / 2) * ds])
        nose = 0 if self.by == "curvature" else self.wave(s[:1], t)[0]  # where a towed body's is; a free one's frame may begin anywhere
        y = nose + np.concatenate([[0], np.cumsum((sin[1:] + sin[:-1]) / 2) * ds])
        return x, y, angle


class Swim:
    """A body and its water. `cells` a length; `box` lengths, a slab's without height."""

    def __init__(self, data, cells, box, cfl, device, edge=0.5, thinnest=0.5):
        self.midline, self.nu, self.towed = Midline(data["midline"]), data["viscosity"], data.get("towed")
        self.flat, self.box, self.cfl, self.device = data.get("slab", False), box, cfl, device
        self.square = data.get("square", False)
        self.n = tuple(round(b * cells) for b in box)
        self.h, self.d = 1 / cells, len(box)
        self.edge = edge  # half the width of the mask's edge, cells
        outline = np.array(data["outline"])
        # nowhere thinner than a cell: where it would be, it is at least seen
        self.width = np.maximum(np.interp(self.midline.s, outline[:, 0], outline[:, 1]), thinnest * self.h)
        if not self.flat:
            self.height = np.maximum(np.interp(self.midline.s, outline[:, 0], outline[:, 2]), thinnest * self.h)
        self.real = {"device": device, "dtype": torch.float32}
        k = [2 * math.pi * (torch.fft.rfftfreq if i == self.d - 1 else torch.fft.fftfreq)(n, box[i] / n, **self.real)
             for i, n in enumerate(self.n)]
        shape = [[-1 if i == j else 1 for j in range(self.d)] for i in range(self.d)]
        self.k = [k[i].reshape(shape[i]) for i in range(self.d)]
        self.k2 = sum(a * a for a in self.k)
        self.inverse_k2 = 1 / self.k2.masked_fill(self.k2 == 0, math.inf)
        self.kept = torch.ones_like(self.k2, dtype=torch.bool)
        for i in range(self.d):
            self.kept &= self.k[i].abs() < 2 / 3 * math.pi * self.n[i] / box[i]
        self.u = torch.zeros((self.d, *self.n), **self.real)
        self.widening, self.pressure, self.last = None, 0, None  # divergence in the body; of the last step: its length, decay, advection
        self.origin, self.angle = np.array([0.55 * box[0], 0.5 * box[1]]), 0.0  # of the midline's frame
        self.velocity, self.spin = np.zeros(2), 0.0                               # at the origin
        self.time, self.fastest, self.dissipation, self.log = 0.0, 0.8, 0.0, []

    def forward(self, a):
        return torch.fft.rfftn(a, dim=tuple(range(-self.d, 0)))

    def back(self, a):
        return torch.fft.irfftn(a, s=self.n, dim=tuple(range(-self.d, 0)))

    def advection(self, u):
        """u x w from and to series; notes the greatest speed and what viscosity takes, in mass L^2/T^3."""
        u = u * self.kept
        place, k = self.back(u), self.k
        if self.d == 2:
            w = self.back(1j * (k[0] * u[1] - k[1] * u[0]))
            product, square = torch.stack([place[1] * w, -place[0] * w]), (w * w).mean()
        else:
            w = [self.back(1j * (k[a - 2] * u[a - 1] - k[a - 1] * u[a - 2])) for a in range(3)]
            product = torch.stack([place[a - 2] * w[a - 1] - place[a - 1] * w[a - 2] for a in range(3)])
            square = sum((a * a).mean() for a in w)
        self.fastest = max(float(place.abs().max()), 0.8)
        self.dissipation = self.nu * float(square) * math.prod(self.box)
        return self.forward(product) * self.kept

    def step(self):
        u = self.forward(self.u)
        excess = sum(1j * self.k[i] * u[i] for i in range(self.d))
        if self.widening is not None:
            excess = excess - self.widening
        excess = excess * self.inverse_k2
        for i in range(self.d):
            u[i] += 1j * self.k[i] * excess
        if self.last:
            self.pressure = self.pressure + excess / self.last[0]
        advection = self.advection(u)
        dt = self.cfl * self.h / self.fastest
        decay = torch.exp(-self.nu * self.k2 * dt)
        if self.last:
            part = dt / self.last[0] / 2
            u = decay * (u + dt * ((1 + part) * advection - part * self.last[1] * self.last[2]))
            for i in range(self.d):
                u[i] += dt * 1j * self.k[i] * self.pressure
        else:
            u = decay * (u + dt * advection)
        self.last = dt, decay, advection
        self.u = self.back(u)
        self.time += dt
        self.origin += dt * self.velocity
        self.angle += dt * self.spin
        self.take_on(dt)

    def body(self):
        """Cells near it: their indices, chi, the velocity and the divergence of its bending, their places in the plane."""
        e, s, mid = 1e-4, self.midline.s, [self.midline.at(self.time + k * 1e-4) for k in (-1, 0, 1)]
        x, y, turned = mid[1]
        rate = [(b - a) / (2 * e) for a, b in zip(mid[0], mid[2])]
        c, q = math.cos(self.angle), math.sin(self.angle)
        tail = self.origin + [c * x[-1] - q * y[-1], q * x[-1] + c * y[-1]]
        rows = [c * x - q * y, q * x + c * y, c * rate[0] - q * rate[1], q * rate[0] + c * rate[1], np.cos(turned + self.angle),
                np.sin(turned + self.angle), rate[2], np.gradient(turned, s), np.gradient(rate[2], s), self.width]
        if not self.flat:
            rows.append(self.height)
        table = torch.as_tensor(np.array(rows), **self.real)
        pad, h = self.width.max() + 3 * self.h, self.h
        low = [math.floor((self.origin[a] + rows[a].min() - pad) / h) for a in (0, 1)]
        high = [math.ceil((self.origin[a] + rows[a].max() + pad) / h) + 1 for a in (0, 1)]
        index = [torch.arange(low[a], high[a], device=self.device) for a in (0, 1)]
        local = [((index[a] * h).double() - self.origin[a]).float() for a in (0, 1)]
        px, py = (a.reshape(-1) for a in torch.meshgrid(*local, indexing="ij"))
        near = torch.cat([((a[:, None] - table[0, ::4]) ** 2 + (b[:, None] - table[1, ::4]) ** 2).argmin(1)
                          for a, b in zip(px.split(1 << 20), py.split(1 << 20))]) * 4.0

        def along(rows):
            k = near.floor().clamp(0, PARTS - 1).long()
            return table[rows][:, k] + (near - k) * (table[rows][:, k + 1] - table[rows][:, k])
        for _ in range(3):  # the foot of the normal, by Newton
            mx, my, tx, ty, bend = along([0, 1, 4, 5, 7])
            out = (py - my) * tx - (px - mx) * ty
            near = (near + ((px - mx) * tx + (py - my) * ty) * PARTS / (1 - bend * out).clamp(0.3, 3)).clamp(0, PARTS)
        mx, my, vx, vy, tx, ty, spin, bend, bending, width = along(list(range(10)))
        out = (py - my) * tx - (px - mx) * ty
        beyond = ((px - mx) * tx + (py - my) * ty).abs() * ((near <= 0) | (near >= PARTS))
        velocity = torch.stack([vx - out * spin * tx, vy - out * spin * ty])
        widening = -bending * out / (1 - bend * out).clamp(0.3, 3)
        flat = tuple(len(a) for a in index)
        if self.flat:
            inside = width - out.abs()
        else:
            half = self.height.max() + 3 * h
            index.append(torch.arange(math.floor((self.box[2] / 2 - half) / h), math.ceil((self.box[2] / 2 + half) / h) + 1, device=self.device))
            z, high = (index[2] * h - self.box[2] / 2).to(torch.float32), along([10])[0]
            if self.square:
                inside = torch.minimum((width - out.abs())[:, None], high[:, None] - z.abs())
            root = ((out / width)[:, None] ** 2 + (z / high[:, None]) ** 2).sqrt().clamp(min=1e-3)
            slope = ((out / width ** 2)[:, None] ** 2 + (z / high[:, None] ** 2) ** 2).sqrt() / root
            beyond = beyond[:, None]
            if not self.square:
                inside = (1 - root) / slope.clamp(min=1e-6)
        inside = torch.where(beyond > 0, torch.minimum(inside, -beyond.expand_as(inside)), inside)
        inside = (inside / h / self.edge).clamp(-1, 1)
        chi = (1 + inside + torch.sin(math.pi * inside) / math.pi) / 2
        return ([a % n for a, n in zip(index, self.n)], chi.reshape(*flat, *self.n[2:2], *([-1] if self.d == 3 else [])),
                velocity.reshape(2, *flat), widening.reshape(flat), local, tail)

    def take_on(self, dt):
        """The body's motion, rigid and bending, is put on the water in it."""
        index, chi, bending, widening, local, tail = self.body()
        where = (slice(None), *torch.meshgrid(*index, indexing="ij"))
        water = self.u[where]
        deep = (lambda a: a.sum(-1)) if self.d == 3 else (lambda a: a)
        column, volume = deep(chi), float(chi.double().sum())
        rest = [(deep(chi * water[a]) - column * bending[a]).double() for a in (0, 1)]
        x, y = local[0][:, None].double(), local[1][None, :].double()
        middle = np.array([float((column * x).sum()), float((column * y).sum())]) / volume
        ax, ay = x - middle[0], y - middle[1]
        if self.towed is None:
            speed = np.array([float(rest[0].sum()), float(rest[1].sum())]) / volume
            self.spin = float((ax * rest[1] - ay * rest[0]).sum() / (column * (ax * ax + ay * ay)).sum())
        else:
            speed = np.array([-self.towed, 0.0])
        self.velocity = speed + self.spin * np.array([middle[1], -middle[0]])
        target = torch.stack([bending[0] + speed[0] - self.spin * ay, bending[1] + speed[1] + self.spin * ax]).float()
        if self.d == 3:
            target = torch.cat([target, torch.zeros_like(target[:1])])[..., None]
            widening = widening[..., None]
        change = chi * (target - water)
        self.u[where] += change
        self.widen(where[1:], chi * widening)
        away = (torch.arange(self.n[0], **self.real) * self.h - (self.origin[0] + middle[0]) + self.box[0] / 2) % self.box[0]
        away = torch.minimum(away, self.box[0] - away) / (0.06 * self.box[0])
        self.u *= torch.exp(-10 * dt * (1 + torch.cos(math.pi * away.clamp(max=1))) / 2)[(slice(None),) + (None,) * (self.d - 1)]
        force = -change[:2].double().reshape(2, -1).sum(1) * self.h ** self.d / dt  # of the water on the body
        self.log.append([self.time, *(self.origin + middle), *tail, -float(force[0]), self.dissipation])

    def widen(self, where, rate):
        """Divergence that the next pressure leaves, 1/T, there."""
        divergence = torch.zeros(self.n, **self.real)
        divergence[where] += rate
        self.widening = self.forward(divergence)
        self.widening.reshape(-1)[0] = 0

    def run(self, beats):
        """A row of the table: means over the last two beats, and how much these differ."""
        begin = time.time()
        while self.time < beats:
            self.step()
            if not math.isfinite(self.fastest):
                raise SystemExit("the water is unstable; expected a smaller --cfl or --mach")
        log = np.array(self.log)
        last = log[log[:, 0] > beats - 2]
        path = lambda rows: (rows[-1, 1:3] - rows[0, 1:3]) / (rows[-1, 0] - rows[0, 0])
        mean = lambda column: np.trapezoid(last[:, column], last[:, 0]) / (last[-1, 0] - last[0, 0])
        way = path(last) if self.towed is None else np.array([-self.towed, 0])
        halves = [np.hypot(*path(log[(log[:, 0] > beats - k) & (log[:, 0] <= beats - k + 1)])) for k in (1, 2)]
        speed = -way[0]
        side = np.array([-way[1], way[0]]) / max(np.hypot(*way), 1e-12)
        beat = np.ptp((last[:, 3:5] - last[:, :1] * way) @ side)
        waves = self.midline.waves
        return {"speed": speed, "spread": abs(halves[0] - halves[1]), "lateral": way[1], "slip": speed * waves,
                "tail_beat": beat, "strouhal": beat / speed, "reynolds": speed / self.nu, "swimming_number": math.pi * beat / self.nu,
                "force": mean(5), "power": mean(6), "steps": len(log), "seconds": round(time.time() - begin)}


class Lattice(Swim):
    """Plane water on a D2Q9 lattice by cumulants (Geier, Schönherr, Pasquali, Krafczyk, Comput. Math. Appl. 70 (2015), 507), third ones with
    Lambda = 1/4. The body takes on its cells as before: populations are made from their moments about the velocity that it puts on them."""

    def __init__(self, data, cells, box, mach, device):
        super().__init__(data, cells, box, mach, device, edge=0.1)
        self.dt = mach / math.sqrt(3) / (1.2 * cells)  # 1.2 L/T, about a tail's, is that Mach number
        viscosity = self.nu * self.dt * cells ** 2
        self.rate, self.third = 1 / (0.5 + 3 * viscosity), 1 / (0.5 + 0.25 / (3 * viscosity))
        self.dissipation = math.nan  # not measured
        one = torch.tensor([1 / 6, 2 / 3, 1 / 6], **self.real)
        self.f = (one[:, None] * one)[:, :, None, None].expand(3, 3, *self.n).clone()

    @staticmethod
    def moments(f, u, axis):
        low, rest, high = f.unbind(axis)
        drift, spread = high - low, high + low
        return torch.stack([spread + rest, drift - u * (spread + rest), spread - 2 * u * drift + u * u * (spread + rest)], axis)

    @staticmethod
    def populations(k, u, axis):
        mass, drift, spread = k.unbind(axis)
        drift, spread = drift + u * mass, spread + 2 * u * drift + u * u * mass
        return torch.stack([(spread - drift) / 2, mass - spread, (spread + drift) / 2], axis)

    def widen(self, where, rate):
        """A lattice's water is compressed a little instead."""

    def step(self):
        density, scale, f = self.f.sum((0, 1)), self.h / self.dt, self.f
        u = torch.stack([(f[2] - f[0]).sum(0), (f[:, 2] - f[:, 0]).sum(0)]) / density
        self.u = u * scale
        self.time += self.dt
        self.origin += self.dt * self.velocity
        self.angle += self.dt * self.spin
        self.take_on(self.dt)
        k = self.moments(self.moments(f, u[0], 0), u[1], 1)
        apart = (1 - self.rate) * (k[2, 0] - k[0, 2])
        k[2, 0], k[0, 2] = density / 3 + apart / 2, density / 3 - apart / 2
        k[1, 1] *= 1 - self.rate
        k[2, 1] *= 1 - self.third
        k[1, 2] *= 1 - self.third
        k[2, 2] = (k[2, 0] * k[0, 2] + 2 * k[1, 1] ** 2) / density
        k[1, 0] = k[0, 1] = 0
        f = self.populations(self.populations(k, self.u[1] / scale, 1), self.u[0] / scale, 0)
        self.f = torch.stack([torch.stack([f[a, b].roll((a - 1, b - 1), (0, 1)) for b in range(3)]) for a in range(3)])
        if len(self.log) % 50 == 0:
            self.fastest = float(self.u.abs().max())


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("swimmer", help="name of a file in sim-native/references/swimmers")
    parser.add_argument("--variant", help="only this one (default: all)")
    parser.add_argument("--cells", type=int, default=64, help="of a length (default: 64)")
    parser.add_argument("--cfl", type=float, default=0.3, help="cells that the fastest water goes in a step (default: 0.3)")
    parser.add_argument("--mach", type=float, help="water on a lattice, of slabs; about a tail's Mach number, such as 0.15")
    parser.add_argument("--box", type=float, nargs="+", help="lengths (default: 4 2, and 1 high but for slabs)")
    parser.add_argument("--beats", type=float, default=8.0, help="(default: 8)")
    parser.add_argument("--device", default="cpu")
    parser.add_argument("-o", "--output", type=pathlib.Path, required=True, help="CSV file; rows that it holds are kept")
    options = parser.parse_args()
    data = json.loads((SWIMMERS / f"{options.swimmer}.json").read_text())
    box = options.box or ([4, 2] if data.get("slab") else [4, 2, 1])
    if options.mach and not data.get("slab"):
        parser.error(f"--mach: {options.swimmer} is no slab; expected one")
    if len(box) != (2 if data.get("slab") else 3):
        parser.error("--box: expected two lengths for a slab, three for others")
    held = list(csv.DictReader(options.output.open())) if options.output.exists() else []
    for variant, change in data.get("variants", {"": {}}).items():
        name = {"swimmer": options.swimmer, "variant": variant, "cells": options.cells, "cfl": "" if options.mach else options.cfl, "mach": options.mach or "",
                "box": " ".join(f"{b:g}" for b in box), "beats": options.beats}
        known = any(all(row[key] == str(value) for key, value in name.items()) for row in held)
        if known or (options.variant is not None and options.variant != variant):
            continue
        water, step = (Lattice, options.mach) if options.mach else (Swim, options.cfl)
        row = name | water(merged(data, change), options.cells, box, step, options.device).run(options.beats)
        row = {key: f"{value:.4g}" if isinstance(value, float) and key not in name else value for key, value in row.items()}
        print(row, flush=True)
        new = not options.output.exists()
        with options.output.open("a") as file:
            writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
            if new:
                writer.writeheader()
            writer.writerow(row)


if __name__ == "__main__":
    main()
