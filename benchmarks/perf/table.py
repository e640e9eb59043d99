"""Verdicts and the table that shows them."""
import dataclasses

OK, FAIL, REPORTED, NOT_COMPARABLE = "ok", "FAIL", "reported", "not comparable"


@dataclasses.dataclass
class Row:
    check: str
    what: str
    base: str
    head: str
    change: str
    verdict: str


def percent(ratio):
    return f"{100 * (ratio - 1):+.2f} %"


def failed(rows):
    return any(row.verdict == FAIL for row in rows)


def markdown(rows):
    cells = [["check", "what", "base", "head", "change", "verdict"]]
    cells += [[text.replace("|", "\\|") for text in dataclasses.astuple(row)] for row in rows]
    widths = [max(len(line[i]) for line in cells) for i in range(len(cells[0]))]
    cells.insert(1, ["-" * width for width in widths])
    return "\n".join("| " + " | ".join(text.ljust(width) for text, width in zip(line, widths)) + " |" for line in cells)
