from . import Verdict


def spray(drone, trip, context, *, dose) -> str:
    return str(dose)


def find_blooms(mission, results) -> Verdict:
    return Verdict()
