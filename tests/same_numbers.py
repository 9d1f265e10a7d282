#!/usr/bin/env python3
"""Two folders of results hold the same numbers: every record but for timings and versions, every table but for those of times,
every picture of a run, byte for byte.

usage: tests/same_numbers.py RESULTS OTHER-RESULTS
"""

import json
import sys
from pathlib import Path


def contents(results: Path) -> dict[str, object]:
    """What must be the same, by name."""
    found: dict[str, object] = {}
    for path in sorted(results.glob("*/*.json")):
        record = json.loads(path.read_text())
        if not {"experiment", "run", "timings", "versions"} <= record.keys():
            continue
        # Runs are told apart by their configs, for the names of runs and pictures may be made otherwise.
        run = f"{path.parent.name} {json.dumps(record['config'], sort_keys=True)}"
        for i, name in enumerate(record["pictures"]):
            found[f"{run}, picture {i}"] = (results / "figures" / name).read_bytes()
        del record["timings"], record["versions"], record["run"], record["pictures"]
        # As text, for a NaN is no more itself than -0 is 0.
        found[run] = json.dumps(record, sort_keys=True)
    for path in results.glob("*/table.md"):
        found[str(path.relative_to(results))] = path.read_bytes()
    return found


def main() -> None:
    one, two = (contents(Path(folder)) for folder in sys.argv[1:])
    different = sorted(name for name in one.keys() | two.keys() if one.get(name) != two.get(name))
    for name in different[:20]:
        missing = [folder for folder, found in zip(sys.argv[1:], (one, two)) if name not in found]
        print(f"{name}: " + (f"not in {missing[0]}" if missing else "differs"))
    records = sum(name.endswith("}") for name in one)
    print(f"{records} records, {len(one) - records} tables and pictures, {len(different)} different")
    if different or records == 0:
        sys.exit(1)


main()
