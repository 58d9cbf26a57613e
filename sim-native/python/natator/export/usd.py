"""Swims as layers of USD."""

import numpy as np

from natator.export.bodies import Rig, colours

MUSCLE_WIDTH = 0.05  # in solid rest distances
KEPT = 1 << 24       # bytes of values that wait in memory
WATER, OBSTACLES = [(0.35, 0.62, 0.86)], [(0.56, 0.62, 0.66)]


class Usd:
    """`swim.usda` or `swim.usdc`, a time code for each simulated frame. `Water`, `BodyParticles` and `Obstacles` are points,
    `Muscles` are curves, `WaterSurface` is a mesh. `Body` is the swimmer's surface: the mesh that it was made of, or that of its
    slices; `Companion1` and so on are those of companions. Where there is a surface, its particles are there but invisible. The
    unit of length counts as a metre."""

    def __init__(self, swim, folder, water_surface=None, binary=False):
        from pxr import Sdf, Usd, UsdGeom, Vt  # not everybody has them

        self._Sdf, self._UsdGeom, self._Vt = Sdf, UsdGeom, Vt
        self._swim, self._folder, self._water_surface, self._binary = swim, folder, water_surface, binary
        self._prims, self._sampled, self._codes, self._kept = [], [], [], 0
        self._stage = stage = Usd.Stage.CreateNew(str(folder / "swim.usdc"))
        root = UsdGeom.Xform.Define(stage, "/Swim").GetPrim()
        Usd.ModelAPI(root).SetKind("component")
        stage.SetDefaultPrim(root)
        UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.y)
        UsdGeom.SetStageMetersPerUnit(stage, 1)
        stage.SetTimeCodesPerSecond(1 / swim.scene["timeStep"])
        stage.SetFramesPerSecond(1 / swim.scene["timeStep"])
        stage.GetRootLayer().documentation = swim.title

    def _define(self, start):
        swim, geom, scene = self._swim, self._UsdGeom, self._swim.scene
        if len(swim.water):
            water = self._points("Water", swim.water, scene["fluidRestDistance"], WATER)
            water.CreateDisplayOpacityPrimvar("constant").Set([0.3])
            if self._water_surface:
                water.MakeInvisible()
        if self._water_surface:
            mesh = self._mesh("WaterSurface", lambda frame: self._water_surface(frame)[0], None, WATER)
            mesh.CreateDisplayOpacityPrimvar("constant").Set([0.3])
            self._sample(mesh.CreateFaceVertexCountsAttr(), lambda frame: np.full(len(self._water_surface(frame)[1]), 3, "i4"))
            self._sample(mesh.CreateFaceVertexIndicesAttr(), lambda frame: self._water_surface(frame)[1].ravel())
        for name, creature in swim.surfaces().items():
            if creature == 0 and swim.skin:
                rig = Rig(swim, 0, start)
                self._mesh(name, lambda frame: rig.places(frame.position), rig.triangles, colours(rig.cluster))
            else:
                own = np.flatnonzero(swim.creature == creature)
                mesh = self._mesh(name, lambda frame, own=own: frame.position[own], swim.places_in(own, swim.triangles[creature]),
                                  colours(swim.cluster[own]))
                mesh.CreateDoubleSidedAttr(True)
        bodies = np.flatnonzero(swim.creature >= 0)
        if len(bodies):
            points = self._points("BodyParticles", bodies, scene["solidRestDistance"] / 2, colours(swim.cluster[bodies]))
            for name, values in (("cluster", swim.cluster), ("creature", swim.creature)):
                self._primvar(points, name, "int[]", "vertex").Set(self._value(values[bodies]))
            if swim.surfaces():
                points.MakeInvisible()
        obstacles = np.flatnonzero((swim.kind != 0) & (swim.creature < 0))
        if len(obstacles):
            self._points("Obstacles", obstacles, scene["solidRestDistance"], OBSTACLES)
        if len(swim.muscle_ends):
            ends, width = swim.muscle_ends.ravel(), MUSCLE_WIDTH * scene["solidRestDistance"]
            curves = self._prim(geom.BasisCurves, "Muscles", lambda frame: frame.position[ends], width)
            curves.CreateTypeAttr("linear")
            curves.CreateCurveVertexCountsAttr(self._value(np.full(len(swim.muscle_ends), 2, "i4")))
            curves.CreateWidthsAttr([width])
            curves.SetWidthsInterpolation("constant")
            self._primvar(curves, "actuator", "int[]", "uniform").Set(self._value(swim.muscle_actuators))
            self._sample(self._primvar(curves, "contraction", "float[]", "uniform"), swim.contraction)

    def _prim(self, schema, name, places, width=0):
        """A prim whose points move; width: of what is drawn at a point, length."""
        prim = schema.Define(self._stage, f"/Swim/{name}")
        self._sample(prim.CreateExtentAttr(), lambda frame: _extent(places(frame), np.float32(width / 2)))
        self._sample(prim.CreatePointsAttr(), places)
        return prim

    def _points(self, name, particles, width, colour):
        points = self._prim(self._UsdGeom.Points, name, lambda frame: frame.position[particles], width)
        points.CreateIdsAttr(self._Vt.Int64Array.FromNumpy(particles.astype("i8")))
        points.CreateWidthsAttr([width])
        points.SetWidthsInterpolation("constant")
        self._primvar(points, "mass", "float[]", "vertex").Set(self._value(self._swim.mass[particles]))
        self._colour(points, colour)
        if "velocity" in self._swim.fields:
            self._sample(points.CreateVelocitiesAttr(), lambda frame: frame.velocity[particles])
        if "density" in self._swim.fields:
            self._sample(self._primvar(points, "density", "float[]", "vertex"), lambda frame: frame.density[particles])
        return points

    def _mesh(self, name, places, triangles, colour):
        mesh = self._prim(self._UsdGeom.Mesh, name, places)
        mesh.CreateSubdivisionSchemeAttr("none")
        self._colour(mesh, colour)
        if triangles is not None:
            mesh.CreateFaceVertexCountsAttr(self._value(np.full(len(triangles), 3, "i4")))
            mesh.CreateFaceVertexIndicesAttr(self._value(triangles.ravel()))
        return mesh

    def _colour(self, prim, colour):
        primvar = prim.CreateDisplayColorPrimvar("vertex" if len(colour) > 1 else "constant")
        primvar.Set(self._value(np.array(colour, "f4")))

    def _primvar(self, prim, name, dtype, interpolation):
        return self._UsdGeom.PrimvarsAPI(prim).CreatePrimvar(name, self._Sdf.ValueTypeNames.Find(dtype), interpolation).GetAttr()

    def _sample(self, attribute, values):
        """An attribute with a value at every time."""
        self._sampled.append((attribute, values))

    def _value(self, array):
        kind = "Int" if array.dtype.kind in "iu" else "Float" if array.ndim == 1 else "Vec3f"
        return getattr(self._Vt, f"{kind}Array").FromNumpy(np.ascontiguousarray(array, "i4" if kind == "Int" else "f4"))

    def frame(self, frame):
        if not self._codes:
            self._define(frame.position)
        self._codes.append(frame.number)
        for attribute, values in self._sampled:
            array = values(frame)
            attribute.Set(self._value(array), frame.number)
            self._kept += array.nbytes
        if self._kept > KEPT:  # what is saved is no longer in memory
            self._stage.Save()
            self._kept = 0

    def finish(self):
        self._stage.SetStartTimeCode(self._codes[0])
        self._stage.SetEndTimeCode(self._codes[-1])
        self._stage.Save()
        if not self._binary:
            self._stage.GetRootLayer().Export(str(self._folder / "swim.usda"))
            (self._folder / "swim.usdc").unlink()

    def close(self):
        """Releases the layer, which only this writer has."""


def _extent(places, margin):
    return np.array([places.min(0) - margin, places.max(0) + margin], "f4")
