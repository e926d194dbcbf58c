# SPDX-License-Identifier: GPL-3.0-or-later
"""Finds marks in Markdown, which are the places that scripts/documents writes, and fills them. A mark names a function
of the document's module, which returns the text."""
import re

from pages.data import Missing

TABLE = re.compile(r"^( *)<!-- table (.+?) -->$")
END = re.compile(r"^ *<!-- end -->$")
VALUE = re.compile(r"<!--= (.+?) -->(.*?)<!--/-->")
BY_HAND = re.compile(r"^ *<!-- by hand: \S+( \S+){2,} -->$")  # a reason has three words or more
ANY = re.compile(r"<!--(=|/| *(table|end|by hand)\b)")
WITHIN = re.compile(r"<!--(?:(?!-->).)*?<!--", re.S)


def mark(function):
    """Decorator of functions whose name may be in a mark. Such a function returns text or, for a table, a list of
    lines."""
    function.is_mark = True
    return function


def functions(module):
    """Returns the functions for marks of a document's module and of its parts, by name."""
    return {name: f for part in (module, *getattr(module, "PARTS", ())) for name, f in vars(part).items()
            if getattr(f, "is_mark", False) and f.__module__ == part.__name__}


def compared(name, found, expected):
    """Returns messages for the lines of a page that differ from the expected ones."""
    found, expected, wrong = found.splitlines(), expected.splitlines(), []
    for k in range(max(len(found), len(expected))):
        here, there = (lines[k] if k < len(lines) else "no line" for lines in (found, expected))
        if here != there:
            wrong.append(f"{name}:{k + 1}: found '{here}', expected '{there}'")
    if len(wrong) > 20:
        wrong[20:] = [f"{name}: and {len(wrong) - 20} more lines"]
    return wrong


def hidden(name, text):
    """Returns messages for marks inside an HTML comment, which would be filled without being visible."""
    return [f"{name}:{text.count(chr(10), 0, m.start()) + 1}: a mark within an HTML comment"
            for m in WITHIN.finditer(text)]


def filled(module, modules, text, used, check):
    """Fills the marks of a document. Returns the new text; messages about faults, and about differences if `check` is
    set; the lines with the contents of tables removed; and the values written, each with its mark."""
    name, wrong, out, outside, written = module.DOCUMENT, hidden(module.DOCUMENT, text), [], [], {}
    lines, k = text.splitlines(), 0

    def made(what, number):
        words = what.split()
        of, _, function = words[0].rpartition(".")
        function = functions(modules.get(of, module) if of else module).get(function)
        if function is None or (of and of not in modules):
            wrong.append(f"{name}:{number}: mark '{what}': there is no such function in scripts/pages/")
            return None
        used.add(function)
        try:
            return function(*words[1:])
        except Missing as error:  # reported once, even if several marks need the file
            if not any(str(error) in line for line in wrong):
                wrong.append(f"{name}:{number}: {error}")
            return None
        except Exception as error:  # reported with the position of the mark
            wrong.append(f"{name}:{number}: mark '{what}': {type(error).__name__}: {error}")
            return None

    while k < len(lines):
        line, number = lines[k], k + 1
        if start := TABLE.match(line):
            end = next((j for j in range(k + 1, len(lines)) if END.match(lines[j])), None)
            if end is None or any(TABLE.match(other) for other in lines[k + 1:end]):
                wrong.append(f"{name}:{number}: '{line.strip()}' has no '<!-- end -->'")
                return text, wrong, lines, written
            body = made(start[2], number)
            if body is None:
                body = lines[k + 1:end]
            else:
                body = ["", *[(start[1] + row).rstrip() for row in body], ""]
                if check:
                    for j in range(max(len(body), end - k - 1)):
                        here = lines[k + 1 + j] if j < end - k - 1 else "no line"
                        there = body[j] if j < len(body) else "no line"
                        if here != there:
                            wrong.append(f"{name}:{number + 1 + j}: found '{here}', expected '{there}'")
            out += [line, *body, lines[end]]
            outside += [""] * (end - k + 1)
            k = end + 1
            continue

        def value(m):
            # Markdown takes a line that begins with a comment for HTML up to its end
            if not re.sub(r"^(\s|[-*>]\s|\d+\.\s)*", "", line[:m.start()]):
                wrong.append(f"{name}:{number}: a mark begins the line, which Markdown then takes for HTML")
            new = made(m[1], number)
            if new is None:
                return m[0]
            written[new] = m[1]
            if check and new != m[2]:
                wrong.append(f"{name}:{number}: mark '{m[1]}': found '{m[2]}', expected '{new}'")
            return f"<!--= {m[1]} -->{new}<!--/-->"

        out.append(VALUE.sub(value, line))
        if ANY.search(VALUE.sub("", line)) and not BY_HAND.match(line):
            wrong.append(f"{name}:{number}: a broken mark: '{line.strip()}'")
        outside.append(line)
        k += 1
    return "\n".join(out) + "\n", wrong, outside, written
