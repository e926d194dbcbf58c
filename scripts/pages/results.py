# SPDX-License-Identifier: GPL-3.0-or-later
"""The committed files of results as tables of an SQLite database. Marks of pages are queries of it:

    text('{:.1f} %', 100 * max(void_cells)) FROM "voids.csv" WHERE fraction = 0.1

`FROM "voids.csv"` reads bench/results/voids.csv; a name with a slash is a path from the top folder. All numbers are
floating-point numbers, so that a quotient is not cut off, and an empty cell is NULL. A text file (.txt, .md) has the
columns n (number of the line), line, and heading (the last Markdown heading before the line). Lines that begin with #
are comments: comment('voids.csv') is the first one. views.sql has the selections that several marks use, and
functions.py has the functions beside SQLite's own.
"""
import csv
import functools
import re
import sqlite3
from pathlib import Path

from pages import numbers
from pages.functions import AGGREGATES, FUNCTIONS, Refused, path

VIEWS = Path(__file__).with_name("views.sql")
FILE = re.compile(r'"([^"\s]+\.(?:csv|txt|md))"')
FACTS = re.compile(r"\b(comment|asserted)\(")  # functions that read a file
NAMES = ("commit", "sha256", "version", "cgal", "hdf5", "itk", "fmt")  # columns whose cells may look like numbers


def cell(text):
    """Returns a number if the text of a cell is one, None if it is empty, otherwise the text (also "+1.7")."""
    if not text:
        return None
    try:
        return text if text.startswith("+") else float(text)
    except ValueError:
        return text


class Results:
    """The database. Files are read when a query names them first."""

    def __init__(self):
        self.base, self.files, self.said, self.answers = sqlite3.connect(":memory:"), set(), None, {}
        for name, function in FUNCTIONS.items():
            self.base.create_function(name, -1, self.reporting(function), deterministic=True)
        for name, kind in AGGREGATES.items():
            methods = {"finalize": self.reporting(kind.finalize)}
            self.base.create_aggregate(name, -1, type(kind.__name__, (kind,), methods))
        self.base.executescript(VIEWS.read_text(encoding="utf-8"))
        self.of_view = {}  # view: the files that it reads
        for name, query in self.base.execute("SELECT name, sql FROM sqlite_schema WHERE type = 'view'"):
            self.of_view[name] = self.files_of(query)

    def reporting(self, function):
        """Returns a function of the database that keeps the message of an exception, which SQLite does not show."""
        def call(*values):
            try:
                return function(*values)
            except Exception as error:
                self.said = str(error) if isinstance(error, LookupError) else f"{type(error).__name__}: {error}"
                raise
        return call

    def load(self, name):
        """Reads the file `name` into the table with this name."""
        lines = path(name).read_text(encoding="utf-8").splitlines()
        if not name.endswith(".md"):
            lines = [line for line in lines if not line.startswith("#")]
        if name.endswith(".csv"):
            heads, *rows = csv.reader(line for line in lines if line)
            if wrong := [row for row in rows if len(row) != len(heads)]:
                raise Refused(f"{name} has {len(heads)} columns, and a row of {len(wrong[0])}: {wrong[0]}")
            rows = [[text if head in NAMES else cell(text) for head, text in zip(heads, row)] for row in rows]
        else:
            heads, rows, heading = ("n", "line", "heading"), [], None
            for n, line in enumerate(lines):
                heading = line.lstrip("#").strip() if line.startswith("#") else heading
                rows.append((float(n), line.rstrip(), heading))
        self.add(name, heads, rows)

    def add(self, name, heads, rows):
        """Makes a table, or adds rows to one."""
        if name not in self.files:
            self.base.execute(f'CREATE TABLE "{name}" ({", ".join(f"[{head}]" for head in heads)})')
            self.files.add(name)
        self.base.executemany(f'INSERT INTO "{name}" VALUES ({", ".join("?" for _ in heads)})', rows)
        self.answers.clear()

    def files_of(self, query):
        """Returns the names of the files that a query reads, also through views."""
        views = (files for view, files in self.of_view.items() if re.search(rf"\b{view}\b", query))
        return set(FILE.findall(query)).union(*views)

    def reads_results(self, query):
        """Returns whether a query reads a committed file. A query that is only a typed number does not."""
        return bool(self.files_of(query) or FACTS.search(query))

    def ask(self, query):
        """Returns heads and rows of a query. Raises Refused, with the reason, if it has no answer."""
        if query not in self.answers:
            for name in sorted(self.files_of(query) - self.files):
                self.load(name)
            self.said = None
            try:
                found = self.base.execute(query)
                self.answers[query] = [column[0] for column in found.description], found.fetchall()
            except sqlite3.Error as error:
                raise Refused(self.said or str(error)) from None
        return self.answers[query]

    def value(self, query):
        """Returns the text of a query with one row and one column."""
        _, rows = self.ask("SELECT " + query)
        if len(rows) != 1 or len(rows[0]) != 1 or rows[0][0] is None:
            raise Refused(f"{len(rows)} rows of {len(rows[0]) if rows else 0} columns where one value is expected"
                          if len(rows) != 1 or len(rows[0]) != 1 else "no value")
        return numbers.shown(rows[0][0])

    def rows(self, query):
        """Returns heads and rows of a query that has rows."""
        heads, rows = self.ask(query)
        if not rows:
            raise Refused("no rows")
        return heads, rows

    def table(self, query):
        """Returns the lines of a Markdown table. A head that ends with a colon aligns its column to the right."""
        heads, rows = self.rows(query)
        return numbers.table([head.removesuffix(":") for head in heads], [map(numbers.shown, row) for row in rows],
                             [k for k, head in enumerate(heads) if head.endswith(":")])

    def turned(self, query):
        """Returns the lines of a Markdown table whose columns are the rows of the query. The first head is its corner."""
        (corner, *names), rows = self.rows(query)
        heads = [corner.removesuffix(":"), *(numbers.shown(row[0]) for row in rows)]
        lines = [[name, *(numbers.shown(row[k]) for row in rows)] for k, name in enumerate(names, 1)]
        return numbers.table(heads, lines, range(1, len(heads)) if corner.endswith(":") else ())

    def copy(self, query):
        """Returns the rows of a query with one column as lines."""
        _, rows = self.rows(query)
        return [numbers.shown(row[0]) for row in rows]

    def lines(self, query):
        """Returns the rows of a query with one column as lines of preformatted text."""
        return [f"    {line}".rstrip() for line in self.copy(query)]


@functools.cache
def committed():
    """Returns the database of the committed results."""
    return Results()
