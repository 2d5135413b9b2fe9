#!/usr/bin/env python3
"""Checks the links in Markdown documents: each file that a document links to exists, and so does each heading.

    check_links.py FOLDER

Reads every .md file below FOLDER, but for folders that hold a CMakeCache.txt, folders whose names begin with a dot, and
FOLDER/tests/links, where a document has dead links on purpose. A path in backquotes that begins with a folder of FOLDER
and names a .md file counts as a link, too. Links to the web are not followed.
"""
import functools
import os
import pathlib
import re
import sys
import urllib.parse

FENCE = re.compile(r"^ {0,3}(```|~~~).*?^ {0,3}\1[`~]* *$", re.MULTILINE | re.DOTALL)
CODE = re.compile(r"`[^`\n]+`")
HEADING = re.compile(r"^ {0,3}#{1,6} +(.+?)[ #]*$", re.MULTILINE)
ANCHOR = re.compile(r"<a (?:id|name)=\"([^\"]+)\"")
LINK = re.compile(r"\]\(\s*<?([^)\s>]+)>?(?:\s+\"[^\"]*\")?\s*\)|^ {0,3}\[[^\]]+\]:\s*<?(\S+?)>?\s*$", re.MULTILINE)
NAMED = re.compile(r"`((?:[\w.-]+/)+[\w.-]+\.md)`")


def documents(root):
    for folder, folders, files in os.walk(root):
        path = pathlib.Path(folder)
        if path != root and ("CMakeCache.txt" in files or path.relative_to(root).as_posix() == "tests/links"):
            folders.clear()
            continue
        folders[:] = sorted(f for f in folders if not f.startswith("."))
        yield from (path / f for f in sorted(files) if f.endswith(".md"))


@functools.cache
def anchors(document):
    """Names of a document's headings, as GitHub and GitLab make them: in lower case, without punctuation, - for a space."""
    text = FENCE.sub("", document.read_text(encoding="utf-8"))
    found = set(ANCHOR.findall(text))
    for heading in HEADING.findall(text):
        heading = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading)
        name = re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")
        repeat, unique = 0, name
        while unique in found:
            repeat += 1
            unique = f"{name}-{repeat}"
        found.add(unique)
    return found


def blank(match):
    """Spaces and the line breaks of what was matched, so that what follows keeps its line."""
    return re.sub(r"[^\n]", " ", match.group())


def faults(root):
    """Yields a message for each link that leads nowhere, or one if there is no link at all."""
    count = 0
    for document in documents(root):
        text = FENCE.sub(blank, document.read_text(encoding="utf-8"))
        prose = CODE.sub(blank, text)
        links = [(m.start(), m.group(1) or m.group(2), document.parent) for m in LINK.finditer(prose)]
        links += [(m.start(), m.group(1), root) for m in NAMED.finditer(text) if (root / m.group(1).split("/")[0]).is_dir()]
        for position, link, base in sorted(links, key=lambda found: found[0]):
            if re.match(r"[a-z][a-z0-9+.-]*:", link):
                continue
            count += 1
            where = f"{document.relative_to(root).as_posix()}:{text.count(chr(10), 0, position) + 1}"
            path, _, fragment = urllib.parse.unquote(link).partition("#")
            target = (base / path) if path else document
            if not target.exists():
                yield f"{where}: {link} does not exist"
            elif fragment and target.suffix == ".md" and fragment not in anchors(target.resolve()):
                yield f"{where}: {path or document.name} has no heading #{fragment}"
    if not count:
        yield f"{root} has no document with a link"


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    found = list(faults(pathlib.Path(sys.argv[1]).resolve()))
    print("\n".join(found) if found else "Every link leads to a file and a heading.")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
