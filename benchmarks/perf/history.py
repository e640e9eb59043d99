"""What the gate has found so far: a file to which each run appends a line, and a page that draws it.

A line is a JSON object: date (UTC), base and head (commits), verdict, and rows: check, what, base, head, change, verdict, as the
gate's table has them. Lines are only ever appended, so that two branches of a file can be merged by their union."""
import datetime
import html
import json
import re

WIDTH, HEIGHT, MARGIN = 560, 120, 8
STYLE = """:root { color-scheme: light dark; --line: #0072b2; --bad: #d55e00; --faint: #8884; }
body { font: 16px/1.5 system-ui, sans-serif; max-width: 70rem; margin: 2rem auto; padding: 0 1rem; }
figure { margin: 0; } figcaption { font-weight: 600; } .charts { display: grid; gap: 1.5rem; grid-template-columns: repeat(auto-fit, minmax(20rem, 1fr)); }
svg { width: 100%; height: auto; background: var(--faint); border-radius: .4rem; } polyline { fill: none; stroke: var(--line); stroke-width: 2; }
circle { fill: var(--line); } circle.FAIL { fill: var(--bad); } table { border-collapse: collapse; } td, th { padding: .2rem .8rem .2rem 0; text-align: left; }
.FAIL { color: var(--bad); } code { font-size: .9em; }"""


def entry(base, head, rows, verdict, now=None):
    now = now or datetime.datetime.now(datetime.timezone.utc)
    return {"date": now.strftime("%Y-%m-%dT%H:%M:%SZ"), "base": base, "head": head, "verdict": verdict,
            "rows": [vars(row) for row in rows]}


def append(path, line):
    with open(path, "a", encoding="utf-8") as file:
        file.write(json.dumps(line) + "\n")


def read(path):
    """Raises ValueError with the line's number."""
    entries = []
    for number, text in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        try:
            found = json.loads(text)
            entries.append({key: found[key] for key in ("date", "base", "head", "verdict", "rows")})
        except (json.JSONDecodeError, KeyError, TypeError) as error:
            raise ValueError(f"{path}:{number}: no line of perf-gate --history: {error}") from None
    return sorted(entries, key=lambda e: e["date"])


def ratio_of(change):
    """1.02 of "+2.00 %"; None of other texts."""
    found = re.match(r"([-+]?[0-9.]+) %", change)
    return 1 + float(found[1]) / 100 if found else None


def series_of(entries):
    """By (check, what): a list of (entry, ratio to the base, verdict). Counts have no ratio; they are equal or the gate fails."""
    series = {}
    for e in entries:
        for row in e["rows"]:
            ratio = ratio_of(row["change"])
            if ratio is not None:
                series.setdefault((row["check"], row["what"]), []).append((e, ratio, row["verdict"]))
    return series


def chart(name, points):
    """The product of the ratios so far: speed relative to the first base, as each head is a later base."""
    level, levels = 1, []
    for _, ratio, _ in points:
        level *= ratio
        levels.append(level)
    low, high = min(levels + [1]), max(levels + [1])
    spread = high - low or 1
    step = (WIDTH - 2 * MARGIN) / max(len(levels) - 1, 1)
    places = [(MARGIN + i * step, HEIGHT - MARGIN - (y - low) / spread * (HEIGHT - 2 * MARGIN)) for i, y in enumerate(levels)]
    line = " ".join(f"{x:.1f},{y:.1f}" for x, y in places)
    dots = "".join(f'<circle class="{html.escape(verdict)}" cx="{x:.1f}" cy="{y:.1f}" r="4"><title>{html.escape(e["date"])} '
                   f'{html.escape(e["head"][:10])}: {100 * (ratio - 1):+.2f} %</title></circle>'
                   for (x, y), (e, ratio, verdict) in zip(places, points))
    return (f'<figure><figcaption>{html.escape(": ".join(name))}</figcaption><svg viewBox="0 0 {WIDTH} {HEIGHT}" role="img" '
            f'aria-label="{html.escape(name[1])}: from {levels[0]:.3f} to {levels[-1]:.3f}"><polyline points="{line}"/>{dots}</svg>'
            f"{low:.3f} to {high:.3f} times the first base</figure>")


def page(entries):
    runs = "".join(f'<tr class="{html.escape(e["verdict"])}"><td>{html.escape(e["date"])}</td><td><code>{html.escape(e["base"][:10])}'
                   f'</code></td><td><code>{html.escape(e["head"][:10])}</code></td><td>{html.escape(e["verdict"])}</td></tr>'
                   for e in reversed(entries))
    charts = "".join(chart(name, points) for name, points in sorted(series_of(entries).items()))
    return (f'<!doctype html><html lang="en"><meta charset="utf-8"><meta name="viewport" content="width=device-width">'
            f"<title>perf-gate</title><style>{STYLE}</style><h1>What the performance gate has found</h1>"
            f'<div class="charts">{charts}</div><h2>Runs</h2><table><tr><th>date<th>base<th>head<th>verdict</tr>{runs}</table></html>\n')
