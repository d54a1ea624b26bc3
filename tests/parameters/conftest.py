from pathlib import Path

import pytest


@pytest.fixture(scope="session")
def shared_data():
    """Measured files of others, read in place; they do not come with the package."""
    folder = Path(__file__).resolve().parents[2].parent / "shared" / "data" / "bicycleparameters"
    if not folder.is_dir():
        pytest.skip("measured files of others are not here: ../shared/data/bicycleparameters does not exist")
    return folder
