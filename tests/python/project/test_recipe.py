"""The conda recipe says what pyproject.toml says."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path
from typing import Any

import pytest
import yaml

import pyrod

ROOT = Path(__file__).parents[3]
RECIPE: dict[str, Any] = yaml.safe_load((ROOT / "recipe" / "recipe.yaml").read_text())
PYPROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())
PROJECT = PYPROJECT["project"]


def names(requirements: list[str]) -> set[str]:
    return {re.split(r"[ <>=]", requirement)[0] for requirement in requirements}


def spaced(requirement: str) -> str:
    """As conda writes it: name, space, version."""
    return re.sub(r"(?<=\w)(?=[<>=])", " ", requirement)


def test_it_names_the_same_package() -> None:
    assert RECIPE["schema_version"] == 1
    assert RECIPE["package"]["name"] == PROJECT["name"]
    assert RECIPE["context"]["version"] == pyrod.__version__
    assert RECIPE["about"]["summary"] == PROJECT["description"]


def test_it_is_for_the_same_pythons() -> None:
    assert f">={RECIPE['context']['python_min']}" == PROJECT["requires-python"]
    assert 'match(python, "<" ~ python_min)' in RECIPE["build"]["skip"]


def test_it_builds_with_the_same_tools() -> None:
    host = RECIPE["requirements"]["host"]
    for requirement in PYPROJECT["build-system"]["requires"]:
        assert spaced(requirement) in host


def test_it_has_what_cmake_looks_for() -> None:
    sought = (ROOT / "CMakeLists.txt").read_text()
    assert "Eigen3_VERSION VERSION_LESS 3.4" in sought
    assert "find_package(CHOLMOD" in sought
    assert {"eigen >=3.4", "suitesparse", "python", "pip"} <= set(RECIPE["requirements"]["host"])
    least = re.search(r"cmake_minimum_required\(VERSION ([\d.]+)\)", sought)
    assert least
    assert f"cmake >={least[1]}" in RECIPE["requirements"]["build"]


def test_it_needs_the_same_at_run_time() -> None:
    """eigen and suitesparse bring what they need of themselves at run time."""
    assert names(RECIPE["requirements"]["run"]) == {"python", *names(PROJECT["dependencies"])}


def test_licences_are_those_of_what_is_compiled_in() -> None:
    about = RECIPE["about"]
    assert about["license"].split(" AND ")[0] == PROJECT["license"]
    assert "LICENSE" in about["license_file"]
    for file in about["license_file"]:
        assert (ROOT / file).is_file()


@pytest.mark.parametrize("path", ["pyrod --help", "--cmakedir", "build/cantilever"])
def test_it_tries_what_it_built(path: str) -> None:
    scripts = [line for test in RECIPE["tests"] for line in test.get("script", [])]
    assert any(path in line for line in scripts)


def test_it_imports_what_is_there() -> None:
    (python,) = [test["python"] for test in RECIPE["tests"] if "python" in test]
    assert "pyrod" in python["imports"]
    for module in python["imports"]:
        __import__(module)
