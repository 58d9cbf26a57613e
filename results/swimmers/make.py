"""The page's answer, of swimmers-targets.csv: which targets each scheme meets in its largest box, with the most beats, at its finest, and how many of them say only that something is 0 or which way it goes."""
import pathlib

import numpy as np
import pandas
import study

HERE = pathlib.Path(__file__).parent


def make(folder):
    table = pandas.read_csv(HERE / "swimmers-targets.csv", keep_default_na=False)
    table = table[table.mach.astype(str).isin(["", "0.15"]) & ~((table.quantity == "speed") & (table.over == "amplitude"))]  # fits over a rise and a fall
    told = []
    for scheme in ("lattice", "conserving"):
        own = table[table.scheme == scheme].sort_values(["box", "beats", "resolution", "met"], ascending=[True, True, True, False], kind="stable")
        finest = own.drop_duplicates(["case", "variant", "quantity", "over"], keep="last")  # at all pressures: "no" is last
        missed = finest[finest.met != "yes"]
        names = dict.fromkeys(" ".join(filter(None, (row.case, row.variant if row.variant != "all" else "", row.quantity, row.over and f"by {row.over.replace('_', ' ')}")))
                              for row in missed.itertuples())
        least, greatest = (pandas.to_numeric(finest[name]).fillna(bound) for name, bound in (("least", -np.inf), ("greatest", np.inf)))
        signs = finest[(least <= 0) & (greatest >= 0) | np.isinf(least) | np.isinf(greatest)]
        confirmed = finest[finest.confirmed == "yes"]
        told.append((f"In `{scheme}` {(finest.met == 'yes').sum()} of {len(finest)} targets are met at its finest ({(confirmed.met == 'yes').sum()} of the {len(confirmed)} whose figure is confirmed), among them {(signs.met == 'yes').sum()} of {len(signs)} signs or zeros",
                     f"; not: {', '.join(names)}."))
    (first, missed_first), second = told[0], "".join(told[1])
    (folder / "README.md").write_text(study.filled(HERE / "README.md", answer=f"**{first}**{missed_first} {second}\n"), encoding="utf-8")


study.main(make)
