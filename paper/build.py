#!/usr/bin/env python3
"""Builds the paper from the records of `riemap reproduce`.

usage: paper/build.py [--results DIR] [--timings DIR] [--output FILE.pdf] [--pages]

Every number of the text is read while it is built, from DIR/NAME/records.jsonl of the results (by default results/) and from
DIR/NAME.jsonl of the timings (by default paper/timings/). A number that is missing ends the build with its name, and numbers
that are typed into the text are refused. Timings differ from run to run, so that `riemap reproduce` keeps them in files that
are not committed; those of the paper are copies: cp results/cost/timings.jsonl paper/timings/cost.jsonl. Needs Python 3 with venv and, once, the network (PyPI): Typst goes
into an environment under target/.
"""

import argparse
import json
import os
import re
import subprocess
import sys
import venv
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent
SOURCE = HERE / "riemap.typ"
PAGES = range(6, 11)


def environment():
    """Restarts this script under a Python that has the pinned Typst."""
    requirements = HERE / "requirements.txt"
    folder = ROOT / "target" / "paper-venv"
    python = folder / "bin" / "python"
    stamp = folder / "installed.txt"
    if not stamp.is_file() or stamp.read_text() != requirements.read_text():
        venv.EnvBuilder(with_pip=True, clear=True).create(folder)
        command = [python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", "-r", requirements]
        subprocess.run(command, check=True)
        stamp.write_text(requirements.read_text())
    if Path(sys.prefix) != folder:
        os.execv(python, [str(python), str(Path(__file__).resolve()), *sys.argv[1:]])


def lines(path):
    """The values of a file with one JSON text a line; none where there is no file."""
    return [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines()] if path.is_file() else []


def gathered(results, timings):
    """{experiment: [record, ...]} of all records in a folder of results, with the timings that a folder of timings has."""
    records = {}
    for path in sorted(results.glob("*/records.jsonl")):
        experiment = path.parent.name
        seconds = {line["run"]: line["timings"] for line in lines(timings / f"{experiment}.jsonl")}
        for record in lines(path):
            if record["outcome"] != "failed":
                record["timings"] = seconds.get(record["run"], {})
                records.setdefault(experiment, []).append(record)
    if not records:
        sys.exit(f"{results}: no records; make them with `riemap reproduce --results {results}`")
    return records


def without_calls(text):
    """The text less `#name(...)` and `#name[...]`'s names: what is left was typed."""
    out, i = [], 0
    while i < len(text):
        call = re.match(r"#(let|import|show|set)\b[^\n]*|#[a-zA-Z][\w.-]*", text[i:])
        if not call:
            out.append(text[i])
            i += 1
            continue
        i += call.end()
        while i < len(text) and text[i] == "(":
            depth, quoted = 0, False
            while i < len(text):
                c = text[i]
                if c == '"' and text[i - 1] != "\\":
                    quoted = not quoted
                depth += 0 if quoted else (c == "(") - (c == ")")
                i += 1
                if depth == 0 and not quoted:
                    break
    return "".join(out)


def captions(text):
    """The contents of `caption: [...]`: text within a call."""
    for match in re.finditer(r"caption: \[", text):
        depth, end = 1, match.end()
        while depth and end < len(text):
            depth += (text[end] == "[") - (text[end] == "]")
            end += 1
        yield text[match.end() : end - 1]


# Numbers that are no results: of mathematics, of definitions, of names.
ALLOWED = re.compile(
    r"""^(?:
        [0-9]                   # small whole numbers: orders, powers, indices, counts of equations
      | (?:19|20)\d\d           # years
    )$""",
    re.VERBOSE,
)


def typed_numbers(source):
    """Numbers in the running text that are not read from records, with their lines."""
    found = []
    text = re.sub(r"(?<!:)//[^\n]*", "", source)
    # What comes before is layout and questions to the records.
    text = text[text.find("*Abstract.*") :]
    prose = without_calls("\n".join([text, *captions(text)]))
    # References, code, indices of formulas, sections of other papers.
    prose = re.sub(r"@[\w:.-]+|<[\w:.-]+>|`[^`]*`|https?://\S+|_\(\d+\)|sections? \d\.\d", " ", prose)
    for match in re.finditer(r"(?<![\w.])\d+(?:[.,]\d+)*(?![\w])", prose):
        if not ALLOWED.match(match.group()):
            context = " ".join(prose[max(0, match.start() - 40) : match.end() + 20].split())
            found.append(f"{match.group()} in «{context}»")
    return found


def main():
    environment()
    import typst

    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--results", type=Path, default=ROOT / "results")
    parser.add_argument("--timings", type=Path, default=HERE / "timings")
    parser.add_argument("--output", type=Path, default=ROOT / "target" / "paper" / "riemap.pdf")
    parser.add_argument("--pages", action="store_true", help="write the pages as PNG beside the PDF, too")
    arguments = parser.parse_args()
    results, output = arguments.results.resolve(), arguments.output.resolve()

    typed = typed_numbers(SOURCE.read_text(encoding="utf-8"))
    if typed:
        sys.exit("numbers typed into the text; read them from records:\n  " + "\n  ".join(typed))

    output.parent.mkdir(parents=True, exist_ok=True)
    records = output.parent / "records.json"
    records.write_text(json.dumps(gathered(results, arguments.timings)), encoding="utf-8")
    inputs = {
        "records": str(records),
        "figures": str(results / "figures"),
        "provenance": str(results / "provenance.json"),
    }
    # The lettering of the figures.
    fonts = [ROOT / "src" / "figure" / "font"]
    common = {"root": "/", "sys_inputs": inputs, "font_paths": fonts}
    try:
        pdf = typst.compile(SOURCE, **common)
        pages = json.loads(typst.query(SOURCE, "<pages>", field="value", one=True, **common))
    except typst.TypstError as error:
        # A panic of data.typ says which record or value is missing.
        sys.exit(f"the paper does not build: {error.message}\n" + "\n".join(error.hints))
    temporary = output.with_suffix(".part")
    temporary.write_bytes(pdf)
    temporary.replace(output)
    if arguments.pages:
        typst.compile(SOURCE, output=output.parent / "page-{n}.png", ppi=110, **common)
    print(f"{output}: {pages} pages from the records of {results}")
    if pages not in PAGES:
        sys.exit(f"{pages} pages: a paper of {PAGES.start} to {PAGES.stop - 1} was promised")


if __name__ == "__main__":
    main()
