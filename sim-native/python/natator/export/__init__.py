"""Swims in the formats of other programs: ParaView, Blender, USD, tables and numpy (sim-native/docs/exporting.md)."""

import functools
import json

from natator.errors import InputError
from natator.export.bodies import KINDS, Swim
from natator.export.folder import FILES, METADATA, ExportFolder, files_in
from natator.export.glb import Glb
from natator.export.points import Ply, Vti, Vtp
from natator.export.tables import USUAL, WIDTHS, Csv, Npz
from natator.export.usd import Usd
from natator.export.water import WaterSurface
from natator.script import package
from natator.stream import Stream
from natator.trajectory import frames

#: writers: `frame` writes one, `finish` what comes after the last, `close` ends it, whether finished or not; memory does not grow
#: with the number of frames
FORMATS = {"vtp": Vtp, "vti": Vti, "ply": Ply, "usd": Usd, "usdc": functools.partial(Usd, binary=True), "glb": Glb, "csv": Csv, "npz": Npz}
HOLD_MESHES = ("vtp", "ply", "usd", "usdc")  # whose vertices are others in every frame
NOT_METADATA = {"protocol", "number", "restarted", "mass", "fluid"}


def export(scene, format, folder, gait=None, duration=None, every=1, fields=USUAL, water=True, water_surface=False,
           force=False, source=None, on_frame=None, **options):
    """Simulates a swim once and writes every frame of it as it comes to a folder, which appears when it is whole.

    scene, gait, options: as of Stream. format: one of FORMATS. duration: s, to the nearest frame, one at least; None is the
    scene's. fields: of "velocity", "density" and "force" (not in scheme flex); "position" is always there. water: with the water's particles. water_surface:
    with a mesh of it. force: may replace an earlier export. source: more entries of metadata.json. on_frame: called with each
    Frame. Returns metadata.json as a dict. Raises InputError, ProgramError, Unstable and OSError, and then there is no folder.
    """
    if format not in FORMATS:
        raise InputError(f"format = {format!r}: must be one of {', '.join(FORMATS)}")
    if water_surface and format not in HOLD_MESHES:
        raise InputError(f"--water-surface and --format {format}: expected a format that holds meshes of many shapes: "
                         f"{', '.join(HOLD_MESHES)}")
    on_grid = format == "vti"
    if on_grid:
        package("pyvista", "pyvista", "--format vti")
        if not water:
            raise InputError("--no-water and --format vti: expected one of them, as it holds the water alone")
    if water_surface:
        package("pysplashsurf", "pysplashsurf", "--water-surface")
    if format in ("usd", "usdc"):
        package("pxr.Usd", "usd-core", f"--format {format}")
    fields = [field for field in WIDTHS if field == "position" or field in fields]
    with ExportFolder(folder, force) as target, Stream(scene, gait=gait, fields=fields, **options) as stream:
        duration = stream.scene["duration"] if duration is None else duration
        swim = Swim.of(stream, water)
        if on_grid and not stream.water().density.size:
            raise InputError(f"--format vti: {scene} has no water; expected some")
        if water_surface and not len(swim.all_water):
            raise InputError(f"--water-surface: {scene} has no water; expected some")
        if not len(swim.shown) and not water_surface:
            raise InputError(f"{scene} has no particles to export; expected some")
        meshes = {"water_surface": WaterSurface(swim)} if water_surface else {}
        writer, count = FORMATS[format](swim, target.path, **meshes), 0
        try:
            for frame in frames(stream, duration, every, least=1, water=on_grid):
                writer.frame(frame, *[stream.last_water] * on_grid)
                count += 1
                if on_frame:
                    on_frame(frame)
            writer.finish()
        finally:
            writer.close()
        metadata = {"format": format, **(source or {}), "every": every, "frames": count,
                    "water": water and format != "glb", "waterSurface": water_surface,
                    "kinds": {str(i): kind for i, kind in enumerate(KINDS)},
                    **{key: value for key, value in stream.scene.items() if key not in NOT_METADATA}, "duration": duration}
        metadata[FILES] = [*files_in(target.path), METADATA]
        (target.path / METADATA).write_text(json.dumps(metadata, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
        target.commit()
        return metadata
