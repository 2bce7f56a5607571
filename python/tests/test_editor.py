"""Axes that follow edits."""

import medial
import numpy as np
import pytest

ROOM = [(0, 0), (9, 0), (9, 2), (5, 2), (5, 4), (0, 4)]


def test_an_edited_axis_is_the_one_that_is_computed():
    editor = medial.Editor(ROOM)
    editor.move(3, (5.5, 1.5))
    vertex = editor.insert(0, (4, -1)).vertex
    editor.move(vertex, (4.5, -0.5))
    editor.remove(1)
    again = medial.axis(editor.axis.shape)
    assert editor.axis.verify().passed
    assert len(editor.axis.edges) == len(again.edges)
    assert editor.axis.length == pytest.approx(again.length, rel=1e-12)


def test_a_change_names_what_has_changed():
    editor = medial.Editor([(0, 0), (24, 0)] + [(x, 5 + x % 2) for x in range(24, -1, -1)])
    first = editor.axis
    change = editor.move(6, (20.25, 5.125))
    assert not change.everything
    assert len(first.edges) - len(change.removed_edges) + len(change.added_edges) == len(editor.axis.edges)
    edges = editor.edges(change.added_edges)
    assert np.isin(change.added_nodes, edges["node"]).all()
    assert (editor.nodes(edges["node"])["radius"] >= 0).all()
    assert len(editor.sites(edges["site"])) == 2 * len(edges)
    editor.undo()
    assert len(editor.axis.edges) == len(first.edges)


def test_edits_that_are_refused_change_nothing():
    editor = medial.Editor(ROOM)
    with pytest.raises(medial.MedialError) as refused:
        editor.move(0, (7, 3))
    assert refused.value.code == "crossing"
    assert refused.value.point is not None
    assert editor.vertex(0) == (0, 0)
    with pytest.raises(medial.MedialError, match="no such vertex"):
        editor.remove(77)
    with pytest.raises(IndexError):
        editor.nodes([999])
    with pytest.raises(medial.MedialError, match="integers"):
        editor.nodes([0.5])
    assert len(editor.nodes([])) == 0
    with pytest.raises(medial.MedialError):
        editor.move(1, "no")
    other = editor.copy()
    other.move(0, (-1, -1))
    assert editor.vertex(0) == (0, 0)


def test_loops_and_arcs_follow():
    editor = medial.Editor(ROOM)
    hole = editor.insert_loop([(1, 1), (2, 1), (2, 2), (1, 2), (1, 1)]).vertex
    editor.move_loop(hole + 1, (0.5, 0.25))
    assert editor.vertex(hole) == (1.5, 1.25)
    editor.set_bulge(1, 0.25)
    assert editor.bulge(1) == 0.25
    circle = editor.insert_loop([(3.0, 0.5), (3.5, 0.5)], bulges=[1, 1]).vertex
    again = medial.axis(editor.axis.shape)
    assert editor.axis.verify().passed
    assert len(editor.axis.edges) == len(again.edges)
    with pytest.raises(medial.MedialError) as refused:
        editor.move_loop(hole, (0, 2))
    assert refused.value.code == "crossing"
    editor.remove_loop(circle)
    editor.remove_loop(hole)
    assert editor.vertex(hole) is None
    for _ in range(6):
        editor.undo()
    assert editor.bulge(1) == 0
    with pytest.raises(medial.MedialError):
        editor.insert_loop("no")
