"""The page of the study, README.md, and its tables, tables/*.csv. All that they say of numbers follows from the rows."""
import csv
import io
import json
import math
import re
import statistics

from scipy import stats

import claims
import lake
import measured
import plan
import study
from measured import FISH, Sample, error_text, fixed, percent, with_error
from plan import GAITS, WATERS

OUR_DRAWINGS = (3, 4)  # creatures of which the thesis has no measures
WORDS = {"flex": "flex", "open-water": "open water"}
MARK = "<!-- answer -->"
BOUND = 0.02  # from here on a gene counts as being on its bound, as a share of its range


def text(sample, digits=4):
    """Mean ± standard deviation, or the one value that there is."""
    return with_error(sample.mean, sample.sd, digits) if sample.count > 1 else fixed(sample.mean, digits)


class Page:
    def __init__(self, found, vorticity):
        self.study, self.plan = found, found.plan
        self.claims = list(claims.every(found, vorticity))
        self.resolved = lake.Lake(found.folder)
        self.gaits = [one for one in GAITS if one["creature"] in found.size.creatures]

    # Tables: a heading and rows of text.

    def tables(self):
        """All of them, by name."""
        found = {f"{name}-{water}": table(water) for name, table in (("speeds", self.speeds), ("verdicts", self.verdicts), ("controls", self.controls))
                 for water in WATERS}
        found |= {"gaits": self.gait_table(), "claims": self.claim_numbers(), "agreement": self.agreement(), "beside-flex": self.beside_flex(),
                  "decisive": self.decisive(), "fish": self.fish("fits", True),
                  "fish-upright": self.fish("fitsOfBody", False), "attitudes": self.attitudes(), "parameters": self.parameters(),
                  "potentiation": self.potentiation(), "two-clusters": self.two_clusters(),
                  "lake": self.resolved.table(), "lake-motions": self.resolved.recorded(), "untested": self.untested()}
        return {name: table for name, table in found.items() if len(table) > 1}

    def known(self, water):
        return [(one, speed) for one in self.study.subjects(water) if (speed := self.study.speed(one))]

    def speeds(self, water):
        rows = [["creature", "gait", "speed ± error", "starts", "half step", "half spacing", "per beat", "lasts (s)"]
                + (["Re", "Re by the water's viscosity", "St", "St over a larva's", "cavities"] if water == "open-water" else [])]
        for one, speed in self.known(water):
            length = self.study.length(one.creature)
            changes = ["–" if math.isnan(change) else f"{change / length:+.2f}" for change in (speed.half_step, speed.half_spacing)]
            rows.append([str(one.creature), one.label, with_error(speed.mean / length, speed.error / length), error_text(speed.scatter / length),
                         *changes, fixed(speed.mean / length / one.gait["frequency"]), f"{self.study.lasted(one).mean:.1f}"])
            if water == "open-water":
                rows[-1] += ["–" if number is None else fixed(number, digits) for number, digits in zip(self.numbers(one), (0, 0, 2, 2, 2))]
        return rows

    def numbers(self, subject):
        """Of what may swim in open water: Re by the viscosity that is set and by the water's, St, that over a larva's at the latter Re, and cavities."""
        given = plan.PARAMETERS["kinematic viscosity"][1]["open-water"][0]
        names = ("reynolds", "strouhal", "cavities")
        re, st, cavities = ((self.study.number(subject, name) for name in names) if self.study.may_swim(subject) else (None,) * 3)
        if re is None or st is None:
            return [None] * 5
        own = re * given / study.water_viscosity(given)
        return [re, own, st, st / study.larva(own), cavities]

    def verdicts(self, water):
        return [["creature", "gait", "verdict"]] + [[str(one.creature), one.label, " ".join(verdict)] for one in self.study.subjects(water)
                                                    if (verdict := self.study.verdict(one))]

    def controls(self, water):
        conditions = ("resting", "vacuum", "no-clamp", "mirrored", "other-water")
        rows = [["creature", "gait", *(one.replace("-", " ") for one in conditions), "on the processor", "under water"]]
        for one, _ in self.known(water):
            length, under = self.study.length(one.creature), self.study.under_water(one)
            rows.append([str(one.creature), one.label] + [fixed(self.study.means(one, condition).mean / length) if condition in plan.CONDITIONS[water]
                                                          else "–" for condition in conditions]
                        + [fixed(self.study.on_processor(one).mean / length), "–" if under is None else percent(under)])
        return rows

    def agreement(self):
        """What each seed found: how much depends on the chance of an evolution."""
        seeds = sorted({one.seed for one in self.study.evolved()})
        rows = [["creature", "water", *(f"seed {seed}" for seed in seeds), "apart", "agree"]]
        for water in WATERS:
            for creature in self.study.size.creatures:
                speeds = {one.seed: speed for one in self.study.evolved(water, creature) if (speed := self.study.speed(one))}
                if len(speeds) > 1:
                    length, means = self.study.length(creature), [one.mean for one in speeds.values()]
                    samples = [self.study.means(one, "water") for one in self.study.evolved(water, creature)]
                    apart, freedom = max(means) - min(means), sum(one.count - 1 for one in samples)
                    chance = stats.studentized_range.ppf(0.95, len(samples), freedom) * math.sqrt(statistics.fmean(one.error**2 for one in samples))
                    rows.append([str(creature), WORDS[water], *(with_error(speeds[seed].mean / length, speeds[seed].error / length) if seed in speeds
                                                                else "–" for seed in seeds), fixed(apart / length),
                                 "✔" if apart <= chance else "✘"])
        return rows

    def gait_table(self):
        rows = [["creature", "water", "gait", "f (1/s)", "a", "φ", "on a bound"]]
        for one in [one for water in WATERS for one in self.study.subjects(water) if one.seed or water == "flex"]:
            frequency, amplitudes = one.gait["frequency"], one.gait["amplitude"]
            on = ["f"] if min(frequency - 0.5, 2 - frequency) < BOUND * 1.5 else []
            count = sum(min(a, 1 - a) < BOUND for a in amplitudes)
            on += [f"{count} of {len(amplitudes)} a"] if count else []
            rows.append([str(one.creature), WORDS[one.water], one.label, fixed(frequency, 4),
                         *(" ".join(f"{value:.3f}" for value in values) for values in (amplitudes, one.gait["phase"])), ", ".join(on) or "–"])
        return rows

    def claim_table(self):
        rows = {one.says: {} for one in self.claims}
        for one in self.claims:
            rows[one.says][one.water] = one.outcome
        def sign(outcome):
            return outcome[0] if outcome in ("✔ holds", "✘ does not hold", "– open") else outcome
        return [["the thesis says", "in flex", "in open water"]] + [[says, *(sign(row.get(water, "")) for water in WATERS)] for says, row in rows.items()]

    def claim_numbers(self):
        return [["the thesis says", "water", "what was measured", "holds"]] + [[one.says, WORDS[one.water], one.measured, one.outcome]
                                                                               for one in self.claims]

    def beside_flex(self):
        """Published gaits beside the published speeds and beside Flex 1.2.0, which ran five times where it has a deviation, else once."""
        rows = [["gait", "setting", "thesis", "Flex 1.2.0", "flex", "difference", "agrees by"]]
        for gait in self.gaits:
            for setting, condition in (("fluid", "water"), ("fluid-inverse-mass", "inverse-mass"), ("vacuum", "vacuum")):
                ours = self.study.means(plan.subject_of(gait, "flex"), condition)
                theirs = next((Sample(5 if one.get("deviation") is not None else 1, one["mean"], one.get("deviation") or math.nan)
                               for one in gait["flex"] if one["setting"] == setting), Sample(0, math.nan, math.nan))
                published = (gait.get("published") or {}).get({"fluid": "speed", "vacuum": "vacuumSpeed"}.get(setting), math.nan)
                if not ours.count or not theirs.count and math.isnan(published):
                    continue
                difference, spread = ours.mean - theirs.mean, math.hypot(ours.error, theirs.error)
                told, agrees = "–", "–"
                if theirs.count:
                    told = f"{abs(difference) / spread:.1f}" if theirs.count > 1 else f"{difference:+.4f}"
                    # Where nothing scatters, as in vacuum, a difference of rounding remains.
                    agrees = "✔ standard errors" if theirs.count > 1 and abs(difference) <= 3 * spread else \
                        "✔ less than 0.005" if abs(difference) <= 0.005 else "✘ no"
                rows.append([f"{gait['creature']}, {gait['about']}", setting, fixed(published, 4), text(theirs), text(ours), told, agrees])
        return rows

    def decisive(self):
        """What decides the published gaits' speed in flex; parameters were changed of one of them only."""
        rows = [["gait", "as stated", "no friction", "no acceleration clamp", "no damping", "no viscosity", "inverse mass linear"]]
        for one in self.plan.published("flex"):
            without = {name: text(self.study.sample(self.plan.parameter(one, name, 0), lambda run: run["distance"] / self.study.duration))
                       for name in ("friction", "damping", "viscosity")}
            as_is, no_clamp, inverse = (text(self.study.means(one, condition)) for condition in ("water", "no-clamp", "inverse-mass"))
            rows.append([f"{one.creature}, {one.about}", as_is, without["friction"], no_clamp, without["damping"], without["viscosity"], inverse])
        return rows

    def recorded(self):
        """(creature, from, recorded runs)."""
        for water in WATERS:
            for one in self.study.subjects(water):
                yield str(one.creature), f"{one.label}, {WORDS[water]}", self.study.moves(one)
                if water == "flex" and not one.seed:
                    yield str(one.creature), f"{one.label}, flex, inverse mass linear", self.study.motions_of(self.plan.of(one, "inverse-mass"))

    def fish(self, fits, with_published):
        """Table 3.2: e against real fish."""
        rows = [["creature", "from", *FISH, "none", "x_l/L", "like"]]
        for gait in self.gaits if with_published else []:
            published = gait.get("published")
            if published:
                rows.append([str(gait["creature"]), "published", *(fixed(e, 4) for e in published["errors"]), "–", "–", "–"])
            for one in gait["flex"]:
                if one.get("errors"):
                    rows.append([str(gait["creature"]) + ("" if published else f", {gait['about']}"), "thesis' gait, Flex 1.2.0"
                                 + (", inverse mass linear" if one["setting"] == "fluid-inverse-mass" else ""),
                                 *(fixed(e, 4) for e in one["errors"]), "–", "–", "–"])
        for creature, source, runs in self.recorded():
            if runs:
                part, like = statistics.fmean(row["measuredPart"] for row in runs), measured.like(runs, fits)
                rows.append([creature, source, *(f"{text(measured.error(runs, fish, fits))}, α {fixed(measured.scale(runs, fish, fits))}"
                                                 for fish in range(3)), fixed(math.sqrt(part) / 3), fixed(part), "none" if like is None else FISH[like]])
        return rows

    def attitudes(self):
        """How the bodies lie at the end of the recorded runs, and how wide their tails swing."""
        rows = [["creature", "from", "roll θ (degrees)", "largest yaw ρ (degrees)", "height y at start → end", "swing (body lengths)"]]
        for creature, source, runs in self.recorded():
            if runs:
                roll, yaw = (Sample.of(map(math.degrees, angles)) for angles in ([row["end"]["roll"] for row in runs],
                                                                                 [row["largestYaw"] for row in runs]))
                start, end = (fixed(statistics.fmean(row["heights"][which] for row in runs)) for which in (0, 1))
                rows.append([creature, source, text(roll, 0), text(yaw, 0), f"{start} → {end}", fixed(statistics.fmean(row["tailSwing"] for row in runs))])
        return rows

    def cell(self, experiment):
        """Mean ± standard deviation along the own heading, and how many runs became unstable."""
        unstable, speed = self.study.unstable(experiment), self.study.forward(experiment)
        return text(speed) if not unstable else (f"{text(speed)}, " if speed.count else "") + f"{unstable} unstable"

    def parameters(self):
        """Thesis 4.1: what each parameter does; the scene's own value is bold."""
        gaits = ["creature 2"] + [f"creature {creature} evolved" for creature in self.plan.potent()]
        rows = [["parameter", "water", "value", *gaits, *(f"{one}, vacuum" for one in gaits)]]
        for name in self.study.size.parameters:
            for water in WATERS:
                for _, own, values, too in (one for one in self.plan.parameters(water) if one[0] == name):
                    subjects = {claims.name(one): one for one in self.study.studied(water)}
                    for value in values:
                        cells = [self.cell(self.plan.parameter(subjects[one], name, value, vacuum)) if one in subjects and (too or not vacuum) else ""
                                 for vacuum in (False, True) for one in gaits]
                        shown = claims.value_text(value)
                        rows.append([name, WORDS[water], f"**{shown}**" if value == own else shown, *cells])
        return rows

    def potentiation(self):
        """Thesis 4.2: u = ((sin + 1)/2)ᵖ·2 − 1 with f = 2, a = 0.8, and Δφ = 0.25 from head to tail, or 1 − Δφ."""
        return [["creature", "water", "p", "Δφ", "1 − Δφ", "vacuum, Δφ", "vacuum, 1 − Δφ"]] + [
            [str(creature), WORDS[water], claims.value_text(power), *(self.cell(self.plan.potentiated(creature, power, step, water, vacuum))
                                                                      for vacuum in (False, True) for step in plan.PHASE_STEPS)]
            for creature in self.plan.potent() for water in WATERS for power in plan.POWERS]

    def two_clusters(self):
        """Thesis 4.3: one actuator across the one joint; the last row has resting muscles."""
        gaits, cell = self.plan.gaits_of_two_clusters(), lambda *asked: self.cell(self.plan.two_clusters(*asked))
        return [["f (1/s)", "a", "flex", "flex, vacuum", "open water", "open water, vacuum"]] + [
            [f"{gait['frequency']:.1f}", f"{gait['amplitude'][0]:.1f}", *(cell(gait, water, setting) for water in WATERS
                                                                          for setting in ("water", "vacuum"))] for gait in gaits] + [
            ["rest", "", cell(gaits[0], "flex", "resting"), "", cell(gaits[0], "open-water", "resting"), ""]]

    # The first screen.

    def swimming(self, subjects):
        judged = [one for one in subjects if self.study.verdict(one)]
        swim = [one for one in judged if self.study.swims_by_every_control(one)]
        ours = swim and len(swim) < len(judged) and all(one.creature in OUR_DRAWINGS for one in swim)
        return f"{len(swim)} of {len(judged)}{' (of bodies drawn by us)' if ours else ''}" if judged else None

    def published(self, water):
        """The thesis' own gaits, without what is made of them here."""
        return [plan.subject_of(one, water) for one in self.gaits if one.get("published")]

    def seconds(self, subject):
        return f"{self.study.lasted(subject).mean:.1f} s"

    def not_converged(self, water):
        changes = [half / base - 1 for base, half in map(self.study.spacings, self.study.evolved(water))]
        known = [abs(one) for one in changes if not math.isnan(one)]
        if not known:
            return f"{len(changes)} of {len(changes)} break a law" if changes else None
        return f"{sum(one > 0.1 for one in known)} of {len(known)} change by more than a tenth"

    def fastest(self, water):
        swimmers = [one for one in self.study.bests(water) if self.study.swims_by_every_control(one)]
        if not swimmers:
            return None
        one = max(swimmers, key=lambda swimmer: self.study.speed(swimmer).mean)
        speed = self.study.speed(one)
        wall = f", until it touches a wall after {self.seconds(one)}" if water == "open-water" and self.study.ends_at_wall(one) else ""
        return f"creature {one.creature} at {with_error(speed.mean, speed.error)} units/s ({fixed(speed.mean / self.study.length(one.creature))} " \
               f"body lengths/s{wall})"

    def without_water(self, water):
        speeds = [abs(one) for subject in self.study.evolved(water) if math.isfinite(one := self.study.means(subject, "vacuum").mean)]
        return f"{fixed(max(speeds))} units/s" if speeds else None

    def answer(self):
        published, evolved, fastest, without, finer = (in_each(one) for one in (
            lambda water: self.swimming(self.published(water)), lambda water: self.swimming(self.study.evolved(water)), self.fastest, self.without_water,
            self.not_converged))
        kept = in_each(lambda water: claims.kept(self.claims, water), "; ")
        if not published:
            return "**Nothing is measured yet.**"
        return " ".join([f"**Of the thesis' gaits {published} swim by every control" + (f". Of the gaits that evolved here {evolved} do." if evolved else ".")
                         + self.resolved.answer() + "**"]
                        + ([f"The fastest that swims is {fastest}."] if fastest else [])
                        + ([f"Without water, where nothing can swim, the evolved gaits move at up to {without}."] if without else [])
                        + ([f"At half the spacing {finer}."] if finer else [])
                        + ["Creatures 3 and 4 are our own drawings; open water is not the thesis', nor are its bodies' masses and stiffness."] + ([f"Of the conclusions that can be tested, {kept}."] if kept else []))

    def made(self):
        """By which programs and on what it evolved."""
        found = [json.loads((one.folder(self.study.folder) / "environment.json").read_text(encoding="utf-8")) for one in self.study.finished()]
        commits = ", ".join(sorted({one.get("commit", "?")[:8] for one in found}))
        machines = ", ".join(sorted({one.get("gpu", "0: a processor").split(": ", 1)[1].split(",")[0] for one in found}))
        return f"Evolved by the program of commit {commits}, on {machines}." if found else ""

    def evidence(self):
        rows = [["creature", "published", "thesis' gait, flex", "thesis' gait, open water", "evolved, flex", "evolved, open water"]]
        for gait in self.gaits:
            published = gait.get("published")
            rows.append([str(gait["creature"]) + ("" if published else f", {gait['about']}"), fixed(published["speed"]) if published else ""]
                        + [self.told(plan.subject_of(gait, water)) for water in WATERS]
                        + [self.told_of_seeds(gait["creature"], water) if published else "" for water in WATERS])
        return rows

    def told(self, subject):
        speed = self.study.speed(subject) if subject else None
        sign = (self.study.verdict(subject) or "–")[0] if speed else ""
        return f"{sign} {with_error(speed.mean, speed.error)}" if speed and sign != "✘" else sign

    def told_of_seeds(self, creature, water):
        seeds = self.swimming(self.study.evolved(water, creature))
        return self.told(self.study.best(creature, water)) + (f" ({seeds})" if seeds else "")

    # What README.md asks for by name.

    def reynolds(self):
        found = [numbers for subject in self.study.subjects("open-water") if (numbers := self.numbers(subject))[0]]
        if not found:
            return ""
        (least, most), (low, high), (first, last) = ((min(values), max(values)) for values in ([one[k] for one in found] for k in (0, 1, 3)))
        return f": what may swim there has Reynolds numbers of {least:.0f} to {most:.0f} by it, {low:.0f} to {high:.0f} by " \
               f"[the water's](../water/README.md), and {fixed(first, 1)} to {fixed(last, 1)} times a larva's Strouhal number"

    def sinking(self):
        runs = [one for creature in self.study.size.creatures for one in self.study.results(self.plan.sinking(creature))]
        times = sorted(one["simulated"] for one in runs if one["stopped"] == "touched-plane")
        return f"{len(times)} of {len(runs)} runs of its gaits there lie on the floor" + (
            f" after {fixed(times[0])} to {fixed(times[-1])} s" if times else "")

    def evolutions(self):
        """One sentence for each way in which evolution searched."""
        alike = {}
        for one in self.study.finished():
            config = self.study.read(one, "config.json")
            alike.setdefault((one.water, config["population"], config.get("duration") or plan.SECONDS), []).append((one.creature, config["generations"]))
        return " ".join(
            f"In {WORDS[water]} {len(found)} evolutions of creature{'s' if len({one for one, _ in found}) > 1 else ''} "
            f"{listed(sorted({one for one, _ in found}))}: {population} chromosomes over {spread([count for _, count in found])} generations, "
            f"{duration:g} s a run." for (water, population, duration), found in alike.items()) or "No evolution is finished."

    def lake(self):
        """What evolved in finer water, beside the others."""
        rows = [["creature", "flex", "open water", "lattice", "half step, half cells", "body lengths/s", "Re, St (over a larva's)", "like, by our rule", "vorticity at tail, behind"]]
        for name, motion in self.resolved.motions.items():
            one, creature = self.resolved.best(name), int(name[-1])
            speed, (re, st) = self.resolved.speeds(one), self.resolved.numbers(one)
            swim = [self.resolved.verdict((name, seed))[0] == "✔" for seed in self.resolved.seeds(name)]
            rows.append([str(creature), *(self.told(self.study.best(creature, water)) for water in WATERS),
                         f"{self.resolved.verdict(one)[0]} {with_error(speed.mean, speed.interval)} ({sum(swim)} of {len(swim)})",
                         ", ".join(f"{100 * self.resolved.change(one, condition):+.0f} %" for condition in ("half step", "half cells")),
                         fixed(speed.mean / motion["bodyLength"]), f"{re:.0f}, {fixed(st, 1)} ({fixed(st / study.larva(re), 1)})",
                         ", ".join(self.resolved.like(motion)), ", ".join(fixed(motion["wake"][place], 1) for place in ("tail", "behind"))])
        return rows

    def lake_cost(self):
        evaluations, generations, seconds, commits, machines = self.resolved.cost(self.study.folder)
        return f"{len(generations)} evolutions over {spread(generations)} generations after the random one, {evaluations} evaluations in {seconds} s of one {machines}, by commit {commits}." \
            if generations else ""

    def scale(self):
        logs = (self.study.measurements, self.study.processor, self.study.convergence, self.study.motions)
        backends = sorted({row["backend"] for row in self.study.measurements.rows.values()})
        programs = {row["program"] for log in logs for row in log.rows.values()}
        counts = [len(log.rows) for log in logs]
        return f"{len(self.study.finished())} of {len(self.plan.evolutions)} evolutions are finished. {counts[0]} evaluations on {', '.join(backends)} " \
               f"(`measurements.jsonl.gz`), {counts[1]} of them again on the processor (`processor.jsonl`), {counts[2]} gaits at half the spacing " \
               f"(`convergence.jsonl`) and {counts[3]} recorded motions (`motions.jsonl`), by {len(programs)} builds of the native program, " \
               "which every row names by its SHA-256."

    def write(self, pictures):
        """Text of the page: that of README.md, with what a method says, a table or pictures between <!-- NAME --> and <!-- /NAME -->."""
        def value(match):
            name, break_after = match.groups()
            found = pictures[name] if name in pictures else getattr(self, name)()
            return f"<!-- {name} -->{break_after}{markdown(found) if isinstance(found, list) else found}{break_after}<!-- /{name} -->"
        return re.sub(r"<!-- (\w+) -->(\n?).*?<!-- /\1 -->", value, (plan.HERE / "README.md").read_text(encoding="utf-8"), flags=re.DOTALL)

    def untested(self):
        return [["the thesis says", "why it is not tested"], *map(list, claims.UNTESTED)]


def in_each(of, between=" and "):
    """What is said of each water, where there is something; once, if it is the same in all."""
    told = [of(water) for water in WATERS]
    if told[0] and len(set(told)) == 1:
        return f"{told[0]} in both waters"
    return between.join(f"{one} in {'`flex`' if water == 'flex' else WORDS[water]}" for water, one in zip(WATERS, told) if one)


def listed(numbers):
    *most, last = map(str, numbers)
    return f"{', '.join(most)} and {last}" if most else last


def spread(numbers):
    return str(min(numbers)) if min(numbers) == max(numbers) else f"{min(numbers)} to {max(numbers)}"


def markdown(rows):
    if len(rows) < 2:
        return "Nothing is measured yet."
    return study.table(rows[0], rows[1:], "<" * len(rows[0])).rstrip("\n")


def csv_text(rows):
    out = io.StringIO()
    csv.writer(out, lineterminator="\n").writerows(rows)
    return out.getvalue()
