import pytest
from hypothesis import HealthCheck, settings

settings.register_profile("medial", deadline=None, suppress_health_check=list(HealthCheck))
settings.load_profile("medial")


@pytest.fixture
def rectangle():
    return [(0.0, 0.0), (4.0, 0.0), (4.0, 2.0), (0.0, 2.0)]


@pytest.fixture
def plan():
    """A room with a column."""
    return {
        "type": "Polygon",
        "coordinates": [
            [(0, 0), (10, 0), (10, 6), (0, 6), (0, 0)],
            [(4, 2), (4, 4), (6, 4), (6, 2), (4, 2)],
        ],
    }
