from . import Verdict


def spray(drone, trip, context, *, dose):
    if dose > 1.0:
        return "too much"
    return dose


def find_blooms(mission, results) -> Verdict:
    return Verdict()
