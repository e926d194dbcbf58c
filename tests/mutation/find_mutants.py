# SPDX-License-Identifier: GPL-3.0-or-later
"""Finds the places in the sources for mutants: operators and statements of functions, as clang parses them."""
import collections
import json
from pathlib import Path

from clang import cindex
from clang.cindex import CursorKind as Kind
from clang.cindex import TypeKind

OTHER = {"<": "<=", "<=": "<", ">": ">=", ">=": ">", "==": "!=", "!=": "==", "+": "-", "-": "+", "*": "/", "/": "*",
         "&&": "||", "||": "&&", "+=": "-=", "-=": "+=", "*=": "/=", "/=": "*=", "%": "*"}
NUMBERS = {TypeKind.BOOL, TypeKind.INT, TypeKind.UINT, TypeKind.LONG, TypeKind.ULONG, TypeKind.LONGLONG, TypeKind.ULONGLONG,
           TypeKind.SHORT, TypeKind.USHORT, TypeKind.CHAR_S, TypeKind.UCHAR, TypeKind.SCHAR, TypeKind.FLOAT, TypeKind.DOUBLE,
           TypeKind.DEPENDENT, TypeKind.UNEXPOSED}
KEPT = ("-I", "-D", "-std", "-isystem", "-include", "-fopenmp", "-march")

# text: code at [begin, end) of the file; mutated: code that replaces it
Mutant = collections.namedtuple("Mutant", "file line begin end what text mutated")


def arguments_of(command):
    words, out = command.split(), []
    for k, word in enumerate(words[1:-1]):
        if word.startswith(KEPT):
            out.append(word)
            if word in ("-I", "-isystem", "-include"):
                out.append(words[k + 2])
    return out


def find(commands, root, told=print):
    """Returns every mutant of the sources in host/ and kernels/ that a build compiles. `commands` is the file
    compile_commands.json that CMake writes."""
    entries = [e for e in json.loads(Path(commands).read_text()) if "/tests/" not in e["file"] and "/bench/" not in e["file"]]
    found, texts = {}, {}
    index = cindex.Index.create()
    for k, entry in enumerate(entries):
        unit = index.parse(entry["file"], arguments_of(entry["command"]))
        told(f"{k + 1}/{len(entries)} {entry['file']}: {len(found)} places", flush=True)
        for cursor in unit.cursor.get_children():
            walk(cursor, root, texts, found, inside=False)
    return [found[k] for k in sorted(found)]


def ours(cursor, root, texts):
    file = cursor.location.file
    if file is None:
        return None
    name = file.name
    if name not in texts:
        path = Path(name).resolve()
        good = root in path.parents and path.relative_to(root).parts[0] in ("host", "kernels") and ".cu" not in path.name
        texts[name] = (str(path.relative_to(root)), path.read_bytes()) if good else None
    return texts[name]


def kind_of(cursor):
    try:
        return cursor.kind
    except ValueError:  # a kind that is newer than the Python package
        return None


def walk(cursor, root, texts, found, inside):
    kind = kind_of(cursor)
    if kind in (Kind.STATIC_ASSERT, Kind.ENUM_DECL, Kind.TEMPLATE_NON_TYPE_PARAMETER, Kind.CASE_STMT):
        return
    here = ours(cursor, root, texts) if kind != Kind.NAMESPACE else True
    if here is None:
        return
    if kind == Kind.COMPOUND_STMT:
        inside = True
    if kind == Kind.VAR_DECL and any(t.spelling == "constexpr" for t in list(cursor.get_tokens())[:3]):
        return
    if inside and here is not True:
        mutant = mutant_at(cursor, *here)
        if mutant:
            found.setdefault((mutant.file, mutant.begin, mutant.end), mutant)
    children = list(cursor.get_children())
    for child in children:
        if inside and kind == Kind.COMPOUND_STMT and kind_of(child) == Kind.CALL_EXPR and here is not True:
            mutant = without(child, *here)
            if mutant:
                found.setdefault((mutant.file, mutant.begin, mutant.end), mutant)
        walk(child, root, texts, found, inside)


def span(cursor, text):
    begin, end = cursor.extent.start, cursor.extent.end
    same = begin.file and end.file and begin.file.name == end.file.name
    return (begin.offset, end.offset) if same and begin.offset < end.offset <= len(text) else None


def plain(piece):
    """Returns whether a piece of code is short and may be written twice: no lambdas, comments, or macros of several lines."""
    return len(piece) < 160 and not any(mark in piece for mark in ("[&", "[=", "[]", "//", "\n#", "{", ";"))


def mutant_at(cursor, file, text):
    if kind_of(cursor) not in (Kind.BINARY_OPERATOR, Kind.COMPOUND_ASSIGNMENT_OPERATOR):
        return None
    children = list(cursor.get_children())
    if len(children) != 2:
        return None
    whole, left, right = span(cursor, text), span(children[0], text), span(children[1], text)
    if not whole or not left or not right or not whole[0] <= left[0] < left[1] <= right[0] < right[1] <= whole[1]:
        return None
    operator = text[left[1]:right[0]].decode().strip()
    kinds = {child.type.get_canonical().kind for child in children}
    if operator not in OTHER or not kinds <= NUMBERS:
        return None
    a, b = text[left[0]:left[1]].decode(), text[right[0]:right[1]].decode()
    if not plain(a) or not plain(b) or text[whole[0]:whole[1]] != text[left[0]:right[1]]:
        return None
    mutated = f"({a} {OTHER[operator]} {b})"
    return Mutant(file, cursor.location.line, *whole, f"{operator} → {OTHER[operator]}", f"{a} {operator} {b}",
                  f"(::mutation::on(@) ? {mutated} : ({a} {operator} {b}))")


def without(cursor, file, text):
    """Returns the mutant that leaves out a call whose result is not used, or None."""
    whole = span(cursor, text)
    if not whole or text[whole[1]:whole[1] + 1] != b";":
        return None
    piece = text[whole[0]:whole[1]].decode()
    before = text[:whole[0]].rstrip()[-1:]
    if not plain(piece) or before not in b";{}" or piece.startswith(("return", "delete", "throw")):
        return None
    return Mutant(file, cursor.location.line, *whole, "left out", piece, f"if (!::mutation::on(@)) {piece}")
