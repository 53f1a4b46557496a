# SPDX-FileCopyrightText: The plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""public_headers.py FOLDER: every class, enumeration, function and constant that a header under FOLDER declares at
namespace scope, and every public function of such a class, has a `///` comment before it or behind it, stands in one
block, without a blank line, under one that has, or has its whole body on its line."""
import pathlib
import re
import sys

TYPE = re.compile(r"^(template .*)?(struct|class|enum class) \w+[^;]*$")
FUNCTION = re.compile(r"^(template .*|\[\[nodiscard\]\] |inline |constexpr |virtual |static |explicit )*[\w:<>,&* ]+[ &*]~?\w+\(")
CONSTANT = re.compile(r"^inline (constexpr|const) ")
# What its class or the language explains: special members, operators, overrides, and a body on the same line.
PLAIN = re.compile(r"override|= default|= delete|operator|~\w+\(|^(explicit )?\w+\(|\}$")


def declarations(text: str):
    """(line number, line, depth) of each declaration's first line: at namespace scope, or public in a class there."""
    lines = text.splitlines()
    public = True
    for number, line in enumerate(lines, 1):
        body = line.strip()
        indent = len(line) - len(line.lstrip())
        if body in ("public:", "private:", "protected:"):
            public = body == "public:"
        if indent == 0:
            if TYPE.match(line):
                public = not body.startswith("class")
                yield number, body
            elif CONSTANT.match(line) or (FUNCTION.match(line) and not line.endswith("}") and not line.startswith(("#", "//", "using", "namespace"))):
                yield number, body
        elif indent == 2 and public and FUNCTION.match(body) and not PLAIN.search(body) and not body.startswith(("//", "return")):
            yield number, body


def explained(lines: list[str], number: int) -> bool:
    if "///<" in lines[number - 1]:
        return True
    for line in reversed(lines[: number - 1]):
        body = line.strip()
        if body.startswith("///"):
            return True
        if not body or body.endswith("{") or body in ("public:", "private:"):
            return False
    return False


def remarks_on(name: str, text: str) -> tuple[int, list[str]]:
    lines = text.splitlines()
    found = list(declarations(text))
    return len(found), [f"{name}:{n}: no /// comment: {body}" for n, body in found if not explained(lines, n)]


def self_test() -> list[str]:
    """A check that cannot fail is none."""
    bare = "namespace a {\n\nstruct B {\n  int c;\n};\n\nint d(int e);\n\ninline constexpr int kF = 1;\n\n/// G.\nclass G {\n public:\n  void h();\n};\n}\n"
    count, remarks = remarks_on("self-test", bare)
    if (count, len(remarks)) != (5, 4):
        return [f"public_headers.py: sees {count} declarations and {len(remarks)} without a word, not 5 and 4"]
    told = re.sub(r"^( *)(struct|int d|inline|void)", r"\1/// Told.\n\1\2", bare, flags=re.M)
    return [f"public_headers.py: false remark: {r}" for r in remarks_on("self-test", told)[1]]


def main() -> int:
    folder = pathlib.Path(sys.argv[1])
    remarks, total, headers = self_test(), 0, sorted(folder.rglob("*.h"))
    for header in headers:
        count, more = remarks_on(str(header.relative_to(folder)), header.read_text())
        total += count
        remarks += more
    for remark in remarks:
        print(remark)
    print(f"{len(headers)} public headers, {total} declarations, {len(remarks)} remarks")
    return 1 if remarks or not total else 0


sys.exit(main())
