"""The snippets of the documentation run; those of the page "In five lines" have five lines at most."""

import pathlib
import re

import numpy as np
import pytest

PAGE = pathlib.Path(__file__).parent.parent / "docs" / "five_lines.md"


@pytest.fixture
def files(tmp_path, monkeypatch):
    geopandas = pytest.importorskip("geopandas")
    io = pytest.importorskip("skimage.io")
    pytest.importorskip("networkx")
    shapely = pytest.importorskip("shapely")
    pytest.importorskip("matplotlib").use("agg")
    river = shapely.LineString([(0, 0), (300, 80), (600, 0)]).buffer(20)
    geopandas.GeoDataFrame({"name": ["a"]}, geometry=[river], crs=2056).to_file(tmp_path / "rivers.gpkg")
    streets = [shapely.LineString(line).buffer(3) for line in ([(0, 0), (90, 0)], [(40, -50), (40, 60)], [(0, 30), (90, 40)])]
    geopandas.GeoDataFrame({"name": list("abc")}, geometry=streets, crs=2056).to_file(tmp_path / "roads.gpkg")
    image = np.zeros((80, 200), np.uint8)
    for i in range(5):
        image[10 : 70 - 5 * i, 10 + 40 * i : 25 + 40 * i] = 255
    io.imsave(tmp_path / "cells.png", image, check_contrast=False)
    buildings = [shapely.box(0, 0, 9, 4), shapely.box(20, 0, 24, 9)]
    geopandas.GeoDataFrame(geometry=buildings, crs=2056).to_file(tmp_path / "buildings.gpkg")
    font = pytest.importorskip("matplotlib.font_manager").findfont("DejaVu Serif")
    (tmp_path / "DejaVuSerif.ttf").symlink_to(font)
    pytest.importorskip("ezdxf")
    (tmp_path / "plate.dxf").symlink_to(PAGE.parents[2] / "data" / "plate.dxf")
    (tmp_path / "plan.wkt").write_text("POLYGON ((0 0, 10 0, 10 6, 0 6, 0 0), (4 2, 4 4, 6 4, 6 2, 4 2))")
    monkeypatch.chdir(tmp_path)


def snippets_of(page):
    if not page.is_file():
        pytest.skip("the documentation is elsewhere")
    return re.findall(r"```python\n(.*?)```", page.read_text(), re.DOTALL)


PAGES = "../README tutorial how_to/carving how_to/letters how_to/rivers how_to/roads how_to/robot how_to/vessels"


@pytest.mark.parametrize("name", PAGES.split())
def test_pages_run_as_they_stand(files, name):
    page = PAGE.parent / f"{name}.md"
    names: dict[str, object] = {}
    for snippet in snippets_of(page):
        exec(compile(snippet, str(page), "exec"), names)


def test_five_lines(files):
    snippets = snippets_of(PAGE)
    assert len(snippets) == 5 and all(snippet.count("\n") <= 5 for snippet in snippets)
    made = []
    for snippet in snippets:
        names: dict[str, object] = {}
        exec(compile(snippet, str(PAGE), "exec"), names)
        made.append(names)
    river, roads, cells, text, plan = made
    lines = river["lines"]
    assert lines.crs.to_epsg() == 2056 and lines.geometry[0].geom_type == "LineString"
    assert lines["mean"][0] == pytest.approx(40, rel=0.02) and lines["length"][0] > 600
    assert len(roads["way"]) >= 4 and roads["way"][0] == roads["first"]
    assert sorted(cells["widths"]) == [1, 2, 3, 4, 5] and cells["widths"][1] == pytest.approx(15, abs=1.5)
    assert pathlib.Path("axis.nc").read_text().count("\n") > 100 and text["carving"].deepest <= 4
    assert np.nanmax(plan["clearance"]) == pytest.approx(2, abs=0.05)
