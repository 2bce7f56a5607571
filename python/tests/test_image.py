"""Images beside scikit-image."""

import inspect

import numpy as np
import pytest

import medial
from medial import image


@pytest.fixture
def horse():
    data = pytest.importorskip("skimage.data")
    return ~data.horse()


def test_skeletons_keep_the_topology(horse):
    morphology = pytest.importorskip("skimage.morphology")
    for make in (image.medial_axis, image.skeletonize, image.thin):
        ours = make(horse)
        assert ours.dtype == bool and ours.shape == horse.shape and not (ours & ~horse).any()
        assert image.topology(ours) == image.topology(horse)
    theirs = morphology.medial_axis(horse)
    assert morphology.medial_axis(horse).dtype == image.medial_axis(horse).dtype
    assert 0.5 < image.medial_axis(horse).sum() / theirs.sum() < 1.5


def test_distances_are_those_of_scipy(horse):
    ndimage = pytest.importorskip("scipy.ndimage")
    _, distance = image.medial_axis(horse, return_distance=True)
    assert np.array_equal(distance, ndimage.distance_transform_edt(horse))
    assert distance.dtype == np.float64


def test_masks_and_shapes():
    square = np.zeros((9, 9), np.uint8)
    square[1:-1, 1:-1] = 1
    mask = np.ones((9, 9), bool)
    mask[:, 5:] = False
    assert image.medial_axis(square, mask)[3, 7]
    with pytest.raises(ValueError):
        image.medial_axis(np.zeros((2, 2, 2)))
    with pytest.raises(ValueError):
        image.skeletonize(square, method="none")
    assert not image.medial_axis(np.zeros((5, 5))).any()
    assert image.medial_axis(np.zeros((0, 5))).shape == (0, 5)


def test_labels():
    labels = np.zeros((40, 60), int)
    labels[5:15, 5:45] = 2
    labels[20:38, 10:20] = 7
    for smooth in (True, False):
        axes = image.axis(labels, smooth=smooth, spacing=0.5, origin=(100, 200))
        assert list(axes) == [2, 7]
        nodes = axes[2].nodes
        deepest = nodes[nodes["radius"].argmax()]
        assert deepest["radius"] == pytest.approx(2.5, abs=0.3) and deepest["y"] == pytest.approx(205, abs=0.2)
        assert 100 < deepest["x"] < 125
    assert axes[7].branch_count <= 5


def test_outline():
    square = np.zeros((4, 4), bool)
    square[1:3, 1:3] = True
    (ring,) = image.outline(square)
    assert medial.Shape(ring).area == 4


@pytest.mark.parametrize("name", ["horse", "coins", "page", "text", "camera", "cell", "clock"])
def test_sample_images_of_scikit_image(name):
    data = pytest.importorskip("skimage.data")
    morphology = pytest.importorskip("skimage.morphology")
    try:
        picture = getattr(data, name)()
    except Exception as error:
        pytest.skip(f"the image is not there: {error}")
    shape = ~picture if picture.dtype == bool else picture > picture.mean()
    theirs, distance = morphology.medial_axis(shape, return_distance=True)
    ours, own_distance = image.medial_axis(shape, None, True)
    assert np.array_equal(distance, own_distance) and theirs.dtype == ours.dtype
    for make, other in ((image.medial_axis, theirs), (image.skeletonize, morphology.skeletonize(shape))):
        made = make(shape)
        assert image.topology(made) == image.topology(shape) and made.dtype == other.dtype
        assert 0.4 < made.sum() / other.sum() < 1.6
    assert np.array_equal(image.thin(shape, 2), morphology.thin(shape, 2))


def test_signatures_are_those_of_scikit_image():
    morphology = pytest.importorskip("skimage.morphology")
    for name in ("medial_axis", "skeletonize", "thin"):
        theirs = inspect.signature(getattr(morphology, name)).parameters.values()
        ours = inspect.signature(getattr(image, name)).parameters.values()
        assert [(p.name, p.kind, p.default) for p in theirs] == [(p.name, p.kind, p.default) for p in ours]
