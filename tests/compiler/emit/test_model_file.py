"""What `model.py` leaves out goes without saying: for the language, and for the runtime."""

from __future__ import annotations

from dataclasses import fields

from plutoc.graph.categories import PARAMS
from plutoc_runtime.domain.model import Category


def test_a_category_that_is_left_at_its_defaults_means_the_same_to_the_runtime() -> None:
    """The compiler writes what differs from the language's defaults; the runtime has its own."""
    runtimes = {field.name: field.default for field in fields(Category)}
    assert {param.name: param.default for param in PARAMS} == {
        param.name: runtimes[param.name] for param in PARAMS
    }
