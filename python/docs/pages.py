#!/usr/bin/env python3
"""Lays out the pages of the site for MkDocs: those of Python, the gallery, those of the project.

    pages.py GALLERY FOLDER

Pages keep their places relative to each other. A link to a file that is no page becomes plain text.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys

import show_pictures

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
LINK = re.compile(r"(!?)\[((?:[^\[\]]|\[[^\]]*\])*)\]\(([^)\s]+)\)")
REFERENCE = "axes editor arrays parts lines offsets features voronoi images files geopandas spark errors".split()
MADE = {"medial.1": "manual.md", "../include/medial/": "headers.md"}  # by write_reference()
PROJECT = ["docs/*.md", "bench/RESULTS.md", "bench/results/*.md", "CHANGELOG.md", "KNOWN_ISSUES.md", "ARCHITECTURE.md"]


def copy_pages(gallery, pages):
    for pattern in PROJECT:
        for path in ROOT.glob(pattern):
            target = pages / path.relative_to(ROOT)
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(path, target)
    shutil.copytree(ROOT / "docs" / "img", pages / "docs" / "img")
    for path in HERE.rglob("*.md"):
        target = pages / "python" / path.relative_to(HERE)
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(path, target)
    shutil.copytree(gallery, pages / "python" / "gallery")
    home = (HERE / "index.md").read_text().replace("](../", "](").replace("](tut", "](python/tut")
    home = re.sub(r"\]\((how_to|gallery|reference|images|five_lines)", r"](python/\1", home)
    (pages / "index.md").write_text(home)
    (pages / "python" / "index.md").unlink()


def write_reference(folder):
    """The manual, and the public headers, which hold the contract of each function of the library."""
    headers = ROOT / "include" / "medial"
    parts = ["# Headers of the C++ library\n"]
    for header in sorted(headers.rglob("*.h")):
        parts.append(f"## {header.relative_to(headers.parent)}\n\n```cpp\n{header.read_text()}```\n")
    (folder / "headers.md").write_text("\n".join(parts))
    source = ROOT / "docs" / "medial.1"
    manual = subprocess.run(["man", "--nj", "--nh", "-l", source], env={**os.environ, "MANWIDTH": "80"}, text=True,
                            check=False, capture_output=True)  # fmt: skip
    text = re.sub(".\b", "", manual.stdout) or source.read_text()  # bold letters are struck twice
    (folder / "manual.md").write_text(f"# Manual of the command line\n\n```text\n{text}```\n")


def mend_links(pages):
    for page in pages.rglob("*.md"):
        def mended(link, page=page):
            picture, text, target = link.groups()
            target = target.replace("python/docs/", "python/")  # where copy_pages() puts it
            file = target.split("#")[0]
            if re.match(r"[a-z]+:", target) or not file or (page.parent / file).is_file():
                return f"{picture}[{text}]({target})"
            if target in MADE:
                return f"[{text}]({MADE[target]})"
            return "" if picture else text

        page.write_text(LINK.sub(mended, page.read_text()))


def titled(path, pages):
    found = re.search(r"^# (.+)$", path.read_text(), re.MULTILINE)
    title = found[1].replace('"', "'").replace("`", "") if found else path.stem
    return f'"{title}": {path.relative_to(pages)}'


def settings(pages):
    def listed(*patterns):
        found = [path for pattern in patterns for path in sorted(pages.glob(pattern))]
        return "".join(f"      - {titled(path, pages)}\n" for path in found)

    return f"""site_name: medial
docs_dir: pages
use_directory_urls: false
theme:
  name: material
  font: false
  features: [navigation.tabs, navigation.top, content.code.copy]
  palette: {{ primary: indigo }}
markdown_extensions: [admonition, attr_list, md_in_html, tables, toc, pymdownx.superfences, pymdownx.details, pymdownx.highlight]
plugins:
  - search
  - mkdocstrings:
      handlers:
        python:
          options: {{ docstring_style: numpy, show_root_heading: true, heading_level: 3, show_source: false,
                     members_order: source, show_signature_annotations: false, separate_signature: true,
                     line_length: 88, docstring_section_style: list }}
validation: {{ links: {{ not_found: warn, anchors: warn, unrecognized_links: info }}, nav: {{ omitted_files: info }} }}
nav:
  - Home: index.md
  - Python:
      - Tutorial: python/tutorial.md
      - In five lines: python/five_lines.md
      - Images: python/images.md
      - Installing: python/install.md
  - Reference:
      - Contents: python/reference.md
{listed(*(f"python/reference/{name}.md" for name in REFERENCE))}  - How to:
{listed("python/how_to/*.md")}  - Gallery:
{listed("python/gallery/*.md")}  - Command line and C++:
{listed("docs/README.md", "docs/[!R]*.md")}  - Project:
      - Architecture: ARCHITECTURE.md
      - Changelog: CHANGELOG.md
      - Known issues: KNOWN_ISSUES.md
      - Measurements: bench/RESULTS.md
{listed("bench/results/*.md")}"""


def main():
    gallery, folder = map(pathlib.Path, sys.argv[1:])
    pages = folder / "pages"
    shutil.rmtree(folder, ignore_errors=True)
    pages.mkdir(parents=True)
    copy_pages(gallery, pages)
    show_pictures.draw(pages / "python" / "pictures")
    for page in (pages / "python").rglob("*.md"):
        show_pictures.show(page, pages / "python")
    mend_links(pages)
    write_reference(pages / "docs")
    (folder / "mkdocs.yml").write_text(settings(pages))


if __name__ == "__main__":
    main()
