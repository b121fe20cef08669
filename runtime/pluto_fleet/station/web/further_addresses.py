"""The table of the further addresses."""

from __future__ import annotations

from ..map.pictures import LARGEST, PICTURES
from . import map_changes, plan_library
from .further import JSON, Address, Addresses

FLOOR_PLAN = "/api/map/image"
LARGEST_BODIES = {FLOOR_PLAN: LARGEST}
"""The largest bodies in bytes, by the addresses at which they are larger than others."""

_JSON, _PICTURE = (JSON,), tuple(dict.fromkeys(PICTURES.values()))

FURTHER: Addresses = {
    "/api/map": {
        "GET": Address(do=map_changes.map_data),
        "PUT": Address(do=map_changes.change_map, media=_JSON),
    },
    FLOOR_PLAN: {"PUT": Address(do=map_changes.take_floor_plan, media=_PICTURE)},
    "/api/ways": {"POST": Address(do=map_changes.find_ways, media=_JSON)},
    "/api/plan/sweep": {"POST": Address(do=map_changes.sweep_area, media=_JSON)},
    "/api/plan/undo": {"POST": Address(do=plan_library.undo, media=_JSON)},
    "/api/plan/redo": {"POST": Address(do=plan_library.redo, media=_JSON)},
    "/api/plan/changes": {"GET": Address(do=plan_library.plan_changes)},
    "/api/plans": {
        "GET": Address(do=plan_library.saved_plans),
        "PUT": Address(do=plan_library.save_plan, media=_JSON),
        "DELETE": Address(do=plan_library.delete_plan),
    },
    "/api/plans/open": {"POST": Address(do=plan_library.open_plan, media=_JSON)},
    "/api/plans/restore": {"POST": Address(do=plan_library.restore_plan, media=_JSON)},
}
