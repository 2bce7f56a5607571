"""The pictures of the reference pages: each script of pictures/ draws one with matplotlib."""

import pathlib
import re

HERE = pathlib.Path(__file__).resolve().parent
# `<!-- picture: PATH: CAPTION -->`, which is nothing where a page is read as it is.
PLACE = re.compile(r"<!-- picture: (\S+): (.*?) -->")


def draw(folder):
    """Draws NAME.png for each script NAME.py; nothing without matplotlib."""
    try:
        import matplotlib
    except ImportError as missing:
        print(f"pictures: none: {missing}")
        return
    matplotlib.use("agg")
    import matplotlib.pyplot as plt

    folder.mkdir(parents=True, exist_ok=True)
    for script in sorted((HERE / "pictures").glob("*.py")):
        try:
            exec(compile(script.read_text(), str(script), "exec"), {})
        except ImportError as missing:
            print(f"pictures: no {script.stem}: {missing}")
            continue
        plt.savefig(folder / f"{script.stem}.png", dpi=110, bbox_inches="tight")
        plt.close("all")


def show(page, root):
    """Puts pictures below `root` where the page names them, with the code of those that scripts draw."""

    def shown(place):
        path, caption = root / place[1], place[2]
        if not path.is_file():
            return ""
        up = "../" * (len(page.relative_to(root).parts) - 1)
        script = HERE / "pictures" / f"{path.stem}.py"
        picture = f"![{caption}]({up}{place[1]})\n\n*{caption}*"
        if path.parent.name != "pictures" or not script.is_file():
            return picture
        code = "".join(f"    {line}\n" for line in ["```python", *script.read_text().splitlines(), "```"])
        return f'{picture}\n\n??? note "The code of this picture"\n\n{code}'

    page.write_text(PLACE.sub(shown, page.read_text()))
