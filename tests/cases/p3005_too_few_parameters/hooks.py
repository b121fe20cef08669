def pollinate(*, dose):
    return dose


def find_blooms(mission):
    return None
