#!/usr/bin/env python3
"""The JSON Schema of manifests agrees with the table tests/fixtures/manifests.json, which the parser's test goes by, too;
all shipped manifests satisfy it: plugin_schema_test.py SOURCE_FOLDER"""

import json
import pathlib
import sys

import jsonschema

tree = pathlib.Path(sys.argv[1])
schema = json.loads((tree / "sdk/share/plugin.schema.json").read_text())
jsonschema.Draft202012Validator.check_schema(schema)
validator = jsonschema.Draft202012Validator(schema)
problems = []

table = json.loads((tree / "tests/fixtures/manifests.json").read_text())
for case in table["cases"]:
    manifest = {**table["base"], **case.get("with", {})}
    for field in case.get("without", []):
        del manifest[field]
    valid = validator.is_valid(manifest)
    if valid != (case["verdict"] == "good"):
        problems.append(f"{case['name']}: the schema {'accepts' if valid else 'refuses'} what is {case['verdict']}")

shipped = [f for folder in ("plugins", "examples") for f in sorted((tree / folder).rglob("plugin.json"))
           if not {"build"} & set(f.relative_to(tree).parts)]
if len(shipped) < 10:
    problems.append(f"only {len(shipped)} shipped manifests found")
for file in shipped:
    for error in validator.iter_errors(json.loads(file.read_text())):
        problems.append(f"{file.relative_to(tree)}: {error.json_path}: {error.message}")

print("\n".join(problems) or f"{len(table['cases'])} cases and {len(shipped)} shipped manifests agree with the schema")
sys.exit(1 if problems else 0)
