"""Seeded mutation of JSON documents and of their text, and the bounds that keep a case cheap."""
import copy
import json

NUMBERS = [0, -0.0, 1, -1, 2, 3, 7, 0.5, -1e-17, 1e-9, 1e-30, 1e-310, 1e9, 1e38, -1e38, 3.5e38, 1e39, 1e300, 2**31 - 1, 2**31,
           -2**31, 2**53, 2**63, 2**64, 1000, 1001, 4096, 4097, 60, 61]
OTHERS = [None, True, False, "", "x", "thesis/creature-1", "../x", "\u0000", "é\ud83d\ude00", [], {}, [[]], [0, 0, 0], [1], {"x": 1}]
BYTES = ["\x00", "\x7f", "{", "}", "[", "]", ",", ":", '"', "\\", "\\u0000", "\\ud800", "-", "1e999", "-1e999", "NaN", "Infinity",
         "0x1", "1.", "01", "null", "true", "[" * 40, "é", "\ufeff", "//", "\t", " ", "\udcff", "\udcc3"]


def places(value, path=()):
    """The paths of all values inside."""
    yield path
    inside = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, one in inside:
        yield from places(one, path + (key,))


def at(value, path):
    for key in path:
        value = value[key]
    return value


def new_value(random, old):
    """Something else in the place of a value: most often one of the same kind."""
    if isinstance(old, (int, float)) and not isinstance(old, bool) and random.random() < 0.85:
        way = random.randrange(5)
        if way == 0:
            return random.choice(NUMBERS)
        if way == 1:
            return old * random.choice([-1, 0.5, 2, 10, 0.01, 1.001])
        if way == 2:
            return old + random.choice([-1, 1, 0.5])
        if way == 3:
            return random.uniform(-2, 2)
        return random.randrange(0, 20)
    return copy.deepcopy(random.choice(OTHERS if random.random() < 0.7 else NUMBERS))


def mutate(random, document, keys):
    """A copy with one to four changes; `keys` are names that may be added, with a value each."""
    document = copy.deepcopy(document)
    for _ in range(random.choice([1, 1, 1, 2, 2, 3, 4])):
        path = random.choice(list(places(document)))
        if not path:
            continue
        parent, key, way = at(document, path[:-1]), path[-1], random.random()
        if way < 0.6:
            parent[key] = new_value(random, parent[key])
        elif way < 0.7:
            del parent[key]
        elif way < 0.8 and isinstance(parent, list):
            parent.insert(key, copy.deepcopy(parent[key]))
        elif isinstance(parent, dict):
            name, value = random.choice(keys)
            parent[name] = value if random.random() < 0.5 else new_value(random, value)
    return document


def mutate_text(random, text):
    """Damages the text itself: now and then, since most of what comes out is refused at once."""
    for _ in range(random.choice([1, 1, 2, 5])):
        a = random.randrange(len(text) + 1)
        b = min(len(text), a + random.choice([0, 0, 1, 1, 5, 50]))
        text = text[:a] + random.choice(BYTES + ["", text[a:b] * 2]) + text[b:]
    return text


def mutate_arguments(random, arguments):
    """One argument more, less, twice or elsewhere; the first, which names the command, stays."""
    arguments, at = list(arguments), random.randrange(1, len(arguments))
    way = random.randrange(4)
    if way == 0:
        del arguments[at]
    elif way == 1:
        arguments.insert(at, arguments[at])
    elif way == 2:
        arguments.insert(random.randrange(1, len(arguments)), arguments.pop(at))
    else:
        arguments.insert(at, random.choice(["", "-", "--", "-x", "--no-such", "--help", "--duration=0.02", "x", "é", "--at"]))
    return arguments


# What a case may cost at most, by key, where the simulator would rightly take its time.
MOST = {"duration": 0.05, "substeps": 4, "numIterations": 8, "updates": 3, "maximum": 3, "frames": 3}
LEAST = {"timeStep": 0.005}


def cheap(value):
    """Cuts legal settings that only take long; what is beyond the simulator's own limits stays, to be refused."""
    if isinstance(value, list):
        return [cheap(one) for one in value]
    if not isinstance(value, dict):
        return value
    out = {}
    for key, one in value.items():
        if isinstance(one, (int, float)) and not isinstance(one, bool):
            if key in MOST and MOST[key] < one <= 10**6:
                one = MOST[key]
            if key in LEAST and 0 < one < LEAST[key]:
                one = LEAST[key]
        out[key] = cheap(one)
    return out


def dump(value):
    return json.dumps(value, ensure_ascii=False, separators=(",", ":"))
