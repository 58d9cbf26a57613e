"""The schemas of sim-native/protocol, and validators of them."""

import json
from pathlib import Path

from jsonschema import Draft202012Validator
from referencing import Registry, Resource

ROOT = Path(__file__).resolve().parents[2]
FILES = {path.name: json.loads(path.read_text()) for path in sorted((ROOT / "sim-native/protocol").glob("*.schema.json"))}
REGISTRY = Registry().with_resources((schema["$id"], Resource.from_contents(schema)) for schema in FILES.values())


def validator(reference):
    """Of a schema by its file's name, or of a part of it: stream.schema.json#/$defs/senses."""
    return Draft202012Validator({"$ref": "https://natator.io/protocol/" + reference}, registry=REGISTRY)
