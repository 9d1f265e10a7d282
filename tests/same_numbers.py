#!/usr/bin/env python3
"""Compares two folders of results.

usage: tests/same_numbers.py RESULTS OTHER-RESULTS            the same records, tables and pictures of runs, byte for byte
       tests/same_numbers.py --close RESULTS OTHER-RESULTS    the same records up to rounding, of the runs that both have

On another platform floating-point numbers are rounded otherwise. Numbers are close if they differ by at most 1e-6 relative to
the larger or by 1e-9.
"""

import json
import sys
from pathlib import Path


def records(results: Path) -> dict[str, dict]:
    """Records by experiment and config: names of runs and pictures may be made otherwise."""
    found = {}
    for path in sorted(results.glob("*/records.jsonl")):
        for line in path.read_text().splitlines():
            record = json.loads(line)
            found[f"{path.parent.name} {json.dumps(record['config'], sort_keys=True)}"] = record
    return found


def contents(results: Path) -> dict[str, object]:
    """What must be the same, by name."""
    found: dict[str, object] = {}
    for run, record in records(results).items():
        for i, name in enumerate(record["pictures"]):
            found[f"{run}, picture {i}"] = (results / "figures" / name).read_bytes()
        # As text, for a NaN is no more itself than -0 is 0.
        found[run] = json.dumps({key: record[key] for key in record.keys() - {"run", "pictures"}}, sort_keys=True)
    for path in results.glob("*/table.md"):
        found[str(path.relative_to(results))] = path.read_bytes()
    return found


def same(results: Path, other: Path) -> bool:
    one, two = contents(results), contents(other)
    different = sorted(name for name in one.keys() | two.keys() if one.get(name) != two.get(name))
    for name in different[:20]:
        missing = [folder for folder, found in ((results, one), (other, two)) if name not in found]
        print(f"{name}: " + (f"not in {missing[0]}" if missing else "differs"))
    count = sum(name.endswith("}") for name in one)
    print(f"{count} records, {len(one) - count} tables and pictures, {len(different)} different")
    return not different and count > 0


def apart(a: object, b: object, key: str):
    """The dotted keys at which two values differ by more than rounding."""
    if isinstance(a, dict) and isinstance(b, dict):
        for name in sorted(a.keys() | b.keys()):
            yield from apart(a.get(name), b.get(name), f"{key}.{name}")
    elif isinstance(a, list) and isinstance(b, list) and len(a) == len(b):
        for i, (x, y) in enumerate(zip(a, b)):
            yield from apart(x, y, f"{key}.{i}")
    elif isinstance(a, (int, float)) and isinstance(b, (int, float)):
        if abs(a - b) > 1e-9 + 1e-6 * max(abs(a), abs(b)):
            yield f"{key}: {a} and {b}"
    elif a != b:
        yield f"{key}: {a} and {b}"


def close(results: Path, other: Path) -> bool:
    one, two = records(results), records(other)
    both = sorted(one.keys() & two.keys())
    equal = [run for run in both if one[run]["result"] == two[run]["result"]]
    far = {run: list(apart(one[run]["result"], two[run]["result"], "result")) for run in both}
    far = {run: keys for run, keys in far.items() if keys}
    for run, keys in list(far.items())[:20]:
        print(f"{run}: {keys[0]}" + (f" (and {len(keys) - 1} more)" if len(keys) > 1 else ""))
    for folder in (results, other):
        provenance = json.loads((folder / "provenance.json").read_text())
        print(f"{folder}: riemap {provenance['riemap']} on {provenance['platform']}")
    alone = len(one.keys() ^ two.keys())
    print(f"{len(both)} runs in both, {len(equal)} of them equal bit for bit, {len(far)} apart; {alone} runs in one alone")
    return not far and len(both) > 0


def main() -> None:
    arguments = sys.argv[1:]
    compare = close if "--close" in arguments else same
    one, two = (Path(folder) for folder in arguments if folder != "--close")
    if not compare(one, two):
        sys.exit(1)


main()
