#!/usr/bin/env python3
"""Runs the notebooks of the gallery and writes them, with what they print and draw.

    gallery.py FOLDER

Each script of gallery/ becomes NAME.ipynb and NAME.md with pictures beside it. Fails if one fails.
"""

import base64
import pathlib
import re
import sys
import time

import nbclient
import nbformat

HERE = pathlib.Path(__file__).resolve().parent


def notebook_of(text):
    """Cells begin with a line `# %%`, or `# %% [markdown]` for text in comments."""
    notebook = nbformat.v4.new_notebook()
    for part in re.split(r"^# %%", text, flags=re.MULTILINE)[1:]:
        head, _, body = part.partition("\n")
        body = body.strip()
        if "[markdown]" in head:
            body = re.sub(r"^# ?", "", body, flags=re.MULTILINE)
            notebook.cells.append(nbformat.v4.new_markdown_cell(body))
        else:
            notebook.cells.append(nbformat.v4.new_code_cell(body))
    return notebook


def written(output, name, folder, count):
    """One output as Markdown."""
    if output.output_type == "stream":
        return f"```text\n{output.text.rstrip()}\n```\n"
    data = output.get("data", {})
    if "image/png" in data:
        picture = f"{name}-{count}.png"
        (folder / picture).write_bytes(base64.b64decode(data["image/png"]))
        return f"![{name}]({picture})\n"
    if "image/svg+xml" in data:
        return data["image/svg+xml"] + "\n"
    if "text/html" in data:
        html = re.sub(r"<style.*?</style>", "", data["text/html"], flags=re.DOTALL)
        return html.replace('<table border="1" class="dataframe">', "<table>").strip() + "\n"  # as the site's own
    return f"```text\n{data.get('text/plain', '').rstrip()}\n```\n"


def run(script, folder):
    notebook = notebook_of(script.read_text())
    nbclient.NotebookClient(notebook, timeout=300, kernel_name="python3").execute()
    nbformat.write(notebook, folder / f"{script.stem}.ipynb")
    parts, count = [], 0
    for cell in notebook.cells:
        if cell.cell_type == "markdown":
            parts.append(cell.source + "\n")
            continue
        parts.append(f"```python\n{cell.source}\n```\n")
        for output in cell.outputs:
            plain = output.get("data", {}).get("text/plain", "")
            if plain.startswith(("(np.float64(", "<Axes", "[<matplotlib")) and len(output.data) == 1:
                continue
            count += 1
            parts.append(written(output, script.stem, folder, count))
    parts.append(f"[The notebook]({script.stem}.ipynb)\n")
    (folder / f"{script.stem}.md").write_text("\n".join(parts))


def main():
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    for script in sorted((HERE / "gallery").glob("*.py")):
        begin = time.monotonic()
        run(script, folder)
        print(f"{script.stem}: {time.monotonic() - begin:.1f} s")


if __name__ == "__main__":
    main()
