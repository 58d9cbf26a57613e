"""`python -m natator`: swims for other programs, pictures of them, and reports of evolutions."""

import argparse
import re
import signal
import sys

from natator import export, gallery, picture, report
from natator.errors import InputError
from natator.export.runs import RUN_FORMATS, export_run
from natator.script import run
from natator.source import source


class Parser(argparse.ArgumentParser):
    """Says what is wrong in one line."""

    def error(self, message):
        self.exit(2, f"{self.prog}: {message}; see {self.prog} --help\n")


def parser():
    all_commands = Parser(prog="python -m natator", description=__doc__)
    commands = all_commands.add_subparsers(required=True, metavar="COMMAND", parser_class=Parser)
    for name, work, about in (("export", exported, "Simulates a swim and writes it, frame by frame, for another program; or writes the course of a run."),
                              ("picture", drawn, "Simulates a swim up to a time and draws it: the body in its water, with a scale.")):
        command = commands.add_parser(name, help=about, description=about)
        command.set_defaults(work=work, command=command)
        command.add_argument("source", metavar="RUN|SCENE", help="a run folder of natator evolve (its best gait), or a scene: a name "
                             "as thesis/creature-1, or a file")
        command.add_argument("--gait", metavar="FILE", help="a gait; also best.json, or a line of evaluations.jsonl, of a run")
        command.add_argument("--overrides", metavar="JSON|FILE", help="JSON Merge Patch on the scene")
        command.add_argument("--scheme", help="flex, conserving or lattice; default: the run's, else the scene's")
        command.add_argument("--no-water", action="store_true", help="without the water's particles")
        if name == "export":
            command.add_argument("--format", required=True, choices=[*export.FORMATS, *RUN_FORMATS], help=f"{', '.join(RUN_FORMATS)} are of the "
                                 "course of a RUN, which simulates nothing; the others of a swim")
            command.add_argument("--fresh", type=int, metavar="N", help="with --format archive: run the best of each kind from so many new starts, too")
            command.add_argument("--workers", type=int, metavar="N", help="with --fresh: how many at a time; default: all processors")
            command.add_argument("--duration", type=float, help="s, to the nearest frame; default: the run's, else the scene's")
            command.add_argument("--every", type=int, default=1, metavar="N", help="every Nth frame only")
            command.add_argument("--fields", default=",".join(export.USUAL), help="of each particle, also force; default: %(default)s")
            command.add_argument("--water-surface", action="store_true", help="with a mesh of the water's surface")
            command.add_argument("--precision", help="what is computed in, float or double; files hold floats")
            command.add_argument("--output-dir", metavar="DIR", help="default: RUN/export-FORMAT, or the scene's name and the format")
            command.add_argument("--force", action="store_true", help="replace an earlier export in that folder")
        else:
            command.add_argument("--at", type=float, metavar="SECONDS", help="default: 1, or the end of a shorter swim; 0 of a body at "
                                 "rest")
            command.add_argument("--from", dest="view", default="side", choices=picture.VIEWS, help="default: %(default)s")
            command.add_argument("--size", metavar="WxH", help="pixels; default: 1600 wide, as high as what is shown")
            command.add_argument("--vortices", action="store_true", help="draw them in place of the water's surface: surfaces of the "
                                 "Q-criterion, red where they turn to the left, seen from above")
            command.add_argument("--slice", choices=picture.SLICES, help="draw this on a plane in place of the water's surface")
            command.add_argument("--plane", choices=picture.PLANES, help="of --slice; default: level")
            command.add_argument("--place", type=float, metavar="X", help="of the plane, in body lengths from the body; default: 0")
            command.add_argument("--pressure", action="store_true", help="colour the body by the pressure on it")
            command.add_argument("--forces", action="store_true", help="draw the water's force on each part of the body")
            command.add_argument("-o", "--output", metavar="FILE", help="default: the scene's name and .png")
    about = "Runs a run's best gait once more, draws how it swims and says what fish it is like: a page report.html and its pictures."
    command = commands.add_parser("report", help=about, description=about)
    command.set_defaults(work=reported, command=command)
    command.add_argument("run", metavar="RUN", help="a run folder of natator evolve")
    command.add_argument("--output-dir", metavar="DIR", help="default: RUN/report")
    about = "Simulates all bundled scenes that have a swimmer, or some, and writes a page with a moving picture of each."
    command = commands.add_parser("gallery", help=about, description=about)
    command.set_defaults(work=shown, command=command)
    command.add_argument("scenes", metavar="SCENE", nargs="*", help="default: all; those of lake/ take longest")
    command.add_argument("--duration", type=float, default=2, metavar="SECONDS", help="of each swim; default: %(default)s")
    command.add_argument("-o", "--output", metavar="FILE", default="gallery.html", help="default: %(default)s")
    return all_commands


def shown(given):
    count = gallery.write(given.output, given.scenes or None, given.duration, lambda line: print(line, file=sys.stderr, flush=True))
    print(f"{given.output}: {count} swim" + "s" * (count != 1))


def reported(given):
    print(report.write(given.run, given.output_dir))


def run_exported(given):
    """The course of a run, in a format that knows nothing of swims."""
    for name in ("gait", "overrides", "scheme", "no_water", "duration", "water_surface", "precision"):
        if getattr(given, name):
            raise InputError(f"--{name.replace('_', '-')} and --format {given.format}: expected a format of swims: {', '.join(export.FORMATS)}")
    if given.fresh is not None and given.fresh < 1:
        raise InputError(f"--fresh is {given.fresh}; expected a whole number from 1")
    folder = given.output_dir or f"{given.source}/export-{given.format}"
    written = export_run(given.source, given.format, folder, given.force, given.fresh or 0, given.workers)
    facts = [f"{key} {value:.6g}" for key, value in written.items() if isinstance(value, (int, float)) and key != "generations"]
    print(", ".join([f"{folder}: {written['generations']} generation" + "s" * (written["generations"] > 1), *facts]))


def exported(given):
    if given.format in RUN_FORMATS:
        return run_exported(given)
    if given.fresh is not None:
        raise InputError(f"--fresh and --format {given.format}: expected --format archive")
    swim = source(given.source, given.gait, given.overrides, given.scheme)
    fields = given.fields.split(",")
    for field in fields:
        if field not in export.WIDTHS or fields.count(field) > 1:
            raise InputError(f"--fields is {given.fields}: must be some of {', '.join(export.WIDTHS)}, each once")
    folder = given.output_dir or (f"{swim.run}/export-{given.format}" if swim.run else f"{swim.name}-{given.format}")
    differences = []
    written = export.export(
        swim.scene, given.format, folder, swim.gait, swim.duration if given.duration is None else given.duration, given.every, fields,
        not given.no_water, given.water_surface, given.force, {"run": swim.run.resolve().name} if swim.run else {},
        lambda frame: differences.append(swim.difference(frame)), overrides=swim.overrides, scheme=swim.scheme,
        arguments=["--precision", given.precision] if given.precision else [])
    for difference in filter(None, differences if not given.precision else ()):
        print(difference, file=sys.stderr)
    print(f"{folder}: {written['frames']} frame" + "s" * (written["frames"] > 1))


def drawn(given):
    swim = source(given.source, given.gait, given.overrides, given.scheme)
    size = None
    if given.size is not None:
        size = tuple(map(int, given.size.split("x"))) if re.fullmatch(r"\d{1,6}x\d{1,6}", given.size) else (0, 0)
        if not all(picture.LEAST <= pixels <= picture.MOST for pixels in size):
            raise InputError(f"--size is {given.size}; expected pixels as 1200x800, each from {picture.LEAST} to {picture.MOST}")
    file = given.output or f"{swim.name}.png"
    if not file.lower().endswith(".png"):
        raise InputError(f"--output is {file}; expected a name that ends in .png")
    for name in ("plane", "place"):
        if getattr(given, name) is not None and not given.slice:
            raise InputError(f"--{name} is {getattr(given, name)}; expected --slice with it")
    if given.vortices and given.slice:
        raise InputError(f"--vortices and --slice {given.slice}: expected one of them")
    size, time = picture.picture(swim.scene, file, swim.gait, given.at, given.view, size, not given.no_water, swim.duration,
                                 given.vortices, given.slice, (given.plane or "level", given.place or 0), given.pressure, given.forces, overrides=swim.overrides, scheme=swim.scheme)
    print(f"{file}: {size[0]} x {size[1]} pixels, at {time:.2f} s")


def main():
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))  # as after an error: what is half done goes
    run(parser(), lambda given: given.work(given))


if __name__ == "__main__":
    main()
