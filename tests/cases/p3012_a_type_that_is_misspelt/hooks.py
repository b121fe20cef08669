from . import Mission, Results, Verdict


def find_blooms(mission: Misson, results: Results) -> Verdict:
    return Verdict(ok=True)
