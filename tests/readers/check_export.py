"""Reads an export back by the readers that its users have; compares every number with the simulator's own stream.

    check_export.py STREAM FOLDER

STREAM is what `natator-sim stream` wrote for the same scene, with all fields and frames; its format is described in
sim-native/protocol/stream.md. FOLDER is the export. Prints how many numbers are equal; exit status 1 and one line if one
is not.
"""

import csv
import json
import struct
import sys
from pathlib import Path

import numpy as np

HEAD_BYTES = 72


class Difference(Exception):
    """A number that is not what it should be."""


class Reference:
    """The stream, decoded by its description alone."""

    def __init__(self, file, every):
        self.scene = None
        self.frames = []
        content = Path(file).read_bytes()
        at = 0
        while at < len(content):
            letters, length = struct.unpack_from("<4sI", content, at)
            body = content[at + 8:at + 8 + length]
            at += 8 + length
            if letters == b"SCEN":
                self.scene = json.loads(body)
            elif letters == b"FRAM" and struct.unpack_from("<I", body, 4)[0] % every == 0:
                self.frames.append(self._frame(body))

    def _frame(self, body):
        count, actuators = self.scene["particles"], self.scene["actuators"]
        number = struct.unpack_from("<I", body, 4)[0]
        time, _, distance = struct.unpack_from("<3d", body, 16)
        values = np.frombuffer(body, "<f4", offset=HEAD_BYTES)
        activation, position, velocity, density = np.split(
            values, np.cumsum([actuators, 3 * count, 3 * count]))
        return {"frame": number, "time": time, "distance": distance, "activation": activation,
                "position": position.reshape(count, 3), "velocity": velocity.reshape(count, 3), "density": density}

    def kind(self):
        kind = np.full(self.scene["particles"], 2, "u1")
        first, count = self.scene["fluid"]
        kind[first:first + count] = 0
        kind[self.scene["body"]] = 1
        return kind

    def first_cluster(self):
        cluster = np.full(self.scene["particles"], -1, "i4")
        for i, members in reversed(list(enumerate(self.scene["clusters"]))):
            cluster[members] = i
        return cluster

    def creature(self):
        """0 for the swimmer, from 1 on companions, -1 for all else."""
        creature = np.full(self.scene["particles"], -1, "i4")
        for i, companion in enumerate(self.scene.get("companions", []), 1):
            creature[companion["body"]] = i
        creature[self.scene["body"]] = 0
        return creature

    def slices(self):
        """Of each creature, in this order."""
        return [self.scene["slices"]] + [companion["slices"] for companion in self.scene.get("companions", [])]

    def mass(self):
        return np.array([np.inf if mass is None else mass for mass in self.scene["mass"]], "f4")

    def muscles(self, key):
        return np.array([muscle[key] for muscle in self.scene["muscles"]])

    def contraction(self, frame):
        if not self.scene["muscles"]:
            return np.empty(0)
        return -0.5 * self.muscles("lateral") * frame["activation"][self.muscles("actuator")]


def hull_area(points):
    """Of the convex hull of points in a plane (Andrew's monotone chain)."""
    hull = []
    for points in (sorted(map(tuple, points)), sorted(map(tuple, points), reverse=True)):
        chain = []
        for x, y in points:
            while len(chain) > 1 and ((chain[-1][0] - chain[-2][0]) * (y - chain[-2][1])
                                      <= (chain[-1][1] - chain[-2][1]) * (x - chain[-2][0])):
                chain.pop()
            chain.append((x, y))
        hull += chain[:-1]
    x, y = np.array(hull).T
    return abs(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2


class Check:
    """One export beside its reference."""

    def __init__(self, stream, folder):
        self.folder = Path(folder)
        self.metadata = json.loads((self.folder / "metadata.json").read_text())
        self.reference = Reference(stream, self.metadata["every"])
        self.compared = 0
        self.fields = self.metadata["fields"]
        self.kind = self.reference.kind()
        self.shown = np.flatnonzero(self.kind >= (0 if self.metadata["water"] else 1))
        self.water = np.flatnonzero(self.kind == 0) if self.metadata["water"] else np.empty(0, int)
        self.solids = np.flatnonzero(self.kind != 0)
        self.creature = self.reference.creature()
        self.has_surface = self.metadata["waterSurface"] and np.any(self.kind == 0)
        self.same("number of frames", [self.metadata["frames"]], [len(self.reference.frames)])
        for key in ("gait", "definition", "scheme", "precision", "timeStep", "planes"):
            if self.metadata[key] != self.reference.scene[key]:
                raise Difference(f"metadata.json: {key} is {self.metadata[key]}")

    def same(self, what, found, expected):
        found, expected = np.asarray(found), np.asarray(expected)
        if found.shape != expected.shape:
            raise Difference(f"{what}: shape {found.shape}; expected {expected.shape}")
        wrong = np.argwhere(found != expected)
        if wrong.size:
            place = tuple(wrong[0])
            raise Difference(f"{what} at {list(map(int, place))}: {found[place]!r}; expected {expected[place]!r}")
        self.compared += expected.size

    def near(self, what, found, expected):
        """Of numbers that follow from others by a product, to rounding."""
        if np.shape(found) != np.shape(expected) or not np.allclose(found, expected, rtol=1e-6, atol=1e-9):
            raise Difference(f"{what}: {found}; expected {expected}")
        self.compared += np.size(expected)

    def surface(self, what, triangles, solids, bodies=None):
        """A closed skin, seen from outside, of the grid that every slice is; of all creatures if not of these."""
        bodies = [slices for slices in (self.reference.slices() if bodies is None else bodies) if len(slices)]
        if not bodies:
            self.same(what, np.size(triangles), 0)
            return
        triangles = np.asarray(triangles).reshape(-1, 3)
        start = self.reference.frames[0]["position"][solids].astype(float)
        edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
        there, count = np.unique(edges, axis=0, return_counts=True)
        back, back_count = np.unique(edges[:, ::-1], axis=0, return_counts=True)
        if not (np.array_equal(there, back) and np.array_equal(count, back_count)):
            raise Difference(f"{what}: open edges")
        a, b, c = (start[triangles[:, i]] for i in range(3))
        volume = np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6
        wanted = 0
        for slices in bodies:
            areas = []
            for members in slices:
                areas.append(hull_area(self.reference.frames[0]["position"][members, 1:].astype(float)))
            places = [self.reference.frames[0]["position"][members, 0].mean() for members in slices]
            for i in range(1, len(areas)):
                wanted += (areas[i - 1] + areas[i]) / 2 * (places[i - 1] - places[i])
        if abs(volume - wanted) > 0.05 * wanted:
            raise Difference(f"{what}: encloses {volume}; expected about {wanted}")
        self.compared += triangles.size

    def water_surface(self, what, frame, vertices, triangles):
        """A closed mesh between the walls, seen from outside, near the water's particles, which are inside it."""
        import pyvista

        vertices, triangles = np.asarray(vertices, float), np.asarray(triangles).reshape(-1, 3)
        edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
        there, count = np.unique(edges, axis=0, return_counts=True)
        back, back_count = np.unique(edges[:, ::-1], axis=0, return_counts=True)
        if not (np.array_equal(there, back) and np.array_equal(count, back_count)):
            raise Difference(f"{what}: open edges")
        spacing = self.reference.scene["fluidRestDistance"]
        behind = min((vertices @ plane[:3] + plane[3]).min() for plane in np.array(self.reference.scene["planes"]))
        if behind < -1e-5:
            raise Difference(f"{what}: a vertex is {-behind} behind a wall")
        mesh = pyvista.PolyData(vertices, np.hstack([np.full((len(triangles), 1), 3), triangles]).ravel())
        water = frame["position"][self.kind == 0].astype(float)
        inside = pyvista.PolyData(water).select_interior_points(mesh)["selected_points"].mean()
        if inside < 0.98:
            raise Difference(f"{what}: {inside:.3f} of the water is inside; expected nearly all")
        a, b, c = (vertices[triangles[:, i]] for i in range(3))
        if np.einsum("ij,ij->i", a, np.cross(b, c)).sum() <= 0:
            raise Difference(f"{what}: seen from inside")
        far = max(np.sqrt(((water - vertex) ** 2).sum(1).min()) for vertex in vertices[::20])
        if far > 1.5 * spacing:
            raise Difference(f"{what}: {far / spacing} spacings from the water")
        self.compared += vertices.size + triangles.size

    # --- one method per format ---------------------------------------------------------------------------------------

    def npz(self):
        data = np.load(self.folder / "swim.npz")
        scene = self.reference.scene
        for key in ("time", "frame", "distance", "activation"):
            self.same(key, data[key], [frame[key] for frame in self.reference.frames])
        for key in self.fields:
            self.same(key, data[key], [frame[key][self.shown] for frame in self.reference.frames])
        for absent in {"velocity", "density"} - set(self.fields):
            if absent in data:
                raise Difference(f"{absent} was not asked for")
        for key in ("position", "mass", "activation"):
            if data[key].dtype != np.float32:
                raise Difference(f"{key} is {data[key].dtype}; expected float32")
        self.same("particle", data["particle"], self.shown)
        self.same("mass", data["mass"], self.reference.mass()[self.shown])
        self.same("kind", data["kind"], self.kind[self.shown])
        self.same("creature", data["creature"], self.creature[self.shown])
        self.same("cluster_creature", data["cluster_creature"],
                  [self.creature[cluster[0]] for cluster in scene["clusters"]])
        members = np.zeros((len(scene["clusters"]), scene["particles"]), bool)
        for i, cluster in enumerate(scene["clusters"]):
            members[i, cluster] = True
        self.same("cluster", data["cluster"], members[:, self.shown])
        if scene["muscles"]:
            self.same("muscle", self.shown[data["muscle"]],
                      np.stack([self.reference.muscles("a"), self.reference.muscles("b")], 1))
        self.same("muscle_actuator", data["muscle_actuator"], self.reference.muscles("actuator"))
        for key, name in (("muscle_lateral", "lateral"), ("muscle_rest_length", "restLength")):
            self.same(key, data[key], self.reference.muscles(name).astype("f4"))
        self.surface("surface", data["surface"], self.shown)

    def csv(self):
        names = ["water", "body", "other"]
        columns = {"position": ["x", "y", "z"], "velocity": ["vx", "vy", "vz"], "density": ["density"]}
        with open(self.folder / "swim.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        wanted = ["frame", "time", "particle", "kind"] + [name for field in self.fields for name in columns[field]]
        if list(rows[0]) != wanted:
            raise Difference(f"columns are {list(rows[0])}; expected {wanted}")
        count, frames = len(self.shown), self.reference.frames
        self.same("rows", [len(rows)], [count * len(frames)])
        self.same("frame", [int(row["frame"]) for row in rows], np.repeat([f["frame"] for f in frames], count))
        self.same("time", [float(row["time"]) for row in rows], np.repeat([f["time"] for f in frames], count))
        self.same("particle", [int(row["particle"]) for row in rows], np.tile(self.shown, len(frames)))
        self.same("kind", [names.index(row["kind"]) for row in rows], np.tile(self.kind[self.shown], len(frames)))
        for field in self.fields:
            found = np.array([[float(row[name]) for name in columns[field]] for row in rows]).astype("f4")
            self.same(field, found.ravel(), np.concatenate([frame[field][self.shown].ravel() for frame in frames]))

    def ply(self):
        from plyfile import PlyData

        names = {"position": ("x", "y", "z"), "velocity": ("vx", "vy", "vz"), "density": ("density",)}
        files = sorted(self.folder.glob("swim_*.ply"))
        wanted = [f"swim_{frame['frame']:06d}.ply" for frame in self.reference.frames]
        if [file.name for file in files] != wanted:
            raise Difference(f"files are {[file.name for file in files]}; expected {wanted}")
        for file, frame in zip(files, self.reference.frames):
            vertices = PlyData.read(file)["vertex"]
            for field in self.fields:
                found = np.stack([vertices[name] for name in names[field]], 1)
                self.same(f"{file.name} {field}", found, frame[field][self.shown].reshape(found.shape))
            self.same(f"{file.name} mass", vertices["mass"], self.reference.mass()[self.shown])
            self.same(f"{file.name} kind", vertices["kind"], self.kind[self.shown])
            self.same(f"{file.name} cluster", vertices["cluster"], self.reference.first_cluster()[self.shown])
            self.same(f"{file.name} creature", vertices["creature"], self.creature[self.shown])
        surfaces = sorted(self.folder.glob("water-surface/*.ply"))
        self.same("surfaces", [len(surfaces)], [len(files) if self.has_surface else 0])
        for file, frame in zip(surfaces, self.reference.frames):
            data = PlyData.read(file)
            vertices = np.stack([data["vertex"][name] for name in "xyz"], 1)
            self.water_surface(file.name, frame, vertices, np.stack(data["face"]["vertex_indices"]))

    def vtp(self):
        import pyvista

        parts = [name for name, there in (("water", self.water.size), ("body", self.solids.size),
                                          ("muscles", len(self.reference.scene["muscles"])),
                                          ("water-surface", self.has_surface)) if there]
        reader = pyvista.get_reader(self.folder / "swim.pvd")
        self.same("times", reader.time_values, [frame["time"] for frame in self.reference.frames])
        for frame in self.reference.frames:
            reader.set_active_time_value(frame["time"])
            blocks = reader.read()
            self.same("parts", [blocks.n_blocks], [len(parts)])
            for name, block in zip(parts, blocks):
                self.same(f"{name} time", block.field_data["TimeValue"], [frame["time"]])
                if name == "water-surface":
                    self.water_surface(name, frame, block.points, block.faces.reshape(-1, 4)[:, 1:])
                elif name == "muscles":
                    self._vtp_muscles(block, frame)
                else:
                    self._vtp_points(name, block, frame, self.water if name == "water" else self.solids)

    def vti(self):
        """The water on its grid; some of its cells are summed up anew from the particles."""
        import pyvista

        reader = pyvista.get_reader(self.folder / "water.pvd")
        self.same("times", reader.time_values, [frame["time"] for frame in self.reference.frames])
        spacing = self.reference.scene["fluidRestDistance"]
        for frame in self.reference.frames:
            reader.set_active_time_value(frame["time"])
            grid = reader.read()[0]
            self.same("time", grid.field_data["TimeValue"], [frame["time"]])
            centres, places = grid.cell_centers().points.astype(float), frame["position"][self.water].astype(float)
            self.near("corner", grid.bounds[::2], places.min(0) - spacing / 2)
            for cell in np.random.default_rng(1).integers(grid.n_cells, size=100):
                q = np.linalg.norm(places - centres[cell], axis=1) / (2 * spacing)
                weight = np.where(q < 1, 21 / (16 * np.pi) * (1 - q) ** 4 * (4 * q + 1), 0)
                self.close("density", grid["density"][cell], weight.sum())
                if weight.sum() > 1e-3:
                    self.close("velocity", grid["velocity"][cell], weight @ frame["velocity"][self.water] / weight.sum())
            shape = [count - 1 for count in grid.dimensions]
            velocity = [grid["velocity"][:, axis].reshape(shape, order="F") for axis in range(3)]
            x, y, z = ([np.gradient(component, spacing, axis=axis) for axis in range(3)] for component in velocity)
            for axis, curl in enumerate((z[1] - y[2], x[2] - z[0], y[0] - x[1])):
                self.close("vorticity", grid["vorticity"][:, axis], curl.ravel(order="F"))
            q = -(x[0] ** 2 + y[1] ** 2 + z[2] ** 2) / 2 - x[1] * y[0] - x[2] * z[0] - y[2] * z[1]
            self.close("Q", grid["Q"], q.ravel(order="F"))

    def close(self, what, found, expected):
        """Within the rounding of sums of floats."""
        found, expected = np.asarray(found), np.asarray(expected)
        if not np.allclose(found, expected, rtol=1e-4, atol=1e-4 * max(1, np.abs(expected).max())):
            raise Difference(f"{what}: {found}; expected {expected}")
        self.compared += expected.size

    def _vtp_points(self, name, block, frame, particles):
        self.same(f"{name} position", block.points, frame["position"][particles])
        for field in self.fields[1:]:
            self.same(f"{name} {field}", block.point_data[field], frame[field][particles])
        for absent in {"velocity", "density"} - set(self.fields):
            if absent in block.point_data:
                raise Difference(f"{name}: {absent} was not asked for")
        self.same(f"{name} mass", block.point_data["mass"], self.reference.mass()[particles])
        self.same(f"{name} kind", block.point_data["kind"], self.kind[particles])
        self.same(f"{name} cluster", block.point_data["cluster"], self.reference.first_cluster()[particles])
        self.same(f"{name} creature", block.point_data["creature"], self.creature[particles])
        self.same(f"{name} particle", block.point_data["particle"], particles)
        self.same(f"{name} vertices", block.verts.reshape(-1, 2)[:, 1], np.arange(len(particles)))
        faces = block.faces.reshape(-1, 4)[:, 1:] if block.faces.size else np.empty(0)
        if name == "body":
            self.surface("body's surface", faces, particles)

    def _vtp_muscles(self, block, frame):
        ends = block.lines.reshape(-1, 3)[:, 1:]
        self.same("muscle's ends", self.solids[ends],
                  np.stack([self.reference.muscles("a"), self.reference.muscles("b")], 1))
        self.same("muscles' points", block.points, frame["position"][self.solids])
        self.same("actuator", block.cell_data["actuator"], self.reference.muscles("actuator"))
        self.near("contraction", block.cell_data["contraction"], self.reference.contraction(frame))

    def usdc(self):
        with open(self.folder / "swim.usdc", "rb") as file:
            self.same("first letters", [file.read(8)], [b"PXR-USDC"])
        self.usd()

    def usd(self):
        from pxr import Usd, UsdGeom

        stage = Usd.Stage.Open(str(self.folder / f"swim.{'usdc' if self.metadata['format'] == 'usdc' else 'usda'}"))
        frames, scene = self.reference.frames, self.reference.scene
        self.same("metersPerUnit", [UsdGeom.GetStageMetersPerUnit(stage)], [1])
        if UsdGeom.GetStageUpAxis(stage) != "Y":
            raise Difference(f"upAxis is {UsdGeom.GetStageUpAxis(stage)}; expected Y")
        self.same("timeCodesPerSecond", [stage.GetTimeCodesPerSecond()], [1 / scene["timeStep"]])
        self.same("time range", [stage.GetStartTimeCode(), stage.GetEndTimeCode()],
                  [frames[0]["frame"], frames[-1]["frame"]])
        root = stage.GetDefaultPrim().GetPath()
        points = {"Water": self.water, "BodyParticles": np.flatnonzero(self.creature >= 0),
                  "Obstacles": np.flatnonzero((self.kind != 0) & (self.creature < 0))}
        wanted = {name for name, particles in points.items() if len(particles)}
        bodies = {f"Companion{i}" if i else "Body": i for i, slices in enumerate(self.reference.slices()) if slices}
        wanted |= set(bodies)
        if self.has_surface:
            wanted.add("WaterSurface")
        if scene["muscles"]:
            wanted.add("Muscles")
        found = {prim.GetName() for prim in stage.GetDefaultPrim().GetChildren()}
        if found != wanted:
            raise Difference(f"prims are {sorted(found)}; expected {sorted(wanted)}")
        for name in wanted & set(points):
            self._usd_points(UsdGeom.Points(stage.GetPrimAtPath(root.AppendChild(name))), points[name])
        for name, i in bodies.items():
            self._usd_body(UsdGeom.Mesh(stage.GetPrimAtPath(root.AppendChild(name))), i)
        if self.has_surface:
            mesh = UsdGeom.Mesh(stage.GetPrimAtPath(root.AppendChild("WaterSurface")))
            values = [self._usd_samples(attribute) for attribute in (
                mesh.GetPointsAttr(), mesh.GetFaceVertexIndicesAttr(), mesh.GetFaceVertexCountsAttr())]
            for frame, points, indices, counts in zip(frames, *values):
                self.same("WaterSurface face counts", counts, np.full(len(indices) // 3, 3))
                self.water_surface("WaterSurface", frame, points, indices)
        if "Muscles" in wanted:
            self._usd_muscles(UsdGeom.BasisCurves(stage.GetPrimAtPath(root.AppendChild("Muscles"))))

    def _usd_samples(self, attribute):
        """The values at the frames' time codes; the attribute has no others."""
        codes = [frame["frame"] for frame in self.reference.frames]
        self.same(f"{attribute.GetPath()} times", attribute.GetTimeSamples(), codes)
        return [np.array(attribute.Get(code)) for code in codes]

    def _usd_extent(self, boundable, particles, width):
        for value, frame in zip(self._usd_samples(boundable.GetExtentAttr()), self.reference.frames):
            position = frame["position"][particles]
            margin = np.float32(width / 2)
            self.near(f"{boundable.GetPath()} extent", value, [position.min(0) - margin, position.max(0) + margin])

    def _usd_points(self, prim, particles):
        from pxr import UsdGeom

        path, frames = prim.GetPath(), self.reference.frames
        primvars = UsdGeom.PrimvarsAPI(prim)
        self.same(f"{path} points", self._usd_samples(prim.GetPointsAttr()),
                  [frame["position"][particles] for frame in frames])
        if "velocity" in self.fields:
            self.same(f"{path} velocities", self._usd_samples(prim.GetVelocitiesAttr()),
                      [frame["velocity"][particles] for frame in frames])
        if "density" in self.fields:
            density = primvars.GetPrimvar("density")
            self.same(f"{path} density", self._usd_samples(density.GetAttr()),
                      [frame["density"][particles] for frame in frames])
            if density.GetInterpolation() != "vertex":
                raise Difference(f"{path} density is {density.GetInterpolation()}")
        self.same(f"{path} ids", np.array(prim.GetIdsAttr().Get()), particles)
        self.same(f"{path} mass", np.array(primvars.GetPrimvar("mass").Get()), self.reference.mass()[particles])
        scene = self.reference.scene
        width = {"Water": scene["fluidRestDistance"], "BodyParticles": scene["solidRestDistance"] / 2,
                 "Obstacles": scene["solidRestDistance"]}[prim.GetPrim().GetName()]
        self.same(f"{path} widths", np.array(prim.GetWidthsAttr().Get()), np.array([width], "f4"))
        if prim.GetPrim().GetName() == "BodyParticles":
            self.same(f"{path} cluster", np.array(primvars.GetPrimvar("cluster").Get()),
                      self.reference.first_cluster()[particles])
            self.same(f"{path} creature", np.array(primvars.GetPrimvar("creature").Get()), self.creature[particles])
        self._usd_extent(prim, particles, width)

    def _usd_body(self, mesh, creature):
        particles = np.flatnonzero(self.creature == creature)
        self.same("Body points", self._usd_samples(mesh.GetPointsAttr()),
                  [frame["position"][particles] for frame in self.reference.frames])
        counts = np.array(mesh.GetFaceVertexCountsAttr().Get())
        self.same("Body face counts", counts, np.full(counts.size, 3))
        self.surface("Body", np.array(mesh.GetFaceVertexIndicesAttr().Get()), particles,
                     [self.reference.slices()[creature]])
        self._usd_extent(mesh, particles, 0)

    def glb(self):
        from glb_reader import Glb

        glb = Glb(self.folder / "swim.glb")
        names = [f"Companion{i}" if i else "Body" for i, slices in enumerate(self.reference.slices()) if slices]
        self.same("meshes", sorted(glb.bodies), sorted(names))
        self.near("times", glb.times, [frame["time"] for frame in self.reference.frames])
        for name in names:
            self._glb_body(name, glb.bodies[name], int(name.removeprefix("Companion")) if name != "Body" else 0)

    def _glb_body(self, name, body, creature):
        """The mesh at rest is the settled start's, or the skin's; moved by its bones it stays by the particles."""
        own = np.flatnonzero(self.creature == creature)
        start = self.reference.frames[0]["position"]
        if creature == 0 and self.reference.scene["skin"]:
            self._glb_skin(body)
            return
        order = {tuple(start[particle]): particle for particle in own}
        particles = np.array([order.get(tuple(place), -1) for place in body.places])
        if particles.min() < 0:
            raise Difference(f"{name}: a vertex is not at a particle of the settled start")
        self.surface(name, particles[body.triangles], np.arange(len(self.creature)), [self.reference.slices()[creature]])
        for i, frame in enumerate(self.reference.frames):
            off = np.linalg.norm(body.moved(i) - frame["position"][particles], axis=1)
            share = np.sqrt((off ** 2).mean()) / self.reference.scene["solidRestDistance"]
            if share > 0.25:
                raise Difference(f"{name} in frame {frame['frame']}: {share:.3f} solid rest distances from its particles")
            self.compared += body.places.size
        if i and self.reference.scene["gait"] and np.allclose(body.moved(i), body.moved(0), atol=1e-4):
            raise Difference(f"{name} does not move")

    def _glb_skin(self, body):
        """Each vertex where the best rigid motions of its two clusters bring it, computed here once more."""
        scene = self.reference.scene
        skin, row = scene["skin"], {particle: i for i, particle in enumerate(scene["body"])}
        vertices, rest = np.array(skin["vertices"]), np.array(skin["rest"])
        self.near("skin", body.places, vertices)
        share, front = np.array(skin["share"])[:, None], np.array(skin["cluster"])
        for i, frame in enumerate(self.reference.frames):
            places = []
            for cluster in scene["clusters"]:
                at = rest[[row[particle] for particle in cluster]]
                now = frame["position"][cluster].astype(float)
                u, _, v = np.linalg.svd((now - now.mean(0)).T @ (at - at.mean(0)))
                turn = u @ np.diag([1, 1, np.sign(np.linalg.det(u @ v))]) @ v
                places.append((vertices - at.mean(0)) @ turn.T + now.mean(0))
            places = np.array(places)
            rear = np.array(skin.get("other", np.minimum(front + 1, len(places) - 1)))
            each = np.arange(len(vertices))
            wanted = share * places[front, each] + (1 - share) * places[rear, each]
            if np.abs(body.moved(i) - wanted).max() > 1e-4:
                raise Difference(f"skin in frame {frame['frame']}: {np.abs(body.moved(i) - wanted).max()} off")
            self.compared += wanted.size

    def _usd_muscles(self, curves):
        from pxr import UsdGeom

        primvars = UsdGeom.PrimvarsAPI(curves)
        ends = np.stack([self.reference.muscles("a"), self.reference.muscles("b")], 1).ravel()
        self.same("Muscles points", self._usd_samples(curves.GetPointsAttr()),
                  [frame["position"][ends] for frame in self.reference.frames])
        self.same("Muscles counts", np.array(curves.GetCurveVertexCountsAttr().Get()),
                  np.full(len(self.reference.scene["muscles"]), 2))
        self.same("actuator", np.array(primvars.GetPrimvar("actuator").Get()), self.reference.muscles("actuator"))
        self.near("contraction", self._usd_samples(primvars.GetPrimvar("contraction").GetAttr()),
                  [self.reference.contraction(frame) for frame in self.reference.frames])


def main(stream, folder):
    try:
        check = Check(stream, folder)
        getattr(check, check.metadata["format"])()
    except Difference as difference:
        print(f"check_export.py: {folder}: {difference}", file=sys.stderr)
        return 1
    print(f"{check.metadata['format']}: {check.compared} numbers equal in {len(check.reference.frames)} frames")
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
