"""The page's answer and tables, of stability.csv: where a law is broken, and by how much of what it allows. Its picture is draw.py's."""
import pathlib

import pandas
import study

HERE = pathlib.Path(__file__).parent
SCHEMES = ("flex", "conserving")


def breaches(runs, scheme):
    """16, 24, 32: tank, 2.55: the values, the law, the most that is used of what it allows"""
    own = runs[runs.scheme == scheme]
    broken = own[own.status != "ok"]
    if broken.empty:
        return "–"
    values = ", ".join(f"{value:g}" for value in sorted(broken.value))
    how = "while settling" if (broken.stage == "settling").all() else f"{broken.largest.max():.2f}"
    return f"{values}: {', '.join(dict.fromkeys(broken.law))}, {how}"


def in_lattice():
    """What the answer says of scheme `lattice`, and for each axis and scene where a swim ends as unstable or is refused."""
    table = pandas.read_csv(HERE / "lattice.csv")
    rows = []
    for axis, of_axis in table.groupby("axis", sort=False):
        row = [axis, f"{of_axis.value.min():g} to {of_axis.value.max():g}"]
        for _, own in of_axis.groupby("scene", sort=False):
            ends = [", ".join(f"{value:g}" for value in own[own.status == status].value) + f": {how}" for status, how in (("unstable", "mach"), ("error", "refused"))
                    if (own.status == status).any()]
            row.append("; ".join(ends) or "–")
        rows.append(row)
    laws = table[table.status == "unstable"].why
    if set(laws) != {"mach"}:
        raise ValueError(f"lattice.csv: laws {sorted(set(laws))}; expected mach alone")
    return f"In `lattice` {len(laws)} of {len(table)} do, by the law mach, and {(table.status == 'error').sum()} are refused.", study.table(["axis", "range", *table.scene.unique()], rows, "<<<<")


def broken(runs):
    """Points that break a law, of each scheme."""
    return ["; ".join(f"{axis} {found.split(':')[0]}" for axis, own in runs.groupby("axis", sort=False) if (found := breaches(own, scheme)) != "–") or "–"
            if scheme in set(runs.scheme) else "" for scheme in SCHEMES]


def compared(one, other, *point):
    """Rows of the same points, and those that end otherwise."""
    both = one.merge(other, on=["scheme", "axis", "value", *point])
    return both, both[both.status_x != both.status_y]


def beyond(tank):
    """What the answer says of 60 s and of a large tank, and the table: points that break a law there, and of how many on a GPU the end is another."""
    longer, gpu = (pandas.read_csv(HERE / f"{name}.csv") for name in ("long", "gpu"))
    small, large = (gpu[gpu.scene == scene] for scene in ("small-tank", "large-tank"))
    both, other = compared(small, tank)

    def told(own):
        return " and ".join(f"{(own[own.scheme == scheme].status != 'ok').sum()} of {(own.scheme == scheme).sum()} in `{scheme}`" for scheme in SCHEMES)

    differ = "; ".join(f"{row.scheme}, {row.axis} {row.value:g}" for row in other.itertuples())
    axes = large.axis.unique()
    return f"With one thing made worse {told(longer)} do over 60 s; of {', '.join(axes)} alone {told(longer[longer.axis.isin(axes)])}, with 300 000 particles in 1 s or at least 8 frames {told(large)}.", (
        study.table(["", *SCHEMES], [["60 s, a processor", *broken(longer)], ["300 000 particles, 30 deep, a GPU", *broken(large)]], "<<<")
        + f"\nThe small tank on a GPU ends as on a processor at {len(both) - len(other)} of {len(both)} points" + (f" (not: {differ})" if differ else "") + ".\n")


def make(folder):
    table, (of_lattice, lattice) = pandas.read_csv(HERE / "stability.csv"), in_lattice()
    single, pairs = table[table.second_axis.isna()], table[table.second_axis.notna()]
    tank = single[(single.scene == "small-tank") & (single.precision == "float")]
    of_beyond, further = beyond(tank)
    rows = [[axis, f"{own.value.min():g} to {own.value.max():g}", *(breaches(own, scheme) for scheme in SCHEMES)] for axis, own in tank.groupby("axis", sort=False)]
    calm = [f"{axis} ({extent})" for axis, extent, *found in rows if found == ["–", "–"]]
    both, otherwise = compared(single[single.precision == "double"], single[single.precision == "float"], "scene")
    scenes = [[scene, *broken(own)] for scene, own in single[single.scene != "small-tank"].groupby("scene", sort=False)]
    two = [[f"{first}, {second}", *(f"{(own[own.scheme == scheme].status != 'ok').sum()} of {(own.scheme == scheme).sum()}" for scheme in SCHEMES)]
           for (first, second), own in pairs.groupby(["axis", "second_axis"], sort=False)]
    unstable = table[table.status != "ok"].scheme.value_counts()
    finite = "No value was infinite. " if not (table.law == "finite").any() else ""
    count = table.scheme.value_counts()
    answer = f"**{unstable.get('flex', 0)} of {count['flex']} runs in `flex` and {unstable.get('conserving', 0)} of {count['conserving']} in `conserving` break a law, in a small tank, mostly in 1 s.** {finite}" \
             + f"Double and float differ in that at {len(otherwise)} of {len(both)} points. {of_beyond} {of_lattice}\n"
    (folder / "README.md").write_text(study.filled(
        HERE / "README.md", answer=answer, axes=study.table(["axis", "range", *SCHEMES], [row for row in rows if row[2:] != ["–", "–"]], "<<<<")
        + f"\nNowhere: {', '.join(calm)}.\n", scenes=study.table(["scene", *SCHEMES], scenes, "<<<"),
        pairs=study.table(["two things", *SCHEMES], two), lattice=lattice, beyond=further), encoding="utf-8")


study.main(make)
