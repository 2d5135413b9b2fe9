#!/usr/bin/python3
"""Fails if a JSON file does not conform to a schema, or if the schema would accept an unknown member.

    check_json.py SCHEMA FILE

Also fails where the schema itself lacks a description of a field or the unit of a number. Needs jsonschema (Debian:
python3-jsonschema).
"""
import copy
import json
import sys

from jsonschema import Draft202012Validator


def undocumented(schema, where=""):
    """Members of the schema without a description, and numbers without a unit."""
    if isinstance(schema, list):
        for item in schema:
            yield from undocumented(item, where)
    if not isinstance(schema, dict):
        return
    for name, field in schema.get("properties", {}).items():
        if "description" not in field:
            yield f"{where}/{name}: no description"
    types = schema.get("type", [])
    if {"number", "integer"} & set([types] if isinstance(types, str) else types) and "unit" not in schema:
        yield f"{where}: no unit"
    for key, value in schema.items():
        children = value.items() if key in ("properties", "$defs") else [("", value)]
        for name, child in children:
            yield from undocumented(child, f"{where}/{name}" if name else where)


def objects(document, where=()):
    """Path of one object of every kind; of a list, only one element counts."""
    if isinstance(document, dict):
        yield where
        for key, value in document.items():
            yield from objects(value, (*where, key))
    elif isinstance(document, list) and document:
        yield from objects(document[0], (*where, 0))


def with_unknown_field(document, path):
    changed = copy.deepcopy(document)
    place = changed
    for key in path:
        place = place[key]
    place["unknown_field"] = []
    return changed


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    schema, document = (json.load(open(path, encoding="utf-8")) for path in sys.argv[1:])
    Draft202012Validator.check_schema(schema)
    validator = Draft202012Validator(schema)
    troubles = list(undocumented(schema))
    troubles += [f"{'/'.join(map(str, e.absolute_path))}: {e.message}" for e in validator.iter_errors(document)]
    troubles += [f"{'/'.join(map(str, path))}: an unknown field passes" for path in objects(document)
                 if validator.is_valid(with_unknown_field(document, path))]
    if troubles:
        sys.exit("\n".join(troubles))


if __name__ == "__main__":
    main()
