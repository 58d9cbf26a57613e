"""Swims as files of points and triangles, one or more for each frame."""

import numpy as np

from natator.export.tables import WIDTHS


class Ply:
    """`swim_FRAME.ply`, binary, a vertex for each particle; meshes of the water's surface in a folder of their own."""

    def __init__(self, swim, folder, water_surface=None):
        self._swim, self._folder, self._water_surface = swim, folder, water_surface

    def frame(self, frame):
        swim, shown = self._swim, self._swim.shown
        columns = {name: column for field in swim.fields
                   for name, column in zip(WIDTHS[field], getattr(frame, field)[shown].reshape(len(shown), len(WIDTHS[field])).T)}
        columns |= {"mass": swim.mass[shown], "kind": swim.kind[shown], "cluster": swim.cluster[shown],
                    "creature": swim.creature[shown]}
        self._write(self._folder / f"swim_{frame.number:06d}.ply", frame, _rows(columns))
        if self._water_surface:
            vertices, triangles = self._water_surface(frame)
            folder = self._folder / "water-surface"
            folder.mkdir(exist_ok=True)
            faces = np.zeros(len(triangles), [("count", "u1"), ("corners", "<i4", 3)])
            faces["count"], faces["corners"] = 3, triangles
            self._write(folder / f"water-surface_{frame.number:06d}.ply", frame, _rows(dict(zip("xyz", vertices.T))), faces)

    def _write(self, file, frame, vertices, faces=None):
        names = {"<f4": "float", "|u1": "uchar", "<i4": "int"}
        lines = ["ply", "format binary_little_endian 1.0",
                 f"comment {self._swim.title}, frame {frame.number}, time {frame.time!r} s", f"element vertex {len(vertices)}",
                 *(f"property {names[dtype]} {name}" for name, dtype in vertices.dtype.descr)]
        if faces is not None:
            lines += [f"element face {len(faces)}", "property list uchar int vertex_indices"]
        with open(file, "wb") as out:
            out.write("\n".join([*lines, "end_header", ""]).encode("ascii", "replace"))
            out.write(vertices.tobytes())
            out.write(b"" if faces is None else faces.tobytes())

    def finish(self):
        """Does nothing: each frame's file is already complete."""

    close = finish


def _rows(columns):
    rows = np.zeros(len(next(iter(columns.values()))), [(name, column.dtype) for name, column in columns.items()])
    for name, column in columns.items():
        rows[name] = column
    return rows


class Vtp:
    """For ParaView: `swim.pvd` names the files of all times, up to four each: `water` and `body` (points with arrays; the body also
    with its surface), `muscles` (lines) and `water-surface` (triangles)."""

    TYPES = {"f": "Float", "i": "Int", "u": "UInt"}

    def __init__(self, swim, folder, water_surface=None):
        self._swim, self._folder, self._water_surface = swim, folder, water_surface
        self._surface = swim.surface_in(swim.solids)
        self._muscles = swim.places_in(swim.solids, swim.muscle_ends)
        self._index = []

    def frame(self, frame):
        swim, part = self._swim, 0
        for name, particles in (("water", swim.water), ("body", swim.solids)):
            if len(particles):
                arrays = {field: getattr(frame, field)[particles] for field in swim.fields if field != "position"}
                arrays |= {"mass": swim.mass[particles], "kind": swim.kind[particles], "cluster": swim.cluster[particles],
                           "creature": swim.creature[particles], "particle": particles.astype("<i4")}
                cells = {"Verts": np.arange(len(particles))[:, None]}
                if name == "body" and len(self._surface):
                    cells["Polys"] = self._surface
                part += self._write(frame, name, part, frame.position[particles], cells, arrays)
        if len(self._muscles):
            part += self._write(frame, "muscles", part, frame.position[swim.solids], {"Lines": self._muscles},
                                of_cells={"contraction": swim.contraction(frame), "actuator": swim.muscle_actuators})
        if self._water_surface:
            vertices, triangles = self._water_surface(frame)
            self._write(frame, "water-surface", part, vertices, {"Polys": triangles})

    def _write(self, frame, name, part, points, cells, of_points={}, of_cells={}):
        """VTK's PolyData in XML, its numbers appended raw after the XML."""
        blocks, offset = [], 0

        def listed(arrays):
            nonlocal offset
            text = ""
            for key, values in arrays.items():
                values = np.ascontiguousarray(values)
                kind = f"{self.TYPES[values.dtype.kind]}{8 * values.dtype.itemsize}"
                text += (f'<DataArray type="{kind}" Name="{key}" NumberOfComponents="{values.shape[1] if values.ndim > 1 else 1}" '
                         f'format="appended" offset="{offset}"/>\n')
                blocks.extend((np.array(values.nbytes, "<u8").tobytes(), values.tobytes()))
                offset += 8 + values.nbytes
            return text

        counts = "".join(f' NumberOf{kind}="{len(corners)}"' for kind, corners in cells.items())
        head = ('<?xml version="1.0"?>\n<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian" header_type="UInt64">\n'
                '<PolyData>\n<FieldData>\n<DataArray type="Float64" Name="TimeValue" NumberOfTuples="1" format="ascii">'
                f'{frame.time!r}</DataArray>\n</FieldData>\n<Piece NumberOfPoints="{len(points)}"{counts}>\n'
                f"<PointData>\n{listed(of_points)}</PointData>\n<CellData>\n{listed(of_cells)}</CellData>\n"
                f"<Points>\n{listed({'points': points})}</Points>\n")
        for kind, corners in cells.items():
            ends = corners.shape[1] * np.arange(1, len(corners) + 1)
            head += f"<{kind}>\n{listed({'connectivity': corners.ravel().astype('<i4'), 'offsets': ends.astype('<i4')})}</{kind}>\n"
        head += '</Piece>\n</PolyData>\n<AppendedData encoding="raw">\n_'
        path = f"{name}/{name}_{frame.number:06d}.vtp"
        (self._folder / name).mkdir(exist_ok=True)
        (self._folder / path).write_bytes(b"".join([head.encode(), *blocks, b"\n</AppendedData>\n</VTKFile>\n"]))
        self._index.append(f'<DataSet timestep="{frame.time!r}" part="{part}" name="{name}" file="{path}"/>\n')
        return 1

    def finish(self):
        _write_collection(self._folder / "swim.pvd", self._index)

    def close(self):
        """Does nothing: no file stays open between frames."""


class Vti:
    """For ParaView: `water.pvd` names `water/water_FRAME.vti` of all times, the water on a grid: velocity, density, pressure, vorticity and Q."""

    def __init__(self, swim, folder):
        self._folder, self._index = folder, []

    def frame(self, frame, water):
        path = f"water/water_{frame.number:06d}.vti"
        (self._folder / "water").mkdir(exist_ok=True)
        water.save(self._folder / path)
        self._index.append(f'<DataSet timestep="{frame.time!r}" part="0" name="water" file="{path}"/>\n')

    def finish(self):
        _write_collection(self._folder / "water.pvd", self._index)

    def close(self):
        """Does nothing: no file stays open between frames."""


def _write_collection(file, entries):
    """ParaView's list of the files of all times."""
    file.write_text('<?xml version="1.0"?>\n<VTKFile type="Collection" version="1.0" byte_order="LittleEndian">\n<Collection>\n'
                    + "".join(entries) + "</Collection>\n</VTKFile>\n")
