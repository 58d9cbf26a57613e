"""Swims for numpy and as a table."""

import zipfile

import numpy as np

from natator.export.bodies import KINDS

WIDTHS = {"position": ("x", "y", "z"), "velocity": ("vx", "vy", "vz"), "density": ("density",), "force": ("fx", "fy", "fz")}
USUAL = ("position", "velocity", "density")  # which every scheme has


class Npz:
    """`swim.npz`: T frames, N particles, A actuators, C clusters, M muscles. Muscles and clusters name particles by their place in
    the arrays. Arrays that grow by a row with each frame wait in files of their own."""

    def __init__(self, swim, folder):
        self._swim, self._folder, self._rows = swim, folder, 0
        count = len(swim.shown)
        self._shapes = {"time": ("<f8",), "frame": ("<i4",), "distance": ("<f8",), "activation": ("<f4", swim.scene["actuators"]),
                        **{field: ("<f4", count, *[3][:len(WIDTHS[field]) - 1]) for field in swim.fields}}
        self._files = {name: open(folder / f"{name}.rows", "wb") for name in self._shapes}

    def frame(self, frame):
        self._rows += 1
        row = {"time": frame.time, "frame": frame.number, "distance": frame.distance, "activation": frame.drive,
               **{field: getattr(frame, field)[self._swim.shown] for field in self._swim.fields}}
        for name, file in self._files.items():
            file.write(np.asarray(row[name], self._shapes[name][0]).tobytes())

    def finish(self):
        with zipfile.ZipFile(self._folder / "swim.npz", "w") as archive:  # not compressed: floats of a motion hardly are
            for name, (dtype, *shape) in self._shapes.items():
                with _entry(archive, name) as entry, open(self._files[name].name, "rb") as rows:
                    self._files[name].close()
                    np.lib.format.write_array_header_1_0(entry, {"descr": dtype, "fortran_order": False,
                                                                 "shape": (self._rows, *shape)})
                    while data := rows.read(1 << 20):
                        entry.write(data)
                (self._folder / f"{name}.rows").unlink()
            for name, values in self._fixed().items():
                with _entry(archive, name) as entry:
                    np.lib.format.write_array(entry, values)

    def _fixed(self):
        swim, shown = self._swim, self._swim.shown
        clusters = swim.scene["clusters"]
        return {"particle": shown.astype("<i4"), "mass": swim.mass[shown], "kind": swim.kind[shown],
                "creature": swim.creature[shown],
                "cluster_creature": np.array([swim.creature[cluster[0]] if cluster else -1 for cluster in clusters], "<i4"),
                "cluster": np.array([np.isin(shown, cluster) for cluster in clusters], bool).reshape(len(clusters), len(shown)),
                "muscle": swim.places_in(shown, swim.muscle_ends), "muscle_actuator": swim.muscle_actuators,
                "muscle_lateral": swim.muscle_lateral.astype("<f4"),
                "muscle_rest_length": swim.muscle_rest_length.astype("<f4"), "surface": swim.surface_in(shown)}

    def close(self):
        for file in self._files.values():
            file.close()


def _entry(archive, name):
    """A zip entry without a date, so that the same export gives the same bytes."""
    return archive.open(zipfile.ZipInfo(f"{name}.npy"), "w", force_zip64=True)


class Csv:
    """`swim.csv`: a row for each particle in each frame. Numbers have all their digits."""

    def __init__(self, swim, folder):
        self._swim, self._out = swim, open(folder / "swim.csv", "w", encoding="ascii")
        self._same = [f"{particle},{KINDS[swim.kind[particle]]}" for particle in swim.shown]
        self._out.write(",".join(["frame,time,particle,kind", *(name for field in swim.fields for name in WIDTHS[field])]) + "\n")

    def frame(self, frame):
        shown = self._swim.shown
        columns = [column.astype(str) for field in self._swim.fields
                   for column in getattr(frame, field)[shown].reshape(len(shown), len(WIDTHS[field])).T]
        head = f"{frame.number},{frame.time!r},"
        self._out.writelines(head + ",".join(row) + "\n" for row in zip(self._same, *columns))

    def finish(self):
        self.close()

    def close(self):
        self._out.close()
