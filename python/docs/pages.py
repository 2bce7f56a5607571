#!/usr/bin/env python3
"""Lays out the pages of the site for MkDocs: those of Python, the gallery, those of the project.

    pages.py GALLERY FOLDER

Pages keep their places relative to each other. A link to a file that is no page becomes plain text.
"""

import pathlib
import re
import shutil
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
LINK = re.compile(r"(!?)\[((?:[^\[\]]|\[[^\]]*\])*)\]\(([^)\s]+)\)")
PROJECT = ["docs/*.md", "bench/RESULTS.md", "CHANGELOG.md", "KNOWN_ISSUES.md", "ARCHITECTURE.md"]


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


def picture_of_skeletons(folder):
    """A picture of skeletons by scikit-image and here, side by side."""
    import matplotlib

    matplotlib.use("agg")
    import matplotlib.pyplot as plt
    import numpy as np
    from skimage import data, morphology

    import medial.image

    horse = ~data.horse()
    pairs = [
        ("scikit-image medial_axis", morphology.medial_axis(horse)),
        ("medial.image.medial_axis", medial.image.medial_axis(horse)),
        ("scikit-image skeletonize", morphology.skeletonize(horse)),
        ("medial.image.skeletonize", medial.image.skeletonize(horse)),
    ]
    figure, axes = plt.subplots(2, 2, figsize=(9, 7.6))
    for ax, (title, skeleton) in zip(axes.flat, pairs, strict=True):
        ax.imshow(np.where(horse, 0.88, 1), cmap="gray", vmin=0, vmax=1)
        y, x = np.nonzero(skeleton)
        ax.plot(x, y, "s", markersize=0.9, color="#b02010")
        ax.set_title(title)
        ax.set_axis_off()
    figure.tight_layout()
    figure.savefig(folder / "skeletons.png", dpi=110)


def mend_links(pages):
    for page in pages.rglob("*.md"):
        def mended(link, page=page):
            picture, text, target = link.groups()
            file = target.split("#")[0]
            if re.match(r"[a-z]+:", target) or not file or (page.parent / file).is_file():
                return link[0]
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
markdown_extensions: [admonition, attr_list, md_in_html, tables, toc, pymdownx.superfences, pymdownx.highlight]
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
      - Reference: python/reference.md
  - How to:
{listed("python/how_to/*.md")}  - Gallery:
{listed("python/gallery/*.md")}  - Command line and C++:
{listed("docs/README.md", "docs/[!R]*.md")}  - Project:
      - Architecture: ARCHITECTURE.md
      - Changelog: CHANGELOG.md
      - Known issues: KNOWN_ISSUES.md
      - Measurements: bench/RESULTS.md
"""


def main():
    gallery, folder = map(pathlib.Path, sys.argv[1:])
    pages = folder / "pages"
    shutil.rmtree(folder, ignore_errors=True)
    pages.mkdir(parents=True)
    copy_pages(gallery, pages)
    images = pages / "python" / "images.md"
    try:
        picture_of_skeletons(images.parent)
        picture = "![Skeletons of one image by both](skeletons.png)"
    except ImportError as missing:
        print(f"pages: no picture of skeletons: {missing}")
        picture = ""
    images.write_text(images.read_text().replace("@PICTURE@", picture))
    mend_links(pages)
    (folder / "mkdocs.yml").write_text(settings(pages))


if __name__ == "__main__":
    main()
